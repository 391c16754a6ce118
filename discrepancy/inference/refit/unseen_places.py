"""Effects beside loops of which nobody knows where they were taken, as long as no place is found beside them.

At a place an effect changes a loop by another amount than the mean over all that is predicted until then: such loops would hold the effect where they
show least of it (discs off centre by 3 um were taken for a hole).  What else was measured tells, and the loops stay as the base model has them.
"""

from collections.abc import Callable, Sequence

import numpy as np

from discrepancy.inference.base_fit.fit import Fit, fit_of
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.problem import ERROR, ORDERS, Candidate, Placing

# A fit in some records, which will not come below a chi-square.
Fitting = Callable[[Workspace, float], Fit]


def without_unseen(space: Workspace, candidates: Sequence[Candidate], fitting: Fitting, least: float) -> Fit | None:
    """The fit by the runs whose place is known, as one of all; None where all are, or where what is left does not show the effects."""
    model = space.model
    if not isinstance(model, Placing):
        return None
    off = {p.name: p.off + p.scale for c in candidates for p in c.amplitudes}
    unseen = set(model.unseen(off))
    sure = [i for i in space.training if i not in unseen]
    tell = {i for i in sure if space.records[i].quantity in (ERROR, ORDERS)}
    if len(sure) == len(space.training) or not all(tell & set(space.touched(c)) for c in candidates):
        return None
    base, few = space.base, space.only(sure)
    kept = np.concatenate([np.arange(space.rows[i].start, space.rows[i].stop) for i in sure])
    few.base = fit_of(base.parameters, base.values, base.residual[kept], base.jacobian[kept])
    left = np.delete(base.residual, kept)
    fit = fitting(few, least - float(left @ left))
    residual, jacobian = base.residual.copy(), np.zeros((space.size, len(fit.parameters)))
    jacobian[:, : len(base.parameters)] = base.jacobian
    residual[kept], jacobian[kept] = fit.residual, fit.jacobian
    return fit_of(fit.parameters, fit.values, residual, jacobian, fit.candidates, fit.converged)
