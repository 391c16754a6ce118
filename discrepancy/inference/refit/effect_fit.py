"""Fits of effects, with the nuisances that go with them.

Nuisances are close to linear around the base fit, so an effect is first fitted with their
sensitivities frozen, and the result is then polished with full predictions.
"""

from collections.abc import Mapping, Sequence
from operator import itemgetter

import numpy as np

from discrepancy.inference.base_fit.fit import Box, Fit, fit_of
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.frozen import Frozen
from discrepancy.inference.refit.joint import STUCK, by_own_sensitivities, jointly, may_reach, polish, still_promised, total_cost
from discrepancy.inference.refit.starts import MOST_AMPLITUDES, alone, along_valley, halved, other_starts
from discrepancy.problem import Candidate, Parameter, Placing, near
from fmu_src.arrays import Floats

MISLED = 0.2
"""Share of the promised gain that may be missing before the frozen sensitivities are held to have misled."""
# Descents from other starts than the score test's, and what these may lack of the gain at once.
OTHERS, PROMISING = 2, 0.1
# Chi-square by sample of a fit that leaves much, share of the base fit's of one that explains much, and how many other places such a fit starts from.
LEAVES, EXPLAINS, ELSEWHERE = 2.0, 0.5, 2
# A fit that is searched for, of which a further step promises more than this chi-square, takes sensitivities anew so often: a wear
# coefficient multiplies what a law does, and the base fit's says little where the law has halved the wear.
UNFINISHED, ANEW = 5.0, 3
# A shape within this share of a bound ended there.
AT_BOUND = 1e-3
# Where the nuisances that follow gain more than this share of what was promised without them, the effect stands where frozen ones had put it.
BENT = 0.05


def fit_effects(space: Workspace, candidates: Sequence[Candidate], starts: Sequence[Mapping[str, float]], widely: bool = False,
                least: float = np.inf) -> Fit:  # fmt: skip
    """Nuisances and the parameters of ``candidates``, from the best of ``starts``; ``widely``: and from wherever else it is better.

    What will not come below the chi-square ``least`` is left where that became clear.
    """
    frozen = Frozen(space, candidates, least)
    own, nuisances = frozen.own, space.model.nuisances
    parameters, names = tuple(nuisances) + own, tuple(c.name for c in candidates)
    begins = [{p.name: float(np.clip(start.get(p.name, p.off), p.lower, p.upper)) for p in own} for start in starts]
    values, converged, columns = _search(frozen, candidates, begins, widely)
    if frozen.misled and not widely:
        anew = _beginning(space, candidates, begins[0])
        return _kept_if_better(space, jointly(space, parameters, anew, names, exact_every=1, least=least), own)
    promised, residual = frozen.cost(values)
    full = {**frozen.nuisances_with(residual), **values}
    if total_cost(space, Box(parameters), full)[0] > space.base.chi2:
        # Too far for frozen sensitivities: from the base fit's nuisances.
        full = {**frozen.theta, **values}
    every = np.column_stack([frozen.jacobian, columns])
    if frozen.hopeless(promised, *frozen.equations(frozen.part.array(values), residual, columns)):
        return fit_of(parameters, full, space.residual(full), every, names, False)
    found = polish(space, parameters, full, every, names, converged, promised)
    if found.chi2 < space.base.chi2:
        found = _finished(space, found, least)
    if found.chi2 - promised > MISLED * (space.base.chi2 - promised) + 1.0:
        # The base fit's nuisances had taken the effect's place, and are no place to start from.
        anew = _beginning(space, candidates, begins[0])
        found = min(found, jointly(space, parameters, anew, names, least=least), key=lambda f: f.chi2)
    elif promised - found.chi2 > max(BENT * (space.base.chi2 - promised), 1.0) and 2.0 * found.chi2 - promised < least:
        # What the nuisances gained once they may gain again: a bent valley promises little at any one place.
        found = min(found, jointly(space, parameters, found.values, names, exact_every=1), key=lambda f: f.chi2)
    if widely:
        found = _from_elsewhere(space, found, candidates, least)
    return _kept_if_better(space, found, own)


