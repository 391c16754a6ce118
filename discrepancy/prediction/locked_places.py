"""Where inputs were locked, counted as the angles of their mounting: from where the transmission error's pattern is found to begin.

An effect that is larger than the base model's own pattern hides where that lies, by up to half a turn of the input: the places are found anew when
the effect is fitted for good, as the cages are, and follow the zero of its fit.  Places that stay hold a large effect where they were found (a ring
oval by 5 um turned by 0.41 deg of 0.03 known, with a zero 1.2 deg of the input off).
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

from discrepancy.held_names import LOCKED_AT
from discrepancy.prediction.by_effects import ByEffects, Effects
from discrepancy.prediction.conditions import angle_zero
from discrepancy.problem import Record

# Nearer places show the same [rad of the input].
NEAR = math.radians(1.0)


class LockedPlaces(ByEffects):
    """Zeros by mounting [rad of the output]; ``zeros`` are those of the bench itself."""

    def __init__(self, records: Sequence[Record], zeros: Mapping[str, float], ratio: float):
        super().__init__(zeros, NEAR / abs(ratio))
        self.ratio = abs(ratio)
        locked = {angle_zero(r) for r in records if has_place(r)}
        self.names = sorted(locked & self.without.keys())

    def now(self, values: Mapping[str, float]) -> dict[str, float]:
        return {name: values[name] for name in self.names}

    def zero_moved(self, record: Record, values: Mapping[str, float]) -> float:
        """How far the zero of a record's mounting is from the bench's own by ``values`` [rad of the input]."""
        name = angle_zero(record)
        return (values[name] - self.without[name]) * self.ratio if name in self.without and name in values else 0.0

    def placed(self, record: Record, effects: Effects, values: Mapping[str, float] | None = None) -> Record:
        """The record as if it was locked where that is with these effects, counted from the bench's own zero; with ``values`` where exactly these say."""
        name = angle_zero(record)
        if name not in self.names:
            return record
        if effects and values and name in values:
            return shifted(record, self.zero_moved(record, values))
        return shifted(record, (self.taken(effects)[name] - self.without[name]) * self.ratio)


def has_place(record: Record) -> bool:
    """Whether it is said where the input was locked."""
    return LOCKED_AT in record.factors or LOCKED_AT in record.axes


def shifted(record: Record, shift: float) -> Record:
    """A record as if its input was locked ``shift`` [rad] further, wherever it says a place."""
    if not shift:
        return record
    factors = {key: value + shift if key == LOCKED_AT else value for key, value in record.factors.items()}
    axes = {key: axis + shift if key == LOCKED_AT else axis for key, axis in record.axes.items()}
    return replace(record, factors=factors, axes=axes)
