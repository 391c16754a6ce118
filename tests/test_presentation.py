"""What a tool finds in a unit beside its numbers: display units, terminals, icons, what initial values depend on."""

import zipfile
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest
from fmpy import read_model_description
from lxml import etree

from fmu_src import icons
from fmu_src.description import add_units
from fmu_src.display import display_unit, displays
from fmu_src.unit import make_unit
from fmu_src.units import conversion
from fmu_src.variables import SETTABLE, Variable
from orchestrator.component import InProcess

SCHEMA = Path(fmpy.__file__).parent / "schema" / "fmi3" / "fmi3TerminalsAndIcons.xsd"
PNG = b"\x89PNG\r\n\x1a\n"


@pytest.fixture(params=[f"{version}/{unit}" for version in ("fmi2", "fmi3") for unit in ("RvPlant", "RvWear")])
def path(request, native_fmus):
    return native_fmus / f"{request.param}.fmu"


@pytest.mark.parametrize("name, shown", [
    ("input.speed", "rpm"), ("output.angle", "deg"), ("output.lag", "arcsec"), ("output.transmission_error", "arcsec"), ("life.lost_motion", "arcmin"),
    ("heat.ambient_temperature", "degC"), ("pin.radius", "mm"), ("bearing.clearance", "um"), ("errors.pin.radial", "um"), ("wear.operating_time", "h"),
    ("material.elastic_modulus", "GPa"), ("effects.support_compliance.housing_compliance", "arcmin/(N.m)"), ("wear.crank_travel", "turn"),
    ("flank.volume", "mm^3"), ("contact.modal_damping_time", "us"), ("effects.grease_ageing.age", "h"), ("effects.thermal_expansion.expansion", "ppm/K"),
    ("output.load_torque", ""), ("load.inertia", ""), ("mesh.force", ""), ("fidelity", ""),
])  # fmt: skip
def test_values_are_shown_in_the_unit_that_people_read(rv20e, name, shown):
    v = next(v for t in (rv20e.plant, rv20e.joint) if (v := t.find(name)) is not None)
    assert display_unit(v) == shown


def test_length_per_torque_is_no_force_below_a_stroke():
    assert display_unit(Variable("windup", "parameter", "m/(N.m)", "of a seat", 0.0)) == "um/(N.m)"
    assert [(d.name, round(d.factor, 6)) for d in displays("m/(N.m)")] == [("um/(N.m)", 1e6)]


def test_every_display_unit_is_one_of_its_unit_and_converts_as_the_unit_does(rv20e):
    for table in (rv20e.plant, rv20e.wear, rv20e.joint):
        for v in table.variables:
            shown = display_unit(v)
            if shown:
                found = next(d for d in displays(v.unit) if d.name == shown)
                assert (found.factor, found.offset) == conversion(v.unit, shown) and not found.inverse, v.path


def test_descriptions_carry_them(path):
    description = read_model_description(str(path))
    defined = {u.name: {d.name: d for d in u.displayUnits} for u in description.unitDefinitions}
    shown = [v for v in description.modelVariables if v.displayUnit]
    assert len(shown) > 50 and all(v.displayUnit in defined[v.unit] for v in shown)
    warm = defined["K"]["degC"]
    assert float(warm.factor) * 293.15 + float(warm.offset) == pytest.approx(20.0)
    assert description.defaultExperiment.tolerance == "0.001"


def test_a_unit_of_one_variable_alone_is_defined():
    """Importers refuse a description whose display units are not."""
    root = ElementTree.Element("fmiModelDescription")
    add_units(root, [Variable("rate", "parameter", "rad/s", "growth of lost motion", 0.0, display="arcsec/h"), Variable("speed", "parameter", "rad/s", "speed", 0.0)])
    factors = {d.get("name"): float(d.get("factor")) for d in root.iter("DisplayUnit")}
    assert factors == pytest.approx({"rpm": 30.0 / np.pi, "arcsec/h": 3600.0 * np.degrees(3600.0)})


def test_stiffness_is_offered_for_compliance_where_fmi_can(native_fmus):
    def offered(version):
        with zipfile.ZipFile(native_fmus / version / "RvPlant.fmu") as archive:
            root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        unit = next(u for u in root.iter("Unit") if u.get("name") == "rad/(N.m)")
        return {d.get("name"): d for d in unit.findall("DisplayUnit")}

    assert set(offered("fmi2")) == {"arcmin/(N.m)"}
    stiffness = offered("fmi3")["N.m/arcmin"]
    assert stiffness.get("inverse") == "true"
    # 1e-5 rad/(N.m) is 100 kN.m/rad.
    assert float(stiffness.get("factor")) / 1e-5 == pytest.approx(1e5 * np.pi / 10800.0)


