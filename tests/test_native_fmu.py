"""Native FMUs of both FMI versions: valid, the same trajectories as in process, refusals, states."""

import ctypes
import math
import zipfile

import fmpy
import numpy as np
import pytest
from conftest import UNITS
from fmpy.fmi3 import fmi3Float64, fmi3ValueReference
from shared import problems_of

from fmu_src.faults import InputFault, RunFault
from fmu_src.project import project
from orchestrator.component import InProcess
from orchestrator.opening import open_fmu
from studies.pair import make_pair

VERSIONS = ["fmi2", "fmi3"]


@pytest.fixture(params=[(v, n) for v in VERSIONS for n in UNITS], ids="-".join)
def path(request, native_fmus):
    return native_fmus / request.param[0] / f"{request.param[1]}.fmu"


@pytest.fixture(params=VERSIONS)
def folder(request, native_fmus):
    return native_fmus / request.param


@pytest.fixture
def plant(folder):
    unit = open_fmu("plant", folder / "RvPlant.fmu")
    yield unit
    unit.close()


def initialised(unit):
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    return unit


def run_pair(rv20e, fmus, steps=100):
    pair = make_pair(rv20e, fmus=fmus)
    pair.wear.set("acceleration", 1e7)
    pair.master.run(steps)
    return pair


def test_validation_finds_no_problem(path, monkeypatch):
    assert problems_of(path, monkeypatch) == []


def test_archive_holds_what_a_person_looks_for(path):
    with zipfile.ZipFile(path) as archive:
        names = set(archive.namelist())
        page = archive.read("documentation/index.html").decode()
    icon = "model.png" if path.parent.name == "fmi2" else "terminalsAndIcons/icon.png"
    assert {icon, "documentation/diagram.png", "documentation/licenses/license.txt"} <= names
    assert "temperature" in page and "<svg" in page


def test_description_and_licence_text_follow_the_project(path):
    description = fmpy.read_model_description(str(path))
    with zipfile.ZipFile(path) as archive:
        text = archive.read("documentation/licenses/license.txt").decode()
    assert (description.author, description.license) == (project().author, project().licence)
    assert description.version.startswith(f"{project().version}+")
    assert project().terms() in text and "FMI standard" in text


def test_every_variable_has_bounds_and_reals_a_nominal_value(path):
    for v in fmpy.read_model_description(str(path)).modelVariables:
        if v.causality != "independent":
            assert float(v.min) <= float(v.max), v.name
            assert v.nominal is None if v.type in ("Integer", "Int64", "Enumeration") else float(v.nominal) > 0.0, v.name
            if v.start is not None and v.dimensions == []:
                assert float(v.min) <= float(v.start) <= float(v.max), v.name


@pytest.mark.parametrize("version", VERSIONS)
def test_native_pair_is_bit_equal_to_the_pair_in_process(rv20e, native_fmus, version):
    ours, theirs = run_pair(rv20e, None), run_pair(rv20e, native_fmus / version)
    for name in ("plant", "wear"):
        a, b = ours.master.components[name], theirs.master.components[name]
        for v in a.table.variables:
            if v.role != "scratch":
                assert np.array_equal(a.record()[v.name], b.record()[v.name]), f"{name}.{v.name}"
    assert ours.wear.get("flank_depth").max() > 1e-8
    theirs.master.close()


def test_motion_is_bit_equal(rv20e, plant):
    inside = InProcess("plant", rv20e.specification("rv_plant"))
    for unit in (inside, plant):
        unit.set("fidelity", 1)
        initialised(unit)
        for n in range(5):
            unit.step(n * 1e-4, 1e-4)
    assert inside.get("transmission_error") == plant.get("transmission_error") != 0.0


def test_fmpy_simulates_each_unit_alone(path):
    result = fmpy.simulate_fmu(str(path), stop_time=0.01, output_interval=1e-3)
    assert len(result) == 11
    if path.stem == "RvPlant":
        assert 2e-4 < result["output.lag"][-1] < 3e-4


def test_surfaces_are_local_arrays_in_fmi_3(rv20e, native_fmus):
    pair = run_pair(rv20e, native_fmus / "fmi3")
    wear = pair.wear.record()
    for name in ("disc_wear", "pin_wear", "inner_race_wear"):
        assert np.array_equal(np.ravel(pair.wear.get(name)), wear[name][0].ravel()), name
    assert pair.wear.get("surface.disc_wear").shape == (2, 39, 180)
    assert pair.wear.get("disc_wear").max() > 0.0
    with pytest.raises(RunFault, match=r"surface.disc_wear\[1,1,1\] is an output of RvWear"):
        pair.wear.set("disc_wear", 0.0)
    pair.master.close()


