"""Which effects this campaign cannot tell apart."""

from collections.abc import Callable, Sequence

import numpy as np
from scipy.special import ndtr, stdtrit

from discrepancy.inference.base_fit.projection import project_out
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.refit import Refit, is_untold
from discrepancy.problem import BASE, CHAIN, Candidate, Parameter
from fmu_src.arrays import Floats

MARGIN = 6.0
"""Difference of chi-square within which an effect stays in the set."""
PER_PARAMETER = 2.0
"""Price of a further parameter, in chi-square (Akaike)."""
PLAUSIBLE = 10.0
"""Amplitudes up to this many times their typical size cost nothing (assumed)."""
DECADE = 0.3
"""Beyond, an amplitude twice as large is one standard deviation less plausible (assumed): real parts may be far softer than typical."""
IDLE = 0.25
"""A shape known no better than this share of its whole range, in the logarithm, is not known."""
NEAR = 0.01
"""Share of a parameter's range in the logarithm that counts as its bound."""
SUPPORTED = 2.0
"""Within this of the best, price of the parameters included, a model is as well supported (Burnham and Anderson 2002)."""
FORM = 5e-4
"""Of what an effect gains: by so much chi-square the catalogue's form of it may be worse than nature's (2 % of the response)."""
NOTHING = 1e-6
"""Of its usual size: an amplitude below does nothing."""


def implausible(sizes: Floats) -> float:
    """Chi-square of the disagreement of amplitudes with their plausible range, from their sizes in units of ``Parameter.scale``."""
    return float(np.sum((np.log10(np.maximum(np.abs(sizes) / PLAUSIBLE, 1.0)) / DECADE) ** 2))


def price(candidate: Candidate, sizes: Floats) -> float:
    """What a candidate's parameters cost (a flexible effect imitates a stiff one, not the other way round) and their implausible ``sizes``."""
    return PER_PARAMETER * len(candidate.parameters) + implausible(sizes)


def penalised(rival: Refit) -> float:
    """Chi-square with the price of what is fitted, as far as it was not known before."""
    values = rival.fit.values
    whole = sum(price(c, np.array([(values[p.name] - p.off) / p.scale for p in c.amplitudes])) for c in rival.candidates)
    return rival.fit.chi2 + whole - PER_PARAMETER * known_before(rival)


def known_before(rival: Refit) -> float:
    """How many of the parameters of its effects are what their priors say and not what the data say: of each the share of its variance."""
    priors = {p.name: p.prior for p in rival.own if p.prior}
    return sum(float(np.clip(rival.covariance[k, k] / priors[p.name] ** 2, 0.0, 1.0)) for k, p in enumerate(rival.fit.parameters) if p.name in priors)


def ends_at_a_bound(rival: Refit, members: Sequence[Candidate] | None = None) -> bool:
    """Whether a parameter, of some ``members`` if they are given, ended at a bound, or a shape so near to one that the effect stands for another, simpler
    one."""
    return any(_at_a_bound(rival, p) and not _is_all(rival, p) for c in (rival.candidates if members is None else members) for p in c.parameters)


def newest_at_a_bound(joint: Refit) -> bool:
    """The same of the effect that came last to a joint fit."""
    return ends_at_a_bound(joint, joint.candidates[-1:])


def number_first(fits: Sequence[Refit], margin: float) -> list[Refit]:
    """``fits`` in their order; before the first of them, if it is not better by a ``margin`` of chi-square, the first whose newest effect is a number of the
    base model: some of these are always off a little."""
    numbers = [f for f in fits if f.candidates[-1].part == BASE and not newest_at_a_bound(f) and penalised(f) - penalised(fits[0]) < margin]
    return sorted(fits, key=lambda f: f not in numbers[:1])


def newest_does_nothing(joint: Refit) -> bool:
    """Whether the effect that came last is off: what the fit gains is where zeros and cages were placed anew with it."""
    return all(abs(joint.fit.values[p.name] - p.off) < NOTHING * p.scale for p in joint.candidates[-1].amplitudes)


def _at_a_bound(rival: Refit, p: Parameter) -> bool:
    return p.name in rival.fit.at_bounds or _near_a_bound(p, rival.fit.values[p.name])


def _is_all(rival: Refit, p: Parameter) -> bool:
    """Whether a parameter is a share, and all: that is a value like another (no wear below a threshold), and no limit of the search."""
    return (p.unit, p.lower, p.upper) == ("1", 0.0, 1.0) and rival.fit.values[p.name] > 0.5


