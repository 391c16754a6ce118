"""Laws of the input torque, of a cage and of the vibration that the catalogue does not have."""

import math

import numpy as np

from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats


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


class Rubbing(Torque):
    """A seal's lip that lifts off as the shaft bends: drag that dies with the load."""

    name = "drag that dies with the load"

    def term(self, s: Setting) -> float:
        return math.exp(-abs(s.load) / 35.0)


class WhippingBelt(Torque):
    """A belt that whips: torque in waves over the speed."""

    name = "torque in waves over the speed"

    def draw(self, rng: np.random.Generator) -> None:
        self.wave = float(rng.uniform(70.0, 110.0))
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))

    def term(self, s: Setting) -> float:
        return math.sin(2.0 * math.pi * s.speed / self.wave + self.phase)


class Resonance(Truth):
    """A resonance of the housing at one frequency."""

    name, blocks, quantities = "resonance of the housing", ("vibration",), ("vibration_order",)
    typical, low, high = 0.05, 1e-4, 20.0

    def draw(self, rng: np.random.Generator) -> None:
        self.frequency = float(rng.uniform(25.0, 60.0))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        frequency = series.axes["order"] * rows[0].speed / 121.0 / (2.0 * math.pi)
        return np.hypot(y, self.a / (1.0 + ((frequency - self.frequency) / 2.0) ** 2))


class Sidebands(Truth):
    """A mesh that a neighbour's shaft beats: lines three orders beside order 39, in proportion to the load."""

    name, blocks, quantities = "lines beside order 39", ("vibration",), ("vibration_order",)
    typical, low, high = 0.05, 1e-4, 20.0

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        orders = series.axes["order"]
        lines = (np.abs(orders - 36.0) < 0.5) + 0.8 * (np.abs(orders - 42.0) < 0.5)
        return np.hypot(y, self.a * rows[0].load / 120.0 * lines)


class FastCage(Truth):
    """Cage driven by churned oil: runs ahead with the square of the speed, whatever the load."""

    name, blocks, quantities = "cage ahead with the speed", ("cage",), ("cage_speed",)
    typical, low, high = 0.002, 1e-5, 0.3

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        return y * (1.0 + self.a * np.array([(s.speed / 209.4) ** 2 for s in rows]))


class HeldCage(Truth):
    """A cage pinched by its bent shaft: behind in proportion to the load."""

    name, blocks, quantities = "cage behind with the load", ("cage",), ("cage_speed",)
    typical, low, high = 0.002, 1e-5, 0.3

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        return y * (1.0 - self.a * np.array([abs(s.load) / 167.0 for s in rows]))
