"""Noise of what a signal is written over: a torque meter's moves the samples of a loop along it, most where it is steep."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from discrepancy.inference.noise.outliers import robust_scale
from discrepancy.inference.noise.replicates import Deviation
from discrepancy.inference.noise.series import path_of, spacing_of
from discrepancy.problem import Record
from fmu_src.arrays import Floats

BESIDE = 2
"""Samples on either side of one over which its slope is taken."""
EVIDENT, MANY = 2.0, 200.0
"""By how much twice the logarithm of the likelihood has to be the larger for one number more (Akaike), and of how many independent deviations."""
FARTHEST = 4.0
"""Deviations count as so many times the noise at most: what stands alone, far off, says nothing of slopes."""
SHARES = np.geomspace(0.1, 30.0, 40)
"""Noise along the axis where the signal is steep, in units of its own noise, that are tried."""


def slopes_of(record: Record, predicted: Floats) -> Floats:
    """(n,) how much a signal changes with its first axis, as ``predicted`` (n,); zero where that is a clock or an angle, which go on one way and are
    written as they were."""
    path = path_of(record)
    if path.size <= 2 * BESIDE or "torque" not in record.axes:
        return np.zeros(path.size)
    width = 2 * BESIDE + 1
    x = np.lib.stride_tricks.sliding_window_view(np.pad(path, BESIDE, mode="edge"), width)
    y = np.lib.stride_tricks.sliding_window_view(np.pad(predicted, BESIDE, mode="edge"), width)
    # Not across samples that were left out: a slope on one side of them is none between.
    near = np.abs(x - path[:, None]) <= width * spacing_of(path)
    many = near.sum(axis=1, keepdims=True)
    x = np.where(near, x - np.sum(near * x, axis=1, keepdims=True) / many, 0.0)
    slopes: Floats = np.einsum("ij,ij->i", x, y) / np.maximum(np.einsum("ij,ij->i", x, x), 1e-300)
    return slopes


def axis_noise_of(values: Sequence[Floats], slopes: Sequence[Floats], shares: Sequence[float]) -> float:
    """Noise along the axis, in its units over those of one of ``values``' own deviation, of deviations between runs that repeat each other, that makes
    them likeliest, 0 where there is no evidence of any; ``shares`` is what each run counts for."""
    every, steep = np.concatenate(values), np.abs(np.concatenate(slopes))
    counts = np.concatenate([np.full(v.size, share) for v, share in zip(values, shares)])
    steepest = float(np.quantile(steep, 0.99))
    if steepest == 0.0 or counts.sum() < MANY:
        return 0.0

    def deviance(ratio: float) -> float:
        factor = np.hypot(1.0, ratio * steep)
        even = every / factor
        scale = max(robust_scale(even), 1e-300)
        even = np.clip(even / scale, -FARTHEST, FARTHEST)
        return float(counts.sum() * np.log(counts @ even**2 / counts.sum() * scale**2) + 2.0 * counts @ np.log(factor))

    ratios = SHARES / steepest
    found = [deviance(ratio) for ratio in ratios]
    best = int(np.argmin(found))
    return float(ratios[best]) if deviance(0.0) - found[best] > EVIDENT else 0.0


def factor_of(record: Record, predicted: Floats, axis: float) -> Floats:
    """(n,) by how much the noise of each sample is larger for the noise of its ``axis``, in units of that of the signal."""
    if axis == 0.0:
        return np.ones(np.size(record.values))
    factor: Floats = np.hypot(1.0, axis * slopes_of(record, predicted))
    return factor


def evened(deviations: Sequence[Deviation], records: Sequence[Record], predictions: Sequence[Floats], axis: float) -> list[Deviation]:
    """Deviations as they would be without noise of the ``axis``: those of steep places smaller."""
    factors = [factor_of(records[d.index], predictions[d.index], axis)[d.rows] for d in deviations]
    return [replace(d, values=d.values / factor, factor=factor) for d, factor in zip(deviations, factors)]
