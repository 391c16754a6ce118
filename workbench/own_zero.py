"""Try: a curve over an angle, from the zero and with the lag that suit it: effects move both, and those of the base model make an effect look worse.

A comparison fits them once for all runs; here each curve has its own, which costs a step to first order and no prediction.
"""

from collections.abc import Sequence

import numpy as np

from discrepancy.prediction.conditions import places_of_zero
from discrepancy.problem import ERROR, Parameter, Record
from fmu_src.arrays import Floats

# Radians of the output.  Beyond, one step of a pattern of some eighty waves a turn says nothing.
FARTHEST = 0.005


def at_own_zero(record: Record, predicted: Floats, nuisances: Sequence[Parameter]) -> Floats:
    """The prediction (n,) of a transmission error as the angles are counted from where it fits best; others, and known zeros, as they are."""
    free = set(places_of_zero(record)) & {p.name for p in nuisances}
    if record.quantity != ERROR or "angle" not in record.axes or not free:
        return predicted
    angle = np.asarray(record.axes["angle"], float)
    good = record.counted & np.isfinite(record.values) & np.isfinite(predicted)
    if good.sum() < 3 or not np.all(np.diff(angle)):
        return predicted
    slope = np.gradient(predicted, angle)
    slope -= slope[good].mean()
    level, left = slope[good], (record.values - predicted)[good]
    size = float(level @ level)
    if not size > 0.0:
        return predicted
    found: Floats = predicted + slope * float(np.clip(level @ left / size, -FARTHEST, FARTHEST))
    return found
