"""Loops of the base model are means over positions of the cranks: near enough to that from very many, with what is left known."""

import numpy as np
import pytest

from discrepancy.prediction.bench import HELD_ANGLES, SHORT_CYCLE, Bench
from discrepancy.prediction.conditions import at_rest
from discrepancy.prediction.units import Condition
from reducers.reducer import load_reducer

ARCSEC = np.radians(1.0) / 3600.0


@pytest.mark.parametrize("reducer", ["RV20E-121", "RV20E-121-rigid"])
def test_mean_over_positions_errs_by_no_more_than_its_halves_differ(reducer):
    bench = Bench(load_reducer(reducer), {})
    condition = at_rest(bench, Condition(speed=bench.rated_speed, load=bench.rated_load))
    # Through the play, where positions differ most.
    torques = np.concatenate([np.linspace(0.3, -0.3, 25), np.linspace(-0.29, 0.31, 25)]) * bench.rated_load
    found = bench.held(condition, {}, torques)
    true = bench.held_mean(condition, {}, torques, 5 * HELD_ANGLES, SHORT_CYCLE)
    off = np.abs((found - found.mean()) - (true - true.mean())).max()
    assert off < 0.05 * ARCSEC
    assert off <= np.abs(bench.held_halves(condition, torques)).max()
