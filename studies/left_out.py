"""Whether a curve was measured at a place, or samples about it were left out: nobody reads a figure across these."""

import numpy as np
import numpy.typing as npt

from fmu_src.arrays import Floats

# Neighbours that are further apart than so many of the steps about them have something between them that was left out.
GAP = 3.0
# Nearer to a torque than this share of it nothing is left out, however close samples lie elsewhere (assumed: the play is gone through below that).
CLOSE = 0.5


def between_near(levels: Floats, at: Floats, close: Floats) -> npt.NDArray[np.bool_]:
    """Whether places ``at`` (n,) lie between neighbours of the rising ``levels`` (m,) that are hardly further apart than those about them, or that are
    ``close`` (n,): a line through what was left out is no reading."""
    if len(levels) < 2:
        return np.zeros(len(at), bool)
    steps = np.diff(levels)
    gap = np.clip(np.searchsorted(levels, at) - 1, 0, len(steps) - 1)
    about = np.maximum(steps[np.maximum(gap - 1, 0)] * (gap > 0), steps[np.minimum(gap + 1, len(steps) - 1)] * (gap < len(steps) - 1))
    inside = (levels[0] <= at) & (at <= levels[-1])
    # A line's error grows with the product of the distances to both ends: that of neighbours so far apart, half-way between them.
    as_if = 2.0 * np.sqrt(np.where(inside, (at - levels[gap]) * (levels[gap + 1] - at), 0.0))
    found: npt.NDArray[np.bool_] = inside & ((steps[gap] <= GAP * about) | (as_if <= close) | (len(steps) == 1))
    return found
