"""Does a named effect depend on the conditions as the data do?

A law that is not the named one usually resembles it in one condition and departs from it in
others, so the effect's own response times functions of the conditions is the sharpest test of
what a fit leaves over.
"""

import numpy as np

from discrepancy.inference.base_fit.components import component_grams, excess
from discrepancy.inference.base_fit.projection import project_out
from discrepancy.inference.base_fit.squares import usual_chance
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.misfit.features import modulations
from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.refit.refit import Refit
from fmu_src.arrays import Floats


def lack_of_fit(space: Workspace, result: Refit) -> dict[str, tuple[float, int, float]]:
    """By name of the test: chi-square, its width and p (Bonferroni over the tests)."""
    records = [space.records[i] for i in space.training]
    streams = [stream_of(r) for r in records]
    blocks: dict[str, list[Floats]] = {}
    for factor, basis in modulations(records).items():
        if factor == "everywhere":
            continue
        columns = []
        for m in range(basis.shape[1]):
            column = np.zeros(space.size)
            for k, i in enumerate(space.training):
                column[space.rows[i]] = basis[k, m] * result.response[space.rows[i]]
            columns.append(column)
        blocks[factor] = columns
    present = [s for s in dict.fromkeys(streams)
               if any(np.any(result.response[space.rows[i]]) for i, t in zip(space.training, streams) if t == s)]
    if len(present) > 1:
        columns = []
        for s in present[:-1]:
            column = np.zeros(space.size)
            for i, t in zip(space.training, streams):
                if t == s:
                    column[space.rows[i]] = result.response[space.rows[i]]
            columns.append(column)
        blocks["signals"] = columns
    # along the axis: early against late, low against high
    halves = [np.zeros(space.size), np.zeros(space.size)]
    for i in space.training:
        n = space.rows[i].stop - space.rows[i].start
        if n > 8:
            x = np.linspace(-1, 1, n)
            halves[0][space.rows[i]] = x * result.response[space.rows[i]]
            halves[1][space.rows[i]] = (x**2 - 1 / 3) * result.response[space.rows[i]]
    blocks["axis"] = halves
    outcome = {}
    factors = excess(space, result.fit)
    settled = result.fit.settled
    for name, columns in blocks.items():
        stacked = np.column_stack(columns)
        projected = project_out(stacked, result.fit.jacobian, result.fit.normal)
        alive = np.sum(projected**2, axis=0) > 1e-4 * np.sum(stacked**2, axis=0) + 1e-12
        if not alive.any():
            continue
        size = np.linalg.norm(stacked[:, alive], axis=0)
        values, vectors = np.linalg.eigh((stacked[:, alive] / size).T @ (projected[:, alive] / size))
        # Below zero only by rounding: what hardly lies outside of the fit's own parameters says nothing.
        keep = values > 1e-6 * max(values.max(), 0.0)
        if not keep.any():
            continue
        root = vectors[:, keep] / np.sqrt(values[keep]) / size[:, None]
        grams = component_grams(space, projected[:, alive] @ root)
        statistic, p = usual_chance(space, root.T @ (stacked[:, alive].T @ settled), grams, factors)
        outcome[name] = (statistic, root.shape[1], p)
    return {k: (s, w, min(1.0, p * len(outcome))) for k, (s, w, p) in outcome.items()}
