"""The profile likelihood of a parameter: how much worse the fit becomes as it is moved and all others follow.

A parabola where the linear interval holds; a plateau, a second valley or a wall tells what an interval cannot.
"""

from dataclasses import dataclass
from functools import partial

import numpy as np

from discrepancy.inference.base_fit.fit import Box
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.refit import Refit, is_untold, valleys
from discrepancy.problem import near
from fmu_src.arrays import Floats

# Places in standard deviations of the linear interval.
AWAY = (-3.5, -1.75, 0.0, 1.75, 3.5)
# Of chi-square: what gains less needs no further correction.
ENOUGH = 0.1


@dataclass(frozen=True)
class Profile:
    """``chi2`` (n,) above that of the fit, with the parameter at ``values`` (n,) [its unit]; ``deviation`` of the linear interval."""

    name: str
    unit: str
    values: Floats
    chi2: Floats
    deviation: float
    is_direction: bool = False


def profiles(space: Workspace, result: Refit) -> list[Profile]:
    """Of every parameter of the named effects whose linear interval has a width."""
    fit, found, along = result.fit, [], valleys(space, result)
    names = [p.name for p in fit.parameters]
    best = Box(fit.parameters).array(fit.values)
    for p in result.own:
        k = names.index(p.name)
        deviation = float(np.sqrt(max(result.covariance[k, k], 0.0)))
        if not 0.0 < deviation < 0.5 * (p.upper - p.lower) or is_untold(fit, k):
            continue
        # From one end of a valley to the other.
        core = (best[k], *along.get(p.name, ((), ()))[0])
        below, above = result.stretch.get(p.name, (1.0, 1.0))
        away = deviation * np.array([a * (below if a < 0.0 else above) for a in AWAY])
        places = np.unique(np.clip([min(core) if a < 0.0 else max(core) if a > 0.0 else best[k] for a in AWAY] + away, p.lower, p.upper))
        others = np.array([j for j in range(len(names)) if j != k], dtype=np.intp)
        chi2 = space.threads.map(partial(moved, space, result, best, k, others), [float(value) for value in places])
        found.append(Profile(p.name, p.unit, places, np.array(chi2) - fit.chi2, deviation, p.is_direction))
    return found


def followed(space: Workspace, result: Refit, k: int, start: Floats, rounds: int) -> tuple[float, Floats]:
    """Chi-square with parameter ``k`` as in ``start`` and the others where they fit best, by the fit's own sensitivities corrected so often, and all places."""
    fit, box, x = result.fit, Box(result.fit.parameters), start
    others = np.array([j for j in range(len(x)) if j != k], dtype=np.intp)
    rest = Box([fit.parameters[j] for j in others])
    normal = fit.normal[np.ix_(others, others)] * np.outer(rest.scale, rest.scale)

    def chi_square(at: Floats) -> tuple[float, Floats]:
        with near(fit.values):
            residual = space.residual(box.named(at))
        return float(residual @ residual) + box.prior_cost(at), residual

    least, residual = chi_square(x)
    for _ in range(rounds):
        trial = x.copy()
        gradient = fit.jacobian[:, others].T @ residual - box.prior_gradient(x)[others]
        trial[others] += rest.step(x[others], normal, rest.scale * gradient)
        found, residual = chi_square(trial)
        gain = least - found
        if gain > 0.0:
            least, x = found, trial
        if gain < ENOUGH:
            break
    return least, x


def moved(space: Workspace, result: Refit, best: Floats, k: int, others: np.ndarray, value: float) -> float:
    """Chi-square with parameter ``k`` at ``value`` and the others where they fit best, by the fit's own sensitivities."""
    fit, box = result.fit, Box(result.fit.parameters)
    if value == best[k]:
        return fit.chi2
    x = best.copy()
    x[k] = value
    rest = Box([fit.parameters[j] for j in others])
    normal = fit.normal[np.ix_(others, others)] * np.outer(rest.scale, rest.scale)
    x[others] += rest.step(x[others], normal, -rest.scale * fit.normal[others, k] * (value - best[k]))
    # What the sensitivities did not foretell, the others follow once more.
    least, _ = followed(space, result, k, x, 1)
    if least - fit.chi2 <= fit.normal[k, k] * (value - best[k]) ** 2:
        return least
    # A kink lies between (a proud pin that is not between two is as high as it is): where the others follow it is worse than where they stay.
    x[others] = best[others]
    with near(fit.values):
        residual = space.residual(box.named(x))
    return min(least, float(residual @ residual) + box.prior_cost(x))
