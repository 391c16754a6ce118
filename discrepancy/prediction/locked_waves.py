"""Which wave of the pattern the angles of locked inputs count from, where a mounting's zero is found by that pattern.

A transmission error looks alike a wave further on, where the discs have changed places.  A loop does not: pins and lobes then mesh half a pitch apart,
which friction shows at one place (2 arcsec beside oval discs, 0.2 in the base model).  The loops of known places tell, with the base model and anew with
each set of effects.
"""

from collections.abc import Callable, Sequence

import numpy as np

from discrepancy.held_names import LOCKED_AT
from discrepancy.prediction.by_effects import Effects, with_most
from discrepancy.prediction.conditions import angle_zero
from discrepancy.prediction.locked_places import has_place, shifted
from discrepancy.prediction.unstated_places import fewer_samples
from discrepancy.problem import Record
from fmu_src.arrays import Floats

# Squares that another wave leaves of those that the one taken leaves: from more it stays.
CLEARLY = 0.8


class LockedWaves:
    """By effects and mounting how many waves further angles count; ``wave``: one of them [rad of the input], ``count`` differ (the discs)."""

    def __init__(self, records: Sequence[Record], zeros: Sequence[str], wave: float, count: int):
        self.wave, self.count = wave, count
        self.names = {name for name in zeros if any(angle_zero(r) == name and has_place(r) for r in records)}
        # One of each condition tells: they were not turned between.
        self.loops: dict[str, dict[str, Record]] = {}
        for record in records:
            if angle_zero(record) in self.names and record.quantity == "hysteresis" and LOCKED_AT in record.factors and record.fitted:
                self.loops.setdefault(angle_zero(record), {}).setdefault(record.condition, fewer_samples(record))
        self.found: dict[Effects, dict[str, int]] = {}

    def taken(self, effects: Effects) -> dict[str, int]:
        """Those found with these effects, else with the most of them."""
        return with_most(self.found, effects, {})

    def counts(self, record: Record) -> bool:
        """Whether a record's place counts from a zero that is found."""
        return has_place(record) and angle_zero(record) in self.names

    def placed(self, record: Record, effects: Effects) -> Record:
        """The record as if it was locked that many waves further."""
        return self.further(record, self.taken(effects).get(angle_zero(record), 0))

    def further(self, record: Record, waves: int) -> Record:
        """A record of a known place as if it was locked ``waves`` further."""
        return shifted(record, waves * self.wave) if has_place(record) else record

    def chosen(self, effects: Effects, predicted: Callable[[Record], Floats], placed: Callable[[Record], Record]) -> dict[str, int]:
        """The waves with these effects, of loops ``predicted`` [rad] where they are ``placed`` by their zero."""
        chosen = {}
        for name, loops in self.loops.items():
            known = [placed(loop) for loop in loops.values()]
            left = [sum(float(np.var(loop.values - predicted(self.further(loop, k)))) for loop in known) for k in range(self.count)]
            now, best = self.taken(effects).get(name, 0), int(np.argmin(left))
            chosen[name] = best if left[best] < CLEARLY * left[now] else now
        return chosen

    def place(self, effects: Effects, predicted: Callable[[Record], Floats], placed: Callable[[Record], Record]) -> bool:
        """Takes the waves for these effects; False if that changes nothing."""
        before, found = self.taken(effects), self.chosen(effects, predicted, placed)
        self.found[effects] = found
        return any(count != before.get(name, 0) for name, count in found.items())

    def are_elsewhere(self, effects: Effects, predicted: Callable[[Record], Floats], placed: Callable[[Record], Record]) -> bool:
        """Whether loops show other waves than those that are taken with these effects."""
        taken = self.taken(effects)
        return any(count != taken.get(name, 0) for name, count in self.chosen(effects, predicted, placed).items())
