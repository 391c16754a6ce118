"""What a tool shows: structured names, one for each thing, and what old names still do."""

import re
import warnings
import zipfile
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from stand import GIVEN

from cli.main import main
from discrepancy.campaign.load import load_campaign
from discrepancy.model_file import load_model, save_model
from fmu_src.faults import InputFault, OldName
from fmu_src.names import dotted, short_name
from fmu_src.table import Table
from fmu_src.variables import SETTABLE, Variable, output
from orchestrator.component import InProcess
from orchestrator.settings import parse_setting
from orchestrator.system import load
from reducers.reducer import EVERY_PART, kernels_name, load_reducer
from rv_plant.terminals import BUS as PLANT_BUS
from rv_reducer.exchange import PLANT_TO_WEAR, WEAR_TO_PLANT
from studies.building import export_pair
from studies.ensemble.ensemble_file import load_ensemble
from wear_fmu.terminals import BUS as WEAR_BUS

ROOT = Path(__file__).resolve().parents[1]

# FMI's grammar of structured names, without derivatives, quoted parts and indices.
STRUCTURED = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*")
# What a system model connects, besides the bus.
MOST_OUTPUTS = 30

SCENARIO = """
[scenario]
name = "pair"
step = { value = 1.3, unit = "ms" }
duration = { value = 5.2, unit = "ms" }

[components.plant]
reducer = "RV20E-121-rigid"
unit = "plant"
parameters = { PARAMETER = "100 N.m" }
record = ["RECORD"]
"""


def tables(reducer):
    return reducer.plant, reducer.wear, reducer.joint


def test_names_are_structured_unlike_and_one_for_one_thing(rv20e):
    for table in tables(rv20e):
        assert all(STRUCTURED.fullmatch(path) for path in table.by_path)
        assert not [path for path in table.by_path if path.startswith("its")]
    meant = {path: v.description for path, v in rv20e.plant.by_path.items()}
    common = [path for path in rv20e.wear.by_path if path in meant]
    assert len(common) > 20
    units = {(path, v.unit) for table in tables(rv20e) for path, v in table.by_path.items()}
    assert max(Counter(path for path, _ in units).values()) == 1
    assert set(PLANT_TO_WEAR) | set(WEAR_TO_PLANT) <= set(common)
    # The bus of either unit is what they exchange and the forces that another plant may give.
    assert set(PLANT_BUS) == set(WEAR_BUS) == {*PLANT_TO_WEAR, *WEAR_TO_PLANT, "mesh.force", "roller.force"}
    assert {name.replace(".", "_") for name in PLANT_TO_WEAR} - {"heat_contact_temperature"} == set(GIVEN)


def test_groups_are_few(rv20e):
    for table in tables(rv20e):
        groups = Counter(path.partition(".")[0] for path in table.by_path)
        alone = {path for path in table.by_path if "." not in path}
        assert alone <= {"fidelity", "drive", "acceleration"}
        assert len(groups) < 33, groups


def test_outputs_are_what_a_system_model_connects(rv20e):
    for table in tables(rv20e):
        free = [v for v in table.of_role("output") if v.path not in PLANT_BUS]
        assert sum(v.size for v in free) <= MOST_OUTPUTS
    assert all(not v.shape for v in rv20e.joint.of_role("output"))
    assert not [v for v in rv20e.joint.of_role("output") if v.path.startswith("numerics")]


def test_nothing_is_shown_of_parts_that_are_not_there(rv20e):
    plain = load_reducer("cycloidal-actuator")
    for table in (rv20e.plant, rv20e.joint):
        assert "effects.crank_lobe_errors.lobe_throw_error_2" in table.by_path
        assert not [path for path in table.by_path if path.endswith("_3") and "pin_position" not in path]
        assert not [path for path in table.by_path if path.startswith(("output_pin", "effects.output_play"))]
    assert "effects.crank_lobe_errors.lobe_throw_error_2" not in plain.plant.by_path
    assert {"output_pin.clearance", "output_pin.force", "effects.output_play.play"} <= plain.plant.by_path.keys()
    with pytest.raises(InputFault, match="no parameter or input 'effects.crank_lobe_errors.lobe_throw_error_3'"):
        parse_setting("effects.crank_lobe_errors.lobe_throw_error_3=1um", [rv20e.plant])


def test_wear_of_a_disc_has_axes_of_disc_lobe_and_bin(rv20e):
    assert rv20e.wear.by_path["surface.disc_wear"].seen_axes == (("disc", 2), ("lobe", 39), ("bin", 180))


