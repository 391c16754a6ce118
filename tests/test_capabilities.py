"""docs/capabilities.md says what the units declare, and every test that it names exists."""

import ctypes
import re
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import pytest
from shared import made_once

from fmu_src.package import build_native
from orchestrator.opening import open_fmu

ROOT = Path(__file__).resolve().parents[1]
UNITS = ("RvPlant", "RvWear", "RvReducer")
ROWS = [
    [cell.strip() for cell in line.strip("| \n").split(" | ")]
    for line in (ROOT / "docs" / "capabilities.md").read_text(encoding="utf-8").splitlines() if line.startswith("| ")
][1:]  # fmt: skip


@pytest.fixture(scope="session")
def built(rv20e, native_fmus, tmp_path_factory):
    """Attributes of the element CoSimulation by (version, unit)."""
    def make(folder):
        folder.mkdir(exist_ok=True)
        build_native("RvReducer", rv20e.specification("rv_reducer"), 1e-3, "rvwear test", folder)

    both = made_once(tmp_path_factory, "both", make)
    found = {}
    for version in ("fmi2", "fmi3"):
        for name in UNITS:
            with zipfile.ZipFile((both if name == "RvReducer" else native_fmus) / version / f"{name}.fmu") as archive:
                root = ElementTree.fromstring(archive.read("modelDescription.xml"))
            found[version, name] = root.find("CoSimulation").attrib
    return found


@pytest.mark.parametrize("version, column", [("fmi2", 0), ("fmi3", 1)])
@pytest.mark.parametrize("place, name", list(enumerate(UNITS)))
def test_the_page_says_what_is_declared(built, version, column, place, name):
    said = {row[column]: row[2 + place] == "yes" for row in ROWS if row[column] != "-"}
    declared = {flag: value == "true" for flag, value in built[version, name].items() if value in ("true", "false")}
    assert set(declared) <= set(said)
    assert {flag for flag, yes in said.items() if yes} == {flag for flag, yes in declared.items() if yes}


def test_every_capability_names_a_test_that_there_is():
    for row in ROWS:
        named = re.findall(r"`(test_\w+\.py)::(test_\w+)`", row[-1])
        assert named, row[0]
        for file, function in named:
            assert re.search(rf"^def {function}\(", (ROOT / "tests" / file).read_text(encoding="utf-8"), re.MULTILINE), (file, function)


def test_input_derivatives_are_refused(native_fmus):
    unit = open_fmu("plant", native_fmus / "fmi2" / "RvPlant.fmu")
    function = unit.slave.dll["fmi2SetRealInputDerivatives"]
    references, orders, values = (ctypes.c_uint * 1)(0), (ctypes.c_int * 1)(1), (ctypes.c_double * 1)(1.0)
    assert function(ctypes.c_void_p(unit.slave.component), references, ctypes.c_size_t(1), orders, values) == 3
    assert "the unit has no input derivatives" in unit.messages[-1]
    unit.close()
