"""Nonlinear refit of candidates, intervals of their parameters, leave-one-condition-out error."""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.special import stdtrit

from discrepancy.inference.base_fit.components import component_grams, effective_dof
from discrepancy.inference.base_fit.fit import Box, Fit, fit_of
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.effect_fit import fit_effects
from discrepancy.inference.refit.joint import jointly
from discrepancy.inference.refit.unseen_places import without_unseen
from discrepancy.inference.screening.screen import Score
from discrepancy.problem import Candidate, Parameter
from fmu_src.arrays import Floats

UNDETERMINED = 1e-6
"""Information (in units of the parameter's scale) below which a parameter is not estimated."""
FLAT = 0.1
"""Chi-square that is nothing over the whole range of a parameter, or of several that make up for each other."""
WIDEST = 1e4
"""Range of a parameter without bounds, in its scales."""
LEAST_SHARE = 1e-2
"""Of a valley: what moves less is not in it."""
ALLOWED, HALVINGS = 4.0, 5
"""Chi-square by which a fit along a valley may be worse (two standard deviations), and how often a bent one is tried half as far."""


@dataclass(frozen=True)
class Estimate:
    """A parameter with its interval."""

    name: str
    unit: str
    value: float
    deviation: float
    interval: tuple[float, float]
    dof: float
    at_bound: bool
    is_direction: bool = False
    # Where it may stand with ``others`` making up for it; its interval begins at these ends.
    core: tuple[float, float] | None = None
    others: tuple[str, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        return {"value": self.value, "interval": list(self.interval), "unit": self.unit, "standard_deviation": self.deviation,
                "degrees_of_freedom": self.dof, "at_bound": self.at_bound} | ({"direction": True} if self.is_direction else {}) | (
                {"told_with": list(self.others)} if self.others else {})


@dataclass(frozen=True)
class Refit:
    """One or several effects fitted together.  ``response`` (N,) is their whitened contribution.

    ``stretch``: by amplitude, how many times as far below and above its value its interval ends as the covariance says, where a valley is bent (``reach``).
    """

    candidates: tuple[Candidate, ...]
    fit: Fit
    gain: float
    response: Floats
    covariance: Floats
    stretch: Mapping[str, tuple[float, float]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        return " + ".join(c.name for c in self.candidates)

    @property
    def key(self) -> frozenset[str]:
        """The names of its effects, in whatever order they came."""
        return frozenset(c.name for c in self.candidates)

    @property
    def own(self) -> list[Parameter]:
        return [p for c in self.candidates for p in c.parameters]

    @property
    def at(self) -> dict[str, float]:
        """Where its effects stand."""
        return {p.name: self.fit.values[p.name] for p in self.own}


def refit(space: Workspace, candidates: Sequence[Candidate], scores: Sequence[Score], fixed: dict[str, float] | None = None,
          widely: bool = False, least: float = np.inf) -> Refit:  # fmt: skip
    """Fits ``candidates`` together from the screening's starting points; the best of at most two starts, ``widely`` of more.

    ``least``: see ``fit_effects``.
    """
    first = {k: v for s in scores for k, v in s.start.items()}
    starts = [{**first, **(fixed or {})}]
    for s in scores:
        if s.second_start:
            starts.append({**first, **s.second_start, **(fixed or {})})

    def fitting(where: Workspace, at_least: float) -> Fit:
        return fit_effects(where, candidates, starts[:2], widely, at_least)

    by_all, by_sure = fitting(space, least), without_unseen(space, candidates, fitting, least)
    return finished(space, candidates, by_all if by_sure is None else min(by_all, by_sure, key=lambda fit: fit.chi2))


def reshaped(space: Workspace, result: Refit) -> Refit:
    """The fit, or a better one from other shapes of its effects: what calibrated without the newest stood for that, too, far from its own (a seat with memory
    that slips at 10 N m slipped at 759, and found no way back)."""
    fit = result.fit
    for c in result.candidates:
        for shape in c.shape_grid if not any(p.is_direction or p.counts for p in c.shapes) else ():
            fit = min(fit, jointly(space, fit.parameters, {**fit.values, **shape}, fit.candidates), key=lambda f: f.chi2)
    return result if fit is result.fit else finished(space, result.candidates, fit)


def finished(space: Workspace, candidates: Sequence[Candidate], fit: Fit, covariance: Floats | None = None) -> Refit:
    """Adds response, gain and ``covariance`` (p, p) to a fit; that of its own sensitivities where none is given."""
    own = {p.name: fit.values[p.name] for c in candidates for p in c.parameters}
    rest = {k: v for k, v in fit.values.items() if k not in own}
    which = [i for i in space.training if any(i in space.touched(c) for c in candidates)]
    high, low = space.predictions({**rest, **own}, which), space.predictions(rest, which)
    response = space.whiten({i: a - b for i, a, b in zip(which, high, low)})
    return Refit(tuple(candidates), fit, space.base.chi2 - fit.chi2, response, covariance_of(fit) if covariance is None else covariance)


def covariance_of(fit: Fit) -> Floats:
    """Covariance (p, p) of all parameters by the fit's own sensitivities."""
    # scaled before inversion: units differ by orders of magnitude
    size = np.array([p.scale for p in fit.parameters])
    scaled = np.asarray(np.linalg.pinv(fit.normal * np.outer(size, size), rcond=1e-11, hermitian=True), dtype=float)
    return scaled * np.outer(size, size)


def estimates(space: Workspace, result: Refit, coverage: float = 0.95, inflation: float = 1.0) -> list[Estimate]:
    """Intervals by Student's law with the degrees of freedom of the noise that matters for each parameter.

    Parameters that cannot change sign get intervals symmetric in their logarithm.
    ``inflation`` widens for a misfit that is left.  Where a combination of parameters alone is told, each has all of the valley in which they make up for
    each other.
    """
    fit = result.fit
    influence = fit.jacobian @ result.covariance
    grams = component_grams(space, influence)
    estimated = []
    along = valleys(space, result)
    for k, p in enumerate(fit.parameters):
        if not any(p is q for q in result.own):
            continue
        value = p.off if p.is_off(fit.values[p.name]) else fit.values[p.name]
        if is_untold(fit, k):
            # The data say nothing about it: the interval is its range.
            without = fit.normal[k, k] * p.scale**2 < UNDETERMINED
            dof = 1.0 if without else effective_dof(space, {c: float(g[k, k]) for c, g in grams.items()})
            estimated.append(Estimate(p.name, p.unit, value, float("inf"), (p.lower, p.upper), dof, False, p.is_direction))
            continue
        deviation = float(np.sqrt(max(result.covariance[k, k], 0.0))) * inflation
        dof = effective_dof(space, {c: float(g[k, k]) for c, g in grams.items()})
        half = stdtrit(dof, 0.5 + coverage / 2) * deviation
        shape = not any(p is a for c in result.candidates for a in c.amplitudes)
        if shape and p.lower > 0 and value > 0:
            # Nothing is told beyond its bounds.
            factor = np.exp(min(half / value, np.log(p.upper / p.lower)))
            low, high = value / factor, value * factor
        else:
            below, above = result.stretch.get(p.name, (1.0, 1.0))
            low, high = value - below * half, value + above * half
        core, others = along.get(p.name, ((value, value), ()))
        low, high = low + core[0] - value, high + core[1] - value
        interval = (float(max(low, p.lower)), float(min(high, p.upper)))
        estimated.append(Estimate(p.name, p.unit, value, deviation, interval, dof, p.name in fit.at_bounds, p.is_direction, core, others))
    return estimated


def is_untold(fit: Fit, k: int) -> bool:
    """Whether the data say nothing about a parameter: over its whole range, by the curvature where it stands, the chi-square hardly rises."""
    p = fit.parameters[k]
    return bool(fit.normal[k, k] * p.scale**2 < UNDETERMINED or fit.normal[k, k] * (p.upper - p.lower) ** 2 < FLAT)


def valleys(space: Workspace, result: Refit) -> dict[str, tuple[tuple[float, float], tuple[str, ...]]]:
    """Of each parameter of the effects that is told only together with others: the range over which these make up for it, and their names.

    Friction and what it has more at rest show in a loop as their sum: neither has a curvature of its own, and which of both is how large no inverse says.
    """
    fit, box = result.fit, Box(result.fit.parameters)
    told = [k for k in range(len(fit.parameters)) if not is_untold(fit, k)]
    own = {p.name for p in result.own}
    if sum(fit.parameters[k].name in own for k in told) < 2:
        return {}
    x = box.array(fit.values)
    widths = np.array([min(p.upper - p.lower, WIDEST * p.scale) for p in (fit.parameters[k] for k in told)])
    values, vectors = np.linalg.eigh(fit.normal[np.ix_(told, told)] * np.outer(widths, widths))
    flat = vectors[:, values < FLAT]
    found = {}
    for j, k in enumerate(told):
        way = flat @ flat[j]
        if fit.parameters[k].name not in own or way[j] < LEAST_SHARE:
            continue
        way = np.where(np.abs(way) < LEAST_SHARE * way[j], 0.0, way) / way[j]
        others = tuple(fit.parameters[told[i]].name for i in np.flatnonzero(way) if i != j)
        if others:
            step = np.zeros(len(x))
            step[told] = way * widths
            ends = [float(x[k] + step[k] * _followed(space, fit, box, x, sense * step) * sense) for sense in (-1.0, 1.0)]
            found[fit.parameters[k].name] = (ends[0], ends[1]), others
    return found


def _followed(space: Workspace, fit: Fit, box: Box, x: Floats, step: Floats) -> float:
    """How many of ``step`` the parameters can go before one of them is at its bound, or the fit is worse than an interval allows."""
    moves = step != 0.0
    far = float(np.min(np.where(step > 0.0, box.upper - x, box.lower - x)[moves] / step[moves]))
    for _ in range(HALVINGS):
        there = np.clip(x + far * step, box.lower, box.upper)
        residual = space.residual(box.named(there))
        if float(residual @ residual) + box.prior_cost(there) < fit.chi2 + ALLOWED:
            return far
        far *= 0.5
    return 0.0


def drop_cost(result: Refit, candidate: Candidate) -> float:
    """Growth of chi-square without one of several effects, if all were linear (Wald)."""
    index = [k for k, p in enumerate(result.fit.parameters) if any(p is a for a in candidate.amplitudes)]
    parameters = [result.fit.parameters[k] for k in index]
    size = np.array([p.scale for p in parameters])
    amounts = np.array([result.fit.values[p.name] - p.off for p in parameters]) / size
    covariance = result.covariance[np.ix_(index, index)] / np.outer(size, size)
    return float(amounts @ np.linalg.pinv(covariance, rcond=1e-9, hermitian=True) @ amounts)


def leave_condition_out(space: Workspace, fit: Fit) -> dict[str, float]:
    """Chi-square of each condition when the fit had not seen it, e_c = (I - H_cc)^-1 e_c in the form of normal equations."""
    rows: dict[str, list[slice]] = defaultdict(list)
    for i, s in space.rows.items():
        rows[space.records[i].condition].append(s)
    size = np.array([p.scale for p in fit.parameters])
    gradient = fit.gradient
    at = np.array([fit.values[p.name] for p in fit.parameters])
    lower, upper = np.array([(p.lower, p.upper) for p in fit.parameters]).reshape(-1, 2).T
    result = {}
    for condition, slices in rows.items():
        jacobian = np.vstack([fit.jacobian[s] for s in slices])
        residual = np.concatenate([fit.residual[s] for s in slices])
        if not size.size:
            result[condition] = float(residual @ residual)
            continue
        normal = (fit.normal - jacobian.T @ jacobian) * np.outer(size, size)
        step = size * (np.linalg.pinv(normal, rcond=1e-10, hermitian=True) @ (size * (gradient - jacobian.T @ residual)))
        # What the others hardly determine goes to its bounds, not beyond.
        step = np.clip(at + step, lower, upper) - at
        error = residual - jacobian @ step
        result[condition] = float(error @ error)
    return result


def literal_leave_out(space: Workspace, result: Refit, conditions: Sequence[str] | None = None) -> dict[str, float]:
    """The same with real refits: the records of one condition get no weight."""
    errors = {}
    base, training, rows, size = space.base, space.training, space.rows, space.size
    try:
        for condition in conditions or space.conditions:
            inside = [i for i in training if space.records[i].condition != condition]
            outside = [i for i in training if space.records[i].condition == condition]
            space.training = inside
            space.lay_out()
            keep = np.concatenate([np.arange(rows[i].start, rows[i].stop) for i in inside])
            space.base = fit_of(base.parameters, base.values, base.residual[keep], base.jacobian[keep])
            fit = fit_effects(space, result.candidates, [result.fit.values])
            ys = space.predictions(fit.values, outside)
            errors[condition] = float(sum(np.sum(space.noise.whiteners[i](space.records[i].values - y) ** 2) for i, y in zip(outside, ys)))
    finally:
        space.base, space.training, space.rows, space.size = base, training, rows, size
    return errors
