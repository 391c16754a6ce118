"""Laws of the loops with the input held that the catalogue does not have."""

import math

import numpy as np

from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.laws.shared import ARCSEC
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats


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


class Creep(Truth):
    """A glued joint that creeps (Kelvin and Voigt): it goes on turning while the torque stands, and back later than it came."""

    name, blocks, quantities = "glued joint that creeps", ("loops",), ("hysteresis",)
    typical, low, high = 2 * ARCSEC, 0.01 * ARCSEC, 100 * ARCSEC

    def draw(self, rng: np.random.Generator) -> None:
        # In shares of a record, which is passed at an even pace.
        self.lag = float(rng.uniform(0.05, 0.25))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        torque = series.axes["torque"] / 167.0
        keep = math.exp(-1.0 / (self.lag * len(torque)))
        state, found = 0.0, np.zeros(len(torque))
        for i, now in enumerate(torque):
            state = keep * state + (1.0 - keep) * float(now)
            found[i] = state
        change = self.a * found
        return y + change - float(change.mean())


class SlippingFlange(Truth):
    """A flange that shifts in its screws at one torque of either sense, and back at the other."""

    name, blocks, quantities = "flange that shifts at one torque", ("loops",), ("hysteresis",)
    typical, low, high = 1 * ARCSEC, 0.01 * ARCSEC, 60 * ARCSEC

    def draw(self, rng: np.random.Generator) -> None:
        self.torque = float(rng.uniform(60.0, 110.0))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        change = self.a * np.tanh((series.axes["torque"] - self.torque) / 4.0)
        return y + change - float(change.mean())