def has_idle_shapes(rival: Refit, members: Sequence[Candidate] | None = None) -> bool:
    """Whether the data say nothing about one of its shapes, or of those of some ``members``: then it is a simpler effect in disguise."""
    names = [p.name for p in rival.fit.parameters]
    for p in (p for c in (rival.candidates if members is None else members) for p in c.shapes if p.lower > 0.0):
        k = names.index(p.name)
        deviation = float(np.sqrt(max(rival.covariance[k, k], 0.0)))
        if is_untold(rival.fit, k) or deviation / rival.fit.values[p.name] > IDLE * np.log(p.upper / p.lower):
            return True
    return False


def is_settled(rival: Refit, members: Sequence[Candidate] | None = None) -> bool:
    """Whether it, or some ``members`` of it, stand for no simpler effect."""
    return not ends_at_a_bound(rival, members) and not has_idle_shapes(rival, members)


def _near_a_bound(p: Parameter, value: float) -> bool:
    """In the logarithm, where the parameter cannot change its sign."""
    if p.lower <= 0.0 or value <= 0.0:
        return False
    whole = np.log(p.upper / p.lower)
    return bool(min(np.log(p.upper / value), np.log(value / p.lower)) < NEAR * whole)


def every_member(rival: Refit) -> Sequence[Candidate]:
    return rival.candidates


def confusable_set(rivals: Sequence[Refit], inflation: float = 1.0, dof: float = 1e6, margin: float = MARGIN,
                   compared: Callable[[Refit], Sequence[Candidate]] = every_member) -> list[Refit]:  # fmt: skip
    """Effects whose fit is as good as the best but for ``margin``, best first; nothing that ends at a bound stands beside others.

    ``compared``: the effects of a rival by which it differs from the others; those that all have beside it speak for none.
    ``inflation`` is the leftover misfit per degree of freedom; few replicates widen the margin to
    what Student's law asks for the same probability.
    """
    if not rivals:
        return []
    ordered = sorted(rivals, key=penalised)
    inside = [r for r in ordered if not ends_at_a_bound(r, compared(r))] or ordered[:1]
    simple = [r for r in inside if not has_idle_shapes(r, compared(r))]
    # Where nothing simpler is near, those of which a shape is unknown stand beside one another.
    inside = simple if simple and penalised(simple[0]) - penalised(inside[0]) <= margin * max(1.0, inflation) else inside
    best = ordered[0] if penalised(inside[0]) - penalised(ordered[0]) > margin * max(1.0, inflation) else inside[0]
    if dof < 200:
        margin = stdtrit(max(dof, 2.0), ndtr(-np.sqrt(margin))) ** 2
    near = [r for r in inside if penalised(r) - penalised(best) <= margin * max(1.0, inflation)]
    return near if best in near else [best, *near]


def unsettled(rivals: Sequence[Refit], members: Sequence[Refit], final: Refit, margin: float = MARGIN,
              compared: Callable[[Refit], Sequence[Candidate]] = every_member) -> list[Refit]:  # fmt: skip
    """Effects that are no plain members, for a value ends at a bound or is told by nothing, but cannot be left out of a set either.

    Mostly such a fit is a simpler effect in disguise (a seat that never slips is a spring); it stands beside that one where the data
    support it as well, or where it puts the cause elsewhere: into the reducer and not into the instruments, or the other way round.
    A number of the base model leaves none out that is as well supported, and stands itself beside no effect.  ``compared``: see ``confusable_set``.
    """
    part = compared(final)[0].part
    found = []
    for r in rivals:
        other = compared(r)[0].part
        if r not in members and other != BASE:
            elsewhere = part != BASE and (part == CHAIN) != (other == CHAIN)
            if penalised(r) - penalised(final) <= (margin if elsewhere else SUPPORTED):
                found.append(r)
    return found


def canonical_correlation(space: Workspace, a: Refit, b: Refit) -> float:
    """Largest canonical correlation of two effects' responses, nuisances projected out: 1 cannot be separated."""
    base = space.base
    spans = []
    for rival in (a, b):
        own = rival.fit.jacobian[:, len(base.parameters):]
        columns = project_out(np.column_stack([rival.response, own]), base.jacobian, base.normal)
        columns = columns[:, :1] if np.linalg.norm(columns[:, 0]) > 0 else columns
        norms = np.linalg.norm(columns, axis=0)
        q, _ = np.linalg.qr(columns[:, norms > 0] / norms[norms > 0])
        spans.append(q)
    if not spans[0].shape[1] or not spans[1].shape[1]:
        return 0.0
    return float(min(1.0, np.linalg.svd(spans[0].T @ spans[1], compute_uv=False)[0]))
