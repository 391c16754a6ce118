"""A few of the scenarios of ``python -m benchmarks.equality``: native FMUs give the bits of the unit in process."""

import numpy as np
import pytest

from benchmarks.equality.__main__ import difference
from benchmarks.equality.scenarios import NAMES, scenarios, states
from orchestrator.component import InProcess, unit_of
from orchestrator.opening import open_fmu

# Those of the units that the tests build anyway.
CHOSEN = [s for s in scenarios(8) if s.reducer == "RV20E-121-rigid"]


@pytest.mark.parametrize("scenario", CHOSEN, ids=lambda s: s.name)
def test_native_units_give_the_bits_of_the_unit_in_process(scenario, native_fmus):
    right = states(scenario, InProcess("unit", scenario.specification))
    assert len(np.unique(right[:, : len(right[0]) // 2], axis=0)) == len(right)
    for version in ("fmi2", "fmi3"):
        unit = open_fmu("unit", native_fmus / version / f"{NAMES[scenario.unit]}.fmu")
        found = states(scenario, unit)
        unit.close()
        assert np.array_equal(found, right), difference(scenario, found, right)


def test_a_sum_of_forces_that_cancel_is_judged_by_these_forces():
    """On the housing two discs leave 1e-8 N of 300 N: rounding, which other mathematics makes into another."""
    scenario = next(s for s in scenarios(8) if s.name == "plant driven by torque")
    right = states(scenario, InProcess("unit", scenario.specification))
    nudged = InProcess("unit", scenario.specification)
    nudged.set("eccentricity", np.nextafter(nudged.number("eccentricity"), 1.0))
    found = states(scenario, nudged)
    table = unit_of(scenario.specification).table
    place = table.offset["housing_force_y"]
    force, other = (float(cells[-1, place].view("f8")) for cells in (right, found))
    assert abs(force) < 1e-6 and abs(other - force) > 0.1 * abs(force)
    # The largest that is left: where contacts would be of pins that do not touch, looked for to 1e-5 rad.
    worst, where = difference(scenario, found, right)
    assert worst < 1e-3 and where == "phase_shift"
