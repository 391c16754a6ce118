"""How well each part of the noise is known, and what that does to tests and intervals.

In whitened space every part of the noise has unit variance; the bulk of a signal's noise is
known from thousands of samples, its offset from run to run only from the few replicates.
"""

from collections import defaultdict
from collections.abc import Mapping

import numpy as np
from scipy.linalg.lapack import dpstrf

from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.projection import Projected, in_parts
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.problem import ORDERS
from fmu_src.arrays import Floats

# A part of the noise: the signal, and "main" or the pattern by which its runs differ.
Component = tuple[str, str]
# Samples from which the mean square of a signal's misfit says something.
LONG = 200


def component_grams(space: Workspace, columns: Floats | Projected, places: Mapping[int, slice] | None = None) -> dict[Component, Floats]:
    """Gram matrix of ``columns`` (N, m) in each part of the noise; their sum is the whole.  ``places``: rows of each run, without those of the training."""
    grams: dict[Component, Floats] = {}
    width = columns.shape[1]
    for i, rows in (space.rows if places is None else places).items():
        whitener = space.noise.whiteners[i]
        main = grams.setdefault((whitener.quantity, "main"), np.zeros((width, width)))
        along = np.zeros((whitener.directions.shape[1], width))
        for part in in_parts(rows):
            block = columns[part]
            main += block.T @ block
            along += whitener.directions[part.start - rows.start : part.stop - rows.start].T @ block
        if len(along):
            main -= along.T @ along
            for k, component in enumerate(whitener.components):
                gram = grams.setdefault(component, np.zeros((width, width)))
                gram += np.outer(along[k], along[k])
    return grams


def effective_dof(space: Workspace, shares: Mapping[Component, float]) -> float:
    """Satterthwaite's degrees of freedom of a variance made of parts with these shares."""
    total = sum(max(s, 0.0) for s in shares.values())
    if total <= 0:
        return 1e6
    inverse = sum((max(s, 0.0) / total) ** 2 / space.noise.dof(c) for c, s in shares.items())
    return float(np.clip(1.0 / max(inverse, 1e-7), 1.0, 1e6))


def excess(space: Workspace, fit: Fit) -> dict[Component, float]:
    """By which factor the misfit of each long signal is larger than its noise from replicates, at least 1.

    What a fit leaves all over a signal (heavy tails, a base that is a little wrong) is no evidence for one effect.  Of tables of orders it is
    what the middle one of the orders has: a single order that is far off is none of that.
    """
    tables: dict[Component, dict[float, list[Floats]]] = defaultdict(lambda: defaultdict(list))
    squares: dict[Component, float] = defaultdict(float)
    counts: dict[Component, int] = defaultdict(int)
    for i, rows in space.rows.items():
        key = (space.noise.whiteners[i].quantity, "main")
        squares[key] += float(np.sum(fit.residual[rows] ** 2))
        counts[key] += rows.stop - rows.start
        record = space.records[i]
        if record.quantity == ORDERS:
            order = np.asarray(record.axes["order"])[space.noise.whiteners[i].kept]
            for o in np.unique(order).tolist():
                tables[key][o].append(fit.residual[rows][order == o] ** 2)
    for key, by_order in tables.items():
        squares[key] = counts[key] * float(np.median([np.mean(np.concatenate(parts)) for parts in by_order.values()]))
    return {key: max(1.0, squares[key] / count) for key, count in counts.items() if count >= LONG}


def mean_excess(factors: Mapping[Component, float], shares: Mapping[Component, float]) -> float:
    """The factor for a test whose noise has these shares."""
    total = sum(max(s, 0.0) for s in shares.values())
    return sum(max(s, 0.0) * factors.get(c, 1.0) for c, s in shares.items()) / total if total > 0.0 else 1.0


def simulate(space: Workspace, grams: dict[Component, Floats], draws: int, rng: np.random.Generator,
             factors: dict[Component, float]) -> Floats:
    """Scores (draws, m) of pure noise whose parts have variances estimated with their degrees of freedom, times ``factors``."""
    width = next(iter(grams.values())).shape[0]
    scores = np.zeros((draws, width))
    for component, gram in grams.items():
        # In units of each column: sizes differ by many powers of ten, and rounding goes with the largest.
        size = np.sqrt(np.maximum(np.diag(gram), 0.0))
        inverse = np.divide(1.0, size, out=np.zeros(width), where=size > 0.0)
        # A pivoted Cholesky factor is a root as good as any, and ends where the rank does.
        lower, pivots, rank, _ = dpstrf(gram * np.outer(inverse, inverse), lower=1, tol=1e-12)
        if rank == 0:
            continue
        root = np.zeros((width, rank))
        root[pivots - 1] = np.tril(lower)[:, :rank]
        root *= size[:, None]
        dof = space.noise.dof(component)
        inflation: Floats = np.sqrt(dof / rng.chisquare(dof, draws)) if dof < 1e4 else np.ones(draws)
        inflation *= np.sqrt(factors.get(component, 1.0))
        scores += inflation[:, None] * (rng.standard_normal((draws, rank)) @ root.T)
    return scores