@pytest.mark.parametrize("parameter, effect, short", [
    ("thermal_expansion", "thermal_expansion", "expansion"), ("thermal_time", "thermal_expansion", "time"),
    ("needle_clearance_added", "needle_clearance", "added"), ("seal_torque", "drag", "seal_torque"), ("unbalance", "unbalance", "unbalance"),
    ("my_2", "my", "my_2"),
])  # fmt: skip
def test_parameters_of_an_effect_do_not_repeat_its_name(parameter, effect, short):
    assert short_name(parameter, effect) == short


def test_two_variables_of_one_name_are_refused():
    with pytest.raises(ValueError, match=r"two variables show the same name: \['mesh.force'\]"):
        Table("Unit", "", [output("mesh.force", "N", ""), Variable("force", "parameter", "N", "", path="mesh.force")])


@pytest.mark.parametrize("old, new", [("bearing_clearance", "bearing.clearance"), ("pin_radius_error[3]", "errors.pin.radius[3]"),
                                      ("thermal_expansion", "effects.thermal_expansion.expansion"), ("hardness", "material.hardness")])
def test_an_old_name_in_a_setting_works_and_the_new_one_is_said(rv20e, old, new):
    both = [rv20e.plant, rv20e.wear]
    with pytest.warns(OldName, match=re.escape(f"{old} is now called {new}; the old name works through version 0.3")):
        before = parse_setting(f"{old}=1e-6", both) if "hardness" not in old else parse_setting(f"{old}=7 GPa", both)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        now = parse_setting(f"{new}=1e-6", both) if "hardness" not in old else parse_setting(f"{new}=7 GPa", both)
    assert now == before


