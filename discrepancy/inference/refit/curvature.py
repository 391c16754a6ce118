"""How sharply the chi-square rises about a fit, at the distance that matters: one standard deviation.

A transmission error has kinks where contacts open and close, so that its derivatives jump.  Where parameters do nearly the same,
what is left of the difference of two such derivatives is mostly jumps, and the interval comes out too narrow by several times.
Differences of whole predictions, a standard deviation apart along the main axes of the covariance, have no such error.
"""

from collections.abc import Sequence
from functools import partial

import numpy as np

from discrepancy.inference.base_fit.fit import Box, Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.problem import Candidate, near
from fmu_src.arrays import Floats

# The first axes are those of the derivatives; the second time they are the right ones.
ROUNDS = 2
# Steps in units of the parameters' scales: no smaller than what predictions resolve, no larger than what is typical.
LEAST, MOST = 1e-3, 1.0


def by_secants(space: Workspace, fit: Fit, candidates: Sequence[Candidate]) -> tuple[Floats, Floats]:
    """Sensitivities (N, p) of a fit, those to the effects' own parameters taken over a standard deviation, and the covariance (p, p) by them."""
    own = [p for c in candidates for p in c.parameters]
    places = [fit.names.index(p.name) for p in own]
    box, part = Box(fit.parameters), Box(own)
    x, units = box.array(fit.values), np.outer(box.scale, box.scale)
    columns, covariance = fit.jacobian, np.linalg.pinv(fit.normal * units, rcond=1e-11, hermitian=True)
    for _ in range(ROUNDS if own else 0):
        variances, axes = np.linalg.eigh(covariance[np.ix_(places, places)])
        steps = axes * np.clip(np.sqrt(np.maximum(variances, 0.0)), LEAST, MOST)
        columns = fit.jacobian.copy()
        along = np.column_stack(space.threads.map(partial(_along, space, fit, part, x, places), list(steps.T)))
        columns[:, places] = along @ np.linalg.inv(steps) / part.scale
        normal = columns.T @ columns + np.diag(box.precision)
        covariance = np.linalg.pinv(normal * units, rcond=1e-11, hermitian=True)
    return columns, covariance * units


def _along(space: Workspace, fit: Fit, part: Box, x: np.ndarray, places: Sequence[int], step: np.ndarray) -> np.ndarray:
    """Change (N,) of the whitened prediction per step of the effects' parameters [scales], from both sides within their bounds."""
    ends, parts, box = [], [], Box(fit.parameters)
    for sense in (1.0, -1.0):
        moved = x.copy()
        wanted = x[places] + sense * step * part.scale
        moved[places] = np.clip(wanted, part.lower, part.upper)
        # As much of the step as the bounds allow, the whole of it shortened alike so that the direction stays.
        shares = (moved[places] - x[places]) / np.where(step == 0.0, 1.0, sense * step * part.scale)
        share = float(np.min(np.where(step == 0.0, 1.0, shares)))
        moved[places] = x[places] + share * sense * step * part.scale
        with near(box.named(x)):
            ends.append(space.residual(box.named(moved)))
        parts.append(share)
    whole = parts[0] + parts[1]
    if whole * np.linalg.norm(step) < LEAST:
        # Between bounds to either side nothing is left but rounding.
        return np.asarray(fit.jacobian[:, places] @ (step * part.scale))
    return np.asarray((ends[1] - ends[0]) / whole)
