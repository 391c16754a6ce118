"""Sobol' points of an ensemble and what they mean.

SALib's design: of each base sample the rows A, AB_1 ... AB_k, B, where AB_i is A with the columns of
parameter i from B.  All columns of an array (the errors of forty pins) change together: one parameter.
Rows A and B are independent, and distributions are taken from them; all rows give the sensitivities.
"""

import math
from typing import Any

import numpy as np
from SALib.sample import sobol
from scipy import stats

from fmu_src.arrays import Floats, Integers
from studies.ensemble.ensemble_file import Ensemble, Scatter
from studies.ensemble.member import Cells, Task


def problem(ensemble: Ensemble) -> dict[str, Any]:
    """The design in SALib's words, on the unit cube."""
    names: list[str] = []
    groups: list[str] = []
    for scatter in ensemble.scatters:
        size = math.prod(scatter.shape)
        names += [f"{scatter.name}[{i}]" for i in range(size)]
        groups += size * [scatter.name]
    return {"num_vars": len(names), "names": names, "groups": groups, "bounds": [[0.0, 1.0]] * len(names)}


def points(ensemble: Ensemble) -> Floats:
    """Rows of the unit cube, the same for the same seed."""
    rows: Floats = sobol.sample(problem(ensemble), ensemble.samples, calc_second_order=False, seed=ensemble.seed)
    return rows


def values_of(ensemble: Ensemble, row: Floats) -> dict[str, Cells]:
    """The parameters of one life, arrays as nested lists."""
    found: dict[str, Cells] = {}
    place = 0
    for scatter in ensemble.scatters:
        size = math.prod(scatter.shape)
        # Sobol' points may lie on the cube's edge, where a normal has no value.
        cells = quantile(scatter, np.clip(row[place : place + size], 1e-9, 1.0 - 1e-9)).reshape(scatter.shape)
        found[scatter.name] = cells.tolist()
        place += size
    return found


def tasks_of(ensemble: Ensemble) -> list[Task]:
    """The lives of an ensemble, one for each point."""
    return [
        Task(number, ensemble.reducer, ensemble.settings, ensemble.duty, ensemble.hours, ensemble.tolerance, values_of(ensemble, row))
        for number, row in enumerate(points(ensemble))
    ]


def quantile(scatter: Scatter, share: Floats) -> Floats:
    numbers = scatter.numbers
    if scatter.distribution == "normal":
        return np.asarray(stats.norm.ppf(share, *numbers))
    if scatter.distribution == "uniform":
        return numbers[0] + share * (numbers[1] - numbers[0])
    if scatter.distribution == "triangular":
        low, mode, high = numbers
        return np.asarray(stats.triang.ppf(share, (mode - low) / (high - low), low, high - low))
    median, factor = numbers
    return np.asarray(median * factor ** stats.norm.ppf(share))


def independent_rows(ensemble: Ensemble) -> Integers:
    """Indices of the rows A and B."""
    block = len(ensemble.scatters) + 2
    starts = block * np.arange(ensemble.samples)
    return np.sort(np.concatenate([starts, starts + block - 1]))
