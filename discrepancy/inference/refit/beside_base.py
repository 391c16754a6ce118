"""How much wider an interval is when the base model's own numbers may be anywhere in their ranges.

A fit takes the numbers of the reducer file as they stand.  Where each is known beforehand to a standard deviation only, the same fit with all
of them free has, with C their whitened responses per standard deviation (N, m) and J, V sensitivities and covariance of the fit,

    V + B (I + C'C - C'J B)^-1 B',     B = V J'C

to first order about the fit, so that what scales an effect's response is in it.
"""

from collections.abc import Sequence

import numpy as np

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.refit import Refit, covariance_of
from discrepancy.problem import BASE, Candidate, Parameter
from fmu_src.arrays import Floats

# From here on it is said: below, the assumed numbers add less than the noise.
WIDER = 1.5


def base_parameters(candidates: Sequence[Candidate], fitted: Sequence[Candidate]) -> list[Parameter]:
    """Numbers of the base model that no fit determined."""
    return [p for c in candidates if c.part == BASE and all(c.name != other.name for other in fitted) for p in c.amplitudes]


def widening(space: Workspace, result: Refit, free: Sequence[Parameter]) -> dict[str, float]:
    """By which factor the interval of each parameter of ``result`` is wider with the numbers ``free``; 1 where they make no difference."""
    fit = result.fit
    known = [p for p in free if p.prior and p.name not in fit.names]
    if not known or not fit.parameters:
        return {}
    values = fit.values

    def response(p: Parameter) -> Floats:
        step = (p.sign or 1) * p.scale
        changes = space.predictions.changes({**values, p.name: p.off + step}, values, space.training, first_order=True)
        return space.whiten({i: change / step * (p.prior or 0.0) for i, change in zip(space.training, changes)})

    with space.predictions.roughly():
        columns = np.column_stack(space.threads.told("the base model's own numbers", response, known, lambda p: p.name))
    size = np.array([p.scale for p in fit.parameters])
    # In units of the scales, which differ by orders of magnitude.
    own = covariance_of(fit) / np.outer(size, size)
    shared = (fit.jacobian * size).T @ columns
    moved = own @ shared
    left = np.eye(len(known)) + columns.T @ columns - shared.T @ moved
    added = np.einsum("pm,mp->p", moved, np.linalg.solve(left, moved.T))
    variance = np.diag(own)
    wanted = {p.name for p in result.own}
    return {
        p.name: float(np.sqrt(1.0 + max(added[k], 0.0) / variance[k])) if variance[k] > 0.0 else 1.0
        for k, p in enumerate(fit.parameters) if p.name in wanted
    }  # fmt: skip


def widened(interval: tuple[float, float], core: tuple[float, float], factor: float, bounds: tuple[float, float]) -> tuple[float, float]:
    """The interval by that factor about the value, or about the ends between which others make up for it (``core``), within the parameter's bounds."""
    low, high = (inner + factor * (end - inner) for inner, end in zip(core, interval))
    return max(low, bounds[0]), min(high, bounds[1])
