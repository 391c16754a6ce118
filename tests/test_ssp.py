"""SSP packages: read as others write them, flattened, with units, transformations, bindings and mappings."""

import shutil
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from lxml import etree

from fmu_src.faults import InputFault
from orchestrator.ssp.exporter import Experiment, export_ssp
from orchestrator.ssp.importer import read_ssp
from orchestrator.ssp.notes import NAMESPACES
from orchestrator.system import connect, load
from studies.building import export_pair

NAMES = """xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
 xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon"
 xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues"
 xmlns:ssm="http://ssp-standard.org/SSP1/SystemStructureParameterMapping" """

# Two springs, one in a subsystem; b.u = -2 (x in mm, as m) + 0.1 on a way of three hops.
NESTED = f"""<?xml version="1.0"?>
<ssd:SystemStructureDescription {NAMES} version="1.0" name="nested">
 <ssd:System name="root">
  <ssd:ParameterBindings>
   <ssd:ParameterBinding>
    <ssd:ParameterValues><ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>
     <ssv:Parameter name="a.x"><ssv:Real value="1.0"/></ssv:Parameter>
     <ssv:Parameter name="inner.b.c"><ssv:Real value="0.25"/></ssv:Parameter>
     <ssv:Parameter name="inner.b.note"><ssv:String value="hello"/></ssv:Parameter>
     <ssv:Parameter name="inner.b.loud"><ssv:Boolean value="false"/></ssv:Parameter>
    </ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues>
   </ssd:ParameterBinding>
   <ssd:ParameterBinding prefix="inner." source="extra.ssv">
    <ssd:ParameterMapping><ssm:ParameterMapping version="1.0">
     <ssm:MappingEntry source="inner.stiffness" target="inner.k"><ssc:LinearTransformation factor="3" offset="1"/></ssm:MappingEntry>
    </ssm:ParameterMapping></ssd:ParameterMapping>
   </ssd:ParameterBinding>
  </ssd:ParameterBindings>
  <ssd:Elements>
   <ssd:Component name="a" type="application/x-fmu-sharedlibrary" source="resources/Spring.fmu">
    <ssd:Connectors>
     <ssd:Connector name="x" kind="output"><ssc:Real unit="mm"/></ssd:Connector>
     <ssd:Connector name="u" kind="input"><ssc:Real/></ssd:Connector>
    </ssd:Connectors>
   </ssd:Component>
   <ssd:System name="inner">
    <ssd:Connectors>
     <ssd:Connector name="in" kind="input"><ssc:Real/></ssd:Connector>
     <ssd:Connector name="out" kind="output"><ssc:Real/></ssd:Connector>
     <ssd:Connector name="k" kind="parameter"><ssc:Real/></ssd:Connector>
    </ssd:Connectors>
    <ssd:Elements>
     <ssd:Component name="b" source="resources/Spring.fmu">
      <ssd:Connectors>
       <ssd:Connector name="u" kind="input"><ssc:Real unit="m"/></ssd:Connector>
       <ssd:Connector name="x" kind="output"><ssc:Real/></ssd:Connector>
      </ssd:Connectors>
     </ssd:Component>
    </ssd:Elements>
    <ssd:Connections>
     <ssd:Connection startConnector="in" endElement="b" endConnector="u"><ssc:LinearTransformation factor="-1"/></ssd:Connection>
     <ssd:Connection startElement="b" startConnector="x" endConnector="out"/>
     <ssd:Connection startConnector="k" endElement="b" endConnector="k"/>
    </ssd:Connections>
   </ssd:System>
  </ssd:Elements>
  <ssd:Connections>
   <ssd:Connection startElement="a" startConnector="x" endElement="inner" endConnector="in">
    <ssc:LinearTransformation factor="2" offset="-0.1"/>
   </ssd:Connection>
   <ssd:Connection startElement="inner" startConnector="out" endElement="a" endConnector="u"/>
  </ssd:Connections>
 </ssd:System>
 <ssd:Units>
  <ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit>
  <ssc:Unit name="mm"><ssc:BaseUnit m="1" factor="0.001"/></ssc:Unit>
 </ssd:Units>
 <ssd:DefaultExperiment startTime="1" stopTime="3">
  <ssd:Annotations><ssc:Annotation type="org.openmodelica">
   <oms:FixedStepMaster xmlns:oms="https://openmodelica.org" stepSize="0.05"/>
  </ssc:Annotation></ssd:Annotations>
 </ssd:DefaultExperiment>
</ssd:SystemStructureDescription>
"""
EXTRA = """<ssv:ParameterSet version="1.0" name="extra"><ssv:Parameters>
 <ssv:Parameter name="stiffness"><ssv:Real value="2"/></ssv:Parameter>
 <ssv:Parameter name="unused"><ssv:Real value="7"/></ssv:Parameter>
</ssv:Parameters></ssv:ParameterSet>
"""


