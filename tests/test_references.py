"""What FMUs carry (FMI-LS-REF): experiments that they meet, values, worn states that they take, in every flavour; what is wrong is told."""

import shutil
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lxml import etree

from cli.main import main
from fmu_src.description import guid
from fmu_src.faults import InputFault
from fmu_src.package import build_native, validate
from fmu_src.references import FOLDER, MANIFEST, Experiment, experiments
from fmu_src.source_hash import source_hash
from orchestrator.component import InProcess
from orchestrator.experiments import experiments_in, judged
from orchestrator.fmu import Fmu
from studies import reference_material
from studies.reference_material import add_references
from studies.worn import worn_reducer

STEP = 1.3e-3
UNITS = {"RvPlant": "rv_plant", "RvWear": "wear_fmu"}
SPACE = {"ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues"}


@pytest.fixture(scope="module")
def carrying(rv20e, fmus, native_fmus, tmp_path_factory):
    """FMUs of both units that carry their references, one worn state each: path by (name, flavour)."""
    folder, hours = tmp_path_factory.mktemp("carrying"), reference_material.WORN_HOURS
    reference_material.WORN_HOURS = (5000.0,)
    made = {}
    for name, unit in UNITS.items():
        for flavour, source in (("python", fmus), ("fmi2", native_fmus / "fmi2"), ("fmi3", native_fmus / "fmi3")):
            (folder / flavour).mkdir(exist_ok=True)
            made[name, flavour] = Path(shutil.copy(source / f"{name}.fmu", folder / flavour))
        paths = [path for (named, _), path in made.items() if named == name]
        add_references(paths, rv20e, unit, STEP)
        for path in paths:
            validate(path)
    reference_material.WORN_HOURS = hours
    return made


@pytest.fixture(params=["python", "fmi2", "fmi3"])
def flavour(request):
    return request.param


@pytest.mark.parametrize("name", UNITS)
def test_unit_meets_its_own_experiments(carrying, name, flavour, capsys):
    assert main(["check", str(carrying[name, flavour])]) == 0
    said = capsys.readouterr().out
    assert "variables agree with the FMU's experiments smoke-test, validation" in said
    assert int(said.split()[0]) == int(said.split()[2]) > 10


@pytest.mark.parametrize("name, parameter", [("RvPlant", "mesh_stiffness"), ("RvWear", "mesh_wear_coefficient")])
def test_another_unit_does_not_meet_them(carrying, rv20e, name, parameter):
    """A part in a thousand of a stiffness or of a coefficient, and the experiments fail."""
    fmu = Fmu("unit", carrying[name, "fmi3"])
    (validation,) = (e for e in experiments_in(fmu.folder) if e.name == "validation")
    fmu.close()
    component = InProcess("unit", rv20e.specification(UNITS[name]))
    component.set(parameter, 1.001 * component.get(parameter))
    assert not all(c.passed for c in judged(component, validation, []))


@pytest.mark.parametrize("name", UNITS)
def test_files_follow_their_drafts(carrying, name, flavour):
    with zipfile.ZipFile(carrying[name, flavour]) as archive:
        files = {n: archive.read(n) for n in archive.namelist()}
    root = etree.fromstring(files[MANIFEST])
    space = "{http://fmi-standard.org/fmi-ls-manifest}"
    assert root.tag == "fmiReferences" and root.get(f"{space}fmi-ls-name") == "org.fmi-standard.fmi-ls-ref"
    assert root.get(f"{space}fmi-ls-version") == "1.0.0-beta.1"
    roles = {}
    for related in root:
        roles[related.get("role")] = related
        assert (Path(FOLDER) / related.get("source")).as_posix().replace(f"{FOLDER}/../../", "") in files
    wanted = {"experiment/smoke-test", "experiment/validation", "parameter", "rationale", "document"}
    assert set(roles) == wanted | ({"serialized-state"} if name == "RvWear" else set())
    for kind in ("smoke-test", "validation"):
        text = etree.fromstring(files[f"{FOLDER}/{kind}.exp"])
        assert text.tag == "Experiments" and [child.tag for child in text[0]][:1] == ["TransientSimulation"]
    assert b"Archard" in files["documentation/effects.html"] or b"<h2>" in files["documentation/effects.html"]
    assert b"fmi-ls-ref.html" in files["documentation/index.html"]


def test_arrays_are_set_whole_in_fmi_3(carrying):
    for flavour, count in (("fmi2", 1 + 80 + 64), ("fmi3", 3)):
        with zipfile.ZipFile(carrying["RvWear", flavour]) as archive:
            root = etree.fromstring(archive.read(f"{FOLDER}/validation-values.ssv"))
        found = root.findall("ssv:Parameters/ssv:Parameter", SPACE)
        assert len(found) == count
    assert [len(p[0].get("value").split()) for p in found] == [1, 80, 64]


