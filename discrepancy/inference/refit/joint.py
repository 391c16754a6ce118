"""Fits of all parameters together, from wherever they stand: polished by sensitivities that are known, or along whatever way leads down."""

from collections.abc import Mapping, Sequence

import numpy as np

from discrepancy.inference.base_fit.fit import Box, Fit, fit_of
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.frozen import HOPE
from discrepancy.inference.refit.secants import Secants
from discrepancy.problem import Parameter, near
from fmu_src.arrays import Floats

# Predictions that a joint fit may take.
JOINT_STEPS = 15
# So often the sensitivities of a joint fit are taken anew in a search; between, its steps tell.
EXACT_EVERY = 3
# Shortenings of one step of a joint fit.
MOST_DAMPED = 6
# A fit stands still when its chi-square falls by less than this.
STILL = 2e-3
# A search stands still by this already.
ROUGHLY_STILL = 0.1
# So does one that only says which of several starts is right, and from where to go on.
ABOUT_STILL = 1.0
# Of what is left beyond twice the noise a gain of this share moves nothing that is told: that widens the intervals by far more.
LITTLE = 1e-5
# Rounds of polishing a fit that is searched for, by the sensitivities that it has, and one that is reported.
ROUGH_ROUNDS, ROUNDS = 4, 8
# Of what a descent must still gain, what it gains at least from sensitivities that are taken anew; else it will not in the steps that it has.
STUCK = 0.02


def total_cost(space: Workspace, box: Box, values: Mapping[str, float]) -> tuple[float, Floats]:
    """Chi-square with the priors, and the whitened residual."""
    r = space.residual(values)
    return float(r @ r) + box.prior_cost(box.array(values)), r


def there(space: Workspace, fit: Fit) -> Fit:
    """The fit where it stands, with predictions of its own values."""
    return fit_of(fit.parameters, fit.values, space.residual(fit.values), fit.jacobian, fit.candidates, fit.converged)


def left_by(space: Workspace, fit: Fit) -> float:
    """Chi-square of the records of ``space`` with the values of a fit."""
    return total_cost(space, Box(fit.parameters), fit.values)[0]


def left_of(residual: Floats, jacobian: Floats) -> float:
    """Squares of a whitened ``residual`` (n,) that no parameter of the ``jacobian`` (n, p) takes away."""
    steps, *_ = np.linalg.lstsq(jacobian, residual, rcond=None)
    left = residual - jacobian @ steps
    return float(left @ left)


def stands_still(gain: float, cost: float, samples: int, still: float = STILL) -> bool:
    """Whether a fit that leaves the chi-square ``cost`` of so many ``samples`` stands still where it falls by ``gain``."""
    return gain < max(still, LITTLE * (cost - 2.0 * samples))


def may_reach(fit: Fit, least: float) -> bool:
    """Whether a fit may come below the chi-square ``least`` by more steps, by what the next one promises."""
    return fit.chi2 - HOPE * still_promised(fit) < least


def still_promised(fit: Fit) -> float:
    """What another step would gain in chi-square if all were linear."""
    box = Box(fit.parameters)
    normal, gradient = fit.normal * np.outer(box.scale, box.scale), fit.gradient * box.scale
    step = box.step(box.array(fit.values), normal + 1e-10 * np.diag(np.diag(normal) + 1e-300), gradient) / box.scale
    return float(2.0 * gradient @ step - step @ normal @ step)


def polish(space: Workspace, parameters: Sequence[Parameter], values: Mapping[str, float], columns: Floats, candidates: tuple[str, ...],
            converged: bool, expected: float, fresh: bool = False) -> Fit:  # fmt: skip
    """Full predictions until the chi-square stands still; sensitivities are renewed where the frozen ones mislead."""
    box = Box(parameters)
    x = box.array(values)

    def cost_of(z: Floats) -> tuple[float, Floats]:
        return total_cost(space, box, box.named(z))

    cost, r = cost_of(x)
    rough = space.predictions.rough
    for _ in range(ROUGH_ROUNDS if rough else ROUNDS):
        normal = (columns.T @ columns + np.diag(box.precision)) * np.outer(box.scale, box.scale)
        normal += 1e-10 * np.diag(np.diag(normal) + 1e-300)
        step = box.step(x, normal, box.scale * (columns.T @ r - box.prior_gradient(x)))
        for part in (1.0, 0.4, 0.1):
            trial = np.clip(x + part * step, box.lower, box.upper)
            with near(box.named(x)):
                new, new_r = cost_of(trial)
            if new < cost:
                break
        gain = cost - new
        if gain > 0:
            x, r, cost = trial, new_r, new
        if stands_still(gain, cost, r.size, STILL if fresh else 0.05):
            # done, unless frozen sensitivities left it above what the partly linear fit promised
            if fresh or rough or (cost < expected + 0.5 and cost < space.base.chi2):
                break
            columns = space.columns(parameters, box.named(x))
            fresh = True
        else:
            fresh = False
    return fit_of(parameters, box.named(x), r, columns, candidates, converged)


