"""Runs that repeat each other, the one among them that does not, and those that are copies.

Repetitions of one condition are told by a few sizes of each run (how far it spans, its mean, how far it departs from the middle of
all); one that is far from the median of the others, by their median absolute deviation, stands out.  Of three to five runs that
deviation is itself hardly known: what is far is taken from the distribution that normal noise gives with so few.
"""

from collections import defaultdict
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats

# Largest of n deviations from the median over their median (times 1.4826): what normal noise passes once in 20 and in 200 groups.
# Simulated, 200,000 groups each.
COUNTS = (3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 15.0, 20.0, 30.0, 50.0)
ONCE_IN_20 = (22.0, 6.9, 7.9, 5.5, 5.8, 4.9, 4.6, 4.4, 4.3, 4.0, 3.8, 3.8)
ONCE_IN_200 = (223.0, 22.7, 26.9, 12.8, 13.8, 9.7, 8.1, 7.3, 6.8, 5.8, 5.2, 4.8)
# Repetitions that agree better than this share of their size are equal (assumed: no bench promises more).
EQUAL = 0.02
# A size so many times off the median is no noise of a bench (assumed) if deviations say once in 20, too.
TWICE = 2.0
# Off the nearest other by so many times, where the others agree within the factor before (assumed): also among three.
THREEFOLD = 3.0
# Below so many samples a run is a list of numbers.
SERIES = 8
# Numbers below which runs may agree to the last digit by chance.
FEW = 3
# Share of the samples at either end that does not count for what a run spans: single spikes are another fault.
SPIKES = 0.005
# Few repetitions may seem to deviate by so many times what is usual without being another kind (assumed).
USUAL = 3.0
# A deviation of so many times the usual one still has full weight.
FULL = 2.5


@dataclass(frozen=True)
class Outlying:
    """A run that stands out of its repetitions by one of its sizes.

    ``what`` names the size, ``size`` is the run's, ``low`` to ``high`` those of the others, all in ``unit`` (SI); ``times`` is its distance
    to the median in usual deviations; ``weight`` (0 to 1) what the run should count for (Huber).
    """

    run: str
    quantity: str
    tags: tuple[tuple[str, str], ...]
    condition: str
    replicate: int
    count: int
    what: str
    size: float
    low: float
    high: float
    unit: str
    times: float

    @property
    def weight(self) -> float:
        return min(1.0, FULL / self.times)

    @property
    def signal(self) -> str:
        return self.quantity + (f"[{','.join(f'{k}={v}' for k, v in self.tags)}]" if self.tags else "")


def outlying(records: Sequence[Record]) -> list[Outlying]:
    """Each run that stands out, by the plainest of its sizes that does: span, mean, departure."""
    groups: dict[Hashable, list[Record]] = defaultdict(list)
    for record in records:
        tags = tuple(sorted(record.tags.items()))
        groups[record.quantity, tags, record.condition, record.mounting, record.factors.get("direction", 1.0)].append(record)
    repeated = [members for members in groups.values() if len(members) > 2]
    usual = usual_deviations(repeated)
    found: dict[str, Outlying] = {}
    for members in repeated:
        for what, sizes in sizes_of(members).items():
            common = usual[members[0].quantity, what]
            for k, times in enumerate(distances(sizes, *common)):
                rest = np.delete(sizes, k)
                r = members[k]
                if times > 0.0 and r.name not in found:
                    found[r.name] = Outlying(
                        r.name, r.quantity, tuple(sorted(r.tags.items())), r.condition, r.replicate, len(members), what, float(sizes[k]),
                        float(rest.min()), float(rest.max()), r.unit, float(times),
                    )  # fmt: skip
    return list(found.values())


def copies(records: Sequence[Record]) -> dict[str, str]:
    """Name of each run that holds the numbers of another one of its condition -> that one, which comes before it.

    A series that agrees to the last digit is a copy of a file.  Few numbers may agree by chance, or because the instrument shows no
    finer: they count as copies where no repetition of their signal differs and no noise is stated, for they tell nothing of it then.
    """
    groups: dict[Hashable, dict[Hashable, list[Record]]] = defaultdict(lambda: defaultdict(list))
    for record in records:
        signal = record.quantity, tuple(sorted(record.tags.items()))
        groups[signal][record.condition].append(record)
    found: dict[str, str] = {}
    for conditions in groups.values():
        same = [pair for members in conditions.values() for pair in equal_pairs(members)]
        few = [r for members in conditions.values() if len(members) > 1 for r in members if is_few(r)]
        chance = any(r.stated_noise for r in few) or len(few) > len({r.condition for r in few}) + sum(is_few(copy) for copy, _ in same)
        found |= {copy.name: first.name for copy, first in same if not (chance and is_few(copy))}
    return found


