"""Correlation of the noise along a run, from deviations between replicates."""

from collections.abc import Sequence

import numpy as np

from discrepancy.inference.noise.replicates import Deviation
from discrepancy.inference.noise.series import spacing_of
from discrepancy.inference.noise.whiten import correlations, gains, innovations
from fmu_src.arrays import Floats

# Samples that a tap of the autoregression needs.
PER_TAP = 20


def trend_of(position: Floats) -> Floats:
    """(n, 2): level and slope."""
    x = position - position.mean()
    return np.column_stack([np.ones_like(x), x])


def detrended_values(position: Floats, values: Floats) -> Floats:
    basis = trend_of(position)
    trend: Floats = basis @ np.linalg.lstsq(basis, values, rcond=None)[0]
    return values - trend


def correlation_of(deviations: Sequence[Deviation], values: Sequence[Floats]) -> tuple[float, float]:
    """Length and white share that maximise the likelihood, over a grid and then around its best point."""
    # the two deviations of a pair mirror each other: one is enough
    seen: set[str] = set()
    single = []
    for k, d in enumerate(deviations):
        if not (d.pair and d.condition in seen):
            single.append(k)
        seen.add(d.condition)
    chosen = sorted(single, key=lambda k: -values[k].size)[:12]
    spacing = spacing_of(*(deviations[i].position for i in chosen))
    longest = np.median([np.ptp(deviations[i].position) for i in chosen])
    total = sum(values[i].size for i in chosen)

    trends = []
    # Runs over the same positions are whitened together.
    together: dict[bytes, list[int]] = {}
    for k, i in enumerate(chosen):
        x = deviations[i].position - deviations[i].position.mean()
        trends.append(np.column_stack([values[i], np.ones_like(x), x / (np.ptp(x) or 1.0)]))
        together.setdefault(deviations[i].position.tobytes(), []).append(k)
    groups = [(deviations[chosen[runs[0]]].position, runs, np.hstack([trends[k] for k in runs])) for runs in together.values()]

    def deviance(length: float, nugget: float) -> float:
        """Restricted likelihood: level and trend of each run are left out, or slow noise would be taken for them."""
        square = logs = 0.0
        for position, runs, columns in groups:
            rho = correlations(position, length)
            gain, deviation = gains(rho, nugget)
            inside = innovations(columns, rho, gain, deviation).reshape(len(position), len(runs), 3)
            gram = np.einsum("ira,irb->rab", inside, inside)
            basis, along = gram[:, 1:, 1:], gram[:, 1:, :1]
            square += float(np.sum(gram[:, 0, 0] - (along * np.linalg.solve(basis, along)).sum(axis=(1, 2))))
            logs += float(len(runs) * 2.0 * np.sum(np.log(deviation)) + np.sum(np.log(np.linalg.det(basis))))
        free = total - 2 * len(trends)
        return float(free * np.log(square / free) + logs)

    best = (deviance(0.0, 0.0), 0.0, 0.0)
    for _ in range(3):
        if best[1] == 0:
            lengths: Sequence[float] = [spacing * 2.0**k for k in range(-1, 8) if spacing * 2.0**k < 0.3 * longest]
            nuggets: Sequence[float] = (0.0, 0.1, 0.3, 0.6, 0.85)
        else:
            lengths = [best[1] * factor for factor in (0.6, 0.8, 1.0, 1.25, 1.6)]
            nuggets = [min(max(best[2] + shift, 0.0), 0.97) for shift in (-0.08, 0.0, 0.08)]
        trials = [(deviance(length, nugget), length, nugget) for length in lengths for nugget in nuggets]
        if not trials or min(trials)[0] >= best[0] - (6 if best[1] == 0 else 0):
            break
        best = min(trials)
    return best[1], best[2]


def autoregression_of(series: Sequence[Floats], trends: Sequence[Floats], shares: Sequence[float], most: int = 10) -> Floats:
    """Remaining correlation of the innovations: taps of the order with the best AIC, last entry the gain.

    ``series`` (n,) of unit size, which lack their ``trends`` (n, m) and count for their ``shares``.  What is left of white noise
    without its trends goes together less than not at all: a sample's products with its neighbours fall short by the trace of the
    projection there.  Runs of fifty samples would seem to have a quarter of their noise at slow waves.
    One tap too many costs little; a resonance that is left makes effects out of noise.
    """
    total = sum(share * e.size for e, share in zip(series, shares))
    most = min(most, int(total / PER_TAP))
    c = np.zeros(most + 1)
    for e, trend, share in zip(series, trends, shares):
        basis = np.linalg.qr(trend)[0]
        left = np.clip(e - basis @ (basis.T @ e), -4, 4)
        variance = left @ left / max(e.size - basis.shape[1], 1)
        lost = [float(np.sum(basis[lag:] * basis[: e.size - lag])) for lag in range(most + 1)]
        c += share * np.array([left[lag:] @ left[: e.size - lag] + variance * lost[lag] for lag in range(most + 1)])
    c /= c[0]
    best: tuple[float, Floats] = (0.0, np.zeros(0))
    for order in range(1, most + 1):
        matrix = c[np.abs(np.subtract.outer(np.arange(order), np.arange(order)))]
        taps = np.linalg.solve(matrix, c[1: order + 1])
        variance = 1 - taps @ c[1: order + 1]
        if variance <= 0:
            continue
        score = 0.5 * total * float(np.log(variance)) + order
        if score < best[0] - 1:
            best = (score, np.append(taps, np.sqrt(variance)))
    return best[1]
