"""The catalogue's effects as other textbooks write them."""

import math

import numpy as np

from benchmarks.blind_trial.generator.reducer import HOUR
from benchmarks.blind_trial.generator.truth import Truth, worn_places

UM = 1e-6
ARCSEC = math.pi / 648000.0
BOTH = ("transmission_error", "hysteresis", "vibration_order")
WEAR = ("wear_depth", "wear_profile")
PINS, LOBES = 40, 39
LEVER = 21e-3 * math.cos(math.radians(20.0))


class Clearance(Truth):
    """Races ground too wide: clearance of every bearing by its own size, 8 % scatter."""

    name, effect, blocks, quantities = "clearance of the needle bearings", "needle_clearance", ("te", "loops"), BOTH
    typical, low, high = 0.5 * UM, 0.01 * UM, 6 * UM

    def draw(self, rng):
        self.scatter = 0.08 * rng.standard_normal((2, 2))

    def parts(self, p, setting):
        p["roller_profile_error"][0] = (self.a * (1.0 + self.scatter))[..., None]

    def parameters(self):
        return {"needle_clearance_added": self.a * (1.0 + float(self.scatter.mean()))}


class RaceHollow(Truth):
    """Hollow of Gaussian shape worn into one kind of race before the campaign."""

    name, effect, blocks, quantities = "hollow in the raceways", "raceway_wear", ("te", "loops"), BOTH
    typical, low, high = 1.0 * UM, 0.02 * UM, 12 * UM

    def draw(self, rng):
        self.inner = bool(rng.random() < 0.5)
        self.width = math.radians(rng.uniform(28.0, 40.0))

    def surfaces(self, w, setting):
        race = "inner_race_wear" if self.inner else "outer_race_wear"
        bins = w[race].shape[-1]
        angle = (np.arange(bins) + 0.5) * 2.0 * math.pi / bins - worn_places()[0 if self.inner else 1]
        away = (angle + math.pi) % (2.0 * math.pi) - math.pi
        w[race][0] = self.a * np.exp(-0.5 * (away / self.width) ** 2)


class PinRing(Truth):
    """Pins out of place by a Fourier series over the ring, one harmonic dominant, 8 % of others and of scatter."""

    name, effect, blocks, quantities = "pin positions by harmonics", "pin_position_errors", ("te",), BOTH
    typical, low, high = 1.5 * UM, 0.05 * UM, 12 * UM

    def draw(self, rng):
        self.order = int(rng.integers(1, 4))
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.more = 0.08 * rng.standard_normal((2, 5))
        self.scatter = 0.05 * rng.standard_normal(PINS)

    def parts(self, p, setting):
        eta = 2.0 * math.pi * np.arange(PINS) / PINS
        radial = np.cos(self.order * eta - self.phase) + self.scatter
        for m in range(2, 7):
            radial += self.more[0, m - 2] * np.cos(m * eta) + self.more[1, m - 2] * np.sin(m * eta)
        p["pin_position_error_radial"][0] += self.a * radial
        if self.order == 1:
            p["pin_position_error_tangential"][0] -= self.a * np.sin(eta - self.phase)


class DiscTeeth(Truth):
    """Discs ground with a wandering centre: profile by harmonics, pitch as an integrated random walk."""

    name, effect, blocks, quantities = "disc teeth by harmonics", "disc_tooth_errors", ("te",), BOTH
    typical, low, high = 1.5 * UM, 0.05 * UM, 12 * UM

    def draw(self, rng):
        self.order = int(rng.integers(1, 3))
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.opposed = bool(rng.random() < 0.5) or self.order == 1
        self.more = 0.08 * rng.standard_normal(4)
        walk = np.cumsum(rng.standard_normal(LOBES))
        self.pitch = 0.05 * (walk - np.linspace(walk[0], walk[-1], LOBES))

    def parts(self, p, setting):
        place = 2.0 * math.pi * np.arange(LOBES) / LOBES
        for d in range(2):
            here = place + (math.pi * d if self.opposed else 0.0)
            gap = np.cos(self.order * here - self.phase)
            gap += self.more[0] * np.cos(3 * here) + self.more[1] * np.sin(3 * here) + self.more[2] * np.cos(5 * here + self.more[3])
            p["lobe_profile_error"][0, d] += self.a * gap
            p["lobe_pitch_error"][0, d] += 0.3 * self.a * self.pitch


