"""The kernels as plain Python: same functions, no compiler, same numbers."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from stand import crank_period, pair_of, steps_together
from test_effects_order import everything

from fmu_src.kernel import Kernel
from reducers.reducer import load_reducer
from rv_plant import plant
from rv_plant.effects import EFFECTS as PLANT
from wear_fmu.effects import EFFECTS as WEAR

STEPS, HOURS_PER_STEP = 2, 2.0
# Of a communication step: a crank turn's fortieth, in motion 20 us.
IN_MOTION = 2e-5
# What each case asks of the kernels beyond the ideal reducer.
CASES = {
    "ideal": {},
    "every effect": {**everything(PLANT), **everything(WEAR), "pins": 1},
    "in motion": {"fidelity": 1, "damping_law": 2, "housing_compliance": 1e-7, "crank_support_compliance": 7e-9},
    "output pins": {"reducer": "cycloidal-actuator", "output_play": 1e-5},
    "other laws": {"contact_law": 1, "mesh_wear_law": 0, "raceway_wear_law": 3, "sliding_form": 1, "first_stage_ratio": 0.0},
    "compliant with errors": {
        "crank_support_compliance": 7e-9, "main_bearing_compliance": 3e-9, "first_stage_compliance": 1e-8,
        "housing_compliance": 1e-7, "lobe_profile_error": 2e-6, "pin_radius_error": 1e-6, "angle_modification": 1e-5,
        "pins": 1, "load_torque": -100.0,
    },
}


def trajectory(case):
    """State cells of both units after each of some coupled steps."""
    values = {"reducer": "RV20E-121", **CASES[case]}
    reducer = load_reducer(values.pop("reducer"))
    tables = reducer.plant, reducer.wear
    machine, surface = pair_of(reducer, **values)
    rows = []
    assert plant.initialise(machine) == 0
    step = IN_MOTION if "fidelity" in values else crank_period(machine) / 40
    surface["acceleration"] = HOURS_PER_STEP * 3600 / step
    for _ in steps_together(machine, surface, step, STEPS):
        rows.append([{v.name: np.array(r[v.name][0]) for v in t.of_role("output", "state")}
                     for t, r in zip(tables, (machine, surface))])
    return rows


def values_of(case):
    return {f"{i}/{u}/{n}": v for i, row in enumerate(trajectory(case)) for u, unit in enumerate(row) for n, v in unit.items()}


def write_all(folder):
    for i, case in enumerate(CASES):
        np.savez(Path(folder) / f"{i}.npz", **values_of(case))


@pytest.fixture(scope="module")
def plain(tmp_path_factory):
    """Folder with the trajectories of all cases, by a process without the compiler."""
    folder, root = tmp_path_factory.mktemp("plain"), Path(__file__).resolve().parents[1]
    program = f"import test_plain_python as t; t.assert_plain(); t.write_all({str(folder)!r})"
    search = os.pathsep.join([str(root), str(root / "tests")])
    subprocess.run([sys.executable, "-c", program], check=True, timeout=240,
                   env={**os.environ, "RVWEAR_PLAIN_PYTHON": "1", "PYTHONPATH": search})
    return folder


@pytest.mark.parametrize("case", CASES)
def test_plain_python_gives_the_compiled_trajectory(plain, case):
    found, expected = np.load(plain / f"{list(CASES).index(case)}.npz"), values_of(case)
    assert set(found) == set(expected) and len(found) > 100
    for name in expected:
        if expected[name].dtype.kind == "i":
            assert (found[name] == expected[name]).all(), name
            continue
        scale = np.abs(expected[name]).max()
        assert np.abs(found[name] - expected[name]).max() <= 1e-12 * scale, name


def test_a_unit_in_process_runs_as_plain_python():
    """As commands have it: the records that it makes have fields as attributes."""
    program = (
        "from orchestrator.component import InProcess\nfrom reducers.reducer import load_reducer\n"
        "plant = InProcess('plant', load_reducer('RV20E-121-rigid').specification('rv_plant'))\n"
        "plant.enter_initialisation(0.0); plant.exit_initialisation(); print(repr(plant.get('lag')))\n"
    )
    said = [float(subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True,
                                 env=os.environ | {"RVWEAR_PLAIN_PYTHON": flag}).stdout) for flag in ("1", "")]
    assert said[0] == pytest.approx(said[1], rel=1e-12)


def assert_plain():
    assert not isinstance(plant.step, Kernel), "the compiler is not switched off"
