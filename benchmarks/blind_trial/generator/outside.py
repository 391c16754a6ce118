"""Laws that the catalogue does not have."""

import math
from collections.abc import Mapping

import numpy as np

from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.laws.shared import ARCSEC, BOTH, PINS, UM
from benchmarks.blind_trial.generator.laws.wearing import Wearing
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats


class Angular(Truth):
    """Base of patterns over the output angle."""

    blocks, quantities = ("te",), ("transmission_error",)
    typical, low, high = 0.3 * ARCSEC, 0.005 * ARCSEC, 100 * ARCSEC

    def draw(self, rng: np.random.Generator) -> None:
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        """Over the angle [rad], of size 1 or so."""
        raise NotImplementedError

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        change = self.a * self.pattern(series.axes["angle"], rows[0])
        return y + change - float(change.mean())


class Cogging(Angular):
    """Magnetic cogging of a motor with an unlucky slot number: order 47 and its half."""

    name = "cogging at order 47"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(47.0 * angle + self.phase) + 0.3 * np.cos(23.5 * angle + self.phase)


class Belt(Angular):
    """A belt on the input, order 5.5."""

    name = "belt at order 5.5"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(5.5 * angle + self.phase)


class ThreeLobes(Angular):
    """A flange clamped at three points: order 3 in proportion to the load."""

    name = "order 3 with the load"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return s.load / 120.0 * np.cos(3.0 * angle + self.phase)


class StickSlip(Angular):
    """Stick-slip as a saw tooth at order 17, only above 80 N m."""

    name = "stick-slip at order 17"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        x = 17.0 * angle + self.phase
        return (np.sin(x) - 0.5 * np.sin(2.0 * x) + 0.33 * np.sin(3.0 * x)) * (s.load > 80.0)


class LoadedTurn(Angular):
    """Carrier bearing that tips over at a load: order 1 changes its sign at 110 N m."""

    name = "order 1 changing sign with the load"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(angle + self.phase) * math.tanh((s.load - 110.0) / 15.0)


class WarmRipple(Angular):
    """A ripple of order 29 that grows as the square of the warmth."""

    name = "order 29 with the temperature squared"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(29.0 * angle + self.phase) * (0.2 + ((s.temperature - 293.15) / 20.0) ** 2)


class Beating(Angular):
    """A belt's teeth, order 52, that come and go once per turn."""

    name = "order 52 that beats once per turn"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(52.0 * angle + self.phase) * (1.0 + 0.8 * np.cos(angle))


class OddPins(Truth):
    """Every pin out of place by its own normal number."""

    name, blocks, quantities = "pins at random", ("te",), BOTH
    typical, low, high = 1.0 * UM, 0.05 * UM, 8 * UM
    acceptable = ("pin_position_errors",)

    def draw(self, rng: np.random.Generator) -> None:
        self.places = rng.standard_normal(PINS)

    def parts(self, p: np.ndarray, setting: Setting) -> None:
        p["pin_position_error_radial"][0] += self.a * self.places


class Cubic(Truth):
    """A spring that stiffens or softens with the cube of the torque."""

    name, blocks, quantities = "cubic stiffness", ("loops",), ("hysteresis",)
    typical, low, high = 1 * ARCSEC, 0.01 * ARCSEC, 60 * ARCSEC

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        change = self.a * (series.axes["torque"] / 167.0) ** 3
        return y - change + float(change.mean())


class LiftingFoot(Truth):
    """A foot of the housing that lifts under torque of either sense, always to the same side: the square of the torque."""

    name, blocks, quantities = "foot that lifts with the square of the torque", ("loops",), ("hysteresis",)
    typical, low, high = 1 * ARCSEC, 0.01 * ARCSEC, 60 * ARCSEC

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        change = self.a * (series.axes["torque"] / 167.0) ** 2
        return y + change - float(change.mean())