def _beginning(space: Workspace, candidates: Sequence[Candidate], start: Mapping[str, float]) -> dict[str, float]:
    """Where all parameters together begin: the nuisances off or at the base fit, the effects at ``start`` or no larger than they usually are, whichever
    costs least.  An effect that feeds on itself runs away where a slope at the base model puts it."""
    nuisances = space.model.nuisances
    amplitudes = [p for c in candidates for p in c.amplitudes]
    usual = {p.name: p.off + float(np.clip(start[p.name] - p.off, -p.scale, p.scale)) for p in amplitudes}
    places = (_off(nuisances), {p.name: space.base.values[p.name] for p in nuisances})
    box = Box((*nuisances, *(p for c in candidates for p in c.parameters)))
    return min(({**place, **start, **own} for own in ({}, usual) for place in places), key=lambda values: total_cost(space, box, values)[0])


def _off(parameters: Sequence[Parameter]) -> dict[str, float]:
    return {p.name: p.off for p in parameters}


def _kept_if_better(space: Workspace, fit: Fit, own: Sequence[Parameter]) -> Fit:
    """The fit, or whatever a search has lost: switched off, an effect is as good as none."""
    if fit.chi2 <= space.base.chi2:
        return fit
    return fit_of(fit.parameters, {**space.base.values, **_off(own)}, space.base.residual, fit.jacobian, fit.candidates, False)


def _from_elsewhere(space: Workspace, fit: Fit, candidates: Sequence[Candidate], least: float) -> Fit:
    """The fit, or a better one from where the model places its nuisances beside the effects: what the base fit had placed without a large one may be
    far from there.  Only of what explains much and leaves much, unless another leaves little (``least``)."""
    model, much = space.model, LEAVES * len(fit.residual)
    if not isinstance(model, Placing) or not much < fit.chi2 < EXPLAINS * space.base.chi2 or least < much:
        return fit
    own = {p.name: fit.values[p.name] for c in candidates for p in c.parameters}
    forms = [own, *({**own, **shapes} for c in candidates for shapes in c.shape_grid)]
    found = [(*model.placed_anew({**fit.values, **form}), form) for form in forms]
    off = _off(model.nuisances)
    sure = [i for i in space.training if i not in model.unplaced()]
    for _, places, form in sorted(found, key=itemgetter(0))[:ELSEWHERE]:
        if not places:
            continue
        start: Mapping[str, float] = {**off, **form, **places}
        if len(sure) < len(space.training):
            # What stands nobody knows where follows: it would hold the effects where it shows least of them.
            start = jointly(space.only(sure), fit.parameters, start, fit.candidates).values
            space.predictions.settle(start)
        fit = min(fit, jointly(space, fit.parameters, start, fit.candidates), key=lambda f: f.chi2)
    return fit


def _finished(space: Workspace, fit: Fit, least: float) -> Fit:
    """A fit that is searched for, by sensitivities at its own values where those of the base fit have left it half-way; not one that will
    not come below ``least``."""
    for _ in range(ANEW):
        promised = still_promised(fit)
        if promised < UNFINISHED or not may_reach(fit, least):
            break
        before, fit = fit.chi2, by_own_sensitivities(space, fit, fit.candidates)
        if before - fit.chi2 < UNFINISHED:
            break
    return fit