def test_outputs_during_initialisation_fit_the_values_set(plant):
    """Importers read them to start coupled units; the later initialisation must not notice."""
    plant.enter_initialisation(0.0)
    plant.set("load_torque", 100.0)
    early = plant.get("lag")
    plant.set("load_torque", 167.0)
    plant.exit_initialisation()
    usual = plant.get("lag")
    assert 0.0 < early < usual
    plant.slave.reset()
    initialised(plant)
    assert plant.get("lag") == usual


# state


def test_restored_pair_repeats_itself_bit_for_bit(rv20e, folder):
    pair = run_pair(rv20e, folder)
    saved = pair.master.save()
    pair.master.run(30)
    after = [pair.wear.save(), pair.plant.save()]
    pair.master.restore(saved)
    pair.master.run(30)
    assert [pair.wear.save(), pair.plant.save()] == after
    pair.master.close()


def test_state_goes_from_any_flavour_to_any_other(fmus, native_fmus):
    units = [initialised(open_fmu("wear", f / "RvWear.fmu")) for f in (fmus, native_fmus / "fmi2", native_fmus / "fmi3")]
    for source in units:
        source.set("crank_angle", source.get("crank_angle") + 0.1)
        source.set("mesh_force", 300.0)
        source.step(0.0, 1e-3)
        for target in units:
            target.restore(source.save())
            assert target.get("operating_time") == source.get("operating_time")
            assert target.record().tobytes() == source.record().tobytes()
    for unit in units:
        unit.close()


@pytest.mark.parametrize("spoil, said", [
    (lambda s: s[:-8], "cut off"), (lambda s: s + s[:8], "cut off or added to"), (lambda s: s[:60], "not a state"),
    (lambda s: b"x" * len(s), "not a state"), (lambda s: s[:40] + bytes([s[40] ^ 1]) + s[41:], "same build"),
    (lambda s: s[:300] + bytes([s[300] ^ 64]) + s[301:], "checksum"), (lambda s: b"", "not a state"),
])  # fmt: skip
def test_foreign_state_is_refused(plant, spoil, said):
    initialised(plant)
    before = plant.save()
    with pytest.raises(RunFault, match=said):
        plant.restore(spoil(before))
    assert plant.save() == before


def test_state_of_another_instance_or_freed_is_refused(native_fmus):
    one, other = (initialised(open_fmu(n, native_fmus / "fmi2" / "RvPlant.fmu")) for n in ("one", "other"))
    state = one.slave.getFMUstate()
    with pytest.raises(RunFault, match="no state of this instance"):
        other.attempt(other.slave.setFMUstate, state)
    kept = ctypes.c_void_p(state.value)
    one.slave.freeFMUstate(state)
    with pytest.raises(RunFault, match="or it was freed"):
        one.attempt(one.slave.setFMUstate, kept)
    one.close()
    other.close()


# refusals


@pytest.mark.parametrize("name, value", [
    ("load_torque", math.nan), ("mesh_profile_error[1,7]", math.inf), ("eccentricity", -1e-3), ("contact_law", 9),
    ("load_torque", -1e300), ("max_newton", 1), ("lag", 1.0),
])  # fmt: skip
def test_bad_value_is_refused_in_the_words_of_the_table(rv20e, plant, name, value):
    inside = InProcess("plant", rv20e.specification("rv_plant"))
    with pytest.raises(InputFault) as expected:
        inside.set(name, value)
    before = plant.save()
    with pytest.raises(RunFault) as refused:
        plant.set(name, value)
    words = str(expected.value).removeprefix("plant: ")
    if name == "mesh_profile_error[1,7]" or not name.startswith("mesh"):
        assert words in str(refused.value)
    assert plant.save() == before


@pytest.mark.parametrize("duration", [0.0, -1e-3, math.nan, math.inf, 1e300, 3601.0])
def test_impossible_step_is_refused_and_changes_nothing(plant, duration):
    initialised(plant)
    before = plant.save()
    with pytest.raises(RunFault, match=r"at time 0 s: communication step of .* give a positive one of at most 3600 s"):
        plant.step(0.0, duration)
    assert plant.save() == before
    plant.step(0.0, 1e-3)


