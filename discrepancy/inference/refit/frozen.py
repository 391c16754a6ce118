"""Chi-square of effects beside the nuisances of the base fit, which are close to linear there: projected out, not fitted."""

from collections.abc import Mapping, Sequence

import numpy as np

from discrepancy.inference.base_fit.fit import Box
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.problem import Candidate
from fmu_src.arrays import Floats

# A descent that would not reach what it must even if it gained this many times what its slopes promise is given up.
HOPE = 3.0
# Of what an effect gains, what it may gain more where the nuisances follow it, whose sensitivities are those of the base fit, and along a bent valley:
# grease that ages in a tenth of the time it began with, and a wear coefficient with it, brought two thirds; to hope for more takes no longer (measured).
FOLLOW = 1.0
# Share of the base fit's chi-square below which much is promised.
MUCH = 0.5


class Frozen:
    """Chi-square of effects with the nuisances projected out, priors included, at the base fit's sensitivities."""

    def __init__(self, space: Workspace, candidates: Sequence[Candidate], least: float):
        self.space, self.least = space, least
        self.own = tuple(p for c in candidates for p in c.parameters)
        self.part = Box(self.own)
        self.shows = {p.name: [i for i in space.touched(c) if i in space.rows] for c in candidates for p in c.parameters}
        self.which = sorted({i for indices in self.shows.values() for i in indices})
        self.theta = dict(space.base.values)
        self.jacobian = space.base.jacobian
        self.box = Box(space.model.nuisances)
        self.pull = self.box.prior_gradient(self.box.array(self.theta))
        # A nuisance that the base model hardly shows stays where it is, rather than running to its bounds.
        width = 50.0 * (self.box.upper - self.box.lower)
        self.inverse = np.linalg.pinv(space.base.normal + np.diag(width**-2.0), hermitian=True)
        # Not known before much is promised.
        self.misled: bool | None = None
        self.base = dict(zip(space.training, space.predictions(self.theta, space.training)))

    def residual(self, values: Mapping[str, float]) -> Floats:
        """Whitened residual with the base fit's nuisances."""
        ys = self.space.predictions({**self.theta, **values}, self.which)
        return self.space.base.residual - self.space.whiten({i: y - self.base[i] for i, y in zip(self.which, ys)})

    def nuisance_gradient(self, residual: Floats) -> Floats:
        return self.jacobian.T @ residual - self.pull

    def cost(self, values: Mapping[str, float]) -> tuple[float, Floats]:
        """Generalised least squares: chi-square at the best nuisances, and the residual before they follow."""
        r = self.residual(values)
        g = self.nuisance_gradient(r)
        return float(r @ r - g @ self.inverse @ g), r

    def columns(self, values: Mapping[str, float]) -> Floats:
        space, at = self.space, {**self.theta, **values}
        return np.column_stack(space.threads.map(lambda p: space.whiten(space.column(at, p, self.shows[p.name])), self.own))

    def total(self, values: Floats) -> tuple[float, Floats]:
        """``cost`` of the effects' own parameters (p,) with their priors."""
        cost, r = self.cost(self.part.named(values))
        return cost + self.part.prior_cost(values), r

    def information(self, columns: Floats, cross: Floats) -> Floats:
        """What ``columns`` (N, p) of the effects' own parameters tell, nuisances projected out; ``cross`` are their products with these."""
        found: Floats = columns.T @ columns - cross.T @ self.inverse @ cross
        return found

    def equations(self, values: Floats, residual: Floats, columns: Floats) -> tuple[Floats, Floats]:
        """Normal matrix (p, p) of the effects' own parameters, nuisances projected out and priors included, from ``columns`` (N, p), and its
        right side (p,) at ``values`` (p,)."""
        cross = self.jacobian.T @ columns
        normal = self.information(columns, cross) + np.diag(self.part.precision)
        pull = self.part.prior_gradient(values)
        return normal, columns.T @ residual - cross.T @ self.inverse @ self.nuisance_gradient(residual) - pull

    def misleads(self, values: Mapping[str, float], cost: float, residual: Floats) -> bool:
        """Whether the first ``cost`` that promises much, at ``values``, is no gain at all where the nuisances follow: they bend too much to be
        projected out."""
        base = self.space.base.chi2
        if self.misled is None and cost < MUCH * base:
            r = self.space.residual({**self.nuisances_with(residual), **values})
            self.misled = float(r @ r) > base
        return bool(self.misled)

    def hopeless(self, cost: float, normal: Floats, gradient: Floats) -> bool:
        """Whether a descent that stands where these equations hold will not come below what it must."""
        if not np.isfinite(self.least):
            return False
        scale = self.part.scale
        promised = (scale * gradient) @ np.linalg.pinv(normal * np.outer(scale, scale), rcond=1e-11, hermitian=True) @ (scale * gradient)
        return bool(cost - HOPE * promised - FOLLOW * max(self.space.base.chi2 - cost, 0.0) > self.least)

    def nuisances_with(self, residual: Floats) -> dict[str, float]:
        """The nuisances that go with what the effects leave."""
        shift = self.inverse @ self.nuisance_gradient(residual)
        return self.box.named(np.clip(self.box.array(self.theta) + shift, self.box.lower, self.box.upper))
