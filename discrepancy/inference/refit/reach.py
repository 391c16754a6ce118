"""How far two numbers that do nearly the same may go together, where the chi-square along their valley is no parabola.

Which teeth bear hangs on equidistant and shift of a profile themselves, so that the chi-square rises by less to one side than to the other, or falls again
behind a hump.  An unbalance shows over the mass that vibrates, which is assumed and ends at a bound.  A walk from the fit outwards, all others following, tells
where it has risen by what an interval allows.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from discrepancy.inference.base_fit.fit import Box
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.bent import SAME
from discrepancy.inference.refit.profile import followed
from discrepancy.inference.refit.refit import Refit, is_untold, valleys
from fmu_src.arrays import Floats

# An interval's half width in standard deviations; the chi-square at its end is the square of that.
HALF = 1.96
# Of chi-square: by so much a fit from another start, or a place on the way, is another optimum, where the fit starts anew.
BETTER = 1.0
# In standard deviations: beyond what lies so high nobody looks for a lower place.
HUMP = 4.5
# The first step of a walk in standard deviations, over the end of a parabola; by how much the next is longer, or shorter after one that went far too high.
FIRST, GROWTH, SHORTER, MOST_STEPS = 2.2, 1.6, 0.3, 10
# In deviations with all else held: an amplitude that is so large is there.
PLAINLY = 4.0
# Corrections of what follows at each place.
ROUNDS = 3


@dataclass(frozen=True)
class Reach:
    """By amplitude, how many times as far below and above its value its interval ends as a parabola says; ``better`` are values on the way that fit better."""

    stretch: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    better: Mapping[str, float] | None = None


def pairs(space: Workspace, result: Refit) -> list[tuple[int, int]]:
    """Places, among the parameters of a fit, of the two amplitudes of each effect that has two which do nearly the same."""
    fit, names, found = result.fit, result.fit.names, []
    deviations = np.sqrt(np.maximum(np.diag(result.covariance), 0.0))
    for c in result.candidates:
        if len(c.amplitudes) != 2:
            continue
        k, j = (names.index(p.name) for p in c.amplitudes)
        if not (is_untold(fit, k) or is_untold(fit, j)) and abs(result.covariance[k, j]) > SAME * deviations[k] * deviations[j] > 0.0:
            found.append((k, j))
    # What is told only together has all of its valley as it is.
    together = valleys(space, result) if found else {}
    return [(k, j) for k, j in found if names[k] not in together and names[j] not in together]


def carried(result: Refit) -> list[tuple[int, int]]:
    """Places of amplitudes that are plainly there and might be none by the parabola, each with that of what makes up for it: a number that is assumed."""
    fit, covariance, own = result.fit, result.covariance, {p.name for p in result.own}
    x = Box(fit.parameters).array(fit.values)
    deviations = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    assumed = [j for j, p in enumerate(fit.parameters) if p.prior and p.name not in own]
    found = []
    for k in (fit.names.index(p.name) for c in result.candidates for p in c.amplitudes):
        size, seen = abs(x[k] - fit.parameters[k].off), 1.0 / np.sqrt(max(fit.normal[k, k], 1e-300))
        if not PLAINLY * seen < size < HALF * deviations[k]:
            continue
        found += [(k, j) for j in assumed if abs(covariance[k, j]) > SAME * deviations[k] * deviations[j] > 0.0][:1]
    return found


def reach(space: Workspace, result: Refit) -> Reach:
    """How far the amplitudes of a fit that do nearly the same, or as a number that is assumed, may go to either side, or the first better place on the way."""
    stretch: dict[str, tuple[float, float]] = {}
    x, names = Box(result.fit.parameters).array(result.fit.values), result.fit.names
    half = HALF * np.sqrt(np.maximum(np.diag(result.covariance), 0.0))
    for k, j in [*carried(result), *pairs(space, result)]:
        ends, better = both_ends(space, result, k)
        if better is not None:
            return Reach(stretch, better)
        below, above = (np.abs(end - x) for end in ends)
        stretch[names[k]] = float(below[k] / half[k]), float(above[k] / half[k])
        if result.fit.parameters[j] in result.own:
            # Where the first stands at its end, the second has gone as far as the first takes it along.
            along = half[j] * abs(result.covariance[k, j]) / np.sqrt(result.covariance[k, k] * result.covariance[j, j])
            low, high = float(below[j] / along), float(above[j] / along)
            stretch[names[j]] = (low, high) if result.covariance[k, j] > 0.0 else (high, low)
    return Reach(stretch)


def both_ends(space: Workspace, result: Refit, k: int) -> tuple[list[Floats], Mapping[str, float] | None]:
    """Where ``walk`` ends to either side of parameter ``k``, or the first better place."""
    ends: list[Floats] = []
    for sense in (-1.0, 1.0):
        end, better = walk(space, result, k, sense)
        if better is not None:
            return ends, better
        ends.append(end)
    return ends, None


def walk(space: Workspace, result: Refit, k: int, sense: float) -> tuple[Floats, Mapping[str, float] | None]:
    """Where a valley that is walked in the ``sense`` of parameter ``k`` has risen by what an interval allows, or a bound ends it, and all values of a better
    place that lay on the way."""
    fit, box = result.fit, Box(result.fit.parameters)
    begin = box.array(fit.values)
    room = float(box.upper[k] - begin[k] if sense > 0.0 else begin[k] - box.lower[k])
    way = sense * result.covariance[:, k] / result.covariance[k, k]
    step = FIRST * float(np.sqrt(result.covariance[k, k]))
    inner, inner_root, gone = begin, 0.0, 0.0
    end: Floats | None = None
    for _ in range(MOST_STEPS):
        far = min(gone + step, room)
        if far <= gone:
            break
        rise, there = place(space, result, k, inner + (far - gone) * way)
        if rise < -BETTER:
            return begin, box.named(there)
        root = float(np.sqrt(max(rise, 0.0)))
        if root > HUMP and end is None:
            step *= SHORTER
            continue
        if root > HUMP:
            break
        if root < HALF:
            end = None
        elif end is None:
            end = inner + (HALF - inner_root) / (root - inner_root) * (there - inner)
        way = (there - inner) / (far - gone)
        inner, inner_root, gone, step = there, root, far, GROWTH * step
    return inner if end is None else end, None


def place(space: Workspace, result: Refit, k: int, start: Floats) -> tuple[float, Floats]:
    """How much higher than at the fit the chi-square is with parameter ``k`` as in ``start`` and the others where they fit best, and these places."""
    box = Box(result.fit.parameters)
    chi2, there = followed(space, result, k, np.clip(start, box.lower, box.upper), ROUNDS)
    return chi2 - result.fit.chi2, there
