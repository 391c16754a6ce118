"""Other people's tools import both units, co-simulate the pair, and get what our master gets.

All of them exchange values at the beginning of the step (Jacobi), as our master does when it runs the package.
"""

import importlib.util
import json
import os
import subprocess
import sys
import zipfile
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave
from lxml import etree

from orchestrator.fmu import Fmu
from orchestrator.master import Master
from orchestrator.model_description import Described
from orchestrator.system import load
from studies.building import export_pair
from studies.pair import CONNECTIONS

STEP, STEPS = 1.3e-3, 100
WATCHED = ["plant.output.angle", "plant.output.lag", "plant.mesh.largest_force", "plant.mesh.force[1,7]", "plant.mesh.force[2,30]",
           "plant.roller.force[1,2,3]", "wear.mesh.profile_error[1,7]", "wear.mesh.profile_error[2,30]"]  # fmt: skip
SCRIPTS = Path(__file__).parent / "strangers"
# Other tools add up time, ours multiplies: the plant sees angles that differ in the last digits.
SAME = {"rel": 1e-8, "abs": 1e-15}


@pytest.fixture(scope="module", params=["python", "fmi2", "fmi3"])
def folder(request, rv20e, fmus):
    """Both units of one flavour and the package of them."""
    folder = fmus if request.param == "python" else request.getfixturevalue("native_fmus") / request.param
    export_pair(rv20e, folder, STEP)
    return folder


@cache
def ours(folder):
    system = load(folder / "RvReducer.ssp", step=STEP)
    system.run(STEP * STEPS)
    values = {path: system[path] for path in WATCHED}
    system.close()
    return values


def stranger(script, *arguments, needs, scratch):
    """What another tool finds; whatever it unpacks goes to ``scratch``, for they do not tidy up."""
    if importlib.util.find_spec(needs) is None:
        pytest.skip(f"{needs} is not installed: pip install \"rvwear[strangers]\"")
    command = [sys.executable, SCRIPTS / script, *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=os.environ | {"TMPDIR": str(scratch)})
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout.splitlines()[-1])["values"]


def unpacked(folder, target):
    with zipfile.ZipFile(folder / "RvReducer.ssp") as archive:
        archive.extractall(target)
    return target


def test_ecos_runs_the_package(folder, tmp_path):
    if folder.name == "fmi3":
        pytest.skip("ecos 0.7.2 knows no arrays: see the test of scalars")
    theirs = stranger("ecos.py", folder / "RvReducer.ssp", STEP, STEPS, *WATCHED, needs="ecospy", scratch=tmp_path)
    assert theirs == pytest.approx(ours(folder), **SAME)


def test_ecos_couples_fmi3_units_by_their_scalars(folder, tmp_path):
    if folder.name != "fmi3":
        pytest.skip("FMI 2.0 units are coupled as a package")
    watched = WATCHED[:3]
    theirs = stranger("ecos_scalars.py", folder, STEP, STEPS, *watched, needs="ecospy", scratch=tmp_path)
    units = {"plant": Fmu("plant", folder / "RvPlant.fmu"), "wear": Fmu("wear", folder / "RvWear.fmu")}
    scalars = [(a, b) for a, b in CONNECTIONS if not units[a.partition(".")[0]].signal(a.partition(".")[2]).shape]
    master = Master(units, scalars, STEP, scheme="jacobi")
    master.initialise()
    master.run(STEPS)
    assert theirs == pytest.approx({w: units[w.partition(".")[0]].get(w.partition(".")[2]) for w in watched}, **SAME)
    master.close()


def test_libcosim_runs_the_package(folder, tmp_path):
    if folder.name == "fmi3":
        pytest.skip("libcosim knows FMI 1.0 and 2.0 only")
    theirs = stranger("libcosim.py", unpacked(folder, tmp_path), STEP, STEPS, *WATCHED, needs="libcosimpy", scratch=tmp_path)
    assert theirs == pytest.approx(ours(folder), **SAME)


