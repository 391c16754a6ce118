"""Linear maps, O(n), that turn the noise of one record into independent unit noise.

The noise of a record in units of its scale is AR1 in continuous ``position`` (correlation
exp(-|dx|/length), a share ``nugget`` of the variance being white), passed through a short
autoregression ``taps``, plus random run-wide amounts of ``patterns`` (offset, drift, gain).
The AR1 part is whitened by the innovations of its Kalman filter, the patterns by a correction
of low rank.  The ``directions`` of the patterns in whitened space are kept: their variance is
known from few replicates only, so tests must give them few degrees of freedom.  So are those of
the slowest waves where noise is slow (``slow_waves``): of these, too, there were few.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from fmu_src.arrays import Floats, Mask
from fmu_src.kernel import kernel

# The part of the noise that is slower than it forgets.
SLOW = "slow"
# Share of a wave that is no pattern.
OWN = 0.1


@kernel
def fill_gains(correlation: Floats, nugget: float, gain: Floats, deviation: Floats) -> None:
    """Fill Kalman gain and innovation standard deviation of each sample (total variance 1)."""
    variance = 0.0
    for i in range(correlation.shape[0]):
        rho = correlation[i]
        predicted = rho * rho * variance + (1.0 - rho * rho) * (1.0 - nugget)
        total = predicted + nugget + 1e-12
        gain[i] = predicted / total
        deviation[i] = math.sqrt(total)
        variance = predicted * (1.0 - gain[i])


def gains(correlation: Floats, nugget: float) -> tuple[Floats, Floats]:
    """(Kalman gain, innovation standard deviation) of each sample (total variance 1)."""
    gain, deviation = np.empty_like(correlation), np.empty_like(correlation)
    fill_gains(correlation, float(nugget), gain, deviation)
    return gain, deviation


@kernel
def fill_innovations(columns: Floats, correlation: Floats, gain: Floats, deviation: Floats, state: Floats, result: Floats) -> None:
    """Fill ``result`` (samples, columns); ``state`` (columns) starts at zero."""
    count, width = columns.shape
    for i in range(count):
        for j in range(width):
            predicted = correlation[i] * state[j]
            error = columns[i, j] - predicted
            result[i, j] = error / deviation[i]
            state[j] = predicted + gain[i] * error


def innovations(columns: Floats, correlation: Floats, gain: Floats, deviation: Floats) -> Floats:
    """Normalised innovations of each column."""
    if not correlation.any():
        # Noise that forgets at once: nothing to go along.
        return columns / deviation[:, None]
    columns = np.ascontiguousarray(columns, dtype=float)
    result = np.empty_like(columns)
    fill_innovations(columns, correlation, gain, deviation, np.zeros(columns.shape[1]), result)
    return result


def correlations(position: Floats, length: float) -> Floats:
    """Correlation of each sample with the one before it; the first has none."""
    result = np.zeros(position.size)
    if length > 0:
        result[1:] = np.exp(-np.abs(np.diff(position)) / length)
    return result


@dataclass(frozen=True)
class Whitener:
    """Whitening of one record: ``kept`` rows, divided by ``scale``, innovations, weights, patterns.

    ``between``: variance of all patterns together, by which whole runs differ, in units of scale^2.
    """

    kept: Mask
    scale: Floats
    correlation: Floats
    gain: Floats
    deviation: Floats
    taps: Floats
    weight: Floats
    directions: Floats
    shrink: Floats
    components: tuple[tuple[str, str], ...]
    quantity: str
    between: float = 0.0

    @property
    def floor(self) -> float:
        """Root mean square of its noise, in units of the record."""
        return float(np.sqrt(np.mean(self.scale**2) * (1.0 + self.between)))

    @property
    def size(self) -> int:
        return self.scale.size

    def innovate(self, columns: Floats) -> Floats:
        """Without weights and patterns."""
        rows = columns if self.kept.all() else columns[self.kept]
        result = innovations(rows / self.scale[:, None], self.correlation, self.gain, self.deviation)
        return autoregress(result, self.taps)

    def __call__(self, columns: Floats) -> Floats:
        flat = columns.ndim == 1
        result = self.innovate(columns[:, None] if flat else columns)
        # Made anew there, it may be changed: a further array of millions takes longer than the product.
        result *= self.weight[:, None]
        if self.directions.shape[1]:
            result -= self.directions @ (self.shrink[:, None] * (self.directions.T @ result))
        return result[:, 0] if flat else result


@kernel
def fill_autoregressed(columns: Floats, taps: Floats, result: Floats) -> None:
    """Fill ``result`` (samples, columns): tap by tap along a row, as numpy would with arrays of its own for each."""
    count, width = columns.shape
    order = taps.shape[0] - 1
    for i in range(count):
        for j in range(width):
            result[i, j] = columns[i, j]
        for lag in range(1, min(order, i) + 1):
            tap = taps[lag - 1]
            for j in range(width):
                result[i, j] -= tap * columns[i - lag, j]
        for j in range(width):
            result[i, j] /= taps[order]


def autoregress(columns: Floats, taps: Floats) -> Floats:
    """Prediction error of a short autoregression; the first rows use what there is of it."""
    if not taps.size or len(columns) <= taps.size:
        return columns
    columns = np.ascontiguousarray(columns, dtype=float)
    result = np.empty_like(columns)
    fill_autoregressed(columns, taps, result)
    return result


def whitener(
    kept: Mask, scale: Floats, position: Floats, length: float, nugget: float, taps: Floats, weight: Floats, patterns: Floats,
    variances: Floats, components: Sequence[tuple[str, str]], quantity: str,
) -> Whitener:  # fmt: skip
    """Builds the map; ``patterns`` (n, k) over the kept rows carry random amounts of ``variances`` (in units of scale)."""
    correlation = correlations(position, length)
    gain, deviation = gains(correlation, nugget)
    plain = Whitener(kept, scale, correlation, gain, deviation, taps, weight,
                     np.zeros((scale.size, 0)), np.zeros(0), (), quantity)
    if not patterns.shape[1]:
        return plain
    whole = np.zeros((kept.size, patterns.shape[1]))
    whole[kept] = patterns * scale[:, None]
    inside = plain(whole)
    basis, triangle = np.linalg.qr(inside)
    values, vectors = np.linalg.eigh(triangle @ np.diag(variances) @ triangle.T)
    directions = basis @ vectors
    # each direction is booked on the pattern that it mostly is
    owner = np.abs(directions.T @ (inside / np.maximum(np.linalg.norm(inside, axis=0), 1e-300)))
    booked = tuple(components[i] for i in np.argmax(owner, axis=1))
    shrink = 1.0 - 1.0 / np.sqrt(1.0 + np.maximum(values, 0.0))
    return Whitener(kept, scale, correlation, gain, deviation, taps, weight, directions, shrink, booked, quantity,
                    float(np.sum(variances)))


def slow_waves(position: Floats, length: float) -> Floats:
    """(n, m) half waves over a run that are slower than noise of this correlation ``length`` forgets."""
    span = float(np.ptp(position)) or 1.0
    waves = np.arange(1, int(span / (math.pi * length)) + 2)
    return np.cos(math.pi * np.outer((position - position.min()) / span, waves))


def with_slow(plain: Whitener, slow: Floats) -> Whitener:
    """The same map, which keeps the directions of ``slow`` waves (n, m) apart too, booked on the component "slow"."""
    whole = np.zeros((plain.kept.size, slow.shape[1]))
    whole[plain.kept] = slow * plain.scale[:, None]
    inside = plain.weight[:, None] * plain.innovate(whole)
    inside /= np.maximum(np.linalg.norm(inside, axis=0), 1e-300)
    inside -= plain.directions @ (plain.directions.T @ inside)
    basis, values, _ = np.linalg.svd(inside, full_matrices=False)
    basis = basis[:, values > OWN]
    return replace(plain, directions=np.hstack([plain.directions, basis]), shrink=np.append(plain.shrink, np.zeros(basis.shape[1])),
                   components=(*plain.components, *[(plain.quantity, SLOW)] * basis.shape[1]))
