"""Runs that repeat each other, the one among them that does not, and those that are copies.

Repetitions of one condition are told by a few sizes of each run (how far it spans, its mean, how far it departs from the middle of
all); one that is far from the median of the others, by their median absolute deviation, stands out.  Of three to five runs that
deviation is itself hardly known: what is far is taken from the distribution that normal noise gives with so few.

What stands out against most of its repetitions is left out of all that is fitted, judged or averaged.  A weight that falls as one over the distance
would not do: where the others agree closely, a hundredth of a file that is 700 times their noise off still outweighs them.  Of two that differ nobody
knows which is wrong: both count, and it is said.  A single number has nothing but its repetitions to be judged by: it is left out beyond what chance makes
of such scatter once in a hundred groups, else it counts, and is said to stand out.
"""

from collections import defaultdict
from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from discrepancy.problem import Record
from discrepancy.rounding import jumps_of
from discrepancy.scatter import EQUAL, LEVEL, Scatter, beyond_chance, is_usual, scatter_of
from fmu_src.arrays import Floats

# Largest of n deviations from the median over their median (times 1.4826): what normal noise passes once in 20 and in 200 groups.
# Simulated, 200,000 groups each.
COUNTS = (3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 10.0, 12.0, 15.0, 20.0, 30.0, 50.0)
ONCE_IN_20 = (22.0, 6.9, 7.9, 5.5, 5.8, 4.9, 4.6, 4.4, 4.3, 4.0, 3.8, 3.8)
ONCE_IN_200 = (223.0, 22.7, 26.9, 12.8, 13.8, 9.7, 8.1, 7.3, 6.8, 5.8, 5.2, 4.8)
# The same of departures, which are those of all samples together, as a share of the span.
EQUAL_SHAPE = 1e-3
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
# Times the noise of a sample, or that which is stated (of the zero, for means), within which nothing stands out, whatever the others agree to.
STATED = 3.0

# Axes along which a run may go further than another, and the share of the furthest by which they still go as far (assumed).
REACHING, AS_FAR = {"angle", "torque", "hours", "order", "depth_angle", "speed", "load"}, 0.1
SPAN, MEAN, DEPARTURE = OF_SERIES = "span", "mean", "departure"


