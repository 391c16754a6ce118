"""Noise as on a bench: coloured, heavy-tailed, drifting, different from run to run, quantised."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import toeplitz
from scipy.signal import lfilter

from fmu_src.arrays import Floats


@dataclass(frozen=True)
class Noise:
    """Noise of one signal, in its SI unit.

    ``sigma`` is the standard deviation of the coloured part, AR2 with the poles
    ``radius`` exp(+-i ``turn``); ``moving`` a share of moving average (ARMA); ``tail`` the degrees of freedom
    of the innovations (Student's t, 0: normal); ``offset``, ``drift`` (from end to end) and ``gain`` differ from
    run to run and are over sigma, over sigma and relative; ``quantum`` is the resolution; ``relative``
    a share of the value.
    """

    sigma: float
    radius: float = 0.0
    turn: float = 0.0
    moving: float = 0.0
    tail: float = 0.0
    offset: float = 0.0
    drift: float = 0.0
    gain: float = 0.0
    quantum: float = 0.0
    relative: float = 0.0

    def filters(self) -> tuple[Floats, Floats]:
        return np.array([1.0, self.moving]), np.array([1.0, -2.0 * self.radius * np.cos(self.turn), self.radius**2])

    def correlation(self, n: int) -> Floats:
        """Autocovariance of the coloured part for unit innovations, lags 0 to n - 1."""
        impulse = np.zeros(4 * max(n, 200))
        impulse[0] = 1.0
        response = lfilter(*self.filters(), impulse)
        size = 2 * len(response)
        spectrum = np.abs(np.fft.rfft(response, size)) ** 2
        return np.fft.irfft(spectrum, size)[:n]

    def covariance(self, values: Floats) -> Floats:
        """Covariance of one run's noise around ``values``, for one and the same order of samples."""
        n = len(values)
        lags = self.correlation(n)
        size = np.sqrt(self.sigma**2 + (self.relative * values) ** 2)
        ramp = np.linspace(-0.5, 0.5, n) if n > 1 else np.zeros(n)
        total: Floats = toeplitz(lags / lags[0]) * np.outer(size, size)
        total += (self.offset * self.sigma) ** 2 + (self.drift * self.sigma) ** 2 * np.outer(ramp, ramp)
        total += self.gain**2 * np.outer(values, values) + self.quantum**2 / 12.0 * np.eye(n)
        return total

    def spectrum(self, n: int) -> Floats:
        """Variance of the coloured part by frequency of an n-point Fourier transform, as of a periodic record; their mean is ``sigma``^2."""
        top, bottom = self.filters()
        power = np.abs(np.fft.fft(top, n) / np.fft.fft(bottom, n)) ** 2
        return np.asarray(self.sigma**2 * power / power.mean(), np.float64)

    def draw(self, rng: np.random.Generator, values: Floats) -> Floats:
        """Noise of one run with ``values``."""
        n, lead = len(values), 200
        if self.tail > 0.0:
            innovations = rng.standard_t(self.tail, n + lead) / np.sqrt(self.tail / (self.tail - 2.0))
        else:
            innovations = rng.standard_normal(n + lead)
        coloured = lfilter(*self.filters(), innovations)[lead:] / np.sqrt(self.correlation(1)[0])
        size = np.sqrt(self.sigma**2 + (self.relative * values) ** 2)
        noise: Floats = coloured * size + self.offset * self.sigma * rng.standard_normal()
        if n > 1:
            noise = noise + self.drift * self.sigma * rng.standard_normal() * np.linspace(-0.5, 0.5, n)
        return noise + self.gain * rng.standard_normal() * values

    def scaled(self, factor: float) -> "Noise":
        return Noise(**{**self.__dict__, "sigma": self.sigma * factor, "relative": self.relative * factor,
                        "gain": self.gain * factor, "quantum": self.quantum * factor})


def round_to(values: Floats, quantum: float) -> Floats:
    return np.round(values / quantum) * quantum if quantum > 0.0 else values


# Typical standard deviations: TE and loops [rad], torque [N m], wear [m], mass [kg], acceleration [m/s^2], cage [rad/s].
ARCSEC = np.pi / 648000.0
SIZES = {
    "transmission_error": 0.8 * ARCSEC, "hysteresis": 1.0 * ARCSEC, "lost_motion": 0.8 * ARCSEC, "input_torque": 0.012,
    "no_load_torque": 0.012, "wear_depth": 0.04e-6, "wear_profile": 0.06e-6, "mass_loss": 1e-7, "debris_iron": 2e-6,
    "vibration_order": 0.03, "cage_speed": 0.02, "torsional_stiffness": 1e4,
}  # fmt: skip
RELATIVE = {"wear_depth": 0.02, "wear_profile": 0.015, "mass_loss": 0.02, "debris_iron": 0.02, "cage_speed": 0.001,
            "vibration_order": 0.03, "torsional_stiffness": 0.005}
SERIES = ("transmission_error", "hysteresis")


def noise_for(rng: np.random.Generator, quantity: str, plain: bool = False) -> Noise:
    """A noise drawn for a quantity; ``plain`` is white and normal."""
    size = SIZES[quantity] * np.exp(rng.uniform(-0.35, 0.35))
    relative = RELATIVE.get(quantity, 0.0)
    if plain:
        return Noise(size, relative=relative)
    tail = float(rng.choice([0.0, 3.0, 4.0, 6.0]))
    if quantity not in SERIES:
        return Noise(size, tail=tail if tail != 3.0 else 4.0, offset=float(rng.choice([0.0, 0.3])), relative=relative,
                     gain=0.5 * relative * float(rng.random() < 0.5))
    radius = float(rng.uniform(0.0, 0.75))
    return Noise(size, radius, float(rng.uniform(0.0, 1.0)), float(rng.choice([0.0, 0.4])), tail,
                 float(rng.choice([0.1, 0.5])), float(rng.choice([0.0, 0.6])), 0.0, float(rng.choice([0.0, 0.3])) * size)
