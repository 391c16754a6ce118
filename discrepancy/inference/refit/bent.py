"""Other optima of an effect two or three amplitudes of which do nearly the same, and not in proportion to their size.

Which teeth bear hangs on the amplitudes themselves (equidistant and shift of a profile), so that a descent ends where the next tooth comes into contact, and
what the base fit had placed, the zero of the angles above all, holds it there.
"""

from collections.abc import Mapping, Sequence

import numpy as np

from discrepancy.inference.base_fit.fit import Box, Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.effect_fit import EXPLAINS, jointly, total_cost
from discrepancy.inference.refit.starts import MOST_AMPLITUDES, by_themselves
from discrepancy.problem import Candidate, Parameter, Placing

# Standard deviations of chi-square beyond which what a fit leaves is no noise's, and by which share of what they do amplitudes are bent.
NO_NOISE, BENT = 3.0, 0.1
# So many of the places are descended from.
MOST_PLACES = 2


def from_across(space: Workspace, fit: Fit, candidate: Candidate) -> Fit:
    """The fit of one effect, or a better one from where each amplitude stands alone, with zeros of angles placed beside it; only of one that explains most of
    the misfit and leaves what noise does not."""
    if not leaves_some(space, fit) or not is_bent(space, fit, candidate.amplitudes):
        return fit
    model, box = space.model, Box(fit.parameters)
    starts: list[Mapping[str, float]] = []
    for form in by_themselves(candidate.amplitudes, fit.values):
        starts.append({**form, **model.placed_anew(form)[1]} if isinstance(model, Placing) else form)
    by_cost = space.threads.map(lambda start: total_cost(space, box, start)[0], starts)
    for k in np.argsort(by_cost)[:MOST_PLACES]:
        fit = min(fit, jointly(space, fit.parameters, starts[k], fit.candidates), key=lambda f: f.chi2)
    return fit


def leaves_some(space: Workspace, fit: Fit) -> bool:
    """Whether a fit explains more of the misfit than it leaves, and leaves what noise does not."""
    count = len(fit.residual)
    left = fit.chi2 - count
    return bool(NO_NOISE * np.sqrt(2.0 * count) < left < EXPLAINS * (space.base.chi2 - count))


def is_bent(space: Workspace, fit: Fit, amplitudes: Sequence[Parameter]) -> bool:
    """Whether half of two or three amplitudes changes something else than half of what they do."""
    if not 1 < len(amplitudes) <= MOST_AMPLITUDES:
        return False
    off, half = ({**fit.values, **{p.name: p.off + share * (fit.values[p.name] - p.off) for p in amplitudes}} for share in (0.0, 0.5))
    without, whole = space.residual(off), space.residual(fit.values)
    return float(np.linalg.norm(space.residual(half) - 0.5 * (without + whole))) > BENT * float(np.linalg.norm(whole - without))
