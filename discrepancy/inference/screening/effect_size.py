"""d': the size of an effect in noise units after the nuisances are projected out."""

from collections.abc import Callable, Mapping

import numpy as np

from discrepancy.inference.base_fit.projection import project_out
from discrepancy.inference.base_fit.workspace import Workspace
from fmu_src.arrays import Floats


def effect_size(space: Workspace, difference: Mapping[int, Floats]) -> float:
    """d' of a change of the records' values (by training record), on a workspace whose base is fitted."""
    column = space.whiten({i: np.asarray(d, dtype=float) for i, d in difference.items() if i in space.rows})
    square = float(column @ project_out(column[:, None], space.base.jacobian, space.base.normal)[:, 0])
    return float(np.sqrt(max(square, 0.0)))


def amplitude_for(space: Workspace, response: Callable[[float], Mapping[int, Floats]], target: float, start: float, rounds: int = 12) -> float:
    """Amplitude at which ``response(amplitude) -> {record: change}`` has d' = ``target``."""
    amplitude = start
    for _ in range(rounds):
        size = effect_size(space, response(amplitude))
        if size <= 0:
            amplitude *= 4
            continue
        ratio = target / size
        if abs(ratio - 1) < 0.01:
            break
        amplitude *= float(np.clip(ratio, 0.2, 5.0))
    return amplitude