class Cycling(Truth):
    """Play that comes and goes periodically with the temperature."""

    name, blocks, quantities = "periodic play over the temperature", ("loops",), ("hysteresis",)
    typical, low, high = 1 * ARCSEC, 0.01 * ARCSEC, 60 * ARCSEC

    def draw(self, rng: np.random.Generator) -> None:
        self.period = float(rng.uniform(14.0, 22.0))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        change = self.a * math.sin(2.0 * math.pi * (rows[0].temperature - 283.15) / self.period + 0.8) * np.tanh(series.axes["torque"] / 8.0)
        return y + change - float(change.mean())


class Torque(Truth):
    """Base of terms of the input torque."""

    blocks, quantities = ("torque",), ("input_torque",)
    typical, low, high = 0.02, 1e-5, 1.5

    def term(self, s: Setting) -> float:
        """Of size 1 or so."""
        raise NotImplementedError

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        return y + self.a * np.array([self.term(s) for s in rows])


class Ventilation(Torque):
    """Ventilation: drag with the 2.5th power of the speed, whatever the temperature."""

    name = "drag with speed^2.5"

    def term(self, s: Setting) -> float:
        return float((s.speed / 209.4) ** 2.5)


class Bump(Torque):
    """Friction bump at one speed and one temperature (grease that changes phase)."""

    name = "friction bump in speed and temperature"

    def draw(self, rng: np.random.Generator) -> None:
        self.middle = float(rng.uniform(70.0, 130.0))

    def term(self, s: Setting) -> float:
        return math.exp(-(((s.speed - self.middle) / 35.0) ** 2)) * math.exp(-(((s.temperature - 296.0) / 9.0) ** 2)) * (s.load / 167.0)


class Humidity(Torque):
    """Weather: up and down from condition to condition, whatever is set."""

    name = "humidity"

    def draw(self, rng: np.random.Generator) -> None:
        self.way = float(rng.uniform(1.5, 2.5))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        day = sum(map(ord, series.condition))
        return y + self.a * math.sin(self.way * day)


class Chatter(Wearing):
    """Cranks that chatter at one speed: wear has a peak there."""

    name = "wear peak at one speed"
    typical, low, high = 0.3, 0.005, 20.0

    def draw(self, rng: np.random.Generator) -> None:
        self.middle = float(rng.uniform(130.0, 190.0))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 + self.a * math.exp(-(((setting.speed - self.middle) / 25.0) ** 2))


class Accident(Wearing):
    """An accident at one hour: dust gets in, wear jumps up for 300 h and is as before."""

    name = "accident at one hour"
    typical, low, high = 1.0, 0.01, 30.0

    def draw(self, rng: np.random.Generator) -> None:
        self.hour = float(rng.uniform(400.0, 900.0))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 + self.a * (self.hour < life["hours"] < self.hour + 300.0)


class Resonance(Truth):
    """A resonance of the housing at one frequency."""

    name, blocks, quantities = "resonance of the housing", ("vibration",), ("vibration_order",)
    typical, low, high = 0.05, 1e-4, 20.0

    def draw(self, rng: np.random.Generator) -> None:
        self.frequency = float(rng.uniform(25.0, 60.0))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        frequency = series.axes["order"] * rows[0].speed / 121.0 / (2.0 * math.pi)
        return np.hypot(y, self.a / (1.0 + ((frequency - self.frequency) / 2.0) ** 2))


class FastCage(Truth):
    """Cage driven by churned oil: runs ahead with the square of the speed, whatever the load."""

    name, blocks, quantities = "cage ahead with the speed", ("cage",), ("cage_speed",)
    typical, low, high = 0.002, 1e-5, 0.3

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        return y * (1.0 + self.a * np.array([(s.speed / 209.4) ** 2 for s in rows]))


OUTSIDE: tuple[type[Truth], ...] = (
    Cogging, Belt, ThreeLobes, StickSlip, LoadedTurn, WarmRipple, Beating, OddPins, Cubic, LiftingFoot, Cycling, Ventilation, Bump,
    Humidity, Chatter, Accident, Resonance, FastCage,
)  # fmt: skip
