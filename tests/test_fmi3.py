"""FMI 3.0: arrays by element and as a whole, state, and the Modelica Association's reference units if they are at hand.

Set RVWEAR_REFERENCE_FMUS to a folder with BouncingBall.fmu, Feedthrough.fmu and StateSpace.fmu of FMI 3.0.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from fmu_src.faults import RunFault
from orchestrator.fmu import Fmu
from studies.pair import make_pair


@pytest.fixture
def plant(native_fmus):
    unit = Fmu("plant", native_fmus / "fmi3" / "RvPlant.fmu")
    yield unit
    unit.close()


def test_arrays_are_arrays_and_elements_keep_their_neighbours(plant):
    errors = np.linspace(1e-6, 2e-6, 40)
    plant.set("pin_radius_error", errors)
    plant.set("pin_radius_error[7]", 5e-6)
    expected = errors.copy()
    expected[6] = 5e-6
    assert np.array_equal(plant.get("pin_radius_error"), expected)
    assert plant.get("pin_radius_error[7]") == 5e-6


def test_elements_of_several_variables_move_in_one_transfer(plant):
    names = ["pin_radius_error[3]", "load_torque", "pin_radius_error[1]"]
    references = tuple(r for name in names for r in plant.signal(name).references)
    buffer = np.array([3e-6, 150.0, 1e-6])
    plant.writer(references, buffer)()
    back = np.zeros(3)
    plant.reader(references, back)()
    assert np.array_equal(back, buffer)
    assert plant.get("pin_radius_error[2]") == 0.0


def test_state_comes_back(plant):
    plant.enter_initialisation(0.0)
    plant.exit_initialisation()
    snapshot, saved = plant.snapshot(), plant.save()
    plant.step(0.0, 1e-3)
    first = plant.get("mesh_force")
    for back in (lambda: plant.revert(snapshot), lambda: plant.restore(saved)):
        back()
        plant.step(0.0, 1e-3)
        assert np.array_equal(plant.get("mesh_force"), first)
    plant.forget(snapshot)
    with pytest.raises(RunFault, match="fmi3DoStep failed"):
        plant.step(1e-3, float("nan"))


@pytest.mark.parametrize("scheme", ["gauss-seidel", "jacobi"])
def test_fmi3_pair_is_the_pair_in_process(rv20e, native_fmus, scheme):
    ours, theirs = make_pair(rv20e, scheme=scheme), make_pair(rv20e, fmus=native_fmus / "fmi3", scheme=scheme)
    for pair in (ours, theirs):
        pair.master.run(50)
    assert theirs.plant.get("mesh_force") == pytest.approx(ours.plant.get("mesh_force"), rel=1e-9, abs=1e-9)
    theirs.master.close()


def reference(name):
    path = Path(os.environ.get("RVWEAR_REFERENCE_FMUS", "nowhere"), f"{name}.fmu")
    if not path.is_file():
        pytest.skip("set RVWEAR_REFERENCE_FMUS to a folder with the FMI 3.0 reference units")
    return Fmu(name, path)


def test_reference_feedthrough_passes_every_type_and_declares_it():
    unit = reference("Feedthrough")
    given = {"Float32_continuous": 0.5, "Float64_continuous": 3.5, "Int8": -3, "UInt64": 9, "Int64": -(2**40),
             "Boolean": True, "Enumeration": 2}  # fmt: skip
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    through = unit.feedthrough()
    for name, value in given.items():
        unit.set(f"{name}_input", value)
        assert unit.get(f"{name}_output") == value
        (output,) = unit.signal(f"{name}_output").elements
        assert through[output] == tuple(unit.signal(f"{name}_input").elements)
    unit.close()


def test_reference_state_space_has_shapes_from_structural_parameters():
    unit = reference("StateSpace")
    assert unit.signal("B").shape == (3, 3) and unit.signal("u").shape == (3,)
    unit.set("B[1,2]", 5.0)
    assert np.array_equal(unit.get("B"), np.eye(3) + np.array([[0, 5, 0], [0, 0, 0], [0, 0, 0]]))
    unit.close()


def test_reference_ball_falls():
    unit = reference("BouncingBall")
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    unit.step(0.0, 0.1)
    assert unit.get("h") == pytest.approx(1.0 - 0.5 * 9.81 * 0.01, abs=5e-3)
    unit.close()