def _search(
    frozen: Frozen, candidates: Sequence[Candidate], starts: Sequence[dict[str, float]], widely: bool
) -> tuple[dict[str, float], bool, Floats]:  # fmt: skip
    """The best optimum (values, whether it converged, columns) from ``starts``; ``widely`` also from other sizes and along its valley."""

    def cost(values: Mapping[str, float]) -> float:
        return frozen.total(frozen.part.array(values))[0]

    found = []
    for start in starts:
        found.append(_descend(frozen, start))
        if frozen.misled and not widely:
            return found[-1]
    if len(candidates) > 1:
        ended = min(found, key=lambda f: cost(f[0]))[0]
        if usual := _usual_again(candidates, ended):
            found.append(_descend(frozen, {**ended, **usual}))
    if min(cost(f[0]) for f in found) > frozen.space.base.chi2:
        # Worse than no effect at all: the start lay where the effect runs away, and slopes there lead nowhere.
        found += [_descend(frozen, start) for start in halved([p for c in candidates for p in c.amplitudes], starts[0], cost, frozen.space.base.chi2)]
    amplitudes = candidates[0].amplitudes if len(candidates) == 1 else ()
    if widely and amplitudes:
        # An optimum may lie behind a ridge, further along a valley, beyond a threshold, or by another harmonic.
        best = min(found, key=lambda f: cost(f[0]))
        others = other_starts(amplitudes, best[0])
        if 1 < len(amplitudes) <= MOST_AMPLITUDES:
            others += along_valley(frozen.own, best[0], _information(frozen, best[2]))
        by_cost, least = frozen.space.threads.map(cost, others), cost(best[0])
        promising = least + PROMISING * max(frozen.space.base.chi2 - least, 0.0)
        chosen = [others[k] for k in np.argsort(by_cost)[:OTHERS] if by_cost[k] < promising]
        if len(amplitudes) > MOST_AMPLITUDES:
            best_of_each = sorted((min(zip(frozen.space.threads.map(cost, starts), starts), key=itemgetter(0)) for starts in alone(amplitudes, best[0])),
                                  key=itemgetter(0))  # fmt: skip
            chosen += [start for left, start in best_of_each[:OTHERS] if left < frozen.space.base.chi2]
        found += [_descend(frozen, start) for start in chosen]
    return min(found, key=lambda f: cost(f[0]))


def _usual_again(candidates: Sequence[Candidate], values: Mapping[str, float]) -> dict[str, float]:
    """Shapes that ended at a bound, at what they usually are: an effect that began far too small, for beside others it is larger, may have an optimum there."""
    shapes = [p for c in candidates for p in c.shapes if not p.is_direction]
    return {p.name: p.off for p in shapes if np.isclose(values[p.name], (p.lower, p.upper), rtol=AT_BOUND, atol=0.0).any()}


def _information(frozen: Frozen, columns: Floats) -> Floats:
    """Information about the effect's own parameters, nuisances projected out, in units of their scale."""
    part = frozen.part
    return frozen.information(columns, frozen.jacobian.T @ columns) * np.outer(part.scale, part.scale)


def _descend(frozen: Frozen, values: Mapping[str, float], iterations: int = 12) -> tuple[dict[str, float], bool, Floats]:
    """Levenberg-Marquardt within bounds over the effects' parameters: values, whether it converged, columns (N, p)."""
    box = frozen.part
    x = box.array(values)
    cost, r = frozen.total(x)
    damping, converged = 1e-3, False
    c, fresh = frozen.columns(box.named(x)), True
    for _ in range(iterations):
        normal, gradient = frozen.equations(x, r, c)
        if frozen.hopeless(cost, normal, gradient) or frozen.misleads(box.named(x), cost, r):
            break
        better = False
        for _ in range(6):
            scaled = normal * np.outer(box.scale, box.scale)
            scaled = scaled + damping * np.diag(np.maximum(np.diag(scaled), 1e-9 * (np.max(np.diag(scaled)) + 1e-300)))
            step = box.step(x, scaled, gradient * box.scale)
            trial = np.clip(x + step, box.lower, box.upper)
            with near(frozen.theta | box.named(x)):
                new, new_r = frozen.total(trial)
            if np.isfinite(new) and new < cost:
                better = True
                break
            damping = max(damping * 8, 1e-3)
            if not fresh or np.max(np.abs(step) / box.scale) < 1e-4:
                break
        gain = cost - new if better else 0.0
        if fresh and gain < STUCK * (cost - frozen.least):
            break
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
        c, fresh = frozen.columns(box.named(x)), True
    return box.named(x), converged, c