def test_worn_state_goes_into_the_new_unit(carrying, rv20e, flavour):
    path = carrying["RvWear", flavour]
    with zipfile.ZipFile(path) as archive:
        state = archive.read(f"{FOLDER}/worn-5000h.state")
    fmu = Fmu("wear", path)
    fmu.enter_initialisation(0.0)
    fmu.exit_initialisation()
    assert not np.any(fmu.get("flank_depth"))
    fmu.restore(state)
    inside = InProcess("wear", worn_reducer(rv20e, 5000.0).specification("wear_fmu"))
    inside.exit_initialisation()
    assert fmu.get("flank_depth").max() == pytest.approx(4.03e-6, rel=0.01)
    for n in range(3):
        for unit in (fmu, inside):
            unit.set("crank_angle", 0.05 * (n + 1))
            unit.set("mesh_force", 100.0)
            unit.step(n * STEP, STEP)
    for name in ("flank_depth", "mesh_profile_error", "operating_time"):
        assert np.array_equal(fmu.get(name), inside.get(name))
    fmu.close()


def test_a_worn_unit_carries_no_other_states(rv20e, codes, tmp_path):
    worn = worn_reducer(rv20e, 5000.0)
    (path,) = build_native("RvWear", worn.specification("wear_fmu"), STEP, "rvwear test", tmp_path, ("3",), codes=codes["RvWear"])
    add_references([path], worn, "wear_fmu", STEP)
    with zipfile.ZipFile(path) as archive:
        assert not [name for name in archive.namelist() if name.endswith(".state")]
    assert main(["check", str(path)]) == 0
    assert guid(worn.specification("wear_fmu"), source_hash()) != guid(rv20e.specification("wear_fmu"), source_hash())


@pytest.fixture
def unpacked(carrying, tmp_path):
    with zipfile.ZipFile(carrying["RvPlant", "fmi3"]) as archive:
        archive.extractall(tmp_path)
    return tmp_path


@pytest.mark.parametrize("file, before, after, said", [
    ("fmi-ls-manifest.xml", "experiment/", "other", "the FMU carries no experiments .*give --reference"),
    ("fmi-ls-manifest.xml", 'source="smoke-test.exp"', 'source="../../../outside.exp"', "source '../../../outside.exp' is not a file within the FMU"),
    ("fmi-ls-manifest.xml", 'source="smoke-test.exp"', 'source="other.exp"', "no file other.exp"),
    ("smoke-test.exp", 'stepSize="0.0013"', 'stepSize="-1"', r"stepSize = -1 s: a start at 0, a positive step and an end after it are needed"),
    ("smoke-test.exp", "<References", "<Other", "'smoke-test' has no References"),
    ("smoke-test.exp", 'startTime="0"', 'startTime="soon"', "startTime = 'soon' is not a number"),
    ("smoke-test-results.csv", "time,", "hour,", "no column 'time'"),
])
def test_experiment_that_cannot_be_read_is_told(unpacked, file, before, after, said):
    place = unpacked / FOLDER / file
    text = place.read_text(encoding="utf-8")
    assert before in text
    place.write_text(text.replace(before, after), encoding="utf-8")
    with pytest.raises(InputFault, match=said):
        experiments_in(unpacked)


@pytest.mark.parametrize("change, said", [
    (lambda e: replace(e, references={"time": np.zeros(1), "lagg": np.zeros(1)}), "experiment 'smoke-test' names 'lagg', which plant does not have; did you mean output.lag"),
    (lambda e: replace(e, stimuli={"time": np.array([0.0, 0.01]), "load_torque": np.zeros(2)}), "its stimuli end at 0.01 s, the run at 0.0936 s"),
    (lambda e: replace(e, stimuli=e.stimuli | {"temperature": np.full(73, 1000.0)}), "temperature = 1000 K is out of range"),
    (lambda e: replace(e, stimuli=e.stimuli | {"torque_of_load": np.zeros(73)}), "names 'torque_of_load', which plant does not have"),
])
def test_experiment_that_cannot_be_done_is_told(unpacked, rv20e, change, said):
    smoke = next(e for e in experiments_in(unpacked) if e.name == "smoke-test")
    with pytest.raises(InputFault, match=said):
        judged(InProcess("plant", rv20e.specification("rv_plant")), change(smoke), [])


@pytest.mark.parametrize("arguments, said", [
    (("{fmu}", "--step", "1e-3"), "--step without --reference: an experiment that the FMU carries says itself how it is done"),
    (("system.ssp",), "system.ssp: only an FMU carries experiments; give --reference"),
])
def test_options_that_would_be_ignored_are_told(carrying, arguments, said, capsys):
    assert main(["check", *(a.format(fmu=carrying["RvPlant", "fmi3"]) for a in arguments)]) == 2
    assert said in capsys.readouterr().err


def test_fmu_without_experiments_is_told(spring, capsys):
    assert main(["check", str(spring)]) == 2
    assert "the FMU carries no experiments" in capsys.readouterr().err


def test_experiments_are_written_as_the_schema_has_them():
    root = etree.fromstring(experiments("set", [Experiment("a", "what", 2.0, 0.5, 1e-6, "r.csv", "s.csv", "v.ssv")]))
    (experiment,) = root
    assert [child.tag for child in experiment] == ["TransientSimulation", "Parameters", "Stimuli", "References"]
    assert dict(experiment[0].attrib) == {"startTime": "0", "stopTime": "2.0", "stepSize": "0.5"} and experiment.get("tolerance") == "1e-06"
