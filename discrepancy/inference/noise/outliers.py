"""Samples that should not count: missing, stuck, and far from what the replicates agree on."""

import numpy as np
from scipy.ndimage import median_filter

from fmu_src.arrays import Floats, Mask

CUT = 2.5


def usable(values: Floats) -> Mask:
    """Mask of samples that are neither missing nor part of a stuck stretch (a dropout).

    A stretch counts as stuck when at least eight samples are identical and the record
    elsewhere does not repeat itself (so that coarse quantisation is not taken for it).
    """
    good = np.isfinite(values)
    if values.size < 32:
        return good
    same = np.concatenate([[False], np.diff(values) == 0])
    starts = np.flatnonzero(~same)
    lengths = np.diff(np.append(starts, values.size))
    stuck = lengths >= 8
    moving = lengths[~stuck]
    if stuck.any() and moving.size and np.mean(moving) < 2:
        for start, length in zip(starts[stuck], lengths[stuck]):
            good[max(start - 1, 0): start + length + 1] = False
    if good.sum() < 0.3 * values.size:
        return np.isfinite(values)
    return good


def robust_scale(values: Floats) -> float:
    """Standard deviation by the median absolute value (about zero), consistent for a normal law."""
    return float(1.4826 * np.median(np.abs(values))) if values.size else 0.0


def huber_weights(deviations: Floats, cut: float = CUT) -> Floats:
    """Huber's weights of deviations in units of the scale."""
    return np.minimum(1.0, cut / np.maximum(np.abs(deviations), 1e-300))


def local_deviation(innovations: Floats, width: int = 9) -> Floats:
    """Deviation from the running median: what a record alone can say about its outliers."""
    if innovations.size < width:
        return np.zeros_like(innovations)
    return innovations - median_filter(innovations, size=width, mode="nearest")