def test_failed_step_changes_nothing_and_says_what_the_kernel_says(rv20e, plant):
    inside = initialised(InProcess("plant", rv20e.specification("rv_plant")))
    initialised(plant)
    before = plant.save()
    faults = []
    for unit in (inside, plant):
        unit.set("mesh_profile_error", -1e-3)
        with pytest.raises(RunFault) as fault:
            unit.step(0.0, 1e-3)
        faults.append(str(fault.value).partition("RvPlant")[2].replace(" at time", ": at time").replace(":: ", ": "))
    assert faults[0] in faults[1] and "no equilibrium" in faults[1]
    plant.set("mesh_profile_error", 0.0)
    assert plant.save() == before
    plant.step(0.0, 1e-3)


def test_impossible_geometry_is_named_at_initialisation(plant):
    plant.set("eccentricity", 1.5e-3)
    plant.enter_initialisation(0.0)
    with pytest.raises(InputFault, match="the trochoid has loops: crank.eccentricity 0.0015 m.*Reduce crank.eccentricity"):
        plant.exit_initialisation()
    plant.set("eccentricity", 0.9e-3)
    plant.exit_initialisation()


def test_illegal_order_of_calls_is_refused(plant):
    with pytest.raises(RunFault, match="DoStep is not allowed before initialisation; enter and exit"):
        plant.step(0.0, 1e-3)
    with pytest.raises(InputFault, match="ExitInitializationMode is not allowed before initialisation"):
        plant.exit_initialisation()
    plant.enter_initialisation(0.0)
    with pytest.raises(RunFault, match="not allowed in initialisation mode"):
        plant.enter_initialisation(0.0)
    plant.exit_initialisation()
    with pytest.raises(RunFault, match="pin.radius is fixed once the unit is initialised; reset"):
        plant.set("pin_radius", 2.1e-3)
    plant.slave.terminate()
    with pytest.raises(RunFault, match="not allowed after termination"):
        plant.step(0.0, 1e-3)
    plant.slave.reset()
    initialised(plant).step(0.0, 1e-3)


def test_wrong_type_and_unknown_reference_are_refused(native_fmus):
    plant = open_fmu("plant", native_fmus / "fmi2" / "RvPlant.fmu")
    torque, fidelity = plant.signal("load_torque").references[0], plant.signal("fidelity").references[0]
    with pytest.raises(RunFault, match="load_torque is a real"):
        plant.attempt(plant.slave.setInteger, [torque], [167])
    with pytest.raises(RunFault, match="fidelity is an integer or enumeration"):
        plant.attempt(plant.slave.setReal, [fidelity], [1.0])
    with pytest.raises(RunFault, match="no variable with value reference 999999"):
        plant.attempt(plant.slave.getReal, [999999])
    with pytest.raises(RunFault, match="no Boolean variables"):
        plant.attempt(plant.slave.getBoolean, [0])
    plant.close()


def test_array_of_the_wrong_size_is_refused(native_fmus):
    plant = open_fmu("plant", native_fmus / "fmi3" / "RvPlant.fmu")
    reference = next(v.valueReference for v in plant.description.modelVariables if v.name == "mesh.profile_error")
    with pytest.raises(RunFault, match="have 80 values, 3 were given"):
        plant.attempt(plant.slave.fmi3SetFloat64, plant.slave.component, (fmi3ValueReference * 1)(reference), 1,
                      (fmi3Float64 * 3)(), 3)
    plant.close()


def test_message_goes_to_its_category_or_nowhere(native_fmus):
    plant = open_fmu("plant", native_fmus / "fmi2" / "RvPlant.fmu")
    one = (ctypes.c_char_p * 1)(b"logStatusDiscard")
    plant.slave.fmi2SetDebugLogging(plant.slave.component, 1, 1, one)
    with pytest.raises(RunFault, match="it logged nothing"):
        plant.step(0.0, 1e-3)
    with pytest.raises(RunFault, match="it logged nothing"):
        plant.attempt(plant.slave.fmi2SetDebugLogging, plant.slave.component, 1, 1, (ctypes.c_char_p * 1)(b"none"))
    plant.slave.fmi2SetDebugLogging(plant.slave.component, 1, 0, one)
    with pytest.raises(RunFault, match="before initialisation"):
        plant.step(0.0, 1e-3)
    plant.close()


def test_library_of_another_build_is_refused(native_fmus, tmp_path):
    changed = tmp_path / "RvPlant.fmu"
    with zipfile.ZipFile(native_fmus / "fmi2" / "RvPlant.fmu") as old, zipfile.ZipFile(changed, "w") as new:
        for name in old.namelist():
            data = old.read(name)
            new.writestr(name, data.replace(b'guid="{', b'guid="{0') if name == "modelDescription.xml" else data)
    with pytest.raises(RunFault, match="library and modelDescription.xml are of two builds"):
        open_fmu("plant", changed)