class Relief(Truth):
    """Profile relieved by a larger grinding wheel on a smaller circle."""

    name, effect, blocks, quantities = "relieved profile", "profile_modification", ("loops", "te"), BOTH
    typical, low, high = 1.0 * UM, 0.02 * UM, 15 * UM

    def draw(self, rng):
        self.share = float(rng.uniform(0.3, 0.9))

    def parts(self, p, setting):
        p["equidistant_modification"] += self.a
        p["shift_modification"] -= self.share * self.a

    def parameters(self):
        return {"equidistant_added": self.a, "shift_added": -self.share * self.a}


class Lobe(Truth):
    """One lobe of a crank ground off centre, the others within a tenth of it."""

    name, effect, blocks, quantities = "crank lobe off centre", "crank_lobe_errors", ("te",), BOTH
    typical, low, high = 1.0 * UM, 0.02 * UM, 10 * UM

    def draw(self, rng):
        self.disc, self.crank = int(rng.integers(2)), int(rng.integers(2))
        self.others = 0.05 * rng.standard_normal((2, 2))
        self.turned = float(rng.choice([0.0, 0.5]))
        self.sign = float(rng.choice([-1.0, 1.0]))

    def parts(self, p, setting):
        shape = self.others.copy()
        shape[self.disc, self.crank] += self.sign
        p["crank_eccentricity_error"][0] += self.a * shape
        p["crank_phase_error"][0, self.disc, self.crank] += self.turned * self.a / 0.9e-3


class Hole(Truth):
    """One hole bored off its place, along the circle and a little radially."""

    name, effect, blocks, quantities = "hole off its place", "hole_position_errors", ("te",), BOTH
    typical, low, high = 1.0 * UM, 0.02 * UM, 12 * UM

    def draw(self, rng):
        self.disc, self.crank = int(rng.integers(2)), int(rng.integers(2))
        self.radial = float(rng.normal(0.0, 0.08))
        self.sign = float(rng.choice([-1.0, 1.0]))

    def parts(self, p, setting):
        p["disc_hole_error_tangential"][0, self.disc, self.crank] += self.sign * self.a
        p["disc_hole_error_radial"][0, self.disc, self.crank] += self.radial * self.a


class Flange(Truth):
    """Bolted flange in series: a spring that settles by a few percent under torque."""

    name, effect, blocks, quantities = "soft flange", "support_compliance", ("loops",), ("hysteresis",)
    typical, low, high = 5e-8, 1e-9, 1e-5

    def draw(self, rng):
        self.settle = float(rng.uniform(0.0, 0.05))

    def post(self, series, y, rows):
        torque = series.axes["torque"]
        change = self.a * torque * (1.0 - self.settle * np.abs(torque) / 250.0)
        return y + change - change.mean()


class PlanetRunout(Truth):
    """A planet off its centre: once per turn of the planet against the carrier, with a tenth of second harmonic."""

    name, effect, blocks, quantities = "planet off centre", "first_stage_error", ("te",), ("transmission_error",)
    typical, low, high = 3 * UM, 0.05 * UM, 60 * UM

    def draw(self, rng):
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.second = float(rng.uniform(0.02, 0.1))

    def post(self, series, y, rows):
        angle = series.axes["angle"]
        size = self.a / (2.0 * LEVER * LOBES)
        return y - size * (np.cos(40.0 * angle + self.phase) + self.second * np.cos(80.0 * angle + 2.0 * self.phase))


class TeethPlay(Truth):
    """Play of the sun's teeth, crossed smoothly within a newton metre or two (oil and friction)."""

    name, effect, blocks, quantities = "play of the first stage", "first_stage_error", ("loops",), ("hysteresis",)
    typical, low, high = 5 * UM, 0.1 * UM, 200 * UM

    def draw(self, rng):
        self.width = float(rng.uniform(0.3, 1.5))

    def post(self, series, y, rows):
        change = 0.5 * self.a / (LEVER * LOBES) * np.tanh(series.axes["torque"] / self.width)
        return y + change - change.mean()

    def parameters(self):
        return {"backlash": self.a}


class Warming(Truth):
    """Ring and discs of different temperature: the discs stay behind by a share that grows with warmth."""

    name, effect, blocks, quantities = "thermal gap of ring and discs", "thermal_expansion", ("loops", "te"), BOTH
    typical, low, high = 1e-6, 1e-8, 1.1e-5

    def draw(self, rng):
        self.curve = float(rng.uniform(0.0, 0.1))
        self.sign = 1.0

    def parts(self, p, setting):
        warm = setting.temperature - 293.15
        p["pin_position_error_radial"][0] += self.sign * self.a * 52e-3 * warm * (1.0 + self.curve * warm / 40.0)


