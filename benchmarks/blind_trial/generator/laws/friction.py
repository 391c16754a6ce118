"""Friction and drag: loops with the input held, and the input torque."""

import math

import numpy as np

from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats


def dahl(torque: Floats, y: Floats, share: float, least: float, way: float) -> Floats:
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
    return found - float(found.mean())


class DryFriction(Truth):
    """Stribeck curve of Gaussian form for the mesh as a whole; with the input held, Dahl's model."""

    name, effect, blocks, quantities = "friction with a velocity minimum", "stribeck_friction", ("torque",), ("input_torque", "hysteresis")
    typical, low, high = 0.01, 1e-5, 0.12
    rigid_only = True

    def draw(self, rng: np.random.Generator) -> None:
        self.static = float(rng.uniform(0.5, 2.0))
        self.speed = float(rng.uniform(0.008, 0.05))
        self.viscous = float(rng.uniform(0.0, 0.6))
        self.way = 2e-5 * float(np.exp(rng.uniform(-0.5, 0.5)))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        if series.quantity == "hysteresis":
            most = self.a * (1.0 + self.static)
            return dahl(series.axes["torque"], y, 1.35 * most, 0.5 * most, self.way)
        speed: Floats = np.array([s.speed for s in rows])
        load: Floats = np.array([s.load for s in rows])
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
    numbers = ("input_seal_torque", "input_churning_torque")

    def draw(self, rng: np.random.Generator) -> None:
        self.seal = float(rng.uniform(0.0, 0.6))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        speed = np.array([s.speed for s in rows])
        warm = np.array([s.temperature for s in rows]) - 273.15
        vogel = np.exp(880.0 / (warm + 105.0) - 880.0 / (20.0 + 105.0))
        return y + self.a * (self.seal + (1.0 - self.seal) * (speed / 209.44) ** 0.7 * vogel**0.7)
