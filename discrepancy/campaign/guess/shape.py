"""What a column's curve looks like."""

from dataclasses import dataclass

import numpy as np

from fmu_src.arrays import Floats

# A reversal counts from this share of the range on: noise makes smaller ones.
REVERSAL = 0.2
# What rises throughout falls back by no more than this share of the range.
STEADY = 0.02


@dataclass(frozen=True)
class Shape:
    """Range, number of large reversals, whether it is one number, rises or falls throughout, holds whole numbers."""

    low: float
    high: float
    reversals: int
    constant: bool
    steady: bool
    whole: bool
    jumps: bool

    @property
    def span(self) -> float:
        return self.high - self.low

    @property
    def loops(self) -> bool:
        """Goes up and down again, as a torque does that is put on and taken off."""
        return not self.constant and 1 <= self.reversals <= 40 and not self.jumps


def shape_of(values: Floats) -> Shape | None:
    """None if there are no numbers."""
    known = values[np.isfinite(values)]
    if not len(known):
        return None
    low, high = float(known.min()), float(known.max())
    span = high - low
    steps = np.diff(known)
    steady = span > 0.0 and reversals(known, STEADY * span) == 0
    jumps = bool(len(steps) > 4 and span > 0.0 and np.abs(steps).max() > 0.8 * span and np.median(np.abs(steps)) < 0.1 * span)
    return Shape(low, high, reversals(known, REVERSAL * span), span <= 1e-9 * max(abs(low), abs(high)), steady, bool((known == np.round(known)).all()), jumps)


def reversals(values: Floats, least: float) -> int:
    """Turning points between which the values move by more than ``least``."""
    if least <= 0.0:
        return 0
    count, sense, extreme = 0, 0, values[0]
    for value in values[:: max(1, len(values) // 20_000)]:
        if sense * (value - extreme) > 0.0 or (sense == 0 and abs(value - extreme) > least):
            sense, extreme = sense or (1 if value > extreme else -1), value
        elif sense and sense * (extreme - value) > least:
            count, sense, extreme = count + 1, -sense, value
    return count