def test_terminals_fit_schema_and_description(path):
    description = read_model_description(str(path))
    names = {v.name for v in description.modelVariables}
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist() if name.startswith("terminalsAndIcons/")}
    root = etree.fromstring(files["terminalsAndIcons/terminalsAndIcons.xml"])
    etree.XMLSchema(etree.parse(str(SCHEMA))).assertValid(root)
    terminals = {t.get("name"): t for t in root.iter("Terminal")}
    assert set(terminals) == ({"input", "output", "housing", "heat", "wear"} if path.stem == "RvPlant" else {"plant"})
    for terminal in terminals.values():
        members = [m.get("variableName") for m in terminal.iter("TerminalMemberVariable")]
        assert set(members) <= names and len(set(members)) == len(members)
        icon = terminal.find("TerminalGraphicalRepresentation").get("iconBaseName")
        assert files[f"terminalsAndIcons/{icon}.png"].startswith(PNG)
        assert etree.fromstring(files[f"terminalsAndIcons/{icon}.svg"]).tag.endswith("svg")
    assert files["terminalsAndIcons/icon.png"].startswith(PNG)


def test_both_ends_of_the_bus_have_the_same_members(native_fmus):
    def members(unit, terminal):
        with zipfile.ZipFile(native_fmus / "fmi3" / f"{unit}.fmu") as archive:
            root = ElementTree.fromstring(archive.read("terminalsAndIcons/terminalsAndIcons.xml"))
        found = next(t for t in root.iter("Terminal") if t.get("name") == terminal)
        return {m.get("memberName") for m in found.iter("TerminalMemberVariable")}

    assert members("RvPlant", "wear") == members("RvWear", "plant") and len(members("RvWear", "plant")) == 15


def test_initial_values_depend_on_nothing_that_is_not_declared(rv20e):
    """Every input and scalar parameter is moved; what is said to depend on none of them stays."""
    random = np.random.default_rng(1)
    for unit in ("rv_plant", "rv_reducer"):
        specification = rv20e.specification(unit)
        table = make_unit(specification).table
        outputs = table.of_role("output")
        for fidelity in (0, 1):
            ones = started(specification, fidelity, lambda v: False, random)
            moved = started(specification, fidelity, lambda v: True, random)
            for v in outputs:
                known = table.known_at_start.get(v.name)
                if known is not None and not known:
                    assert np.array_equal(ones.get(v.name), moved.get(v.name)), v.path
            others = started(specification, fidelity, lambda v: v.name not in set(table.known_at_start.get("lag", [v.name])), random)
            if unit == "rv_reducer":
                assert others.get("lag") == ones.get("lag") != moved.get("lag")


def started(specification, fidelity, moves, random):
    """The unit initialised, those real scalars that ``moves`` chooses a little off their start."""
    unit = InProcess("unit", specification)
    unit.set("fidelity", fidelity)
    for v in unit.table.of_role(*SETTABLE):
        if not v.is_integer and not v.shape and moves(v) and not v.path.startswith(("numerics", "effects")):
            unit.set(v.name, float(np.clip(v.start * (1.0 + 1e-3 * random.uniform()), v.minimum, v.maximum)))
    unit.exit_initialisation()
    return unit


def test_initial_unknowns_of_the_description(rv20e, native_fmus):
    description = read_model_description(str(native_fmus / "fmi3" / "RvPlant.fmu"))
    known = {u.variable.name: u.dependencies for u in description.initialUnknowns}
    assert set(known) == {v.name for v in description.modelVariables if v.causality == "output"}
    assert known["crank.path"] == known["cage.angle"] == [] and known["output.lag"] is None
    assert "life.worst_flank_depth" in rv20e.joint.by_path
    of_lag = rv20e.joint.known_at_start["lag"]
    assert "pin_radius" in of_lag and "hardness" not in of_lag and rv20e.joint.known_at_start["worst_flank_depth"] == ()


def test_icons_are_painted_layer_on_layer():
    """Pixel by pixel: the highest disc that a place lies in, and the mean over the fine places of a pixel."""
    size = 12
    axis = (np.arange(icons.FINE * size) + 0.5) / (icons.FINE * size) * 2.0 - 1.0
    x, y = np.meshgrid(axis, -axis)
    colours = np.zeros((*x.shape, 4))
    for disc in icons.reducer():
        colours[np.hypot(x - disc.x, y - disc.y) < disc.edge(np.arctan2(y - disc.y, x - disc.x))] = icons.paint(disc.colour)
    assert icons.picture(size) == icons.png(colours)
