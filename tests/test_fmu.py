"""The FMUs: description, bytes, state, instances, refusals, and the same trajectories as in process."""

import math
import os
import subprocess
import sys
import zipfile
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest
from conftest import UNITS
from shared import problems_of

from fmu_src.description import guid
from fmu_src.faults import InputFault, RunFault
from fmu_src.native import host_triple
from fmu_src.package import build_fmu
from fmu_src.project import project
from fmu_src.source_hash import source_hash
from fmu_src.units import fmi_base_unit
from orchestrator.fmu import Fmu
from rv_plant.effects import EFFECTS as PLANT
from rv_plant.variables import own_variables as plant_variables
from studies.pair import make_pair
from wear_fmu.effects import EFFECTS as WEAR
from wear_fmu.variables import own_variables as wear_variables

NAMES = ["RvPlant", "RvWear"]


@pytest.fixture(params=NAMES)
def path(request, fmus):
    return fmus / f"{request.param}.fmu"


def description(path):
    with zipfile.ZipFile(path) as archive:
        return ElementTree.fromstring(archive.read("modelDescription.xml"))


def test_validation_finds_no_problem(path, monkeypatch):
    assert problems_of(path, monkeypatch) == []


def test_validation_finds_names_that_are_none(path, monkeypatch, tmp_path):
    """However much alike they are to good ones that were looked at before."""
    spoilt = tmp_path / path.name
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(spoilt, "w") as new:
        text = old.read("modelDescription.xml").replace(b"mesh.force[2,7]", b"mesh.force[2,7").replace(b"mesh.force[1,7]", b"mesh.force[1,x7]")
        new.writestr("modelDescription.xml", text)
    for _ in range(2):
        first, second = problems_of(spoilt, monkeypatch)
        assert '"mesh.force[1,x7]"' in first and '"mesh.force[2,7"' in second


def test_description_follows_the_project(path):
    root = description(path)
    assert (root.get("author"), root.get("license")) == (project().author, project().licence)
    assert root.get("version") == f"{project().version}+{source_hash()[:16]}"


def test_every_quantity_has_a_unit_that_is_defined(path):
    root = description(path)
    defined = {unit.get("name") for unit in root.iter("Unit")}
    bare = {"loaded_teeth", "residual", "first_stage_ratio", "poisson_ratio", "exponent_lankarani", "tolerance",
            "mesh_wear_coefficient", "raceway_wear_coefficient", "run_in_ratio", "load_exponent", "slip_ratio_inner",
            "slip_ratio_outer", "acceleration", "restitution", "sun_teeth", "tooth_stiffness_variation",
            "spectral_radius", "dynamic_tolerance", "energy_error", "pin_wear_share", "mesh_friction", "mesh_friction_excess", "roller_friction"}  # fmt: skip
    bare = {v.path for v in (*plant_variables(), *wear_variables()) if v.name in bare}
    bare |= {v.path for effect in (*PLANT.values(), *WEAR.values()) for v in effect.variables() if v.unit == "1"}
    for variable in root.iter("ScalarVariable"):
        real = variable.find("Real")
        if real is not None and variable.get("name").partition("[")[0] not in bare:
            assert real.get("unit") in defined, variable.get("name")


def test_outputs_depend_on_no_input_within_a_communication_point(path):
    structure = description(path).find("ModelStructure")
    outputs = structure.find("Outputs").findall("Unknown")
    declared = [v for v in description(path).iter("ScalarVariable") if v.get("causality") == "output"]
    assert len(outputs) == len(declared)
    assert {unknown.get("dependencies") for unknown in outputs} == {""}


def test_declared_independence_is_true(fmus):
    """Changing every input between two steps changes no output until the next step."""
    for name in NAMES:
        unit = Fmu(name, fmus / f"{name}.fmu")
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
        unit.step(0.0, 1e-3)
        outputs = [s for s, v in unit.signals.items() if v.causality == "output"]
        before = [np.array(unit.get(s)) for s in outputs]
        for s, v in unit.signals.items():
            if v.causality == "input":
                unit.set(s, np.asarray(unit.get(s)) * 1.01 + 1e-7)
        for s, value in zip(outputs, before):
            assert np.array_equal(unit.get(s), value), f"{name}.{s}"
        unit.close()