def package(folder, spring, text=NESTED, extra=EXTRA):
    (folder / "resources").mkdir(exist_ok=True)
    shutil.copy(spring, folder / "resources")
    (folder / "SystemStructure.ssd").write_text(text, encoding="utf-8")
    (folder / "extra.ssv").write_text(extra, encoding="utf-8")
    target = folder / "nested.ssp"
    with zipfile.ZipFile(target, "w") as archive:
        for name in ("SystemStructure.ssd", "extra.ssv", "resources/Spring.fmu"):
            archive.write(folder / name, name)
    return target


def test_nested_system_is_flattened_with_everything_applied(tmp_path, spring):
    system = load(package(tmp_path, spring))
    master = system.master
    assert (system.name, master.start_time, master.step_size, system.steps) == ("nested", 1.0, 0.05, 40)
    assert list(master.components) == ["a", "inner.b"]
    assert system["a.x"] == 1.0 and system["inner.b.c"] == 0.25
    # 3 * 2 + 1, through the mapping and the subsystem's connector; "unused" is not mapped.
    assert system["inner.b.k"] == 7.0
    system.initialise()
    assert system["inner.b.u"] == pytest.approx(-(2.0 * 1e-3 * system["a.x"] - 0.1))
    system.run()
    assert master.time == pytest.approx(3.0)
    system.close()


@pytest.mark.parametrize("form", ["package", "folder", "file"])
def test_package_folder_and_file_are_the_same(tmp_path, spring, form):
    target = package(tmp_path, spring)
    path = {"package": target, "folder": tmp_path, "file": tmp_path / "SystemStructure.ssd"}[form]
    structure = read_ssp(path)
    assert [str(c) for c in structure.connections] == ["connection a.x -> inner.b.u", "connection inner.b.x -> a.u"]
    assert (structure.connections[0].factor, structure.connections[0].offset) == pytest.approx((-2e-3, 0.1))


def test_package_within_a_package(tmp_path, spring):
    inner = tmp_path / "inner"
    inner.mkdir()
    target = package(inner, spring)
    text = f"""<ssd:SystemStructureDescription {NAMES} name="outer" version="1.0"><ssd:System name="s"><ssd:Elements>
    <ssd:Component name="part" source="inner/{target.name}" type="application/x-ssp-package"/>
    </ssd:Elements></ssd:System></ssd:SystemStructureDescription>"""
    (tmp_path / "SystemStructure.ssd").write_text(text, encoding="utf-8")
    system = load(tmp_path, step=0.1)
    assert list(system.master.components) == ["part.a", "part.inner.b"]
    assert system["part.inner.b.k"] == 7.0
    system.close()


@pytest.mark.parametrize("before, after, said", [
    ("resources/Spring.fmu", "resources/Sprung.fmu", "no FMU at"),
    ("resources/Spring.fmu", "http://there/Spring.fmu", "not a file of the package"),
    ('endElement="a" endConnector="u"', 'endElement="a" endConnector="w"', "no variable 'w'"),
    ('endElement="a" endConnector="u"', 'endElement="inner" endConnector="in"', "driven already"),
    ('name="a.x"><ssv:Real value="1.0"', 'name="a.x"><ssv:Real value="one"', "'one'"),
    ("extra.ssv", "more.ssv", "no file more.ssv"),
    ('factor="2"', 'factor="two"', "factor = 'two' is not a number"),
    ('<ssc:LinearTransformation factor="-1"/>', "<ssc:BooleanMappingTransformation/>", "not supported"),
    ("</ssd:SystemStructureDescription>", "", "not readable as XML"),
])  # fmt: skip
def test_bad_package_is_told_what_is_wrong(tmp_path, spring, before, after, said):
    assert before in NESTED
    with pytest.raises(InputFault, match=said):
        load(package(tmp_path, spring, NESTED.replace(before, after)))


def test_values_that_fit_nothing_are_told_and_left_out(tmp_path, spring):
    text = NESTED.replace('name="a.x"', 'name="z.x"').replace('name="inner.b.c"', 'name="inner.b.d"')
    system = load(package(tmp_path, spring, text))
    assert any("z.x" in warning and "inner.b.d" in warning for warning in system.master.warnings)
    system.close()


