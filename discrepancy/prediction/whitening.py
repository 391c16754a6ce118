"""Misfits in noise of which one sample says something of the next: an instrument's, or an effect that is not yet in the model."""

from collections.abc import Callable

import numpy as np
from scipy.linalg import solve_toeplitz

from fmu_src.arrays import Floats

# Samples that one of the noise remembers.
LAGS = 10


def whitening(rest: Floats) -> Callable[[Floats], Floats]:
    """Prediction error of the autoregression that the noise ``rest`` (n,) follows, of unit variance; of columns (n, k) too."""
    rest = rest - rest.mean()
    order = min(LAGS, len(rest) // 8)
    products = np.array([rest[: len(rest) - lag] @ rest[lag:] for lag in range(order + 1)])
    # A little more on the diagonal: without noise the equations would have no solution.
    products[0] = products[0] * (1.0 + 1e-9) + 1e-300
    taps = np.concatenate([[1.0], -solve_toeplitz(products[:-1], products[1:])])
    error = np.convolve(rest, taps, "valid")
    scale = max(float(np.sqrt(error @ error / len(error))), 1e-150)

    def white(columns: Floats) -> Floats:
        found: Floats = np.apply_along_axis(np.convolve, 0, columns - columns.mean(axis=0), taps / scale, "valid")
        return found

    return white


def gain(misfit: Floats, less: Floats) -> float:
    """Chi-square by which one misfit (n,) is better than another, in noise that one sample does not say of the next."""
    white = whitening(less)
    return float(np.sum(white(misfit) ** 2) - np.sum(white(less) ** 2))
