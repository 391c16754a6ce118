"""How likely noise alone makes a sum of squares, where a part of it is known from few replicates.

An estimate from two degrees of freedom is a hundred times too small once in a hundred campaigns, and a score along what such noise does as much too
large.  The law of F with Satterthwaite's degrees of freedom, which are those of the usual sizes, knows nothing of that: of a score with a
third of such noise it says 1e-10 where it is 1e-3.  Here all that the variance may be is gone through (Behrens and Fisher).
"""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc, chdtri, fdtrc

from discrepancy.inference.base_fit.components import Component, effective_dof, mean_excess
from discrepancy.inference.base_fit.workspace import Workspace
from fmu_src.arrays import Floats

# Degrees of freedom from which a part of the noise counts as well known.
WELL_KNOWN = 30.0
# Share of other noise along a direction from which on that is unsure; how far its estimate may be off, and at how many sizes that is looked at.
UNSURE, LEAST_LIKELY, NODES = 0.01, 1e-12, 120
# Of a probability.
SMALLEST = 1e-300
# What is uncertain beside noise.
PRIOR: Component = ("prior", "prior")


@dataclass(frozen=True)
class Squares:
    """A sum of squares of noise over some directions: variances (m,) of its ``well`` and ``poor`` known parts, and their degrees of freedom."""

    well: Floats
    poor: Floats
    dof: float
    dof_poor: float

    def tail(self, value: float) -> float:
        """Probability of more than ``value``."""
        weights: Floats = np.ones(1)
        variances: Floats = self.well.reshape(1, -1)
        if self.poor.any():
            edges = np.geomspace(chdtri(self.dof_poor, 1.0 - LEAST_LIKELY), chdtri(self.dof_poor, LEAST_LIKELY), NODES + 1)
            weights = -np.diff(np.asarray(chdtrc(self.dof_poor, edges), np.float64))
            ratios: Floats = self.dof_poor / np.sqrt(edges[1:] * edges[:-1])
            variances = self.well + np.outer(ratios, self.poor)
        # Of unequal variances it is a scaled chi-square, nearly.
        width = variances.sum(axis=1) ** 2 / np.sum(variances**2, axis=1)
        tails = fdtrc(width, self.dof, max(value, 0.0) / variances.sum(axis=1))
        return max(float(weights @ tails / weights.sum()), SMALLEST)


# What says how likely scores are by noise alone: ``chance`` or ``usual_chance``.
Chance = Callable[[Workspace, Floats, Mapping[Component, Floats], Mapping[Component, float]], tuple[float, float]]


def squares_of(space: Workspace, shares: Mapping[Component, Floats], factors: Mapping[Component, float], poor: Collection[Component]) -> Squares:
    """The law over directions whose noise has these ``shares`` (m,), times ``factors``, of which parts are ``poor`` known."""

    def sums(parts: Mapping[Component, Floats]) -> dict[Component, float]:
        return {c: float(s.sum()) for c, s in parts.items()}

    well, unsure = {c: s for c, s in shares.items() if c not in poor}, {c: s for c, s in shares.items() if c in poor}
    nothing = np.zeros(len(next(iter(shares.values()))))
    known = sum((np.maximum(s, 0.0) * factors.get(c, 1.0) for c, s in well.items()), nothing)
    unknown = sum((np.maximum(s, 0.0) for s in unsure.values()), nothing)
    return Squares(known, unknown, effective_dof(space, sums(well)), effective_dof(space, sums(unsure)))


def chance(space: Workspace, score: Floats, grams: Mapping[Component, Floats], factors: Mapping[Component, float]) -> tuple[float, float]:
    """(chi-square in units of ``factors``, probability of so much by noise alone) of scores (m,) with variance one.

    Parts of the noise make ``grams`` (m, m) of it; what these lack of one is what else is uncertain: numbers with a prior, parameters of a fit.
    The few directions in which noise is poorly known are tested apart: along them large scores are common, which hides nothing in the others.
    """
    grams = {**grams, PRIOR: np.eye(len(score)) - sum(grams.values())}
    poor = {c for c in grams if space.noise.dof(c) < WELL_KNOWN}
    nothing = np.zeros(len(score))
    turn = np.linalg.eigh(sum((grams[c] for c in poor), np.diag(nothing)))[1]
    shares = {c: np.sum(turn * (g @ turn), axis=0) for c, g in grams.items()}
    unsure = sum((shares[c] for c in poor), nothing) > UNSURE
    squares = (turn.T @ score) ** 2
    statistics, tails = [], []
    for part, parts in ((unsure, poor), (~unsure, ())):
        if part.any():
            own = {c: s[part] for c, s in shares.items()}
            statistics.append(float(squares[part].sum()) / mean_excess(factors, {c: float(s.sum()) for c, s in own.items()}))
            tails.append((int(part.sum()), squares_of(space, own, factors, parts).tail(float(squares[part].sum()))))
    if len(tails) == 1:
        return statistics[0], tails[0][1]
    return sum(statistics), float(chdtrc(len(score), sum(chdtri(width, p) for width, p in tails)))


def usual_chance(space: Workspace, score: Floats, grams: Mapping[Component, Floats], factors: Mapping[Component, float]) -> tuple[float, float]:
    """The same by the usual sizes of all that is uncertain (Satterthwaite): too small where noise is poorly known, so that what is left is doubted sooner."""
    shares = {c: float(np.trace(g)) for c, g in grams.items()}
    statistic = float(score @ score) / mean_excess(factors, shares)
    return statistic, float(fdtrc(len(score), effective_dof(space, shares), statistic / len(score)))
