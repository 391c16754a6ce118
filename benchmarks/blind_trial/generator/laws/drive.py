"""What stands around the mesh: first stage, flange, cranks' masses, the rollers' cage."""

import math

import numpy as np

from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.laws.shared import LEVER, LOBES, UM
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats


class Flange(Truth):
    """Bolted flange in series: a spring that settles by a few percent under torque."""

    name, effect, blocks, quantities = "soft flange", "support_compliance", ("loops",), ("hysteresis",)
    typical, low, high = 5e-8, 1e-9, 1e-5
    # Which spring of the drive yields no loop can tell.
    numbers = ("carrier_twist_compliance", "ring_seat_compliance", "crank_seat_compliance", "tooth_compliance")

    def draw(self, rng: np.random.Generator) -> None:
        self.settle = float(rng.uniform(0.0, 0.05))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        torque = series.axes["torque"]
        change = self.a * torque * (1.0 - self.settle * np.abs(torque) / 250.0)
        return y + change - float(change.mean())


class PlanetRunout(Truth):
    """A planet off its centre: once per turn of the planet against the carrier, with a tenth of second harmonic."""

    name, effect, blocks, quantities = "planet off centre", "first_stage_error", ("te",), ("transmission_error",)
    typical, low, high = 3 * UM, 0.05 * UM, 60 * UM

    def draw(self, rng: np.random.Generator) -> None:
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.second = float(rng.uniform(0.02, 0.1))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        angle = series.axes["angle"]
        size = self.a / (2.0 * LEVER * LOBES)
        return y - size * (np.cos(40.0 * angle + self.phase) + self.second * np.cos(80.0 * angle + 2.0 * self.phase))


class TeethPlay(Truth):
    """Play of the sun's teeth, crossed smoothly within a newton metre or two (oil and friction)."""

    name, effect, blocks, quantities = "play of the first stage", "first_stage_error", ("loops",), ("hysteresis",)
    typical, low, high = 5 * UM, 0.1 * UM, 200 * UM
    numbers = ("tooth_backlash",)

    def draw(self, rng: np.random.Generator) -> None:
        self.width = float(rng.uniform(0.3, 1.5))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        change = 0.5 * self.a / (LEVER * LOBES) * np.tanh(series.axes["torque"] / self.width)
        return y + change - float(change.mean())

    def parameters(self) -> dict[str, float]:
        return {"backlash": self.a}


class Unbalance(Truth):
    """Centrifugal force of the cranks on soft mounts, with a trace of second harmonic."""

    name, effect, blocks, quantities = "unbalance", "unbalance", ("vibration",), ("vibration_order",)
    typical, low, high = 1e-5, 1e-8, 1e-2

    def draw(self, rng: np.random.Generator) -> None:
        self.second = float(rng.uniform(0.0, 0.06))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        omega = rows[0].speed * LOBES / 121.0
        size = self.a * omega**2 / 10.0
        orders = series.axes["order"]
        line = size * (np.abs(orders - 39.0) < 0.5) + self.second * size * (np.abs(orders - 78.0) < 0.5)
        return np.hypot(y, line)


class Skidding(Truth):
    """Cage that lags at low load: a rational fall with the square of the rollers' load."""

    name, effect, blocks, quantities = "skidding rollers", "roller_skidding", ("cage",), ("cage_speed", "transmission_error")
    typical, low, high = 0.01, 1e-5, 0.4

    def draw(self, rng: np.random.Generator) -> None:
        self.load = float(rng.uniform(10.0, 50.0))

    def lost(self, setting: Setting) -> float:
        """Share of rolling."""
        return self.a / (1.0 + (abs(setting.load) / self.load) ** 2)

    def parts(self, p: np.ndarray, setting: Setting) -> None:
        # The cages fall behind in the transmission error, too: the same share whatever a bearing carries.
        p["skid_share"], p["skid_load"] = self.lost(setting), 1e12

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        return y * (1.0 - np.array([self.lost(s) for s in rows])) if series.quantity == "cage_speed" else y