@dataclass(frozen=True)
class Outlying:
    """A run that stands out of its repetitions by one of its sizes.

    ``what`` names the size, ``size`` is the run's, ``low`` to ``high`` those of the others, all in ``unit`` (SI); ``times`` is its distance
    to the median in usual deviations, of two to each other.  ``left_out``: the others are most and agree; else it counts like them, for which of
    them is wrong cannot be told.  ``other``: of two the other run.  ``by_chance``: it is a number, and such scatter makes it now and then.
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
    left_out: bool = True
    other: str = ""
    by_chance: bool = False

    @property
    def weight(self) -> float:
        """What the run counts for."""
        return 0.0 if self.left_out else 1.0

    @property
    def signal(self) -> str:
        return self.quantity + (f"[{','.join(f'{k}={v}' for k, v in self.tags)}]" if self.tags else "")


def outlying(records: Sequence[Record]) -> list[Outlying]:
    """Each run that stands out, by the plainest of its sizes that does: span, mean, departure; of two that are at odds the larger."""
    groups = repetitions_of(records)
    found = []
    for pairs in (False, True):
        repeated = [members for members in groups if (len(members) == 2 if pairs else len(members) > 2)]
        usual, scatter = usual_deviations(repeated), scatter_of_numbers(repeated)
        for members in repeated:
            own = standing_out(members, usual, scatter.get(members[0].quantity))
            # Where as many stand out as do not, it cannot be told who is right.
            few = not pairs and 2 * len(own) < len(members)
            found += [replace(one, left_out=few and not one.by_chance) for one in own]
    # Something has to be left to fit.
    gone = {one.run for one in found if one.left_out}
    if all(r.held_out or r.name in gone for r in records):
        fitted = {r.name for r in records if not r.held_out}
        found = [replace(one, left_out=one.left_out and one.run not in fitted) for one in found]
    return found


def repetitions_of(records: Sequence[Record]) -> list[list[Record]]:
    """Runs of one signal and condition that went as far: a loop to half the torque, or an inspection at other hours, is smaller and not wrong."""
    groups: dict[Hashable, list[list[Record]]] = defaultdict(list)
    for record in records:
        tags = tuple(sorted(record.tags.items()))
        same = groups[record.quantity, tags, record.condition, record.mounting, record.factors.get("direction", 1.0)]
        group = next((members for members in same if went_as_far(members[0], record)), None)
        if group is None:
            same.append([record])
        else:
            group.append(record)
    return [members for same in groups.values() for members in same]


def went_as_far(one: Record, other: Record) -> bool:
    """Whether two runs cover alike what decides how large they are."""
    if one.axes.keys() & REACHING != other.axes.keys() & REACHING:
        return False
    for name in one.axes.keys() & REACHING:
        a, b = (np.asarray(r.axes[name], float)[np.isfinite(r.axes[name])] for r in (one, other))
        if not len(a) or not len(b):
            continue
        # An angle counts from anywhere.
        ends = [np.array([np.ptp(x)]) if name == "angle" else np.array([x.min(), x.max()]) for x in (a, b)]
        if np.any(np.abs(ends[0] - ends[1]) > AS_FAR * np.abs(ends).max()):
            return False
    return True


def standing_out(members: Sequence[Record], usual: Mapping[tuple[str, str], tuple[float, int]], scatter: Scatter | None) -> list[Outlying]:
    """Of the repetitions of one condition those that stand out."""
    found: dict[str, Outlying] = {}
    sizes = sizes_of(members)
    for what, own in sizes.items():
        common, least = usual[members[0].quantity, what], least_of(members, what, sizes)
        two = len(members) == 2
        if what == DEPARTURE:
            # Of two each departs as far.
            far = np.zeros(2) if two else departures(own, float(np.median(sizes[SPAN])), *common)
        else:
            far = at_odds(own, *common, least) if two else distances(own, *common, least)
            if what not in OF_SERIES:
                far = np.where([not two and is_usual(own, k, scatter) for k in range(len(own))], 0.0, far)
        for k, times in enumerate(far):
            rest = np.delete(own, k)
            r = members[k]
            if times > 0.0 and (r.name not in found or found[r.name].by_chance):
                one = Outlying(
                    r.name, r.quantity, tuple(sorted(r.tags.items())), r.condition, r.replicate, len(members), what, float(own[k]),
                    float(rest.min()), float(rest.max()), r.unit, float(times), other=members[1 - k].name if two else "",
                    by_chance=not two and what not in OF_SERIES and not beyond_chance(own, k, scatter, LEVEL / len(sizes)),
                )  # fmt: skip
                if r.name not in found or not one.by_chance:
                    found[r.name] = one
        if two and found:
            break
    return list(found.values())


def with_left_out(records: Sequence[Record], found: Sequence[Outlying]) -> list[Record]:
    """The records, those marked that are ``found`` to be left out."""
    gone = {one.run for one in found if one.left_out}
    return [replace(record, left_out=True) if record.name in gone else record for record in records]


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
    found = {SPAN: np.array([np.ptp(np.quantile(v, (SPIKES, 1.0 - SPIKES))) for v in values])}
    free = members[0].free_zero
    if not free:
        found[MEAN] = np.array([v.mean() for v in values])
    if len(lengths) == 1 and len(values[0]) == len(members[0].values) and same_axes(members):
        stack = np.array([v - v.mean() for v in values])
        found[DEPARTURE] = np.sqrt(np.mean((stack - np.median(stack, axis=0)) ** 2, axis=1))
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
    """Of each quantity and size: the usual deviation as a share of the size (of a departure: of the span), over all conditions, and from how many."""
    shares: dict[tuple[str, str], list[float]] = defaultdict(list)
    for members in repeated:
        every = sizes_of(members)
        for what, sizes in every.items():
            middle = float(np.median(sizes))
            away, of = (sizes, float(np.median(every[SPAN]))) if what == DEPARTURE else (np.abs(sizes - middle), abs(middle))
            # Of an odd number one is the median itself, which deviates from nothing.
            shares[members[0].quantity, what] += list(np.sort(away)[len(away) % 2 :] / (of or 1.0))
    return {key: (1.4826 * float(np.median(v)), len(v)) for key, v in shares.items()}


def scatter_of_numbers(repeated: Sequence[Sequence[Record]]) -> dict[str, Scatter | None]:
    """By quantity, of all conditions and places."""
    numbers: dict[str, list[Floats]] = defaultdict(list)
    for members in repeated:
        numbers[members[0].quantity] += [sizes for what, sizes in sizes_of(members).items() if what not in OF_SERIES]
    return {quantity: scatter_of(groups) for quantity, groups in numbers.items()}


def least_of(members: Sequence[Record], what: str, sizes: Mapping[str, Floats]) -> float:
    """Within so much of each other sizes agree, whatever the others do: of what their noise makes; of means also what runs span, for a zero may jump."""
    noise = float(np.median([jumps_of(values[np.isfinite(values)]) for values in (np.asarray(r.values, float) for r in members)]))
    stated = max(noise, *(r.stated_noise or 0.0 for r in members))
    if what != MEAN:
        return STATED * stated
    return max(STATED * max(stated, *(r.zero_noise for r in members)), float(np.median(sizes[SPAN])))


def distances(sizes: Floats, common: float, count: int, least: float = 0.0) -> Floats:
    """Of each size that stands out its distance to the median in usual deviations; 0 of the others.

    ``common``: the deviation that is usual in all conditions, as a share of the size; known from ``count`` numbers.  What is within ``least`` of the
    median never stands out.
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
        # Beside other conditions it has to be more than is usual there, too.
        apart = np.array([far_from_all(sizes, k) for k in range(len(sizes))])
        stands_out |= apart & (times > rarely) if known > len(sizes) else apart
    return np.where(stands_out & (away > least), times, 0.0)