def test_direction_follows_the_connectors_and_not_the_order_of_writing(tmp_path, spring):
    before = 'startElement="inner" startConnector="out" endElement="a" endConnector="u"'
    after = 'startElement="a" startConnector="u" endElement="inner" endConnector="out"'
    assert before in NESTED
    structure = read_ssp(package(tmp_path, spring, NESTED.replace(before, after)))
    assert "connection inner.b.x -> a.u" in map(str, structure.connections)


def test_no_package_is_told(tmp_path):
    (tmp_path / "text.ssp").write_text("no zip")
    with pytest.raises(InputFault, match="no zip archive"):
        load(tmp_path / "text.ssp")
    with pytest.raises(InputFault, match="no SSP at"):
        load(tmp_path / "none.ssp")


def test_exported_system_comes_back_the_same(tmp_path, spring):
    links = [("a.x", "b.u"), ("b.x", "a.u")]
    path = export_ssp(
        tmp_path / "ring.ssp", "ring", {"a": spring, "b": spring}, links, Experiment(0.1, 2.0),
        {"a": {"k": 2.0}},
    )  # fmt: skip
    back, direct = load(path), connect({"a": spring, "b": spring}, links, 0.1, scheme="jacobi")
    direct["a.k"] = 2.0
    for system in (back, direct):
        system["a.x"] = 1.0
    one, other = back.run(record=["b.v"]), direct.run(2.0, record=["b.v"])
    assert np.array_equal(one["b.v"], other["b.v"]) and one["b.v"].any()
    back.close()
    direct.close()


def test_undeclared_dependencies_are_a_loop_that_costs_two_looks(tmp_path, spring):
    """pythonfmu declares nothing, so every output may depend on every input; here none does."""
    system = connect({"a": spring, "b": spring}, [("a.x", "b.u"), ("b.x", "a.u")], 0.1, scheme="jacobi")
    system["a.x"] = 1.0
    assert len(system.master.loops) == 1
    system.run(1.0)
    assert system.master.loops[0].evaluations <= 2
    system.close()


def description(path):
    with zipfile.ZipFile(path) as archive:
        return etree.fromstring(archive.read("SystemStructure.ssd")), archive.namelist()


SPACE = {"ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription", "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
         "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues", "oms": NAMESPACES["oms"], "mc": NAMESPACES["mc"]}  # fmt: skip


def test_values_may_stand_in_the_description(tmp_path, spring):
    links = [("a.x", "b.u"), ("b.x", "a.u")]
    path = export_ssp(tmp_path / "ring.ssp", "ring", {"a": spring, "b": spring}, links, Experiment(0.1, 2.0), {"a": {"k": 2.0}}, inline=True)
    root, names = description(path)
    assert not any(name.endswith(".ssv") for name in names)
    known = etree.XMLSchema(etree.parse(str(Path(fmpy.__file__).parent / "ssp" / "schema" / "SystemStructureDescription.xsd")))
    known.assertValid(root)
    assert root.xpath("//ssd:Component[@name='a']//ssv:Parameter[@name='k']/ssv:Real/@value", namespaces=SPACE) == ["2.0"]
    system = load(path)
    assert (system["a.k"], system["b.k"]) == (2.0, 1.0)
    system.close()


@pytest.mark.parametrize("scheme, order", [("jacobi", "parallel_single_thread"), ("gauss-seidel", "sequential")])
def test_step_is_where_each_tool_looks_for_it(tmp_path, spring, scheme, order):
    root, _ = description(export_ssp(tmp_path / "x.ssp", "x", {"a": spring}, [], Experiment(0.125, 1.0, scheme=scheme), {}))
    # OMSimulator takes the first annotation of the system.
    first = root.find("ssd:System/ssd:Annotations/ssc:Annotation", SPACE)
    assert first.get("type") == "org.openmodelica"
    master = first.find("oms:Annotations/oms:SimulationInformation/oms:FixedStepMaster", SPACE)
    assert (master.prefix, master.get("description"), master.get("stepSize")) == ("oms", "oms-ma", "0.125")
    task = root.find("ssd:DefaultExperiment/ssd:Annotations/ssc:Annotation[@type='com.avl.model.connect.ssp.task']/mc:Task", SPACE)
    assert (task.get("stepType"), task.get("deltaTime"), task.get("endType")) == (order, "0.125", "end_time")


