"""Repetitions of two conditions whose files were interchanged: each repeats the other condition's run, and not its own.

Runs that were interchanged differ from the repetitions of their own conditions by what the conditions differ by, which is a few orders that stand far
out of the noise; at these an exchange makes all agree.  A zero, a gain or a clock that is another in one run makes orders stand out as well, which
no exchange removes.  Where all first repetitions differ alike from all second ones (another day, another mounting), the first of one condition and the
second of another look as if they belonged together: such two are only taken for interchanged if a third condition has no such difference.
"""

from collections import defaultdict
from collections.abc import Hashable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np
import numpy.typing as npt
from scipy.ndimage import median_filter

from discrepancy.problem import Record
from discrepancy.repetitions import repetitions_of, same_axes
from fmu_src.arrays import Floats, Mask

# Of runs, by order.
Spectra = npt.NDArray[np.complex128]

# Samples of a run at least, and waves in it from which orders count: slower ones may be a drift.
LEAST, SLOWEST = 200, 3
# Noise of an order is the middle of so many neighbours; that of two squares of a spectrum over their mean.
NEIGHBOURS, MIDDLE = 31, 0.839
# Orders stand out by so many times that: e^-2x (1 + 2x), once in 10^11.
STANDS_OUT = 15.0
# What is left at these, exchanged (assumed: noise, and what one repetition differs by from another).
LEFT = 0.2


@dataclass(frozen=True)
class Interchanged:
    """Two runs of different conditions; how far they are, at the orders that stand out, from their own repetitions and, exchanged, from the other's
    (root mean square, SI).

    ``or_else``: of two repetitions each, the other two runs: nobody knows which two it is.
    """

    runs: tuple[str, str]
    conditions: tuple[str, str]
    quantity: str
    unit: str
    before: float
    after: float
    or_else: tuple[str, str] | None


def interchanged(records: Sequence[Record]) -> list[Interchanged]:
    """Of every two conditions the two runs that look most like it, if they do."""
    signals: dict[Hashable, list[list[list[Record]]]] = defaultdict(list)
    for members in repetitions_of(records):
        first = members[0]
        whole = all(np.isfinite(r.values).all() for r in members)
        if len(members) > 1 and whole and len(first.values) >= LEAST and alike(members):
            sampled = signals[first.quantity, tuple(sorted(first.tags.items())), first.mounting]
            groups = next((groups for groups in sampled if alike([groups[0][0], *members])), None)
            if groups is None:
                sampled.append([members])
            else:
                groups.append(members)
    return [found for sampled in signals.values() for groups in sampled for found in among(groups)]


def among(groups: Sequence[Sequence[Record]]) -> Iterator[Interchanged]:
    """The same of the repetitions of conditions that were sampled at the same places."""
    if len(groups) < 2:
        return
    spectra = [np.array([np.fft.rfft(r.values) for r in members]) for members in groups]
    for m, n in combinations(range(len(groups)), 2):
        if groups[m][0].condition != groups[n][0].condition:
            rest = [s for k, s in enumerate(spectra) if k not in (m, n)]
            yield from of_two(groups[m], groups[n], spectra[m], spectra[n], rest)


def alike(members: Sequence[Record]) -> bool:
    """Whether sample by sample they may be held against each other."""
    return len({len(r.values) for r in members}) == 1 and same_axes(members)


def of_two(one: Sequence[Record], other: Sequence[Record], a: Spectra, b: Spectra, rest: Sequence[Spectra]) -> list[Interchanged]:
    """The runs of two conditions that look most like it, if they do; ``rest``: spectra of the other conditions."""
    least, best = LEFT, None
    for i, k in product(range(len(a)), range(len(b))):
        own, its = np.delete(a, i, 0).mean(axis=0), np.delete(b, k, 0).mean(axis=0)
        before, after = squares(a[i] - own, b[k] - its), squares(a[i] - its, b[k] - own)
        noise = median_filter(before, NEIGHBOURS) / MIDDLE
        # By their phases alone they would of another zero as well.
        out = squares(np.abs(a[i]) - np.abs(own), np.abs(b[k]) - np.abs(its)) > STANDS_OUT * noise
        out[:SLOWEST] = False
        was, left = float(before[out].sum()), float(after[out].sum())
        told = one[i].replicate == other[k].replicate or max(len(a), len(b)) > 2 or elsewhere(rest, out) < LEFT * was
        if left < least * was and told:
            least, best = left / was, (i, k, was, left)
    if best is None:
        return []
    i, k, *sums = best
    # Of one side of a spectrum, of two runs.
    rms = [float(np.sqrt(s)) / len(one[0].values) for s in sums]
    others = (one[1 - i].name, other[1 - k].name) if len(one) == len(other) == 2 else None
    return [Interchanged((one[i].name, other[k].name), (one[0].condition, other[0].condition), one[0].quantity, one[0].unit, rms[0], rms[1], others)]


def elsewhere(rest: Sequence[Spectra], out: Mask) -> float:
    """The most that first and last repetition of another condition differ by at these orders; unknown where there is none."""
    return max((float((np.abs(s[0] - s[-1])[out] ** 2).sum()) for s in rest), default=np.inf)


def squares(one: Spectra | Floats, other: Spectra | Floats) -> Floats:
    found: Floats = np.abs(one) ** 2 + np.abs(other) ** 2
    return found
