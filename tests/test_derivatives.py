"""Directional derivatives of the native units against central differences of steps through the FMU itself."""

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from shared import made_once

from fmu_src.package import build_native
from orchestrator.opening import open_fmu

VERSIONS = ["fmi2", "fmi3"]
# Outputs of plant and of the unit of both that show what loads do, and by what they are derived.
OUTPUTS = ("output.angle", "output.speed", "crank.angle", "output.lag", "output.transmission_error", "input.drive_torque", "housing.reaction_torque", "mesh.contact_pressure",
           "mesh.largest_force", "housing.force_x", "heat.power_loss", "heat.contact_temperature")  # fmt: skip
KNOWNS = ("output.load_torque", "input.speed", "heat.ambient_temperature", "effects.pin_position_errors.ring_runout", "effects.profile_modification.equidistant_added", "effects.stribeck_friction.friction_coefficient", "effects.thermal_expansion.expansion",
          "effects.support_compliance.crank_support_compliance")  # fmt: skip
ON = {"effects.stribeck_friction.friction_coefficient": 0.03, "effects.thermal_expansion.expansion": 2e-6, "effects.pin_position_errors.ring_runout": 3e-6, "effects.support_compliance.crank_support_compliance": 1e-9}


@pytest.fixture(scope="session")
def all_units(rv20e, native_fmus, tmp_path_factory):
    """Native units with the one of both."""
    def make(folder):
        folder.mkdir(exist_ok=True)
        build_native("RvReducer", rv20e.specification("rv_reducer"), 1e-3, "rvwear test", folder)

    both = made_once(tmp_path_factory, "both", make)
    return lambda version, name: (both if name == "RvReducer" else native_fmus) / version / f"{name}.fmu"


def started(path, steps=3, **values):
    unit = open_fmu("unit", path)
    for name, value in values.items():
        unit.set(name, value)
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    for i in range(steps):
        unit.step(i * 1e-3, 1e-3)
    return unit


def reference(unit, element):
    """Value reference as FMI's function wants it: of the element in FMI 2, of the whole variable in FMI 3."""
    return next(v.valueReference for v in unit.description.modelVariables if v.name == element)


def derivative(unit, outputs, known, seed=(1.0,), sizes=None):
    found = unit.slave.getDirectionalDerivative(
        [reference(unit, name) for name in outputs], [reference(unit, known)], list(seed), **({"nSensitivity": sum(sizes)} if sizes else {})
    )
    return np.array(found)


def difference(unit, outputs, known, size):
    """By steps of no consequence: a picosecond."""
    ends = []
    time, value = 3e-3, unit.number(known)
    for sign in (1.0, -1.0):
        kept = unit.snapshot()
        unit.set(known, value + sign * size)
        unit.step(time, 1e-12)
        ends.append(np.concatenate([np.ravel(unit.get(name)) for name in outputs]))
        unit.revert(kept)
        unit.forget(kept)
    return (ends[0] - ends[1]) / (2.0 * size)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("name", ["RvPlant", "RvReducer"])
def test_derivatives_are_those_of_differences(all_units, version, name):
    unit = started(all_units(version, name), **ON)
    present = {v.name for v in unit.description.modelVariables}
    outputs, knowns = [n for n in OUTPUTS if n in present], [n for n in KNOWNS if n in present]
    assert len(outputs) > 8 and len(knowns) > 5
    sizes = {v.name: float(v.nominal or 1.0) for v in unit.description.modelVariables}
    before = unit.save()
    moved = set()
    for known in knowns:
        if unit.number(known) == 0.0:
            continue
        found, expected = derivative(unit, outputs, known), difference(unit, outputs, known, 1e-3 * sizes[known])
        for output, ours, theirs in zip(outputs, found, expected):
            # What the equilibrium's tolerance leaves of a difference.
            noise = 1e-7 * max(abs(unit.number(output)), sizes[output]) / sizes[known]
            assert ours == pytest.approx(theirs, rel=1e-3, abs=noise), (known, output)
            if abs(theirs) > 10.0 * noise:
                moved.add(output)
    assert len(moved) >= 8
    assert unit.save() == before
    unit.close()


@pytest.mark.parametrize("version", VERSIONS)
def test_derivatives_of_contacts_by_profile_errors(native_fmus, version):
    """A pin that lacks a micrometre more is relieved, its neighbours take over; the plant's tangent as a matrix is symmetric in this."""
    unit = started(native_fmus / version / "RvPlant.fmu")
    force = unit.get("mesh.force")
    loaded = [tuple(int(i) for i in k) for k in np.argwhere(force > 0.3 * force.max())[:4]]
    matrix = np.zeros((4, 4))
    for column, (d, j) in enumerate(loaded):
        if version == "fmi2":
            names = [f"mesh.force[{a + 1},{b + 1}]" for a, b in loaded]
            matrix[:, column] = derivative(unit, names, f"mesh.profile_error[{d + 1},{j + 1}]")
        else:
            seed = np.zeros(force.shape)
            seed[d, j] = 1.0
            whole = derivative(unit, ["mesh.force"], "mesh.profile_error", seed.ravel(), [force.size]).reshape(force.shape)
            matrix[:, column] = [whole[k] for k in loaded]
    assert np.all(np.diag(matrix) < -1e7)
    assert matrix == pytest.approx(matrix.T, rel=1e-4, abs=1e-3 * np.abs(matrix).max())
    unit.close()