class Fmpy:
    """A unit through fmpy's own calls with lists."""

    def __init__(self, path, starts, scratch):
        description = read_model_description(str(path))
        self.three = description.fmiVersion == "3.0"
        self.described = Described(description)
        self.signals = self.described.signals()
        kind = FMU3Slave if self.three else FMU2Slave
        self.slave = kind(
            instanceName=path.stem, guid=description.instantiationToken if self.three else description.guid,
            unzipDirectory=extract(str(path), scratch / path.stem), modelIdentifier=description.coSimulation.modelIdentifier,
        )  # fmt: skip
        self.slave.instantiate()
        for name, value in starts.items():
            self.set(name, [value])
        if not self.three:
            self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()

    def references(self, name):
        if self.three:
            return [v.valueReference for v in self.described.variables if v.name == name]
        return list(self.signals[name].references)

    def get(self, name):
        if self.three:
            return self.slave.getFloat64(self.references(name), nValues=len(self.described.references[name]))
        return self.slave.getReal(self.references(name))

    def set(self, name, values):
        (self.slave.setFloat64 if self.three else self.slave.setReal)(self.references(name), values)


def test_fmpy_couples_the_units(folder, tmp_path):
    units = {"plant": Fmpy(folder / "RvPlant.fmu", {}, tmp_path), "wear": Fmpy(folder / "RvWear.fmu", {}, tmp_path)}

    def exchange():
        moved = [(b, units[a.split(".", 1)[0]].get(a.split(".", 1)[1])) for a, b in CONNECTIONS]
        for target, values in moved:
            units[target.split(".", 1)[0]].set(target.split(".", 1)[1], values)

    for unit in units.values():
        unit.slave.exitInitializationMode()
    for i in range(STEPS):
        exchange()
        for unit in units.values():
            unit.slave.doStep(i * STEP, STEP)
    forces = np.array(units["plant"].get("mesh.force")).reshape(2, 40)
    expected = ours(folder)
    assert forces[0, 6] == pytest.approx(expected["plant.mesh.force[1,7]"], **SAME)
    assert forces[1, 29] == pytest.approx(expected["plant.mesh.force[2,30]"], **SAME)
    assert units["plant"].get("output.lag")[0] == pytest.approx(expected["plant.output.lag"], **SAME)
    for unit in units.values():
        unit.slave.terminate()
        unit.slave.freeInstance()


def test_fmpy_reads_the_package(folder):
    if folder.name == "fmi3":
        pytest.skip("fmpy 0.3.32 reads SSP 1.0, which has no arrays")
    ssd = pytest.importorskip("fmpy.ssp.ssd")
    system = ssd.read_ssd(str(folder / "RvReducer.ssp")).system
    assert [element.name for element in system.elements] == ["plant", "wear"]
    pairs = ssd.get_connections(system)
    assert len(pairs) == 7 + 3 * 80 + 3 * 64


@pytest.mark.parametrize("file, schema", [
    ("SystemStructure.ssd", "SystemStructureDescription.xsd"), ("resources/plant.ssv", "SystemStructureParameterValues.xsd"),
    ("resources/wear.ssv", "SystemStructureParameterValues.xsd"),
])  # fmt: skip
def test_package_follows_the_standard(folder, tmp_path, file, schema):
    import fmpy

    if folder.name == "fmi3":
        pytest.skip("fmpy has the schemas of SSP 1.0: python -m benchmarks.importers takes those of 2.0")
    known = etree.XMLSchema(etree.parse(str(Path(fmpy.__file__).parent / "ssp" / "schema" / schema)))
    known.assertValid(etree.parse(str(unpacked(folder, tmp_path) / file)))


def test_same_system_gives_the_same_bytes(folder, rv20e):
    first = (folder / "RvReducer.ssp").read_bytes()
    assert export_pair(rv20e, folder, STEP).read_bytes() == first
