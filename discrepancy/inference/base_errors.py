"""By how much the base model itself is off: numbers of its file that were fitted, and what it computes wrong."""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.special import ndtri

from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.refit import Refit, estimates
from discrepancy.inference.verdict import BaseError
from discrepancy.problem import BASE

# What the base model gets wrong itself counts if it is so many of its assumed standard deviations (assumed).
UNLIKELY = 2.5


def base_errors(space: Workspace, members: Sequence[Refit], inflation: Callable[[Refit], float], coverage: float) -> list[BaseError]:
    """Numbers of the base model among ``members``, the best first, and errors of its own that are larger than was assumed."""
    found: dict[str, BaseError] = {}
    for member in members:
        own = [c for c in member.candidates if c.part == BASE]
        numbers = {e.name: e for e in (estimates(space, member, coverage, inflation(member)) if own else ())}
        for c in own:
            for p in c.amplitudes:
                e = numbers[p.name]
                found.setdefault(p.name, BaseError(p.name, p.description, e.value, e.interval, p.unit, p.off, p.said or (p.lower, p.upper), member.gain))
    return [*found.values(), *computed_wrongly(members[0].fit if members else space.base, coverage)]


def computed_wrongly(fit: Fit, coverage: float) -> list[BaseError]:
    """Errors of what the base model computes, as shares; each known beforehand to be small."""
    own = [k for k, p in enumerate(fit.parameters) if p.of_base and p.prior and abs(fit.values[p.name] - p.off) > UNLIKELY * p.prior]
    if not own:
        return []
    scale = np.array([p.scale for p in fit.parameters])
    deviations = np.sqrt(np.maximum(np.diag(np.linalg.pinv(fit.normal * np.outer(scale, scale), rcond=1e-11, hermitian=True)), 0.0)) * scale
    half = float(ndtri(0.5 + coverage / 2.0))
    return [
        BaseError(p.name, p.description, fit.values[p.name], (fit.values[p.name] - half * deviations[k], fit.values[p.name] + half * deviations[k]),
                  p.unit, p.off, (p.off - (p.prior or 0.0), p.off + (p.prior or 0.0)), None)
        for k, p in ((k, fit.parameters[k]) for k in own)
    ]  # fmt: skip
