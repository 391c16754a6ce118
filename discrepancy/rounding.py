"""What a series says of its own noise: what jumps from sample to sample, and the step in which values were rounded, by a converter or when printed."""

import numpy as np

from fmu_src.arrays import Floats

# Fewer samples tell no noise.
SERIES = 8


def jumps_of(values: Floats) -> float:
    """Standard deviation of what jumps from sample to sample, by third differences; 0 of a few numbers."""
    if len(values) < SERIES:
        return 0.0
    return 1.4826 * float(np.median(np.abs(np.diff(values, 3)))) / float(np.sqrt(20.0))


def step_of(values: Floats) -> float:
    """The smallest distance of different values, where values repeat so often that it is a step; 0 where they do not."""
    kept = values[np.isfinite(values)]
    different = np.unique(kept)
    if len(different) < 2 or 2 * len(different) > len(kept):
        return 0.0
    return float(np.diff(different).min())


def noise_of(values: Floats) -> float:
    """Standard deviation that rounding adds to a sample, in what independent samples would say as little as these.

    Neighbours on one step are off alike: they count as one.
    """
    step = step_of(values)
    if step == 0.0:
        return 0.0
    stays = float(np.mean(np.diff(values[np.isfinite(values)]) == 0.0))
    return step / float(np.sqrt(12.0 * max(1.0 - stays, 1.0 / len(values))))
