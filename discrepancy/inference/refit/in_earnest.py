"""Fits as they are reported: by predictions of their own values, and sensitivities over a standard deviation."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from discrepancy.inference.base_fit.fit import Box, Fit, fit_of
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.curvature import by_secants
from discrepancy.inference.refit.joint import STILL, by_own_sensitivities, jointly, may_reach, polish, stands_still, still_promised, there, total_cost
from discrepancy.problem import Candidate, near
from fmu_src.arrays import Floats

TURN = 2.0 * math.pi
# A reported fit of which a further step promises more than this chi-square is not one yet.
UNSETTLED = 0.5
# So many predictions it then may take.
LAST_STEPS = 30
# A fit that is reported is renewed so often.
RENEWALS = 4
# Within so many standard deviations sensitivities over one still hold.
HARDLY = 0.5


def renew(space: Workspace, fit: Fit, candidates: Sequence[Candidate], least: float = np.inf) -> Fit:
    """The same fit with sensitivities at its own values: for what is reported.  Left where it will not come below the chi-square ``least``."""
    for _ in range(RENEWALS):
        renewed = by_own_sensitivities(space, fit, tuple(c.name for c in candidates))
        gain, fit = fit.chi2 - renewed.chi2, renewed
        if not may_reach(fit, least):
            return fit
        if stands_still(gain, fit.chi2, fit.residual.size):
            break
    if not stands_still(still_promised(fit), fit.chi2, fit.residual.size, UNSETTLED):
        # Along a bent valley single steps get stuck.
        start = {p.name: fit.values[p.name] for p in fit.parameters}
        fit = min(fit, jointly(space, fit.parameters, start, fit.candidates, LAST_STEPS, 1, least), key=lambda f: f.chi2)
    return fit


def in_earnest(space: Workspace, fit: Fit, candidates: Sequence[Candidate], least: float = np.inf) -> tuple[Fit, Floats | None]:
    """The fit as it is reported and the covariance (p, p) of its parameters; one that will not come below the chi-square ``least`` as it stands then, its
    covariance that of its own sensitivities (none).

    Last steps go by sensitivities over a standard deviation: over kinks, at which those of a point stand still.
    """
    fit = begin = there(space, turned_back(space, fit, candidates))
    for _ in range(RENEWALS):
        with near(fit.values), space.predictions.anchored(fit.values):
            renewed = renew(space, fit, candidates, least)
        before, found = fit.chi2, there(space, renewed)
        # Of two that are as good the one whose sensitivities are its own: nuisances have those of the base fit before.
        fit = found if found.chi2 < fit.chi2 + STILL else fit
        if not may_reach(renewed, least):
            return fit, None
        # Seen from where it began it may have looked better than it is.
        if stands_still(min(abs(found.chi2 - renewed.chi2), before - fit.chi2), fit.chi2, fit.residual.size):
            break
    with near(fit.values), space.predictions.anchored(fit.values):
        if fit is begin:
            fit = fit_of(fit.parameters, fit.values, fit.residual, space.columns(fit.parameters, fit.values), fit.candidates, fit.converged)
        columns, covariance = by_secants(space, fit, candidates)
        polished = polish(space, fit.parameters, fit.values, columns, fit.candidates, fit.converged, fit.chi2)
    fit = fit_of(fit.parameters, fit.values, fit.residual, columns, fit.candidates, fit.converged)
    return min(fit, there(space, polished), key=lambda f: f.chi2), covariance


def followed(space: Workspace, fit: Fit, candidates: Sequence[Candidate], covariance: Floats, least: float = np.inf) -> tuple[Fit, Floats | None]:
    """A fit in earnest, and the covariance (p, p) of its parameters, after what is placed beside it was placed anew: by the sensitivities that it has
    where it hardly moves; ``least``: see ``in_earnest``."""
    fit = there(space, fit)
    with near(fit.values), space.predictions.anchored(fit.values):
        polished = polish(space, fit.parameters, fit.values, fit.jacobian, fit.candidates, fit.converged, fit.chi2, fresh=True)
    moved = np.abs([polished.values[name] - fit.values[name] for name in fit.names])
    if np.any(moved > HARDLY * np.sqrt(np.diag(covariance))):
        return in_earnest(space, polished, candidates, least)
    return min(fit, there(space, polished), key=lambda f: f.chi2), covariance


def turned_back(space: Workspace, fit: Fit, candidates: Sequence[Candidate]) -> Fit:
    """Angles without bounds worth the name, which a search may have turned round several times, within half a turn of 0."""
    angles = [p.name for c in candidates for p in c.shapes if p.unit == "rad" and p.upper - p.lower > 2.0 * TURN]
    values = {**fit.values, **{name: math.remainder(fit.values[name], TURN) for name in angles if abs(fit.values[name]) > 0.5 * TURN}}
    if values == fit.values:
        return fit
    box = Box(fit.parameters)
    # What stands behind a gear has another period.
    same = abs(total_cost(space, box, values)[0] - total_cost(space, box, fit.values)[0]) < STILL
    return replace(fit, values=values) if same else fit