def by_own_sensitivities(space: Workspace, fit: Fit, names: tuple[str, ...]) -> Fit:
    """The fit polished by sensitivities at its own values."""
    columns = space.columns(fit.parameters, fit.values)
    return polish(space, fit.parameters, fit.values, columns, names, fit.converged, fit.chi2, fresh=True)


def jointly(space: Workspace, parameters: Sequence[Parameter], start: Mapping[str, float], candidates: tuple[str, ...],
             evaluations: int = JOINT_STEPS, exact_every: int = EXACT_EVERY, least: float = np.inf) -> Fit:  # fmt: skip
    """All parameters together, with sensitivities that follow, after Levenberg and Marquardt: dear, but from anywhere and along bent valleys.

    Left where it will not come below the chi-square ``least``.
    """
    still = ROUGHLY_STILL if space.predictions.rough else STILL
    x, r, secants, converged = _walk(space, parameters, start, candidates, evaluations, exact_every, least, still)
    if not secants.exact and r @ r < space.base.chi2:
        secants.forget()
    return fit_of(parameters, Box(parameters).named(x), r, secants.columns(x), candidates, converged)


def _walk(space: Workspace, parameters: Sequence[Parameter], start: Mapping[str, float], candidates: tuple[str, ...], evaluations: int,
          exact_every: int, least: float, still: float) -> tuple[Floats, Floats, Secants, bool]:  # fmt: skip
    """Where ``jointly`` ends, by a step that gains less than ``still``: values (p,), residual, sensitivities, whether it stands still."""
    box = Box(parameters)
    secants = Secants(box, lambda z: space.columns(parameters, box.named(z)), exact_every)

    def cost_of(z: Floats) -> tuple[float, Floats]:
        cost, r = total_cost(space, box, box.named(z))
        secants.seen(z, r)
        return cost, r

    x = np.clip(box.array(start), box.lower, box.upper)
    cost, r = cost_of(x)
    damping, spent, converged, renewed_at = 1e-3, 1, False, np.inf
    while spent < evaluations:
        columns = secants.columns(x)
        normal = (columns.T @ columns + np.diag(box.precision)) * np.outer(box.scale, box.scale)
        gradient = box.scale * (columns.T @ r - box.prior_gradient(x))
        if secants.exact and np.isfinite(least):
            stuck = renewed_at - cost < STUCK * (cost - least)
            if stuck or not may_reach(fit_of(parameters, box.named(x), r, columns, candidates, False), least):
                break
            renewed_at = cost
        shift = np.diag(np.maximum(np.diag(normal), 1e-9 * np.max(np.diag(normal)) + 1e-300))
        for _ in range(MOST_DAMPED):
            trial = np.clip(x + box.step(x, normal + damping * shift, gradient), box.lower, box.upper)
            with near(box.named(x)):
                new, new_r = cost_of(trial)
            spent += 1
            if new < cost:
                break
            damping = max(8.0 * damping, 1e-3)
        gain, move = cost - new, (trial - x) / box.scale
        if gain > 0.0:
            promised = float(2.0 * gradient @ move - move @ normal @ move)
            damping *= 0.4 if gain > 0.75 * promised else 3.0 if gain < 0.25 * promised else 1.0
            x, cost, r = trial, new, new_r
        if stands_still(gain, cost, r.size, still):
            if secants.exact:
                converged = True
                break
            secants.forget()
    return x, r, secants, converged


def from_there(space: Workspace, fit: Fit, values: Mapping[str, float]) -> dict[str, float]:
    """About where a fit of the records of ``space`` ends from other values, all parameters together."""
    return Box(fit.parameters).named(_walk(space, fit.parameters, values, fit.candidates, JOINT_STEPS, EXACT_EVERY, np.inf, ABOUT_STILL)[0])
