"""What single numbers scatter by from repetition to repetition, and whether one is further off than that."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtr

from fmu_src.arrays import Floats

# Repetitions that agree better than this share of their size are equal (assumed: no bench promises more).
EQUAL = 0.02
# Of all repetitions of a condition, and all numbers of a run, together: how often one may be further off by chance.
LEVEL = 0.01
# Within so many times what numbers of its quantity usually scatter one is no other kind (assumed: noise has tails), and within so many nothing to be said
# of; groups that tell of it.
WITHIN, USUALLY, TELLING = 8.0, 4.0, 4


@dataclass(frozen=True)
class Scatter:
    """What numbers of a quantity usually deviate by from the median of their repetitions: ``floor`` [SI] of small ones, ``share`` of large ones."""

    floor: float
    share: float

    def of(self, middle: float) -> float:
        return float(np.hypot(self.floor, self.share * middle))


def scatter_of(groups: Sequence[Floats]) -> Scatter | None:
    """Of the numbers (n,) of several groups, None of too few: an instrument's noise does not shrink with what it measures, and its gain makes large numbers
    scatter more."""
    if len(groups) < TELLING:
        return None
    middles = np.abs([float(np.median(sizes)) for sizes in groups])
    # Of an odd number one is the median itself, which deviates from nothing.
    away = [np.sort(np.abs(sizes - np.median(sizes)))[len(sizes) % 2 :] for sizes in groups]
    half = float(np.median(middles))
    small = np.concatenate([far for middle, far in zip(middles, away) if middle <= half])
    large = np.concatenate([far / (middle or 1.0) for middle, far in zip(middles, away) if middle >= half])
    return Scatter(1.4826 * float(np.median(small)), max(1.4826 * float(np.median(large)), EQUAL))


def is_usual(sizes: Floats, k: int, scatter: Scatter | None) -> bool:
    """Whether one of several numbers is no further from the others than numbers of its quantity are now and then, as far as that is known."""
    middle = float(np.median(sizes))
    return scatter is not None and bool(abs(sizes[k] - middle) <= USUALLY * scatter.of(middle))


def beyond_chance(sizes: Floats, k: int, scatter: Scatter | None, level: float = LEVEL) -> bool:
    """Whether one of several numbers is further from the others than chance makes it: than others of its quantity usually scatter, or, where hardly any tell,
    by Student's law, of the numbers and, of positive ones, of their logarithms."""
    middle = float(np.median(sizes))
    if scatter is not None:
        return bool(abs(sizes[k] - middle) > WITHIN * scatter.of(middle))
    return all(chance_of(scale, k) < level for scale in ((sizes, np.log(sizes)) if np.all(sizes > 0.0) else (sizes,)))


def chance_of(sizes: Floats, k: int) -> float:
    """How often any of so many normal numbers is as far from the mean of the others as this one, by what these differ by."""
    rest = np.delete(sizes, k)
    spread = float(np.std(rest, ddof=1)) * np.sqrt(1.0 + 1.0 / len(rest))
    times = abs(float(sizes[k] - rest.mean())) / max(spread, 1e-300)
    return float(min(1.0, 2.0 * len(sizes) * stdtr(len(rest) - 1, -times)))