@pytest.mark.parametrize("version", VERSIONS)
def test_derivatives_of_the_wear_unit_follow_its_surfaces(native_fmus, version):
    unit = open_fmu("wear", native_fmus / version / "RvWear.fmu")
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    unit.set("acceleration", 1e7)
    for i in range(1, 140):
        unit.set("crank.angle", 0.1 * i)
        unit.set("crank.speed", 100.0)
        unit.set("mesh.force", 300.0)
        unit.set("roller.force", 200.0)
        unit.step(1e-3 * i, 1e-3)
    names = ["profile.angle", "mesh.profile_error[1,3]" if version == "fmi2" else "mesh.profile_error", "wear.operating_time"]
    sizes = [1, 1 if version == "fmi2" else 80, 1]
    found = derivative(unit, names, "crank.angle", sizes=None if version == "fmi2" else sizes)
    errors = []
    for turned in (1e-3, -1e-3):
        kept = unit.snapshot()
        unit.set("acceleration", 0.0)
        unit.set("crank.angle", 13.9 + turned)
        unit.step(0.14, 1e-12)
        errors.append(np.ravel(unit.get("mesh.profile_error")))
        unit.revert(kept)
    expected = (errors[0] - errors[1]) / 2e-3
    assert found[0] == pytest.approx(1.0, rel=1e-9) and found[-1] == 0.0
    assert np.abs(expected).max() > 1e-7
    ours = found[1] if version == "fmi2" else found[1:-1]
    assert ours == pytest.approx(expected[2] if version == "fmi2" else expected, rel=1e-6, abs=1e-12)
    assert derivative(unit, names[:1], "acceleration") == pytest.approx([0.0])
    unit.close()


@pytest.mark.parametrize("version", VERSIONS)
def test_at_a_bound_the_derivative_is_taken_on_its_inner_side(native_fmus, version):
    """An amplitude that is off and cannot be negative."""
    unit = started(native_fmus / version / "RvPlant.fmu")
    twice = started(native_fmus / version / "RvPlant.fmu", crank_support_compliance=1e-12)
    outputs = ("output.lag", "input.drive_torque")
    # Off, it makes unknowns of the cranks' shifts: small and off differ little.
    assert derivative(unit, outputs, "effects.support_compliance.crank_support_compliance") == pytest.approx(
        derivative(twice, outputs, "effects.support_compliance.crank_support_compliance"), rel=1e-3)
    unit.close()
    twice.close()


@pytest.mark.parametrize("version", VERSIONS)
def test_in_motion_places_are_held_and_forces_follow(native_fmus, version):
    unit = started(native_fmus / version / "RvPlant.fmu", fidelity=1)
    assert derivative(unit, ["output.angle", "output.lag"], "output.load_torque") == pytest.approx([0.0, 0.0])
    assert derivative(unit, ["mesh.largest_force"], "effects.profile_modification.equidistant_added")[0] < -1e6
    unit.close()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("unknown, known, text", [
    ("output.angle", "pin.radius", "pin.radius cannot be a known: derivatives are by inputs and tunable parameters"),
    ("output.load_torque", "heat.ambient_temperature", "output.load_torque cannot be an unknown: only outputs have directional derivatives"),
    ("numerics.substeps", "output.load_torque", "numerics.substeps is an integer"),
    ("output.angle", "drive", "drive is an integer"),
])  # fmt: skip
def test_refusals(native_fmus, version, unknown, known, text):
    unit = started(native_fmus / version / "RvPlant.fmu", steps=1)
    with pytest.raises(FMICallException):
        derivative(unit, [unknown], known)
    assert text in unit.messages[-1]
    with pytest.raises(FMICallException):
        derivative(unit, ["output.angle"], "output.load_torque", (float("nan"),))
    assert "not a finite number" in unit.messages[-1]
    unit.close()


@pytest.mark.parametrize("version", VERSIONS)
def test_not_before_the_unit_is_initialised(native_fmus, version):
    unit = open_fmu("unit", native_fmus / version / "RvPlant.fmu")
    with pytest.raises(FMICallException):
        derivative(unit, ["output.angle"], "output.load_torque")
    assert "initialisation" in unit.messages[-1]
    unit.close()
