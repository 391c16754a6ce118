"""How much wider an interval is when the base model's own numbers may be anywhere in their ranges, and how much further on it lies.

A fit takes the numbers of the reducer file as they stand.  Where each is known beforehand to a standard deviation only, the same fit with all
of them free has, with C their whitened responses per standard deviation (N, m) and J, V sensitivities and covariance of the fit,

    V + B (I + C'C - C'J B)^-1 B',     B = V J'C

to first order about the fit, so that what scales an effect's response is in it.  With r what the fit leaves, its numbers are those of the file and

    u = (I + C'C - C'J B)^-1 C'r

standard deviations, and the parameters lie -B u further on: a size is taken for larger where a stiffness of the file is too small.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.refit import Refit, covariance_of
from discrepancy.problem import BASE, Candidate, Parameter
from fmu_src.arrays import Floats

# From here on it is said: below, the assumed numbers add less than the noise.
WIDER = 1.5
# Standard deviations of a number of the file that a misfit may call for; what asks for more is not theirs.
MOST = 2.0


class Freed(NamedTuple):
    """What the base model's numbers do to a parameter when they are free: by which ``factor`` its interval is wider, and how much further on it lies."""

    factor: float = 1.0
    shift: float = 0.0


def base_parameters(candidates: Sequence[Candidate], fitted: Sequence[Candidate]) -> list[Parameter]:
    """Numbers of the base model that no fit determined."""
    return [p for c in candidates if c.part == BASE and all(c.name != other.name for other in fitted) for p in c.amplitudes]


def freed(space: Workspace, result: Refit, free: Sequence[Parameter]) -> dict[str, Freed]:
    """What becomes of each parameter of ``result`` with the numbers ``free``."""
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
    shifts = -moved @ np.clip(np.linalg.solve(left, columns.T @ fit.residual), -MOST, MOST) * size
    variance = np.diag(own)
    wanted = {p.name for p in result.own}
    return {
        p.name: Freed(float(np.sqrt(1.0 + max(added[k], 0.0) / variance[k])), float(shifts[k])) if variance[k] > 0.0 else Freed()
        for k, p in enumerate(fit.parameters) if p.name in wanted
    }  # fmt: skip


def widened(interval: tuple[float, float], core: tuple[float, float], beside: Freed, bounds: tuple[float, float]) -> tuple[float, float]:
    """The interval wider by that factor about the value, or about the ends between which others make up for it (``core``), from there to where it lies with
    the base's numbers free, within the parameter's bounds.

    Both are held: as the file has them the numbers may be right, too.
    """
    low, high = (inner + beside.factor * (end - inner) for inner, end in zip(core, interval))
    return max(low + min(beside.shift, 0.0), bounds[0]), min(high + max(beside.shift, 0.0), bounds[1])
