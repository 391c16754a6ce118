"""How large an effect must be to be seen: what an answer is worth that names nothing.

An effect of amplitude a changes the whitened data by u(a).  Its score statistic, without noise, is what of it the columns U at which the screening looks
take up,

    t(a)^2 = max over shapes of u'MU (U'MU)^-1 U'Mu,     M = I - J N^-1 J'

no more than its d' = |M u|, squared.  With noise the root is spread round t with a standard deviation of 1, so that it passes the level T of all tests
together in 95 of 100 campaigns where t = sqrt(T) + 1.645.  Where u is a straight line in a, u is a column itself; else it is predicted whole: columns over
small amplitudes overstate what closing gaps leave of it (three times as much was met), and what lies between two columns is seen by neither in full.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from discrepancy.inference.base_fit.projection import project_out, squares
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.screening.screen import SMALL, Block, Columns, cone_statistic, known_before, limits
from discrepancy.problem import BASE, Candidate, Parameter
from fmu_src.arrays import Floats

# Standard deviations by which an effect must be beyond the level to pass it in 95 of 100 campaigns.
NINETY_FIVE = 1.645
# Share of a column's square that calibrations leave, below which it is rounding.
LEFT = 1e-6
# Share of their usual size below which it is not asked from where on amplitudes that are no straight line are seen.
OR_LESS = 0.1
# Up to so many usual sizes what is straight at the usual one is taken to be so.
KNOWN_STRAIGHT = 3.0
# Usual sizes beyond which no reducer has an effect, wherever its bounds are; what shows there alone is what rounding leaves of it.
MOST_TIMES = 30.0
# Whole predictions for one amplitude, at most; and by how much t may then be more than what was asked for.
ROUNDS, NEAR = 6, 0.3
AIM = 1.0 + 0.5 * NEAR


@dataclass(frozen=True)
class Visible:
    """From which size [SI, as distance from ``Parameter.off``] one amplitude of a candidate would have been seen: with shapes (a direction, a speed) and to
    the side that show it worst; infinite if not within its bounds, nor ``MOST_TIMES`` its ``usual`` size; ``or_less``: smaller ones, too;
    ``at_best``: where the shapes show it best, of those that are not seen everywhere."""

    candidate: str
    parameter: str
    unit: str
    usual: float
    size: float
    or_less: bool = False
    at_best: float = math.inf

    @property
    def times(self) -> float:
        """``size`` in usual ones: up to 1 what is usual would have been seen."""
        return self.size / self.usual


@dataclass(frozen=True)
class _Own:
    """One candidate: its blocks, the products U'MU of each, and MU of all candidates (N, m)."""

    candidate: Candidate
    blocks: Sequence[Block]
    grams: Sequence[Floats]
    projected: Floats
    needed: float

    @property
    def target(self) -> float:
        return math.sqrt(self.needed) + NINETY_FIVE

    @property
    def straight(self) -> bool:
        """Small amplitudes say all of what is straight; of what begins behind a gap they show nothing."""
        return all(b.size == SMALL for b in self.blocks)

    def taken_up(self, change: Floats) -> float:
        """t of a whitened change (N,)."""
        known, best = np.diag(known_before(self.candidate)), 0.0
        for b, gram in zip(self.blocks, self.grams):
            best = max(best, float(cone_statistic(change[None] @ self.projected[:, b.columns], gram + known, b.signs)[0][0]))
        return math.sqrt(best)


@dataclass(frozen=True)
class _Place:
    """One amplitude with one set of shapes, to one side up to ``reach``; ``slope``: t per size, as the column over the largest has it.  Sizes in scales."""

    amplitude: Parameter
    shape: Mapping[str, float]
    side: int
    slope: float

    @property
    def reach(self) -> float:
        below, above = limits(self.amplitude)
        return min(above if self.side > 0 else below, MOST_TIMES)


