"""Packages of SSP 2: units with arrays, connected as whole."""

import zipfile

import fmpy
import pytest
from lxml import etree

from fmu_src.faults import InputFault
from orchestrator.model_description import Described
from orchestrator.ssp.notes import NAMESPACES
from orchestrator.system import load
from studies.building import export_pair

SPACE = {"ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription", "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
         "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues", "oms": NAMESPACES["oms"], "mc": NAMESPACES["mc"]}

@pytest.fixture
def pair3(rv20e, native_fmus, tmp_path):
    """The package of the FMI 3 units, unpacked, and its description's text."""
    with zipfile.ZipFile(export_pair(rv20e, native_fmus / "fmi3", 1e-3)) as archive:
        archive.extractall(tmp_path)
    return tmp_path, (tmp_path / "SystemStructure.ssd").read_text(encoding="utf-8")


def test_units_with_arrays_make_a_package_of_ssp_2(pair3, native_fmus):
    folder, text = pair3
    root = etree.fromstring(text.encode())
    assert root.get("version") == "2.0" and 'version="2.0"' in (folder / "resources" / "plant.ssv").read_text(encoding="utf-8")
    units = {name: Described(fmpy.read_model_description(str(native_fmus / "fmi3" / f"Rv{name.title()}.fmu"))).signals() for name in ("plant", "wear")}
    arrays = 0
    for component in root.iterfind(".//ssd:Component", SPACE):
        for connector in component.iterfind("ssd:Connectors/ssd:Connector", SPACE):
            shape = tuple(int(d.get("size")) for d in connector.iterfind("ssc:Dimension", SPACE))
            signal = units[component.get("name")][connector.get("name")]
            assert shape == signal.shape and etree.QName(connector[0]).localname == ("Int64" if signal.is_integer else "Float64")
            arrays += bool(shape)
    assert arrays > 10


@pytest.mark.parametrize("before, after, said", [
    ('<ssc:Dimension size="40" />', '<ssc:Dimension size="41" />', "has the dimensions 2 x 41, its FMU's variable 2 x 40; write the FMU's"),
    ('<ssc:Dimension size="40" />', '<ssc:Dimension size="forty" />', "Dimension size = '2', 'forty': a whole number is needed"),
    ('version="2.0"', 'version="3.0"', "SSP version '3.0' is not known; versions 1 and 2 are"),
    ('startConnector="crank.angle"', 'startConnector="crank.angle" startIndices="1"', "startIndices = '1' is not supported; connect whole arrays"),
])
def test_wrong_package_of_ssp_2_is_told(pair3, before, after, said):
    folder, text = pair3
    assert before in text
    (folder / "SystemStructure.ssd").write_text(text.replace(before, after, 1), encoding="utf-8")
    with pytest.raises(InputFault, match=said):
        load(folder)
