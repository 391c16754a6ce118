"""Whether an angle turns as unevenly as the error beside it says: then an encoder on the output wrote it, while the input turned evenly."""

import numpy as np

from fmu_src.arrays import Floats

# Samples that tell it, and how well the two must go together: the least of what is no chance.
LEAST, TOGETHER = 40, 0.9


def is_uneven(angle: Floats, error: Floats) -> bool:
    """``angle`` and ``error`` (n,) in any units, sampled at equal times; False where that cannot be seen: steps that are even are an encoder's marks, or the
    input's angle over the ratio."""
    kept = np.isfinite(angle) & np.isfinite(error)
    if kept.sum() < LEAST:
        return False
    count = np.flatnonzero(kept).astype(float)
    off, wave = (column[kept] - np.polyval(np.polyfit(count, column[kept], 1), count) for column in (angle, error))
    sizes = float(np.std(off) * np.std(wave))
    return sizes > 0.0 and abs(float(np.mean(off * wave))) > TOGETHER * sizes
