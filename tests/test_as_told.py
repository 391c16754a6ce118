"""JSON by the names and in the units of screen and page; SI beside."""

import pytest

from discrepancy.compare import compare
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.verdict import BaseError
from discrepancy.ladder_step import step_of
from discrepancy.model_file import load_model
from discrepancy.words import as_told


@pytest.fixture(scope="module")
def tables():
    return as_told.tables_of(load_model("RV20E-121-rigid"))


@pytest.mark.parametrize("name, told", [
    ("mesh_stiffness", "mesh.stiffness"), ("thermal_expansion", "effects.thermal_expansion.expansion"), ("mesh_force[1,7]", "mesh.force[1,7]"),
    ("sensor_gain[input_torque]", "sensor_gain[input_torque]"), ("angle_zero[1]", "angle_zero[1]"),
])  # fmt: skip
def test_names_are_those_of_tools(tables, name, told):
    assert as_told.told_name(name, tables) == told


def test_an_effects_parameter_needs_no_reducer():
    assert as_told.effect_name("drag", "seal_torque") == "effects.drag.seal_torque" and as_told.effect_name("mine", "x[2]") == "x[2]"


def test_a_row_is_in_the_bench_s_unit_with_si_beside():
    row = as_told.row({"error": 2.908882086657216e-04, "floor": None, "ratio": 2.0}, "hysteresis[locked=input]", "rad", ("error", "floor"))
    assert row["error"] == pytest.approx(1.0) and row["unit"] == "arcmin" and row["ratio"] == 2.0
    assert row["si"] == {"error": 2.908882086657216e-04, "unit": "rad"}


def test_stiffness_of_a_loop_is_told_as_stiffness():
    (told,) = as_told.figures([KeyFigure("hysteresis", "a", "torsional stiffness", "N.m/rad", 3437.746770784939, 0.0, 0.0, 1, False)])
    assert told["measured"] == pytest.approx(1.0) and told["unit"] == "N.m/arcmin" and told["si"]["unit"] == "N.m/rad"


def test_an_estimate_keeps_what_has_no_unit(tables):
    (name, told), = as_told.parameters({"needle_clearance_added": {
        "value": 2e-6, "interval": [1e-6, 3e-6], "unit": "m", "standard_deviation": 5e-7, "at_bound": False}}, tables).items()  # fmt: skip
    assert name == "effects.needle_clearance.added" and told["unit"] == "um" and not told["at_bound"]
    assert told["interval"] == pytest.approx([1.0, 3.0]) and told["standard_deviation"] == pytest.approx(0.5) and told["si"]["value"] == 2e-6


def test_a_number_of_the_base_and_noise(tables):
    told = as_told.base_error(BaseError("mesh_stiffness", "t", 3e5, (2e5, 4e5), "N", 2.5e5, (1e5, 5e5), 9.0), tables)
    assert told["name"] == "mesh.stiffness" and told["value"] == pytest.approx(300.0) and told["unit"] == "kN" and told["within"] == pytest.approx([100.0, 500.0])
    noise = as_told.noises({"hysteresis": {"scale": 2.908882086657216e-04, "between_runs": {"offset": 2.908882086657216e-04}, "tail": 0.1}}, {"hysteresis": "rad"})
    assert noise["hysteresis"]["scale"] == pytest.approx(1.0) == noise["hysteresis"]["between_runs"]["offset"] and noise["hysteresis"]["si"]["unit"] == "rad"


def test_a_comparison_says_the_same_as_its_tables(tmp_path):
    from discrepancy.campaign.load import load_campaign
    from discrepancy.tables import tables_of

    (tmp_path / "loop.csv").write_text("x,y\n" + "\n".join(f"{t},{0.1 * t + 0.3 * (k % 2)}" for k, t in enumerate([*range(0, 160, 8), *range(160, -160, -8)])))
    (tmp_path / "campaign.toml").write_text(
        '[campaign]\nname = "c"\nreducer = "RV20E-121-rigid"\n[conditions.a]\nload_torque = "167 N.m"\ninput_speed = "1800 rpm"\n[[runs]]\nid = "loop"\n'
        'quantity = "hysteresis"\ncondition = "a"\nfile = "loop.csv"\ntags.locked = "input"\n'
        'columns = { value = { column = "y", unit = "arcsec" }, torque = { column = "x", unit = "N.m" } }\n'
    )
    result = compare(load_model("RV20E-121-rigid"), load_campaign(tmp_path))
    (run,), table = result.as_json()["runs"], tables_of(result)[0]
    column = {c.name: c.values[0] for c in table.columns}
    assert run["unit"] == column["unit"] == "arcmin" and run["error"] == pytest.approx(column["error"])
    assert run["si"]["error"] == pytest.approx(result.runs[0]["error"])


def test_a_step_written_by_hand_may_lack_most_of_it():
    step = step_of({"effects": ["sensor_gain.input_torque", "drag"]})
    assert step.label == "sensor gain (input torque) + drag" and step.kept and step.training is None and step.change("held_out") is None and step.signals == ()
    judged = step_of({"effects": ["drag"], "held_out_before": 3.0, "held_out_after": 1.0, "training_before": 2.0, "kept": False})
    assert judged.held_out is not None and (judged.held_out.before, judged.held_out.after) == (3.0, 1.0) and judged.training is None and not judged.kept
