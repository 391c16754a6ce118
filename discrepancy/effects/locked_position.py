"""A loop that was measured with the input locked at one position, and is predicted as the mean over a turn of the cranks.

    y = x + sum_k a_k p_k(T),  k = 1 to 5

x is the mean of the base model's turnings at positions over a turn of the cranks, T the torque; p_k are the first principal components of what
the turning at one position departs from it by, so normalised that each a_k has a mean square of 1 over the positions: what is known of
them beforehand.  The first carries 92 to 99 % of it and is what play and clearance change in a loop; three would leave 0.1 to 0.2 arcsec,
which good loops show, five leave less than 0.1.

One position for all loops is the usual one: a rig locks its input and goes through torques and temperatures.  If it was turned between
conditions each has its own a_k.

Source: the base model (docs/standard_tests.md); which position, nobody said.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from discrepancy.problem import Record, is_unplaced
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude

PER = "loops"
# Standard deviation of its amplitudes over positions.
PRIOR = 1.0
COMPONENTS = 5
PARTS = tuple(f"position_{k}" for k in range(1, COMPONENTS + 1))
# What ``at`` knows besides: the components at the record's samples (COMPONENTS, n) [rad].
PATTERNS = "position_patterns"
EFFECT = Effect(
    0, "input locked at one position, not at many", "y = x + sum_k a_k p_k(T), p_k: components of what loops at single positions depart from their mean by",
    "the base model's loops at 16 positions over a turn of the cranks",
    "a loop wider or narrower about no torque, as more or less play makes it; gone where the position is stated",
    tuple(amplitude(part, "1", f"share of component {k + 1}, of its deviation over positions", 1.0, -4.0, 4.0) for k, part in enumerate(PARTS)),
    signals=("hysteresis",),
    # Where the position, or that it is a mean, is stated there is nothing to look for.
    needs="unknown position",
)  # fmt: skip


def change(values: Floats, record: Record, at: Callable[[str], Any], size: float) -> Floats:
    if not is_unplaced(record):
        return values
    changed: Floats = values + np.array([at(part) for part in PARTS]) @ at(PATTERNS)
    return changed