@pytest.mark.parametrize("unit, exponents", [
    ("N.m", {"kg": 1, "m": 2, "s": -2}), ("1/Pa", {"kg": -1, "m": 1, "s": 2}), ("rad/s", {"rad": 1, "s": -1}),
    ("um", {"m": 1, "factor": 1e-6}), ("1", {}),
])  # fmt: skip
def test_units_decompose_into_fmi_base_units(unit, exponents):
    assert fmi_base_unit(unit) == pytest.approx(exponents)


# The plant's kernels take most of a minute to compile anew; without that its archive is built twice in every run.
@pytest.mark.parametrize("name, compile_anew", [
    ("RvPlant", False), pytest.param("RvPlant", True, marks=pytest.mark.campaign), ("RvWear", True),
])  # fmt: skip
def test_two_builds_are_byte_equal(name, compile_anew, rv20e, codes, fmus, tmp_path):
    code = None if compile_anew else codes[name][host_triple()]
    again = build_fmu(name, rv20e.specification(UNITS[name]), 1e-3, "rvwear test", tmp_path, code)
    assert again.read_bytes() == (fmus / f"{name}.fmu").read_bytes()


def test_guid_tells_reducers_apart(path, rv20e, bx40e):
    unit = {"RvPlant": "rv_plant", "RvWear": "wear_fmu"}[path.stem]
    ours, other = (guid(reducer.specification(unit), source_hash()) for reducer in (rv20e, bx40e))
    assert description(path).get("guid") == ours != other


def run_pair(rv20e, fmus, steps=100, acceleration=1e7):
    pair = make_pair(rv20e, fmus=fmus)
    pair.wear.set("acceleration", acceleration)
    pair.master.run(steps)
    return pair


def test_fmu_pair_and_in_process_pair_give_the_same_trajectories(rv20e, fmus):
    ours, theirs = run_pair(rv20e, None), run_pair(rv20e, fmus)
    for name in ("plant", "wear"):
        a, b = ours.master.components[name], theirs.master.components[name]
        for v in a.table.variables:
            if v.role != "scratch":
                expected = a.record()[v.name][0]
                assert b.record()[v.name][0] == pytest.approx(expected, rel=1e-12, abs=1e-18), f"{name}.{v.name}"
    assert ours.wear.get("flank_depth").max() > 1e-8
    theirs.master.close()


def test_restored_pair_repeats_itself_bit_for_bit(rv20e, fmus):
    pair = run_pair(rv20e, fmus)
    saved = pair.master.save()
    pair.master.run(30)
    after = [pair.wear.record().tobytes(), pair.plant.save()]
    pair.master.restore(saved)
    assert pair.wear.record().tobytes() != after[0]
    pair.master.run(30)
    assert [pair.wear.record().tobytes(), pair.plant.save()] == after
    pair.master.close()


def test_instances_do_not_touch_each_other(rv20e, fmus):
    one, other = run_pair(rv20e, fmus, 10), run_pair(rv20e, fmus, 10)
    before = other.wear.record().tobytes(), other.plant.save()
    one.plant.set("load_torque", 50.0)
    one.master.run(20)
    assert (other.wear.record().tobytes(), other.plant.save()) == before
    other.master.run(5)
    one.master.close()
    other.master.run(5)
    alone = run_pair(rv20e, fmus, 20)
    assert other.wear.record().tobytes() == alone.wear.record().tobytes()
    other.master.close()
    alone.master.close()


def test_reset_gives_a_new_unit(fmus):
    unit = Fmu("plant", fmus / "RvPlant.fmu")
    unit.set("load_torque", 20.0)
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    unit.step(0.0, 1e-3)
    unit.slave.reset()
    assert unit.get("load_torque") == 167.0
    assert unit.get("output_angle") == 0.0
    unit.close()


def test_capabilities_are_declared(path):
    declared = description(path).find("CoSimulation").attrib
    assert declared["canGetAndSetFMUstate"] == declared["canSerializeFMUstate"] == "true"
    assert declared["needsExecutionTool"] == "false"


ALONE = """
import sys
sys.path = [p for p in sys.path if "editable" not in p.lower()]
sys.meta_path = [f for f in sys.meta_path if "editable" not in repr(f).lower()]
import fmpy
for name in ("RvPlant", "RvWear", "RvPlant"):
    assert len(fmpy.simulate_fmu(f"{sys.argv[1]}/{name}.fmu", stop_time=0.005, output_interval=1e-3)) == 6
assert "orchestrator" not in sys.modules
import fmu_src
assert fmu_src.__file__.startswith(__import__("tempfile").gettempdir())
"""


