"""Compiles what predictions of a reducer call, so that no later command waits for it: ``python -m discrepancy.prediction.compiled_ahead RV20E-121``.

Code is made for numbers of discs, pins and rollers: other reducers of the same numbers have it, too.
"""

import sys

import numpy as np

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.lives import ROUGH_CYCLE
from discrepancy.prediction.units import Condition
from reducers.reducer import Reducer, load_reducer
from studies.meshing_cycle import HOUR


def compile_ahead(reducer: Reducer) -> None:
    """The shortest run of each kind."""
    bench = Bench(reducer, {})
    condition = Condition(bench.rated_speed, bench.rated_load)
    angles, torques = np.array([0.0, 0.001]), np.array([0.5, 1.0]) * bench.rated_load
    bench.error_beside(condition, {}, angles, {}, angles)
    bench.held_beside(condition, {}, torques, {})
    bench.worn(condition, {}, HOUR, ROUGH_CYCLE)


if __name__ == "__main__":
    compile_ahead(load_reducer(sys.argv[1]))
