"""How finely a run is computed: as finely as the noise of what was measured lets one tell."""

import copy
from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import TypeVar

import numpy as np

from discrepancy.prediction.support import COARSEST, COMB
from discrepancy.problem import ERROR, FREE_ZERO, ORDERS, Record
from discrepancy.rounding import SERIES, jumps_of, noise_of
from fmu_src.arrays import Floats

# What interpolation may add to the chi-square of a condition's signal, spread over all orders: so much, or such a share of the standard deviation that
# noise gives it.
SEEN, OF_NOISE = 4.0, 0.1
# What equilibria are solved to [rad] (``units.TOLERANCE``; two ways to one equilibrium differ by a tenth of it): an angle below needs no nodes.
SOLVED = 5e-11
# What it may err, of what is changed, where only a direction is looked for or a fit goes on.
ROUGHLY = 0.15
# The fewest nodes are for searches; what is reported may err by so much less there: of few samples noise itself is hardly known.
FEWEST = 0.2
# What is changed to first order is changed by such a share of a typical amplitude.
STEP = 0.01
# A level's error over that of the one before, and what it may be of what is changed to first order, and of a whole change, where finer ones are no better.
NO_LESS, OF_JUMPS, OF_WHOLE = 0.6, 0.5, 0.3
# An error of that much of what is changed says that nodes show nothing of it, be it jumps or a wave faster than they are (teeth of the first stage: order
# 1,440 on 1,447 nodes is an order 7); from ``FAST`` on they would show a wave.
NOTHING, FAST = 0.3, 6
# Finer than this there are no nodes: every sample is computed.
EVERY_SAMPLE = 99
# A decision holds for all values that are less far from the base model's, and for those that are this much further.
FURTHER = 1.25
# A level's error over that of the next, where it falls fast.
A_LEVEL = 2.0

Values = Mapping[str, float]
# Quantity and condition.
Group = tuple[str, str]
# What is away from the base model, and to which side.
Added = tuple[Group, tuple[tuple[str, bool], ...]]
Known = TypeVar("Known")
# Error of interpolation and size of what is interpolated, root mean square, at a level; None where nodes are not worthwhile.
ErrsAt = Callable[[int], tuple[float, float] | None]