def visible(space: Workspace, candidates: Sequence[Candidate], columns: Columns, needed: Mapping[str, float]) -> list[Visible]:
    """Every amplitude of every effect that shows at all; ``needed``: statistic from which each candidate is significant."""
    projected = project_out(columns.values, space.base.jacobian, space.base.normal)
    projected[:, np.einsum("ij,ij->j", columns.values, projected) < LEFT * squares(columns.values)] = 0.0

    def of_candidate(k: int) -> list[Visible]:
        blocks = [b for b in columns.blocks if b.candidate == k]
        products = [columns.values[:, b.columns].T @ projected[:, b.columns] for b in blocks]
        own = _Own(candidates[k], blocks, [0.5 * (gram + gram.T) for gram in products], projected, needed[candidates[k].name])
        return [seen_from(space, own, j) for j in range(len(candidates[k].amplitudes))]

    shown = {b.candidate for b in columns.blocks}
    tested = [k for k, c in enumerate(candidates) if k in shown and c.part != BASE and c.name in needed]
    made = space.threads.told("reckoning what would have been seen", of_candidate, tested, lambda k: candidates[k].name)
    return [found for each in made for found in each]


def seen_from(space: Workspace, own: _Own, j: int) -> Visible:
    """The ``j``-th amplitude, with what shows it worst of all places."""
    p, where = own.candidate.amplitudes[j], sorted(places(own, j), key=lambda place: -place.slope)

    def within(place: _Place) -> float:
        size = own.target / place.slope
        found = size if own.straight and size <= KNOWN_STRAIGHT else predicted(space, own, place)
        return found if found <= place.reach else math.inf

    worst = within(where[-1]) if where else math.inf
    at_best = within(where[0]) if math.isinf(worst) and len(where) > 1 else math.inf
    or_less = not own.straight and worst <= OR_LESS
    return Visible(own.candidate.name, p.name, p.unit, p.scale, p.scale * worst, or_less, p.scale * at_best)


def places(own: _Own, j: int) -> list[_Place]:
    """Where the screening looked at the ``j``-th amplitude; without places where calibrations leave nothing of it."""
    p, known, found = own.candidate.amplitudes[j], known_before(own.candidate)[j], []
    slopes = [(b, gram[j, j] / math.sqrt(gram[j, j] + known)) for b, gram in zip(own.blocks, own.grams) if gram[j, j] > 0.0]
    for shape in [dict(one) for one in dict.fromkeys(tuple(b.shape.items()) for b in own.blocks)]:
        for side in (p.sign,) if p.sign else (1, -1):
            here = [(abs(b.size), float(slope)) for b, slope in slopes if b.shape == shape and b.signs[j] in (0, side)]
            if here:
                found.append(_Place(p, shape, side, max(here)[1]))
    return found


def predicted(space: Workspace, own: _Own, place: _Place) -> float:
    """Size [scales] at which t is what it takes, in whole predictions; a tenth for what is seen there; infinite if not within the bounds."""
    p, which = place.amplitude, [i for i in space.touched(own.candidate) if i in space.rows]
    at = {**space.base.values, **{q.name: q.off for q in own.candidate.shapes}, **place.shape}
    size = min(max(own.target / place.slope, OR_LESS), place.reach)
    # (size, t over what it takes) of the largest that is not seen, and of the smallest that is.
    below, above = (0.0, 0.0), (math.inf, math.inf)
    for _ in range(ROUNDS):
        values = {**at, p.name: p.off + place.side * size * p.scale}
        changes = space.predictions.changes(values, at, which, first_order=False)
        t = own.taken_up(space.whiten(dict(zip(which, changes)))) / own.target
        if 1.0 <= t < 1.0 + NEAR or (t > 1.0 and size <= OR_LESS):
            return size
        if t < 1.0 and size >= place.reach:
            return math.inf
        if t > 1.0:
            above = (size, t)
        else:
            below = (size, t)
        size = min(max(between(below, above), OR_LESS), place.reach)
    return above[0]


def between(below: tuple[float, float], above: tuple[float, float]) -> float:
    """Where t would be a little more than it takes: on the straight line between both, but a fifth of the way from either (behind a gap it is no
    line); up to four times as large where nothing was seen yet."""
    if math.isinf(above[0]):
        return below[0] * min(max(AIM / max(below[1], 1e-300), 1.2), 4.0)
    share = (AIM - below[1]) / (above[1] - below[1])
    return below[0] + (above[0] - below[0]) * min(max(share, 0.2), 0.8)
