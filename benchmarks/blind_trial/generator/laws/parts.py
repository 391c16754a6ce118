"""Parts that are not as drawn, and parts that grow: what changes the contacts of the true reducer."""

import math

import numpy as np

from benchmarks.blind_trial.generator.laws.shared import BOTH, LOBES, PINS, UM
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth


class Clearance(Truth):
    """Races ground too wide: clearance of every bearing by its own size, 8 % scatter."""

    name, effect, blocks, quantities = "clearance of the needle bearings", "needle_clearance", ("te", "loops"), BOTH
    typical, low, high = 0.5 * UM, 0.01 * UM, 6 * UM

    def draw(self, rng: np.random.Generator) -> None:
        self.scatter = 0.08 * rng.standard_normal((2, 2))

    def parts(self, p: np.ndarray, setting: Setting) -> None:
        p["roller_profile_error"][0] = (self.a * (1.0 + self.scatter))[..., None]

    def parameters(self) -> dict[str, float]:
        return {"needle_clearance_added": self.a * (1.0 + float(self.scatter.mean()))}


class PinRing(Truth):
    """Pins out of place by a Fourier series over the ring, one harmonic dominant, 8 % of others and of scatter."""

    name, effect, blocks, quantities = "pin positions by harmonics", "pin_position_errors", ("te",), BOTH
    typical, low, high = 1.5 * UM, 0.05 * UM, 12 * UM

    def draw(self, rng: np.random.Generator) -> None:
        self.order = int(rng.integers(1, 4))
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.more = 0.08 * rng.standard_normal((2, 5))
        self.scatter = 0.05 * rng.standard_normal(PINS)

    def parts(self, p: np.ndarray, setting: Setting) -> None:
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

    def draw(self, rng: np.random.Generator) -> None:
        self.order = int(rng.integers(1, 3))
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.opposed = bool(rng.random() < 0.5) or self.order == 1
        self.more = 0.08 * rng.standard_normal(4)
        walk = np.cumsum(rng.standard_normal(LOBES))
        self.pitch = 0.05 * (walk - np.linspace(walk[0], walk[-1], LOBES))

    def parts(self, p: np.ndarray, setting: Setting) -> None:
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

    def draw(self, rng: np.random.Generator) -> None:
        self.share = float(rng.uniform(0.3, 0.9))

    def parts(self, p: np.ndarray, setting: Setting) -> None:
        p["equidistant_modification"] += self.a
        p["shift_modification"] -= self.share * self.a

    def parameters(self) -> dict[str, float]:
        return {"equidistant_added": self.a, "shift_added": -self.share * self.a}


class Lobe(Truth):
    """One lobe of a crank ground off centre, the others within a tenth of it."""

    name, effect, blocks, quantities = "crank lobe off centre", "crank_lobe_errors", ("te",), BOTH
    typical, low, high = 1.0 * UM, 0.02 * UM, 10 * UM

    def draw(self, rng: np.random.Generator) -> None:
        self.disc, self.crank = int(rng.integers(2)), int(rng.integers(2))
        self.others = 0.05 * rng.standard_normal((2, 2))
        self.turned = float(rng.choice([0.0, 0.5]))
        self.sign = float(rng.choice([-1.0, 1.0]))

    def parts(self, p: np.ndarray, setting: Setting) -> None:
        shape = self.others.copy()
        shape[self.disc, self.crank] += self.sign
        p["crank_eccentricity_error"][0] += self.a * shape
        p["crank_phase_error"][0, self.disc, self.crank] += self.turned * self.a / 0.9e-3


class Hole(Truth):
    """One hole bored off its place, along the circle and a little radially."""

    name, effect, blocks, quantities = "hole off its place", "hole_position_errors", ("te",), BOTH
    typical, low, high = 1.0 * UM, 0.02 * UM, 12 * UM

    def draw(self, rng: np.random.Generator) -> None:
        self.disc, self.crank = int(rng.integers(2)), int(rng.integers(2))
        self.radial = float(rng.normal(0.0, 0.08))
        self.sign = float(rng.choice([-1.0, 1.0]))

    def parts(self, p: np.ndarray, setting: Setting) -> None:
        p["disc_hole_error_tangential"][0, self.disc, self.crank] += self.sign * self.a
        p["disc_hole_error_radial"][0, self.disc, self.crank] += self.radial * self.a


class Warming(Truth):
    """Ring and discs of different temperature: the discs stay behind by a share that grows with warmth."""

    name, effect, blocks, quantities = "thermal gap of ring and discs", "thermal_expansion", ("loops", "te"), BOTH
    typical, low, high = 1e-6, 1e-8, 1.1e-5

    def draw(self, rng: np.random.Generator) -> None:
        self.curve = float(rng.uniform(0.0, 0.1))
        self.sign = 1.0

    def parts(self, p: np.ndarray, setting: Setting) -> None:
        warm = setting.temperature - 293.15
        p["pin_position_error_radial"][0] += self.sign * self.a * 52e-3 * warm * (1.0 + self.curve * warm / 40.0)
