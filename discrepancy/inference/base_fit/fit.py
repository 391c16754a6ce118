"""A fitted model, and least squares in a box with priors."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import OptimizeResult, least_squares, lsq_linear

from discrepancy.problem import Parameter
from fmu_src.arrays import Floats


class Box:
    """Parameters as arrays: ``off``, ``scale``, ``lower``, ``upper`` and ``precision``, the prior's diagonal, each (p,)."""

    def __init__(self, parameters: Sequence[Parameter]):
        self.names = [p.name for p in parameters]
        self.off: Floats = np.array([p.off for p in parameters], dtype=float)
        self.scale: Floats = np.array([p.scale for p in parameters], dtype=float)
        self.lower: Floats = np.array([p.lower for p in parameters], dtype=float)
        self.upper: Floats = np.array([p.upper for p in parameters], dtype=float)
        self.precision: Floats = np.array([0.0 if p.prior is None else p.prior**-2 for p in parameters], dtype=float)

    def named(self, x: Floats) -> dict[str, float]:
        return dict(zip(self.names, map(float, x)))

    def array(self, values: Mapping[str, float]) -> Floats:
        return np.array([values[name] for name in self.names], dtype=float)

    def prior_cost(self, x: Floats) -> float:
        return float(np.sum(self.precision * (x - self.off) ** 2))

    def prior_gradient(self, x: Floats) -> Floats:
        return self.precision * (x - self.off)

    def step(self, x: Floats, normal: Floats, gradient: Floats) -> Floats:
        """Minimiser of s'Ns/2 - g's with x + s in the box; ``normal`` and ``gradient`` by parameters in units of their scale."""
        return self.scale * _bounded_step(normal, gradient, (self.lower - x) / self.scale, (self.upper - x) / self.scale)

    def minimise(self, residual: Callable[[Floats], Floats], columns: Callable[[Floats], Floats], start: Floats, inside: float,
                 xtol: float, ftol: float, evaluations: int) -> OptimizeResult:  # fmt: skip
        """Least squares with the priors; ``columns`` (N, p) are minus the derivatives of ``residual`` (N,).

        The start is moved ``inside`` scales away from the bounds: the solver's steps vanish with the distance to one.
        """
        precision = np.sqrt(self.precision)
        margin = np.minimum(inside * self.scale, 0.25 * (self.upper - self.lower))

        def with_priors(x: Floats) -> Floats:
            return np.concatenate([residual(x), (x - self.off) * precision])

        def derivatives(x: Floats) -> Floats:
            return np.vstack([-columns(x), np.diag(precision)])

        return least_squares(
            with_priors, np.clip(start, self.lower + margin, self.upper - margin), derivatives,
            bounds=(self.lower, self.upper), x_scale=self.scale, xtol=xtol, ftol=ftol, max_nfev=evaluations,
        )  # fmt: skip


@dataclass
class Fit:
    """A fitted model: ``residual`` (N,) whitened, ``jacobian`` (N, p) of -residual by ``names``; ``chi2`` with priors."""

    parameters: tuple[Parameter, ...]
    values: dict[str, float]
    residual: Floats
    jacobian: Floats
    chi2: float
    normal: Floats = field(repr=False)
    candidates: tuple[str, ...] = ()
    at_bounds: tuple[str, ...] = ()
    converged: bool = True

    @property
    def names(self) -> list[str]:
        return [p.name for p in self.parameters]

    @property
    def gradient(self) -> Floats:
        """What is left of the normal equations' right side, priors included: zero at the optimum."""
        box = Box(self.parameters)
        return self.jacobian.T @ self.residual - box.prior_gradient(box.array(self.values))

    @property
    def settled(self) -> Floats:
        """Residual after one more linear step: exactly orthogonal to the parameters, up to their priors."""
        if not self.parameters:
            return self.residual
        return self.residual - self.jacobian @ (np.linalg.pinv(self.normal, hermitian=True) @ self.gradient)


def fit_of(parameters: Sequence[Parameter], values: Mapping[str, float], residual: Floats, jacobian: Floats,
           candidates: tuple[str, ...] = (), converged: bool = True) -> Fit:  # fmt: skip
    """The fit at ``values``, with its chi-square, its normal matrix and what lies at a bound."""
    box = Box(parameters)
    normal = jacobian.T @ jacobian + np.diag(box.precision)
    at_bounds = tuple(p.name for p in parameters if (p.lower != p.off and values[p.name] - p.lower < 1e-3 * p.scale)
                      or p.upper - values[p.name] < 1e-3 * p.scale)  # fmt: skip
    chi2 = float(residual @ residual) + box.prior_cost(box.array(values))
    return Fit(tuple(parameters), dict(values), residual, jacobian, chi2, normal, candidates, at_bounds, converged)


def _bounded_step(normal: Floats, gradient: Floats, lower: Floats, upper: Floats) -> Floats:
    if not gradient.size:
        return gradient
    values, vectors = np.linalg.eigh(normal)
    keep = values > 1e-13 * max(values.max(), 1e-300)
    free: Floats = vectors[:, keep] @ ((vectors[:, keep].T @ gradient) / values[keep])
    if np.all(free >= lower) and np.all(free <= upper):
        return free
    root = np.sqrt(values[keep])
    a = root[:, None] * vectors[:, keep].T
    b = (vectors[:, keep].T @ gradient) / root
    width = np.maximum(upper - lower, 1e-9)
    solution: Floats = lsq_linear(a, b, bounds=(lower, lower + width)).x
    return solution
