"""Numbers without a unit are SI; where no reducer can have such a number, what is said names the unit that was meant."""

import re

import pytest

import rvwear
from cli.main import main
from discrepancy.model_file import load_model
from fmu_src.faults import InputFault
from orchestrator.settings import parse_setting
from orchestrator.system import load
from reducers.reducer import load_reducer

PLANT = """
[scenario]
name = "plant"
step = { value = 1.3, unit = "ms" }
duration = { value = 26, unit = "ms" }

[components.plant]
reducer = "RV20E-121-rigid"
unit = "plant"
parameters = { pin.radius = RADIUS }
"""
HEAD = '[model]\nname = "m"\nreducer = "RV20E-121"\n'


def read(text: str):
    reducer = load_reducer("RV20E-121")
    return parse_setting(text, [reducer.plant, reducer.wear])


@pytest.mark.parametrize(("text", "meant"), [
    ("crank.eccentricity=1.0", "crank.eccentricity = 1 is 1 m, since no unit was given; did you mean 1 mm? write crank.eccentricity=1mm, "),
    ("crank.circle_radius=28", "did you mean 28 mm? write crank.circle_radius=28mm"), ("bearing.clearance=10", "write bearing.clearance=10um"),
    ("first_stage.pressure_angle=20", "write first_stage.pressure_angle=20deg"), ("heat.ambient_temperature=40", "is 40 K, since no unit was given; did you mean 40 degC?"),
    ("effects.crank_lobe_errors.lobe_phase_error_1=3", "did you mean 3 arcmin?"), ("errors.pin.radius[3]=2", "write errors.pin.radius[3]=2um"),
    ("material.elastic_modulus=207", "did you mean 207 GPa?"), ("input.speed=1500", "is 1500 rad/s, since no unit was given; did you mean 1500 rpm?"),
    ("effects.hole_position_errors.disc_hole_shift_1=6", "(it must lie in [-3e-05, 3e-05] m)"),
])  # fmt: skip
def test_a_number_that_no_reducer_has_names_the_usual_unit(text, meant):
    """An eccentricity of 1 m was refused by what followed: the trochoid has loops."""
    with pytest.raises(InputFault, match=re.escape(meant)):
        read(text)


@pytest.mark.parametrize(("text", "value"), [
    ("crank.eccentricity=0.0009", 9e-4), ("crank.eccentricity=1m", 1.0), ("input.speed=1500rad/s", 1500.0), ("output.load_torque=5000", 5000.0),
    ("bearing.clearance=-2e-6", -2e-6),
])  # fmt: skip
def test_what_a_reducer_can_have_and_what_has_its_unit_is_taken(text, value):
    assert read(text).value == value


@pytest.mark.parametrize("text", ["heat.ambient_temperature=700", "pin.radius=-2mm", "crank.eccentricity=nan"])
def test_where_the_usual_unit_mends_nothing_the_bounds_are_said_alone(text):
    with pytest.raises(InputFault, match="out of range|not a finite number") as fault:
        read(text)
    assert "did you mean" not in str(fault.value)


def test_command_line_files_and_python_say_the_same(tmp_path, capsys):
    said = "crank.eccentricity = 1 is 1 m, since no unit was given; did you mean 1 mm?"
    assert main(["solve", "--set", "crank.eccentricity=1.0"]) == 2 and said in capsys.readouterr().err
    with pytest.raises(InputFault, match=re.escape(said)):
        rvwear.solve("RV20E-121", settings={"crank.eccentricity": 1.0})
    path = tmp_path / "m.toml"
    path.write_text(f"{HEAD}[settings]\ncrank.eccentricity = 1.0\n", encoding="utf-8")
    with pytest.raises(InputFault, match=rf"m.toml: settings.crank.eccentricity: .*{re.escape(said)}"):
        load_model(path)
    path.write_text(f"{HEAD}[effects.hole_position_errors]\ndisc_hole_shift_1 = {{ value = 3 }}\n", encoding="utf-8")
    with pytest.raises(InputFault, match="disc_hole_shift_1 = 3 is 3 m, since no unit was given; did you mean 3 um"):
        load_model(path)
    # Which unit it takes is said by what people read it in.
    path.write_text(f"{HEAD}[effects.hole_position_errors]\ndisc_hole_shift_1 = 3\n", encoding="utf-8")
    with pytest.raises(InputFault, match='write "3 um", or { value = 3, unit = "um" }'):
        load_model(path)


def test_a_system_says_it_of_its_files_numbers_and_of_those_set_from_python(tmp_path):
    path = tmp_path / "plant.toml"
    path.write_text(PLANT.replace("RADIUS", "2e-3"), encoding="utf-8")
    system = load(path)
    with pytest.raises(InputFault, match="pin.radius = 2 is 2 m, since no unit was given; did you mean 2 mm"):
        system["plant.pin.radius"] = 2.0
    system["plant.pin.radius"] = "2 mm"
    assert system["plant.pin.radius"] == pytest.approx(2e-3)
    system.close()
    path.write_text(PLANT.replace("RADIUS", "2.0"), encoding="utf-8")
    with pytest.raises(InputFault, match=r"parameters.pin.radius = 2.0: .*did you mean 2 mm"):
        load(path)