class Fineness:
    """Levels of nodes by signal, condition and what is added to the base model; each found once."""

    # Whether predictions may err as much as is allowed roughly.
    rough = False

    def __init__(self, records: Sequence[Record]):
        noise: dict[Group, float] = {}
        counts: dict[Group, int] = {}
        whole: set[Group] = set()
        scatter = scatter_of_orders(records)
        for record in records:
            # Orders are computed as the curve that has them.
            group = (ERROR if record.quantity == ORDERS else record.quantity, record.condition)
            counts[group] = counts.get(group, 0) + len(record.values)
            if record.quantity != ORDERS:
                whole.add(group)
            own = record.stated_noise or scatter if record.quantity == ORDERS else fast_noise(np.asarray(record.values, float))
            noise[group] = min(noise.get(group, np.inf), own)
        self.allowed = {g: max(noise[g] * float(np.sqrt(hidden(count) / count)), SOLVED if g[0] in FREE_ZERO else 0.0) for g, count in counts.items()}
        # Where only orders were measured, nodes for these may do: what lies between shows as their error.
        self.orders = set(counts) - whole
        self.base: dict[Group, int] = {}
        # Parameters that change nothing alone, only how an amplitude shows.
        self.shapes: set[str] = set()
        # Those of which a change hangs so much that it is looked at where they start, where it is large.
        self.steep: set[str] = set()
        # How far off it was, and the level that it needs.
        self.added: dict[Added, list[tuple[Floats, int]]] = {}
        # What is changed to first order needs, where nothing else is known.
        self.slopes: dict[Added, int] = {}

    def roughly(self) -> "Fineness":
        """The same for rough predictions."""
        other = copy.copy(self)
        other.rough, other.added, other.slopes = True, {}, {}
        return other

    def level(self, record: Record, away: Mapping[str, float], errs: ErrsAt) -> int:
        """The level for values of which ``away`` says by name how far the plant's are off the base model's."""
        group = (record.quantity, record.condition)
        if group not in self.allowed:
            return EVERY_SAMPLE
        amounts = self.amounts(away)
        if not amounts:
            if group not in self.base:
                self.base[group] = self.found(self.allowed[group], 0.0, errs, COARSEST if group in self.orders else COMB)
            return self.base[group]
        off = np.abs(np.array(list(amounts.values())))
        known = self.added.setdefault(added(group, amounts), [])
        for distances, level in known:
            # A share of the change is so at any distance.
            if self.rough or np.all(off <= FURTHER * distances):
                return level
        first = max((level for _, level in known), default=self.elsewhere(self.added, group, amounts, lambda known: known[0][1]))
        share, most = (ROUGHLY, OF_WHOLE) if self.rough else (0.0, 0.0)
        level = self.found(self.allowed[group], share, errs, first, most, 1.0 if self.rough or group in self.orders else FEWEST)
        known.append((off, level))
        return level

    def level_of_slopes(self, record: Record, away: Mapping[str, float], errs: ErrsAt) -> int:
        """The level for what they change to first order, roughly: that of a whole change, if one is known."""
        group = (record.quantity, record.condition)
        if group not in self.allowed:
            return EVERY_SAMPLE
        amounts = self.amounts(away)
        key = added(group, amounts)
        if self.added.get(key):
            return self.added[key][0][1]
        if key not in self.slopes:
            first = self.elsewhere(self.slopes, group, amounts, lambda level: level)
            self.slopes[key] = self.found(STEP * self.allowed[group], ROUGHLY, errs, first, OF_JUMPS)
        return self.slopes[key]

    def elsewhere(self, levels: Mapping[Added, Known], group: Group, amounts: Mapping[str, float], level_of: Callable[[Known], int]) -> int:
        """Where to begin: roughly, with the least level that the same change needs in other conditions; a single one may be the hardest."""
        if not self.rough:
            return COARSEST
        others = [level_of(levels[added(g, amounts)]) for g in self.allowed if g[0] == group[0] and levels.get(added(g, amounts))]
        return COARSEST if others == [EVERY_SAMPLE] else min(others, default=COARSEST)

    def largest(self, values: Values) -> Values:
        """The values at which one looks how smooth their change is."""
        return {name: value for name, value in values.items() if name not in self.steep} if self.steep else values

    def amounts(self, away: Mapping[str, float]) -> dict[str, float]:
        return {name: off for name, off in sorted(away.items()) if name not in self.shapes}

    def found(self, allowed: float, share: float, errs: ErrsAt, first: int = 0, most: float = 0.0, fewest: float = 1.0) -> int:
        """The first level, not before ``first``, at which what interpolation errs stays below ``allowed``, or below a ``share`` of the change, and below
        ``fewest`` of that with the fewest nodes.

        An error below the share ``most`` that does not fall is that of jumps, which are as sharp at any level.
        """
        level, before = first, np.inf
        while level < EVERY_SAMPLE:
            at = errs(level)
            if at is None:
                if level >= 0:
                    return EVERY_SAMPLE
                # More than the first nodes without bands may be.
                level = 0
                continue
            error, size = at
            least = max(allowed, share * size) * (fewest if level < COMB else 1.0)
            # Between the few nodes of a band it may be anything.
            if error <= least or (level >= (0 if error < NOTHING * size else FAST) and NO_LESS * before < error < most * size):
                return level
            finer = level + max(1, int(np.log(error / least) / np.log(A_LEVEL))) if least > 0.0 else EVERY_SAMPLE
            # What few orders make, however high, nodes without bands show last.
            level, before = min(finer, COMB) if level < COMB else finer, error
        return EVERY_SAMPLE


def hidden(count: int) -> float:
    """What may be added to a chi-square of so many samples without anyone noticing."""
    return max(SEEN, OF_NOISE * float(np.sqrt(2.0 * count)))


def added(group: Group, amounts: Mapping[str, float]) -> Added:
    return group, tuple((name, amount > 0.0) for name, amount in amounts.items())


def scatter_of_orders(records: Sequence[Record]) -> float:
    """Standard deviation of the numbers of orders between runs that repeat each other; 0 where none do."""
    alike: dict[Hashable, list[Floats]] = {}
    for r in records:
        if r.quantity == ORDERS and not r.left_out:
            alike.setdefault((r.condition, r.mounting, r.factors.get("direction"), np.asarray(r.axes["order"]).tobytes()), []).append(r.values)
    repeated = [np.array(runs) for runs in alike.values() if len(runs) > 1]
    squares = [float(np.sum((runs - runs.mean(axis=0)) ** 2)) for runs in repeated]
    return float(np.sqrt(sum(squares) / sum((len(runs) - 1) * runs.shape[1] for runs in repeated))) if repeated else 0.0


def fast_noise(values: Floats) -> float:
    """Standard deviation of what jumps from sample to sample, at least that of rounding."""
    return max(jumps_of(values), noise_of(values)) if len(values) >= SERIES else 0.0