def dahl(torque: np.ndarray, y: np.ndarray, share: float, least: float, way: float) -> np.ndarray:
    """A loop with Dahl's friction: the turning follows the torque less a force that grows with the way and
    saturates at ``share`` of the torque and ``least`` [N m]."""
    order = np.argsort(torque, kind="stable")
    grid, first = np.unique(torque[order], return_index=True)
    curve = y[order][first]
    slope = np.gradient(curve, grid)
    total, force, found = float(torque[0]), 0.0, np.zeros(len(torque))
    for i in range(len(torque)):
        step = torque[i] - torque[i - 1] if i else 0.0
        for _ in range(12):
            # In small steps: the spring's turning and the friction force move together.
            total += step / 12.0
            move = np.interp(total, grid, slope) * step / 12.0
            most = share * abs(total) + least
            rate = 1.0 - force / most * math.copysign(1.0, move)
            force = np.clip(force + most / way * move * rate, -most, most)
        found[i] = np.interp(total - force, grid, curve)
    return found - found.mean()


class DryFriction(Truth):
    """Stribeck curve of Gaussian form for the mesh as a whole; with the input held, Dahl's model."""

    name, effect, blocks, quantities = "friction with a velocity minimum", "stribeck_friction", ("torque",), ("input_torque", "hysteresis")
    typical, low, high = 0.01, 1e-5, 0.12

    def draw(self, rng):
        self.static = float(rng.uniform(0.5, 2.0))
        self.speed = float(rng.uniform(0.008, 0.05))
        self.viscous = float(rng.uniform(0.0, 0.6))
        self.way = 2e-5 * float(np.exp(rng.uniform(-0.5, 0.5)))

    def post(self, series, y, rows):
        if series.quantity == "hysteresis":
            most = self.a * (1.0 + self.static)
            return dahl(series.axes["torque"], y, 1.35 * most, 0.5 * most, self.way)
        speed = np.array([s.speed for s in rows])
        load = np.array([s.load for s in rows])
        v = 0.08 * speed / 209.4
        mu = self.a * (1.0 + self.static * np.exp(-((v / self.speed) ** 2)) + self.viscous * v)
        return y + mu * (1.45 * load / 0.052) * v / speed


class DahlLoop(DryFriction):
    """The same friction, shown by loops: Dahl's model; in the torque the Gaussian curve."""

    name, blocks = "Dahl friction in the loop", ("loops",)


class Drag(Truth):
    """Seals and grease: (speed)^0.7 and Vogel's viscosity to the power 0.7."""

    name, effect, blocks, quantities = "drag of seals and grease", "drag", ("torque",), ("input_torque",)
    typical, low, high = 0.02, 1e-5, 0.8

    def draw(self, rng):
        self.seal = float(rng.uniform(0.0, 0.6))

    def post(self, series, y, rows):
        speed = np.array([s.speed for s in rows])
        warm = np.array([s.temperature for s in rows]) - 273.15
        vogel = np.exp(880.0 / (warm + 105.0) - 880.0 / (20.0 + 105.0))
        return y + self.a * (self.seal + (1.0 - self.seal) * (speed / 209.44) ** 0.7 * vogel**0.7)


class Unbalance(Truth):
    """Centrifugal force of the cranks on soft mounts, with a trace of second harmonic."""

    name, effect, blocks, quantities = "unbalance", "unbalance", ("vibration",), ("vibration_order",)
    typical, low, high = 1e-5, 1e-8, 1e-2

    def draw(self, rng):
        self.second = float(rng.uniform(0.0, 0.06))

    def post(self, series, y, rows):
        omega = rows[0].speed * LOBES / 121.0
        size = self.a * omega**2 / 10.0
        orders = series.axes["order"]
        line = size * (np.abs(orders - 39.0) < 0.5) + self.second * size * (np.abs(orders - 78.0) < 0.5)
        return np.hypot(y, line)


class Pit(Truth):
    """A pit of parabolic section in one race."""

    name, effect, blocks, quantities = "pit in a race", "race_spall", ("vibration", "te"), ("vibration_order", "transmission_error")
    typical, low, high = 3 * UM, 0.1 * UM, 60 * UM

    def draw(self, rng):
        self.inner = bool(rng.random() < 0.5)
        self.disc, self.crank = int(rng.integers(2)), int(rng.integers(2))
        self.width = float(rng.uniform(0.12, 0.3))
        self.shift = float(rng.uniform(-0.2, 0.2))

    def surfaces(self, w, setting):
        race = "inner_race_wear" if self.inner else "outer_race_wear"
        bins = w[race].shape[-1]
        angle = (np.arange(bins) + 0.5) * 2.0 * math.pi / bins - worn_places()[0 if self.inner else 1] - self.shift
        away = (angle + math.pi) % (2.0 * math.pi) - math.pi
        w[race][0, self.disc, self.crank] += self.a * np.clip(1.0 - (2.0 * away / self.width) ** 2, 0.0, None)