def test_connectors_have_their_place_on_the_picture(tmp_path, spring):
    links = [("a.x", "b.u"), ("b.x", "a.u")]
    root, _ = description(export_ssp(tmp_path / "ring.ssp", "ring", {"a": spring, "b": spring}, links, Experiment(0.1, 2.0), {}))
    places = {}
    for component in root.iterfind(".//ssd:Component", SPACE):
        for connector in component.iterfind("ssd:Connectors/ssd:Connector", SPACE):
            geometry = connector.find("ssd:ConnectorGeometry", SPACE)
            x, y = float(geometry.get("x")), float(geometry.get("y"))
            edge = {"input": x == 0.0, "output": x == 1.0, "parameter": y == 0.0}
            assert edge[connector.get("kind")] and 0.0 <= x <= 1.0 and 0.0 <= y <= 1.0
            places[component.get("name"), connector.get("name")] = x, y
    assert len(set(places.values())) == len(places) / 2
    forward, back = root.iterfind("ssd:System/ssd:Connections/ssd:Connection", SPACE)
    assert forward.find("ssd:ConnectionGeometry", SPACE) is None
    way = back.find("ssd:ConnectionGeometry", SPACE)
    x, y = ([float(t) for t in way.get(f"points{axis}").split()] for axis in "XY")
    # Out to the right of both, below them, in from the left.
    assert x[0] == x[1] > 160.0 and x[2] == x[3] < 0.0 and y[1] == y[2] < 0.0
    # OMSimulator refuses it.
    assert root.find("ssd:System/ssd:SystemGeometry", SPACE) is None


@pytest.mark.parametrize("version, inline", [("fmi2", False), ("fmi2", True), ("fmi3", False)])
def test_values_that_seem_to_name_their_unit_again_are_bound_at_the_system_too(native_fmus, tmp_path, version, inline):
    """OMSimulator reads wear.pin_share of the unit wear as its pin_share, which is not there; libcosim and ecos do not look at the system, nor does OpenMCx."""
    fmus = {name: native_fmus / version / f"Rv{name.title()}.fmu" for name in ("plant", "wear")}
    settings = {"wear": {"wear.pin_share": 0.25, "acceleration": 2.0}}
    path = export_ssp(tmp_path / "x.ssp", "x", fmus, [("plant.output.angle", "wear.output.angle")], Experiment(1e-3, 1.0), settings, inline=inline)
    with zipfile.ZipFile(path) as archive:
        root = etree.fromstring(archive.read("SystemStructure.ssd"))
        places = {place: root.find(f".//ssd:{place}/ssd:ParameterBindings", SPACE) for place in ("System", "Component[@name='wear']")}
        found = {}
        for place, element in places.items():
            for binding in () if element is None else element:
                values = binding if inline else etree.fromstring(archive.read(binding.get("source")))
                found[place] = values.xpath(".//ssv:Parameter/@name", namespaces=SPACE)
    of_unit = found.pop("Component[@name='wear']")
    assert len(of_unit) > 20 and "wear.pin_share" in of_unit and ("wear.inner_slip_ratio" in of_unit) == inline
    assert found == ({} if inline else {"System": [f"wear.{name}" for name in of_unit]})
    system = load(path)
    assert float(system["wear.wear.pin_share"]) == 0.25 and float(system["wear.acceleration"]) == 2.0
    system.close()


def test_the_pairs_package_has_no_value_that_seems_to_name_its_unit_again(rv20e, native_fmus, tmp_path):
    with zipfile.ZipFile(export_pair(rv20e, native_fmus / "fmi2", 1e-3)) as archive:
        names = etree.fromstring(archive.read("resources/wear.ssv")).xpath("//ssv:Parameter/@name", namespaces=SPACE)
        assert not [name for name in archive.namelist() if name.endswith("SystemStructure.ssv")]
    assert len(names) > 20 and not [name for name in names if name.startswith("wear.")]


def test_a_unit_is_not_named_as_the_description(tmp_path, spring):
    with pytest.raises(InputFault, match="a unit cannot be named SystemStructure"):
        export_ssp(tmp_path / "x.ssp", "x", {"SystemStructure": spring}, [], Experiment(0.1, 1.0), {})


def test_values_for_a_unit_that_is_not_there_are_refused(tmp_path, spring):
    with pytest.raises(InputFault, match="values for c, which is no unit of the system: it has a"):
        export_ssp(tmp_path / "x.ssp", "x", {"a": spring}, [], Experiment(0.1, 1.0), {"c": {"k": 1.0}})


@pytest.mark.parametrize("settings, said", [({"a": {"z": 1.0}}, "no scalar parameter or open input z")])
def test_export_refuses_what_it_cannot_write(tmp_path, spring, settings, said):
    with pytest.raises(InputFault, match=said):
        export_ssp(tmp_path / "x.ssp", "x", {"a": spring}, [], Experiment(0.1, 1.0), settings)
