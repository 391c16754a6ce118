"""Whether an angle turns as unevenly as the error beside it says: then an encoder on the output wrote it, while the input turned evenly."""

import numpy as np

from fmu_src.arrays import Floats

# Samples that tell it, how well the two must go together (the least of what is no chance), and the share of the error that rounding may leave.
LEAST, TOGETHER, ROUNDING = 40, 0.9, 0.1


def is_of_output(angle: Floats, error: Floats, beside: Floats | None = None) -> bool | None:
    """Of ``angle`` and ``error`` (n,) [rad], sampled at equal times or ``beside`` an angle of the input (in any unit).

    True: it turns as unevenly as the error says.  False: it is a multiple of the input's, with no error between them.  None: it cannot be seen; even steps
    without an input beside them are an encoder's marks, or the input's angle over the ratio.
    """
    kept = np.isfinite(angle) & np.isfinite(error) & (np.isfinite(beside) if beside is not None else True)
    if kept.sum() < LEAST:
        return None
    even = (np.arange(len(angle), dtype=float) if beside is None else beside)[kept]
    off, wave = (column[kept] - np.polyval(np.polyfit(even - even.mean(), column[kept], 1), even - even.mean()) for column in (angle, error))
    sizes = float(np.std(off) * np.std(wave))
    if sizes > 0.0 and abs(float(np.mean(off * wave))) > TOGETHER * sizes:
        return True
    return False if beside is not None and np.std(off) < ROUNDING * np.std(wave) else None