class Skidding(Truth):
    """Cage that lags at low load: a rational fall with the square of the rollers' load."""

    name, effect, blocks, quantities = "skidding rollers", "roller_skidding", ("cage",), ("cage_speed",)
    typical, low, high = 0.01, 1e-5, 0.4

    def draw(self, rng):
        self.load = float(rng.uniform(10.0, 50.0))

    def post(self, series, y, rows):
        load = np.array([abs(s.load) for s in rows])
        return y * (1.0 - self.a / (1.0 + (load / self.load) ** 2))


class Wearing(Truth):
    """Base of the laws that act on the wear rate."""

    blocks, quantities = ("wear",), WEAR


class RunIn(Wearing):
    """Running-in by a power law of the way: 1 + a/(1 + s/s0)^p, or two exponentials."""

    name, effect = "running-in by a power law", "running_in"
    typical, low, high = 1.0, 0.005, 12.0

    def draw(self, rng):
        self.travel = 67.5 * HOUR * float(np.exp(rng.uniform(math.log(60.0), math.log(350.0))))
        self.power = float(rng.uniform(1.5, 2.5))
        self.double = bool(rng.random() < 0.5)

    def rate(self, surface, life, setting):
        s = life["travel"] / self.travel
        if self.double:
            return 1.0 + self.a * (0.6 * math.exp(-1.6 * s) + 0.4 * math.exp(-0.6 * s))
        return 1.0 + self.a / (1.0 + s / self.power) ** (self.power + 1.0)


class Debris(Wearing):
    """Abrasion by debris: grows like a logistic curve of the iron that is worn off."""

    name, effect = "abrasion by debris, logistic", "debris_abrasion"
    typical, low, high = 1.0, 0.01, 30.0

    def draw(self, rng):
        self.middle = float(rng.uniform(3e-5, 1e-4))

    def rate(self, surface, life, setting):
        share = life["iron"] / self.middle
        return 1.0 + self.a * share / (1.0 + 0.15 * share)


class Film(Wearing):
    """Film by Hamrock and Dowson's exponents (speed 0.68, load -0.073), wear by a Gaussian of film over roughness."""

    name, effect = "lubricant film after Hamrock and Dowson", "lubrication_regime"
    typical, low, high = 0.3, 0.005, 0.95

    def draw(self, rng):
        self.half = float(rng.uniform(0.7, 1.5))

    def rate(self, surface, life, setting):
        warm = setting.temperature - 273.15
        viscosity = math.exp(880.0 / (warm + 105.0) - 880.0 / 145.0)
        film = (viscosity * setting.speed / 209.4) ** 0.68 * (setting.load / 167.0) ** -0.073
        return 1.0 - self.a * (1.0 - math.exp(-((film / self.half) ** 1.5)))


class LoadPower(Wearing):
    """Wear that grows as a power of the mean load of the test."""

    name, effect = "wear by a power of the load", "load_exponent"
    typical, low, high = 0.2, 0.003, 1.5

    def draw(self, rng):
        self.sign = float(rng.choice([-1.0, 1.0, 1.0]))

    def rate(self, surface, life, setting):
        return (setting.load / 140.0) ** (self.sign * self.a)


class SoftCore(Wearing):
    """Hardness that falls in proportion to the depth."""

    name, effect = "hardness falling with depth", "hardness_gradient"
    typical, low, high = 0.1, 0.002, 0.9

    def draw(self, rng):
        self.depth = float(rng.uniform(4.0, 8.0)) * UM

    def rate(self, surface, life, setting):
        return 1.0 / (1.0 - self.a * min(1.0, life[surface] / self.depth))


class Tilt(Wearing):
    """Tilted contacts wear more at the edge, the more the lower the load."""

    name, effect = "tilted contacts", "edge_loading"
    typical, low, high = 0.5, 0.005, 5.0

    def rate(self, surface, life, setting):
        return 1.0 + self.a * (100.0 / setting.load) ** 0.8