def test_units_run_where_the_project_is_not_installed(fmus, tmp_path):
    """One after the other in one process; fmpy deletes the folder of each when it is done.  A folder of own effects that is set is not theirs."""
    own = tmp_path / "own" / "rv_plant"
    own.mkdir(parents=True)
    (own / "mine.py").write_text("EFFECT = None\n", encoding="utf-8")
    done = subprocess.run([sys.executable, "-I", "-c", ALONE, fmus], cwd=tmp_path, capture_output=True, text=True, env={**os.environ, "RVWEAR_EFFECTS": str(own.parent)})
    assert done.returncode == 0, done.stdout + done.stderr


def test_wrong_type_and_late_parameter_are_refused(fmus):
    unit = Fmu("plant", fmus / "RvPlant.fmu")
    torque, fidelity = unit.signal("load_torque").references[0], unit.signal("fidelity").references[0]
    with pytest.raises(RunFault, match="output.load_torque is a real"):
        unit.attempt(unit.slave.setInteger, [torque], [167])
    with pytest.raises(RunFault, match="fidelity is an integer"):
        unit.attempt(unit.slave.setReal, [fidelity], [1.0])
    with pytest.raises(RunFault, match="before initialisation"):
        unit.step(0.0, 1e-3)
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    with pytest.raises(RunFault, match="pin.radius is fixed"):
        unit.set("pin_radius", 2.1e-3)
    unit.close()


@pytest.mark.parametrize("name, value, said", [
    ("load_torque", math.nan, "output.load_torque = nan N.m is not a finite number"),
    ("mesh_profile_error[1,7]", math.inf, r"mesh.profile_error\[1,7\] = inf m is not a finite number"),
    ("eccentricity", -1e-3, r"eccentricity = -0.001 m is out of range"),
    ("contact_law", 9, "contact.law = 9 is not one of 0 .line."),
    ("lag", 1.0, "lag is an output"),
])  # fmt: skip
def test_bad_value_is_refused_by_name_and_leaves_the_unit_unchanged(fmus, name, value, said):
    unit = Fmu("plant", fmus / "RvPlant.fmu")
    before = unit.save()
    with pytest.raises(RunFault, match=said):
        unit.set(name, value)
    assert unit.save() == before
    unit.close()


def test_impossible_geometry_is_named_at_initialisation(fmus):
    unit = Fmu("plant", fmus / "RvPlant.fmu")
    unit.set("eccentricity", 1.5e-3)
    unit.enter_initialisation(0.0)
    with pytest.raises(InputFault, match="the trochoid has loops.*Reduce crank.eccentricity"):
        unit.exit_initialisation()
    unit.close()


@pytest.mark.parametrize("spoil", [lambda s: s[:-8], lambda s: b"x" * len(s), lambda s: s[:100],
                                   lambda s: s[:32] + b"\xff" * (len(s) - 32)])
def test_foreign_state_is_refused(fmus, spoil):
    unit = Fmu("wear", fmus / "RvWear.fmu")
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    before = unit.save()
    with pytest.raises(RunFault, match="state"):
        unit.restore(spoil(before))
    assert unit.save() == before
    unit.close()


def test_fmu_of_another_reducer_is_refused(bx40e, fmus):
    with pytest.raises(InputFault, match="was built from another reducer file.*rvwear build --reducer BX-40E"):
        make_pair(bx40e, fmus=fmus)


def test_fmpy_simulates_each_unit_alone(path):
    result = fmpy.simulate_fmu(str(path), stop_time=0.01, output_interval=1e-3)
    assert len(result) == 11
    if path.stem == "RvPlant":
        assert 2e-4 < result["output.lag"][-1] < 3e-4


def test_many_instances_one_after_the_other(fmus):
    """pythonfmu drops a reference per instance; thirty would crash an unguarded module."""
    unit = Fmu("wear", fmus / "RvWear.fmu")
    for _ in range(30):
        # Not fmpy's freeInstance, which unloads the library too.
        unit.slave.fmi2FreeInstance(unit.slave.component)
        unit.calls.instantiate()
    unit.close()
