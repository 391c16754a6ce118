"""Random legal parameters, a few of the many that ``python -m benchmarks.random_sets`` tries: in balance, or refused with a true fault."""

import numpy as np
import pytest

from benchmarks.random_sets.balance import Bodies
from benchmarks.random_sets.run import REDUCERS, Sets, Tally
from orchestrator.component import InProcess
from reducers.reducer import load_reducer


@pytest.fixture(scope="module")
def all_sets():
    return [Sets(name, None) for name in REDUCERS]


# The first ones, those that were refused although there is an equilibrium (bodies that float in play as the motion starts, no load), and one that fits nowhere.
@pytest.mark.parametrize("number", [*range(9), 57, 96, 105, 238, 477])
def test_set_is_in_balance_or_refused_with_cause(all_sets, number):
    tally = Tally()
    all_sets[number % len(all_sets)].run(number, tally)
    assert not tally.findings and tally.units == 1


def test_balance_sees_a_force_that_is_off_by_a_millionth(rv20e):
    unit = InProcess("reducer", rv20e.specification("rv_reducer"))
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    record = unit.records["plant"][0]
    assert max(Bodies(record).left_over().values()) < 1e-8
    record["mesh_force_now"] *= 1.0 + 1e-6
    assert max(Bodies(record).left_over().values()) > 1e-7


def test_raceways_of_the_plastic_drive_lose_less_than_a_micrometre_in_a_turn():
    unit = InProcess("reducer", load_reducer("cycloidal-actuator").specification("rv_reducer"))
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    step = 2.0 * np.pi / unit.number("input_speed") / 72
    for n in range(72):
        unit.step(n * step, step)
    assert all(0.0 < np.max(unit.get(name)) < 1e-6 for name in ("inner_race_depth", "outer_race_depth", "flank_depth"))
