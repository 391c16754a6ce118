"""A few of the scenarios of ``python -m benchmarks.equality``: native FMUs give the bits of the unit in process."""

import numpy as np
import pytest

from benchmarks.equality.__main__ import difference
from benchmarks.equality.scenarios import NAMES, scenarios, states
from orchestrator.component import InProcess
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
