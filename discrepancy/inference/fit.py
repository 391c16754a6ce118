"""Least squares on whitened residuals: the model's predictions, cached, and fits of its parameters.

Nuisances are close to linear around the base fit, so a candidate is first fitted with their
sensitivities frozen, and the result is then polished with full predictions.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import least_squares, lsq_linear

from discrepancy.inference.noise import Noise, estimate
from discrepancy.inference.predictions import Predictions
from discrepancy.problem import Candidate, Model, Parameter

STEP = 0.01
"""Step of a finite difference in units of ``Parameter.scale``."""
MISLED = 0.2
"""Share of the promised gain that may be missing before the frozen sensitivities are held to have misled."""
JOINT_STEPS = 15


@dataclass
class Fit:
    """A fitted model: ``residual`` (N,) whitened, ``jacobian`` (N, p) of -residual by ``names``; ``chi2`` with priors."""

    parameters: tuple[Parameter, ...]
    values: dict[str, float]
    residual: np.ndarray
    jacobian: np.ndarray
    chi2: float
    candidates: tuple[str, ...] = ()
    at_bounds: tuple[str, ...] = ()
    converged: bool = True
    normal: np.ndarray = field(default=None, repr=False)

    @property
    def names(self) -> list[str]:
        return [p.name for p in self.parameters]

    @property
    def gradient(self) -> np.ndarray:
        """What is left of the normal equations' right side, priors included: zero at the optimum."""
        pull = [0.0 if p.prior is None else (self.values[p.name] - p.off) / p.prior**2 for p in self.parameters]
        return self.jacobian.T @ self.residual - np.array(pull)

    @property
    def settled(self) -> np.ndarray:
        """Residual after one more linear step: exactly orthogonal to the parameters, up to their priors."""
        if not self.parameters:
            return self.residual
        return self.residual - self.jacobian @ (np.linalg.pinv(self.normal, hermitian=True) @ self.gradient)


