"""Other optima of an effect two amplitudes of which do nearly the same, and not in proportion to their size (equidistant and shift of a profile).

Which teeth bear hangs on the amplitudes themselves, so that a descent ends where the next tooth comes into contact, and what the base fit had placed, the zero
of the angles above all, holds it there.  What explains the data lies along a narrow valley, which may begin far off: it is looked for over the plane.
"""

from collections.abc import Mapping, Sequence
from itertools import product

import numpy as np

from discrepancy.inference.base_fit.fit import Box, Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.joint import jointly, total_cost
from discrepancy.inference.screening.screen import TYPICAL, Columns, limits
from discrepancy.problem import Candidate, Placing
from fmu_src.arrays import Floats

# Standard deviations of chi-square beyond which what a fit leaves is no noise's.
NO_NOISE = 3.0
# Cosine from which two amplitudes do nearly the same.
SAME = 0.9
# Of the misfit, what a fit must explain for its effect to be looked for elsewhere; of what that explains, what a place must for it to go on there.
WORTH_IT = 0.2
# Places in typical sizes: of the first amplitude along the valley, and of the second beside what makes up for the first.
ALONG = (-6.0, -4.0, -2.0, 0.0, 2.0, 4.0, 6.0)
ACROSS = (-4.0, -3.0, -2.4, -2.0, -1.6, -1.2, -0.8, -0.4, 0.4, 0.8, 1.2, 1.6, 2.0, 2.4, 3.0, 4.0)
# So many of the places are weighed with all records, and descended from.
MOST_WEIGHED, MOST_PLACES = 12, 3


def leaves_some(fit: Fit) -> bool:
    """Whether a fit leaves what noise does not."""
    count = len(fit.residual)
    return bool(fit.chi2 - count > NO_NOISE * np.sqrt(2.0 * count))


def explains_some(space: Workspace, fit: Fit) -> bool:
    """Whether a fit explains a part of the misfit that is worth a search."""
    return bool(space.base.chi2 - fit.chi2 > WORTH_IT * (space.base.chi2 - len(fit.residual)))


def exchange(columns: Columns, place: int, candidate: Candidate) -> float | None:
    """How much of the second amplitude makes up for the first of the candidate at a ``place`` of the screening, in typical sizes, by the columns over large
    ones to either side, of which one may jam what the other loosens; None where it has no two that do nearly the same."""
    large = [columns.values[:, block.columns] for block in columns.blocks if block.candidate == place and abs(block.size) == TYPICAL]
    if len(candidate.amplitudes) != 2 or not large:
        return None
    pairs = [(one[:, 0], other[:, 1]) for one in large for other in large]
    first, second = max(pairs, key=lambda pair: abs(cosine(*pair)))
    return -float(first @ second) / float(second @ second) if abs(cosine(first, second)) > SAME else None


def cosine(a: Floats, b: Floats) -> float:
    return float(a @ b) / max(float(np.linalg.norm(a) * np.linalg.norm(b)), 1e-300)


def along_valley(space: Workspace, fit: Fit, candidate: Candidate, rate: float) -> Fit:
    """The fit of one effect, or a better one from places all along its valley, with the zero of the angles placed at each."""
    first, second = candidate.amplitudes
    model, box = space.model, Box(fit.parameters)
    reach = [max(limits(p)) for p in (first, second)]
    forms = [
        {**fit.values, first.name: first.off + along * first.scale, second.name: second.off + (rate * along + across) * second.scale}
        for along, across in product(ALONG, ACROSS) if abs(along) <= reach[0] and abs(rate * along + across) <= reach[1]
    ]  # fmt: skip
    placed = space.threads.map(lambda form: model.placed_anew(form) if isinstance(model, Placing) else (0.0, {}), forms)
    starts: list[Mapping[str, float]] = [{**form, **places} for form, (_, places) in zip(forms, placed)]
    lefts = [left for left, _ in placed]
    if not any(lefts):
        # Nothing is placed: the record with the largest misfit says as well which places are likely.
        one = space.only([space.furthest_off(candidate)])
        lefts = space.threads.map(lambda start: total_cost(one, box, start)[0], starts)
    starts = foremost(starts, lefts, MOST_WEIGHED)
    by_cost: Sequence[float] = space.threads.map(lambda start: total_cost(space, box, start)[0], starts)
    if min(by_cost) > space.base.chi2 - WORTH_IT * (space.base.chi2 - fit.chi2):
        # The valley goes on nowhere else.
        return fit
    for start in foremost(starts, by_cost, MOST_PLACES):
        fit = min(fit, jointly(space, fit.parameters, start, fit.candidates), key=lambda f: f.chi2)
    return fit


def foremost(starts: Sequence[Mapping[str, float]], costs: Sequence[float], most: int) -> list[Mapping[str, float]]:
    return [starts[k] for k in np.argsort(costs, kind="stable")[:most]]