def departures(sizes: Floats, span: float, common: float, count: int) -> Floats:
    """The same of departures, which are distances themselves: as those of numbers from their median, for repetitions may differ by a drift or a gain."""
    own, pooled = 1.4826 * float(np.median(sizes)), common * span
    times = sizes / max(own, pooled, EQUAL_SHAPE * span, 1e-300)
    known = float(count if own <= USUAL * pooled else len(sizes))
    return np.where(times > float(np.interp(known, COUNTS, ONCE_IN_200)), times, 0.0)


def at_odds(sizes: Floats, common: float, count: int, least: float) -> Floats:
    """The same of two: of the larger, where they differ by a factor or by far more than other pairs do."""
    low, high = np.sort(np.abs(sizes))
    apart = float(np.ptp(sizes))
    # From their middle two of normal noise are seen at half of what they differ by: 1/sqrt(2) of the deviation of one.
    scale = max(np.sqrt(2.0) * common, EQUAL) * 0.5 * (low + high)
    times = apart / np.sqrt(2.0) / max(scale, 1e-300)
    rarely, hardly = (float(np.interp(0.5 * count, COUNTS, limits)) for limits in (ONCE_IN_20, ONCE_IN_200))
    # Beside other pairs a factor has to be more than is usual there, too.
    differ = times > hardly or (bool(np.all(sizes > 0.0)) and high >= THREEFOLD * low and (count <= 2 or times > rarely))
    return np.where(np.abs(sizes) == high, times, 0.0) if differ and apart > least else np.zeros(2)


def far_from_all(sizes: Floats, k: int) -> bool:
    """Whether one positive size is several times off the nearest other while the others agree."""
    rest = np.delete(sizes, k)
    nearest = min(float(np.max([sizes[k] / r, r / sizes[k]])) for r in rest)
    return bool(nearest >= THREEFOLD and rest.max() <= TWICE * rest.min())
