"""How finely a run is computed: as finely as the noise of what was measured lets one tell."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats

# What interpolation may add to the chi-square of a condition's signal, root: far below what noise adds, spread over all orders.
SEEN = 3.0
# Finer than this there are no nodes: every sample is computed.
EVERY_SAMPLE = 99
# A decision is made for values this many times as far from the base model's, and holds for all that are less.
AHEAD = 2.0

Group = tuple[str, str]
# Error of interpolation, root mean square, at a level with some values of the model; None where nodes are not worthwhile.
ErrorAt = Callable[[int, Mapping[str, float]], float | None]


class Fineness:
    """Levels of nodes by signal, condition and what is added to the base model; each found once."""

    def __init__(self, records: Sequence[Record]):
        self.allowed: dict[Group, float] = {}
        counts: dict[Group, int] = {}
        for record in records:
            group = (record.quantity, record.condition)
            counts[group] = counts.get(group, 0) + len(record.values)
            self.allowed[group] = min(self.allowed.get(group, np.inf), fast_noise(np.asarray(record.values, float)))
        for group, count in counts.items():
            self.allowed[group] *= SEEN / np.sqrt(count)
        self.base: dict[Group, int] = {}
        # By name: distances from the base model's value, and the level that they need, growing.
        self.added: dict[tuple[Group, str, bool], list[tuple[float, int]]] = {}

    def level(self, record: Record, away: Mapping[str, tuple[float, float]], error: ErrorAt) -> int:
        """The level for values that are ``away`` from the base model: by name its value there and how far they are off."""
        group = (record.quantity, record.condition)
        if group not in self.base:
            self.base[group] = self.found(group, 0, {}, error)
        level = self.base[group]
        for name, (start, off) in away.items():
            known = self.added.setdefault((group, name, off > 0.0), [])
            large = [found for distance, found in known if distance >= abs(off)]
            if not large:
                large = [self.found(group, self.base[group], {name: start + AHEAD * off}, error)]
                known.append((AHEAD * abs(off), large[0]))
            level = max(level, large[0])
        return level

    def found(self, group: Group, first: int, values: Mapping[str, float], error: ErrorAt) -> int:
        """The first level at which what interpolation errs stays below what noise allows."""
        level = first
        while level < EVERY_SAMPLE:
            at = error(level, values)
            if at is None:
                return EVERY_SAMPLE
            if at <= self.allowed[group]:
                return level
            # Errors fall with some power of the distance: far off, two levels at once.
            level += 2 if at > 4.0 * self.allowed[group] else 1
        return EVERY_SAMPLE


def fast_noise(values: Floats) -> float:
    """Standard deviation of what jumps from sample to sample, at least that of rounding."""
    if len(values) < 8:
        return 0.0
    third = np.diff(values, 3)
    steps = np.diff(np.unique(values))
    rounding = float(steps.min()) / np.sqrt(12.0) if len(steps) else 0.0
    return max(1.4826 * float(np.median(np.abs(third))) / np.sqrt(20.0), rounding)
