"""Try: a curve over an angle, from the zero and with the lag that suit it: effects move both, and those of the base model make an effect look worse.

A comparison fits them once for all runs; here each curve has its own, which costs a step to first order and no prediction.
"""

import math
from collections.abc import Sequence

import numpy as np

from discrepancy.prediction.conditions import places_of_zero
from discrepancy.problem import ERROR, Parameter, Record
from fmu_src.arrays import Floats
from pages.words import number

# Radians of the output.  Beyond, one step of a pattern of some eighty waves a turn says nothing.
FARTHEST = 0.005
# Errors that differ by less than this share look the same.
ALIKE = 0.01


def at_own_zero(record: Record, predicted: Floats, nuisances: Sequence[Parameter]) -> Floats:
    """The prediction (n,) of a transmission error as the angles are counted from where it fits best; others, and known zeros, as they are."""
    return moved(record, predicted, nuisances)[0]


def moved(record: Record, predicted: Floats, nuisances: Sequence[Parameter]) -> tuple[Floats, float]:
    """``at_own_zero``, and by how much [rad of the output] the curve was moved for it."""
    free = set(places_of_zero(record)) & {p.name for p in nuisances}
    if record.quantity != ERROR or "angle" not in record.axes or not free:
        return predicted, 0.0
    angle = np.asarray(record.axes["angle"], float)
    good = record.counted & np.isfinite(record.values) & np.isfinite(predicted)
    if good.sum() < 3 or not np.all(np.diff(angle)):
        return predicted, 0.0
    slope = np.gradient(predicted, angle)
    slope -= slope[good].mean()
    level, left = slope[good], (record.values - predicted)[good]
    size = float(level @ level)
    if not size > 0.0:
        return predicted, 0.0
    by = float(np.clip(level @ left / size, -FARTHEST, FARTHEST))
    found: Floats = predicted + slope * by
    return found, by


def as_in_look(in_common: float, own: float, unit: str, by: float) -> str:
    """Why an error of one curve is ``own`` here and another one in Look, where all runs have one zero and one lag; empty where they are alike."""
    if abs(in_common - own) < ALIKE * own:
        return ""
    moved_by = f"{number(math.degrees(by), 2)} deg"
    return f"{number(in_common, 3)} {unit} at the one zero and lag that Look has for all runs: here the model is moved by {moved_by} to its own"