class Workspace:
    """Records, noise and whitening; columns of parameters are stacked over the training records."""

    def __init__(self, model: Model):
        self.model = model
        self.records = list(model.records)
        self.predictions = Predictions(model)
        self.training = [i for i, r in enumerate(self.records) if not r.held_out]
        self.held_out = [i for i, r in enumerate(self.records) if r.held_out]
        if not self.training:
            raise ValueError("every record is held out: nothing is left to fit; mark some conditions as training")
        self.noise: Noise | None = None
        self.base: Fit | None = None

    # rows ---------------------------------------------------------------------------------
    def _layout(self) -> None:
        self.rows, start = {}, 0
        for i in self.training:
            size = self.noise.whiteners[i].size
            self.rows[i] = slice(start, start + size)
            start += size
        self.size = start

    def whiten(self, arrays: Mapping[int, np.ndarray]) -> np.ndarray:
        """Whitened stack over the training records; records not given are zero."""
        width = next((a.shape[1] for a in arrays.values() if a.ndim == 2), None)
        result = np.zeros(self.size if width is None else (self.size, width))
        for i, a in arrays.items():
            result[self.rows[i]] = self.noise.whiteners[i](a)
        return result

    def touched(self, candidate: Candidate | None) -> list[int]:
        if candidate is None or not candidate.signals:
            return list(range(len(self.records)))
        return [i for i, r in enumerate(self.records) if r.quantity in candidate.signals]

    def residual(self, values: Mapping[str, float]) -> np.ndarray:
        ys = self.predictions(values, self.training)
        return self.whiten({i: self.records[i].values - y for i, y in zip(self.training, ys)})

    def raw_residuals(self, values: Mapping[str, float]) -> tuple[list[np.ndarray], list[np.ndarray]]:
        every = list(range(len(self.records)))
        ys = self.predictions(values, every)
        return [np.asarray(r.values, dtype=float) - y for r, y in zip(self.records, ys)], ys

    def column(self, values: Mapping[str, float], parameter: Parameter, which: Sequence[int], step: float | None = None,
               at: float | None = None) -> dict[int, np.ndarray]:
        """Finite difference by one parameter, by record, per unit of the parameter."""
        at = values.get(parameter.name, parameter.off) if at is None else at
        step = STEP * parameter.scale if step is None else step
        if not parameter.lower <= at + step <= parameter.upper:
            step = -step
        here = {**values, parameter.name: at}
        high = self.predictions.beside({**values, parameter.name: at + step}, here, which)
        low = self.predictions.beside(here, here, which)
        return {i: (a - b) / step for i, a, b in zip(which, high, low)}

    # fits ---------------------------------------------------------------------------------
    def prior_rows(self, parameters: Sequence[Parameter]) -> np.ndarray:
        """Diagonal of the prior's precision."""
        return np.array([0.0 if p.prior is None else p.prior**-2 for p in parameters])

    def fit_base(self, passes: int = 2) -> Fit:
        """Nuisances fitted and noise estimated in turn: the differences of replicates need the phases of their mountings."""
        nuisances = self.model.nuisances
        values = {p.name: p.off for p in nuisances}
        sensitivities = None
        for turn in range(passes):
            self.noise = estimate(self.records, *self.raw_residuals(values))
            self._layout()
            if not nuisances:
                break
            if sensitivities is None:
                sensitivities = self._sensitivities(nuisances, values)
            values = self._solve_nuisances(nuisances, values, sensitivities)
        raw = self._sensitivities(nuisances, values)
        self.raw_nuisance = raw
        jacobian = self._stack(raw, len(nuisances))
        residual = self.residual(values)
        self.base = self._finish(nuisances, values, residual, jacobian, ())
        # nuisances that no training record can see (mounting phases of held-out runs)
        self.blind = [k for k in range(len(nuisances)) if not np.any(jacobian[:, k])]
        return self.base

    def _sensitivities(self, nuisances, values):
        every = list(range(len(self.records)))
        return [{i: c for i, c in self.column(values, p, every).items() if np.any(c)} for p in nuisances]

    def _stack(self, raw, width):
        jacobian = np.zeros((self.size, width))
        for k, columns in enumerate(raw):
            for i, c in columns.items():
                if i in self.rows:
                    jacobian[self.rows[i], k] = self.noise.whiteners[i](c)
        return jacobian

    def _columns(self, parameters, values):
        """Sensitivities of the training records at ``values``, whitened."""
        return self._stack([self.column(values, p, self.training) for p in parameters], len(parameters))

    def _solve_nuisances(self, nuisances, values, raw):
        scale = np.array([p.scale for p in nuisances])
        precision = np.sqrt(self.prior_rows(nuisances))
        off = np.array([p.off for p in nuisances])
        lower = np.array([p.lower for p in nuisances])
        upper = np.array([p.upper for p in nuisances])
        # Well inside: the solver's steps vanish with the distance to a bound.
        margin = np.minimum(0.3 * scale, 0.25 * (upper - lower))
        start = np.clip([values[p.name] for p in nuisances], lower + margin, upper - margin)
        columns = {"x": start, "j": self._stack(raw, len(nuisances))}

        def residual(x):
            r = self.residual(dict(zip((p.name for p in nuisances), x)))
            return np.concatenate([r, (x - off) * precision])

        def jacobian(x):
            moved = np.max(np.abs(x - columns["x"]) / scale) if len(x) else 0.0
            if moved > 0.3:
                at = dict(zip((p.name for p in nuisances), x))
                columns.update(x=x.copy(), j=self._stack(self._sensitivities(nuisances, at), len(nuisances)))
            return np.vstack([-columns["j"], np.diag(precision)])

        # residuals spoilt by samples left out are zero there: whitening drops them
        solution = least_squares(residual, start, jacobian, bounds=(lower, upper), x_scale=scale, xtol=1e-6, ftol=1e-7, max_nfev=12)
        return dict(zip((p.name for p in nuisances), (float(v) for v in solution.x)))

    def _finish(self, parameters, values, residual, jacobian, candidates, converged=True) -> Fit:
        normal = jacobian.T @ jacobian + np.diag(self.prior_rows(parameters))
        at_bounds = tuple(p.name for p in parameters if p.lower != p.off and values[p.name] - p.lower < 1e-3 * p.scale
                          or p.upper - values[p.name] < 1e-3 * p.scale)
        chi2 = self._chi2(parameters, values, residual)
        return Fit(tuple(parameters), dict(values), residual, jacobian, chi2, candidates, at_bounds, converged, normal)

    def _chi2(self, parameters, values: Mapping[str, float], residual: np.ndarray) -> float:
        """Chi-square with the priors."""
        shift = np.array([values[p.name] - p.off for p in parameters])
        return float(residual @ residual + np.sum(self.prior_rows(parameters) * shift**2))

    def fit_effects(self, candidates: Sequence[Candidate], start: Mapping[str, float], iterations: int = 12) -> Fit:
        """Nuisances and the parameters of ``candidates``, from ``start``."""
        own = tuple(p for c in candidates for p in c.parameters)
        nuisances = self.model.nuisances
        shows = {p.name: [i for i in self.touched(c) if i in self.rows] for c in candidates for p in c.parameters}
        which = sorted({i for indices in shows.values() for i in indices})
        theta = dict(self.base.values)
        values = {p.name: float(np.clip(start.get(p.name, p.off), p.lower, p.upper)) for p in own}
        # A nuisance that the base model hardly shows stays where it is, rather than running to its bounds.
        width = np.array([50.0 * (p.upper - p.lower) for p in nuisances])
        inverse = np.linalg.pinv(self.base.normal + np.diag(width**-2.0), hermitian=True)
        frozen = self.base.jacobian
        base = dict(zip(self.training, self.predictions(theta, self.training)))

        def difference(v):
            ys = self.predictions({**theta, **v}, which)
            return self.whiten({i: y - base[i] for i, y in zip(which, ys)})

        def cost_of(v):
            # nuisances are projected out with their priors: generalised least squares
            r = self.base.residual - difference(v)
            g = frozen.T @ r - self._prior_gradient(theta)
            return float(r @ r - g @ inverse @ g), r

        def columns_of(v):
            return np.column_stack([self.whiten(self.column({**theta, **v}, p, shows[p.name])) for p in own])

        values, converged, columns = self._descend(own, values, cost_of, columns_of, inverse, frozen, theta, iterations)
        # nuisances that go with it, then full predictions
        r = self.base.residual - difference(values)
        shift = inverse @ (frozen.T @ r - self._prior_gradient(theta))
        full = {**{p.name: float(np.clip(theta[p.name] + s, p.lower, p.upper)) for p, s in zip(nuisances, shift)}, **values}
        parameters = tuple(nuisances) + own
        columns = np.column_stack([frozen, columns])
        if self._cost(parameters, full)[0] > self.base.chi2:
            # Too far for frozen sensitivities: from the base fit's nuisances.
            full = {**theta, **values}
        names, promised = tuple(c.name for c in candidates), cost_of(values)[0]
        found = self._polish(parameters, full, columns, names, converged, promised)
        if found.chi2 - promised > MISLED * (self.base.chi2 - promised) + 1.0:
            # The base fit's nuisances had taken the effect's place, and are no place to start from.
            start = {**{p.name: p.off for p in nuisances}, **{p.name: start.get(p.name, p.off) for p in own}}
            found = min(found, self._jointly(parameters, start, names), key=lambda f: f.chi2)
        return found

    def _jointly(self, parameters: Sequence[Parameter], start: Mapping[str, float], candidates: tuple[str, ...]) -> Fit:
        """All parameters together, with new sensitivities at every step: dear, but from anywhere."""
        names = [p.name for p in parameters]
        off, scale, lower, upper = (np.array([getattr(p, k) for p in parameters]) for k in ("off", "scale", "lower", "upper"))
        precision = np.sqrt(self.prior_rows(parameters))
        margin = np.minimum(0.1 * scale, 0.25 * (upper - lower))

        def named(x):
            return dict(zip(names, map(float, x)))

        def residual(x):
            return np.concatenate([self.residual(named(x)), (x - off) * precision])

        solution = least_squares(
            residual, np.clip([start[n] for n in names], lower + margin, upper - margin), lambda x: np.vstack([-self._columns(parameters, named(x)), np.diag(precision)]),
            bounds=(lower, upper), x_scale=scale, xtol=1e-5, ftol=1e-5, max_nfev=JOINT_STEPS,
        )  # fmt: skip
        values = named(solution.x)
        return self._finish(tuple(parameters), values, self.residual(values), self._columns(parameters, values), candidates, bool(solution.success))

    def _cost(self, parameters, values: Mapping[str, float]) -> tuple[float, np.ndarray]:
        """Chi-square with the priors, and the whitened residual."""
        r = self.residual(values)
        return self._chi2(parameters, values, r), r

    def _prior_gradient(self, theta):
        nuisances = self.model.nuisances
        return self.prior_rows(nuisances) * np.array([theta[p.name] - p.off for p in nuisances])

    def _descend(self, own, values, cost_of, columns_of, inverse, frozen, theta, iterations):
        """Levenberg-Marquardt within bounds over the effect's parameters, nuisances projected out."""
        scale = np.array([p.scale for p in own])
        lower = np.array([p.lower for p in own])
        upper = np.array([p.upper for p in own])
        precision = self.prior_rows(own)
        off = np.array([p.off for p in own])
        x = np.array([values[p.name] for p in own])

        def named(z):
            return dict(zip((p.name for p in own), (float(v) for v in z)))

        def total(z):
            cost, r = cost_of(named(z))
            return cost + np.sum(precision * (z - off) ** 2), r

        cost, r = total(x)
        damping, converged = 1e-3, False
        c, fresh = columns_of(named(x)), True
        for _ in range(iterations):
            cross = frozen.T @ c
            normal = c.T @ c - cross.T @ inverse @ cross + np.diag(precision)
            gradient = c.T @ r - cross.T @ inverse @ (frozen.T @ r - self._prior_gradient(theta)) - precision * (x - off)
            better = False
            for _ in range(6):
                scaled = normal * np.outer(scale, scale)
                scaled = scaled + damping * np.diag(np.maximum(np.diag(scaled), 1e-9 * (np.max(np.diag(scaled)) + 1e-300)))
                step = scale * _bounded_step(scaled, gradient * scale, (lower - x) / scale, (upper - x) / scale)
                trial = np.clip(x + step, lower, upper)
                new, new_r = total(trial)
                if np.isfinite(new) and new < cost:
                    better = True
                    break
                damping = max(damping * 8, 1e-3)
                if not fresh or np.max(np.abs(step) / scale) < 1e-4:
                    break
            gain = cost - new if better else 0.0
            if better:
                move = trial - x
                promised = 2.0 * gradient @ move - move @ normal @ move
                x, cost, r = trial, new, new_r
                damping = max(damping / 5, 1e-6)
            if gain < 0.02:
                if fresh:
                    converged = True
                    break
            elif 0.8 * promised < gain < 1.25 * promised:
                # Sensitivities are dear; these still foretell what a step gains.
                fresh = False
                continue
            c, fresh = columns_of(named(x)), True
        return named(x), converged, c

    def renew(self, fit: Fit, candidates: Sequence[Candidate]) -> Fit:
        """The same fit with sensitivities at its own values: for what is reported."""
        for _ in range(3):
            columns = self._columns(fit.parameters, fit.values)
            renewed = self._polish(fit.parameters, fit.values, columns, tuple(c.name for c in candidates), fit.converged, fit.chi2, fresh=True)
            gain, fit = fit.chi2 - renewed.chi2, renewed
            if gain < 0.5:
                break
        return fit

    def _polish(self, parameters, values, columns, candidates, converged, expected: float, rounds: int = 8,
                fresh: bool = False) -> Fit:
        """Full predictions until the chi-square stands still; sensitivities are renewed where the frozen ones mislead."""
        scale = np.array([p.scale for p in parameters])
        lower = np.array([p.lower for p in parameters])
        upper = np.array([p.upper for p in parameters])
        off = np.array([p.off for p in parameters])
        precision = self.prior_rows(parameters)
        x = np.array([values[p.name] for p in parameters])
        names = [p.name for p in parameters]

        def cost_of(z):
            return self._cost(parameters, dict(zip(names, (float(v) for v in z))))

        cost, r = cost_of(x)
        for _ in range(rounds):
            normal = (columns.T @ columns + np.diag(precision)) * np.outer(scale, scale)
            normal += 1e-10 * np.diag(np.diag(normal) + 1e-300)
            gradient = scale * (columns.T @ r - precision * (x - off))
            step = scale * _bounded_step(normal, gradient, (lower - x) / scale, (upper - x) / scale)
            for part in (1.0, 0.4, 0.1):
                trial = np.clip(x + part * step, lower, upper)
                new, new_r = cost_of(trial)
                if new < cost:
                    break
            gain = cost - new
            if gain > 0:
                x, r, cost = trial, new_r, new
            if gain < 0.05:
                # done, unless frozen sensitivities left it above what the partly linear fit promised
                if fresh or cost < expected + 0.5 and cost < self.base.chi2:
                    break
                at = dict(zip(names, (float(v) for v in x)))
                columns = self._columns(parameters, at)
                fresh = True
            else:
                fresh = False
        return self._finish(parameters, dict(zip(names, (float(v) for v in x))), r, columns, candidates, converged)


def _bounded_step(normal, gradient, lower, upper):
    """Minimiser of s'Ns/2 - g's in a box."""
    values, vectors = np.linalg.eigh(normal)
    keep = values > 1e-13 * max(values.max(), 1e-300)
    free = vectors[:, keep] @ ((vectors[:, keep].T @ gradient) / values[keep])
    if np.all(free >= lower) and np.all(free <= upper):
        return free
    root = np.sqrt(values[keep])
    a = root[:, None] * vectors[:, keep].T
    b = (vectors[:, keep].T @ gradient) / root
    width = np.maximum(upper - lower, 1e-9)
    return lsq_linear(a, b, bounds=(lower, lower + width)).x