def test_an_old_name_in_a_scenario_works_and_the_new_one_is_said(tmp_path):
    path = tmp_path / "pair.toml"
    path.write_text(SCENARIO.replace("PARAMETER", "load_torque").replace("RECORD", "lag"), encoding="utf-8")
    with pytest.warns(OldName) as said:
        before = load(path).run()
    assert {"plant.load_torque is now called plant.output.load_torque; the old name works through version 0.3",
            "plant.lag is now called plant.output.lag; the old name works through version 0.3"} <= {str(w.message) for w in said}
    path.write_text(SCENARIO.replace("PARAMETER", "output.load_torque").replace("RECORD", "output.lag"), encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        after = load(path).run()
    assert np.array_equal(before["plant.lag"], after["plant.output.lag"]) and after["plant.output.lag"][-1] > 0.0


def test_an_old_package_works_and_the_new_names_are_said_once_for_an_array(rv20e, native_fmus, tmp_path):
    export_pair(rv20e, native_fmus / "fmi2", 1.3e-3)
    new, old = native_fmus / "fmi2" / "RvReducer.ssp", tmp_path / "old.ssp"
    names = {path: name for table in (rv20e.plant, rv20e.wear) for name, path in table.renamed.items()} | {"heat.ambient_temperature": "temperature"}
    pattern = re.compile(r'(?<=")(' + "|".join(map(re.escape, sorted(names, key=len, reverse=True))) + r')(?=["\[])')
    with zipfile.ZipFile(new) as given, zipfile.ZipFile(old, "w") as made:
        for entry in given.namelist():
            data = given.read(entry)
            if not entry.endswith(".fmu"):
                data = pattern.sub(lambda m: names[m[1]], data.decode().replace("heat.contact_temperature", "CONTACT")).encode()
                data = data.replace(b'startElement="plant" startConnector="CONTACT"', b'startElement="plant" startConnector="reducer_temperature"')
                data = data.replace(b"CONTACT", b"temperature")
            made.writestr(entry, data)
    with pytest.warns(OldName) as said:
        before = load(old)
    messages = [str(w.message) for w in said]
    assert "plant.mesh_force_path is now called plant.mesh.force_path; the old name works through version 0.3" in messages
    assert not [m for m in messages if "[" in m]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        after = load(new)
    for system in (before, after):
        system["wear.acceleration"] = 1e6
        system.run(6.5e-3)
    assert before["wear.flank.depth"].max() == after["wear.flank.depth"].max() > 0.0
    before.close()
    after.close()


def test_an_old_reducer_file_works_and_the_new_names_are_said(rv20e, tmp_path):
    text = rv20e.path.read_text(encoding="utf-8")
    old = text.replace("[pin]\nradius =", "[cycloid]\npin_radius =").replace("\ncircle_radius", "\npin_circle_radius", 1)
    assert old != text
    path = tmp_path / "old.toml"
    path.write_text(old, encoding="utf-8")
    with pytest.warns(OldName, match=r"old.toml: \[cycloid\] pin_radius: pin_radius is now called pin.radius"):
        read = load_reducer(path)
    assert read.starts == rv20e.starts


def test_files_of_this_repository_have_no_old_names():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for file in (ROOT / "reducers").glob("*.toml"):
            load_reducer(file)


def test_python_takes_either_name(rv20e):
    plant = InProcess("plant", rv20e.specification("rv_plant"))
    plant.set("load_torque", 120.0)
    assert plant.get("output.load_torque") == plant.number("load_torque") == 120.0
    assert plant.signal("mesh_force[1,7]") == plant.signal("mesh.force[1,7]")


def test_every_old_name_leads_to_one_new_name(rv20e):
    assert EVERY_PART.cranks == 3
    for table in tables(rv20e):
        old = table.renamed
        assert len(set(old.values())) == len(old) and not set(old) & set(table.by_path)
        assert all(table.find(name) is table.find(path) for name, path in old.items())
        assert {v.path for v in table.of_role(*SETTABLE)} - set(old.values()) <= {"fidelity", "drive", "acceleration"}


def test_keys_with_dots_make_one_table():
    nested = {"mesh": {"force": 1, "deep": {"er": {"value": 2, "unit": "m"}}}, "a.b": 3}
    assert dotted(nested, ("value",)) == {"mesh.force": 1, "mesh.deep.er": {"value": 2, "unit": "m"}, "a.b": 3}


def test_the_command_line_says_an_old_name_once_in_a_line(capsys):
    assert main(["solve", "--positions", "12", "--json", "--set", "bearing_clearance=3um", "--set", "bearing_clearance=3um"]) == 0
    assert capsys.readouterr().err.splitlines() == [
        "warning: setting: bearing_clearance is now called bearing.clearance; the old name works through version 0.3"
    ]


MODEL = """
[model]
name = "gearbox 7"
reducer = "RV20E-121-rigid"

[settings]
CLEARANCE = "3 um"
LAW = "palmgren"

[effects.needle_clearance]
ADDED = { value = 2.1e-6, unit = "m" }
"""


def test_a_model_file_is_written_with_the_names_that_it_is_read_with(tmp_path):
    old, new = tmp_path / "old.toml", tmp_path / "new.toml"
    old.write_text(MODEL.replace("CLEARANCE", "bearing_clearance").replace("LAW", "contact_law").replace("ADDED", "needle_clearance_added"), encoding="utf-8")
    with pytest.warns(OldName) as said:
        read = load_model(old)
    texts = " ".join(str(w.message) for w in said)
    assert "bearing.clearance" in texts and "contact.law" in texts and "needle_clearance_added is now called added" in texts
    assert read.values() == {"bearing_clearance": pytest.approx(3e-6), "contact_law": 2, "needle_clearance_added": 2.1e-6}
    save_model(read, new)
    assert all(text in new.read_text(encoding="utf-8") for text in ("bearing.clearance = ", 'contact.law = "palmgren"', "\nadded = "))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = load_model(new)
    assert again.values() == read.values() and again.effects == read.effects


def test_a_wrong_parameter_of_an_effect_is_told_those_there_are(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text(MODEL.replace("CLEARANCE", "bearing.clearance").replace("LAW", "contact.law").replace("ADDED", "more"), encoding="utf-8")
    with pytest.raises(InputFault, match=r"wrong.toml: effects.needle_clearance.more: there is no such parameter; the effect's: added"):
        load_model(path)


def test_a_heading_tells_a_model_from_the_one_that_it_goes_on_from(tmp_path):
    """`RV20E-121 against banco` stood over both."""
    path = tmp_path / "better.toml"
    path.write_text('[model]\nname = "RV20E-121"\nreducer = "RV20E-121"\n', encoding="utf-8")
    assert load_model(path).heading == "better.toml (RV20E-121)" and load_model("RV20E-121").heading == "RV20E-121"
    assert load_model(path.rename(tmp_path / "RV20E-121.toml")).heading == "RV20E-121"


def test_nuisances_and_scatter_are_written_as_tools_show_them():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert [s.name for s in load_ensemble(ROOT / "examples" / "ensemble.toml").scatters] == [
            "bearing_clearance", "pin_radius_error", "mesh_wear_coefficient",
        ]
        assert {"mesh_wear_coefficient", "bearing_clearance"} <= {n.parameter.name for n in load_campaign(ROOT / "examples" / "durability_test").nuisances}
    with pytest.warns(OldName, match=r"nuisances.carrier_compliance: carrier_compliance is now called effects.support_compliance.carrier_compliance"):
        assert kernels_name("carrier_compliance", "nuisances.carrier_compliance") == "carrier_compliance"
    assert kernels_name("sensor_gain[hysteresis]", "") == "sensor_gain[hysteresis]"