class OldGrease(Wearing):
    """Grease that ages: wear grows as a power of the time since it was filled."""

    name, effect = "ageing grease", "grease_ageing"
    typical, low, high = 0.3, 0.005, 8.0

    def draw(self, rng):
        self.life = float(rng.uniform(2000.0, 5000.0))

    def rate(self, surface, life, setting):
        t = life["hours"] / self.life
        return 1.0 + self.a * t / (1.0 + t)


class StuckPins(Wearing):
    """Pins that stand for a share of the time: two bands in their print."""

    name, effect = "pins that stand", "pin_rotation"
    blocks, quantities = ("wear", "prints"), ("wear_profile",)
    typical, low, high = 0.1, 0.001, 1.0

    def standing(self, setting):
        return self.a

    def parameters(self):
        return {"pin_standing_share": self.a}


class Encoder(Truth):
    """Encoder disc off centre: exact arc sine of the eccentric circle."""

    name, effect, blocks, quantities = "encoder off centre", "encoder_eccentricity", ("te",), ("transmission_error",)
    typical, low, high = 0.3 * ARCSEC, 0.005 * ARCSEC, 60 * ARCSEC

    def draw(self, rng):
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.second = float(rng.uniform(0.0, 0.3))

    def post(self, series, y, rows):
        angle = series.axes["angle"]
        error = np.arcsin(self.a * np.sin(angle + self.phase)) + self.second * self.a * np.sin(2.0 * angle + self.phase)
        return y + error - error.mean()

    def parameters(self):
        sine, cosine = self.a * math.sin(self.phase), self.a * math.cos(self.phase)
        return {"encoder_cos1[1]": sine, "encoder_sin1[1]": cosine, "encoder_cos2[1]": self.second * sine, "encoder_sin2[1]": self.second * cosine}


class GainFault(Truth):
    """A torque meter with a wrong slope, a little curved."""

    name, effect, blocks, quantities = "wrong gain", "sensor_gain", ("torque",), ("input_torque",)
    typical, low, high = 0.01, 1e-4, 0.3

    def draw(self, rng):
        self.sign = float(rng.choice([-1.0, 1.0]))

    def chain(self, series, y, rows, run):
        return y * (1.0 + self.sign * self.a) + 0.02 * self.a * y * np.abs(y)

    def parameters(self):
        return {"sensor_gain[input_torque]": self.sign * self.a}


class OffsetFault(Truth):
    """A torque meter that does not read zero at zero."""

    name, effect, blocks, quantities = "wrong zero", "sensor_offset", ("torque",), ("input_torque",)
    typical, low, high = 0.01, 1e-5, 0.5

    def draw(self, rng):
        self.sign = float(rng.choice([-1.0, 1.0]))

    def chain(self, series, y, rows, run):
        return y + self.sign * self.a


class DriftFault(Truth):
    """An amplifier that warms up: 1 - exp(-t/tau) along each record."""

    name, effect, blocks, quantities = "drifting zero", "sensor_drift", ("te",), ("transmission_error",)
    typical, low, high = 0.5 * ARCSEC, 0.01 * ARCSEC, 60 * ARCSEC

    def draw(self, rng):
        self.tau = float(rng.uniform(0.6, 3.0))
        self.sign = float(rng.choice([-1.0, 1.0]))

    def chain(self, series, y, rows, run):
        t = np.linspace(0.0, 1.0, len(y))
        change = self.sign * self.a * (1.0 - np.exp(-t / self.tau)) / (1.0 - math.exp(-1.0 / self.tau))
        return y + change - change.mean()


class ClockFault(Truth):
    """A recorder that loses pulses: the angle it writes runs ahead evenly."""

    name, effect, blocks, quantities = "slipping clock", "clock_slip", ("te",), ("transmission_error",)
    typical, low, high = 1e-4, 1e-6, 1.5e-2

    def draw(self, rng):
        self.sign = float(rng.choice([-1.0, 1.0]))

    def chain(self, series, y, rows, run):
        angle = series.axes["angle"]
        order = np.argsort(angle)
        return np.interp(angle * (1.0 + self.sign * self.a), angle[order], y[order], period=2.0 * math.pi)

    def parameters(self):
        return {"clock_slip": self.sign * self.a}


CATALOGUE: tuple[type[Truth], ...] = (
    Clearance, RaceHollow, PinRing, DiscTeeth, Relief, Lobe, Hole, Flange, PlanetRunout, TeethPlay, Warming, DryFriction, DahlLoop,
    Drag, OldGrease, Unbalance, Skidding, Pit, RunIn, Debris, Film, LoadPower, SoftCore, Tilt, StuckPins, Encoder, GainFault,
    OffsetFault, DriftFault, ClockFault,
)  # fmt: skip
