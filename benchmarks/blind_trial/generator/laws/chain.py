"""The measuring chain: encoder, torque meter, amplifier, recorder."""

import math

import numpy as np
from scipy.interpolate import make_interp_spline

from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.laws.shared import ARCSEC
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats


class Encoder(Truth):
    """Encoder disc off centre: exact arc sine of the eccentric circle."""

    name, effect, blocks, quantities = "encoder off centre", "encoder_eccentricity", ("te",), ("transmission_error",)
    typical, low, high = 0.3 * ARCSEC, 0.005 * ARCSEC, 60 * ARCSEC

    def draw(self, rng: np.random.Generator) -> None:
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))
        self.second = float(rng.uniform(0.0, 0.3))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        angle = series.axes["angle"]
        error = np.arcsin(self.a * np.sin(angle + self.phase)) + self.second * self.a * np.sin(2.0 * angle + self.phase)
        return y + error - float(error.mean())

    def parameters(self) -> dict[str, float]:
        sine, cosine = self.a * math.sin(self.phase), self.a * math.cos(self.phase)
        return {"encoder_cos1[1]": sine, "encoder_sin1[1]": cosine, "encoder_cos2[1]": self.second * sine, "encoder_sin2[1]": self.second * cosine}


class GainFault(Truth):
    """A torque meter with a wrong slope, a little curved."""

    name, effect, blocks, quantities = "wrong gain", "sensor_gain", ("torque",), ("input_torque",)
    typical, low, high = 0.01, 1e-4, 0.3

    def draw(self, rng: np.random.Generator) -> None:
        self.sign = float(rng.choice([-1.0, 1.0]))

    def chain(self, series: Series, y: Floats, rows: list[Setting], run: int) -> Floats:
        return y * (1.0 + self.sign * self.a) + 0.02 * self.a * y * np.abs(y)

    def parameters(self) -> dict[str, float]:
        return {"sensor_gain[input_torque]": self.sign * self.a}


class OffsetFault(Truth):
    """A torque meter that does not read zero at zero."""

    name, effect, blocks, quantities = "wrong zero", "sensor_offset", ("torque",), ("input_torque",)
    typical, low, high = 0.01, 1e-5, 0.5

    def draw(self, rng: np.random.Generator) -> None:
        self.sign = float(rng.choice([-1.0, 1.0]))

    def chain(self, series: Series, y: Floats, rows: list[Setting], run: int) -> Floats:
        return y + self.sign * self.a


class DriftFault(Truth):
    """An amplifier that warms up: 1 - exp(-t/tau) along each record."""

    name, effect, blocks, quantities = "drifting zero", "sensor_drift", ("te",), ("transmission_error",)
    typical, low, high = 0.5 * ARCSEC, 0.01 * ARCSEC, 60 * ARCSEC

    def draw(self, rng: np.random.Generator) -> None:
        self.tau = float(rng.uniform(0.6, 3.0))
        self.sign = float(rng.choice([-1.0, 1.0]))

    def chain(self, series: Series, y: Floats, rows: list[Setting], run: int) -> Floats:
        t = np.linspace(0.0, 1.0, len(y))
        change = self.sign * self.a * (1.0 - np.exp(-t / self.tau)) / (1.0 - math.exp(-1.0 / self.tau))
        return y + change - float(change.mean())


class ClockFault(Truth):
    """A recorder that loses pulses: the angle it writes runs ahead evenly."""

    name, effect, blocks, quantities = "slipping clock", "clock_slip", ("te",), ("transmission_error",)
    typical, low, high = 1e-4, 1e-6, 1.5e-2

    def draw(self, rng: np.random.Generator) -> None:
        self.sign = float(rng.choice([-1.0, 1.0]))

    def chain(self, series: Series, y: Floats, rows: list[Setting], run: int) -> Floats:
        angle = series.axes["angle"]
        order = np.argsort(angle)
        # What the reducer does between samples is smooth.
        curve = make_interp_spline(angle[order], y[order], k=5)
        return np.asarray(curve(np.clip(angle * (1.0 + self.sign * self.a), angle.min(), angle.max())), np.float64)

    def parameters(self) -> dict[str, float]:
        return {"clock_slip": self.sign * self.a}