def equal_pairs(members: Sequence[Record]) -> list[tuple[Record, Record]]:
    """(copy, the first that holds the same numbers) of one signal and condition."""
    first: dict[bytes, Record] = {}
    pairs = []
    for record in members:
        held = b"|".join(np.ascontiguousarray(column, float).tobytes() for column in (record.values, *(record.axes[name] for name in sorted(record.axes))))
        if (original := first.setdefault(held, record)) is not record:
            pairs.append((record, original))
    return pairs


def is_few(record: Record) -> bool:
    return len(record.values) < FEW or float(np.ptp(record.values)) == 0.0


def sizes_of(members: Sequence[Record]) -> dict[str, Floats]:
    """By name, one size of each run (n,) in SI."""
    values = [np.asarray(r.values, float)[np.isfinite(r.values)] for r in members]
    lengths = {len(v) for v in values}
    if 0 in lengths:
        return {}
    if min(lengths) < SERIES:
        count = len(values[0]) if len(lengths) == 1 else 0
        return {f"number {j + 1}" if count > 1 else "value": np.array([v[j] for v in values]) for j in range(count)}
    found = {"span": np.array([np.ptp(np.quantile(v, (SPIKES, 1.0 - SPIKES))) for v in values])}
    free = members[0].free_zero
    if not free:
        found["mean"] = np.array([v.mean() for v in values])
    if len(lengths) == 1 and len(values[0]) == len(members[0].values) and same_axes(members):
        stack = np.array([v - v.mean() for v in values] if free else values)
        found["departure"] = np.sqrt(np.mean((stack - np.median(stack, axis=0)) ** 2, axis=1))
    return found


def same_axes(members: Sequence[Record]) -> bool:
    """Whether the runs were sampled at the same places."""
    first = members[0].axes
    moving = [name for name in first if name != "time"] or list(first)
    return all(
        name in r.axes and len(r.axes[name]) == len(first[name]) and np.allclose(r.axes[name], first[name], rtol=0.0, atol=1e-3 * np.ptp(first[name]) + 1e-300)
        for r in members for name in moving
    )  # fmt: skip


def usual_deviations(repeated: Sequence[Sequence[Record]]) -> dict[tuple[str, str], tuple[float, int]]:
    """Of each quantity and size: the usual deviation as a share of the size, over all conditions, and from how many."""
    shares: dict[tuple[str, str], list[float]] = defaultdict(list)
    for members in repeated:
        for what, sizes in sizes_of(members).items():
            middle = float(np.median(sizes))
            shares[members[0].quantity, what] += list(np.abs(sizes - middle) / (abs(middle) or 1.0))
    return {key: (1.4826 * float(np.median(v)), len(v)) for key, v in shares.items()}


def distances(sizes: Floats, common: float, count: int) -> Floats:
    """Of each size that stands out its distance to the median in usual deviations; 0 of the others.

    ``common``: the deviation that is usual in all conditions, as a share of the size; known from ``count`` numbers.
    """
    middle = float(np.median(sizes))
    away = np.abs(sizes - middle)
    own = 1.4826 * float(np.median(away))
    pooled = common * abs(middle)
    scale = max(own, pooled, EQUAL * abs(middle), 1e-300)
    times = away / scale
    # Where this condition deviates as all do, so many numbers carry the scale.
    known = float(count if own <= USUAL * pooled else len(sizes))
    rarely, hardly = (float(np.interp(known, COUNTS, limits)) for limits in (ONCE_IN_20, ONCE_IN_200))
    stands_out = times > hardly
    if np.all(sizes > 0.0):
        factor = np.maximum(sizes / middle, middle / sizes)
        stands_out |= (times > rarely) & (factor >= TWICE)
        stands_out |= np.array([far_from_all(sizes, k) for k in range(len(sizes))])
    return np.where(stands_out, np.maximum(times, FULL), 0.0)


def far_from_all(sizes: Floats, k: int) -> bool:
    """Whether one positive size is several times off the nearest other while the others agree."""
    rest = np.delete(sizes, k)
    nearest = min(float(np.max([sizes[k] / r, r / sizes[k]])) for r in rest)
    return bool(nearest >= THREEFOLD and rest.max() <= TWICE * rest.min())
