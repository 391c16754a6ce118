"""Reducer files: what comes with the software, and what a bad file is told."""

import pytest

from fmu_src.faults import InputFault
from reducers.library import available
from reducers.reducer import load_reducer


def test_the_reducers_come_with_the_software():
    assert available() == ["BX-40E", "BX-40E-rigid", "RV20E-121", "RV20E-121-rigid", "cycloidal-actuator"]


@pytest.mark.parametrize("name", available())
def test_every_number_has_a_source(name):
    reducer = load_reducer(name)
    assert reducer.starts.keys() == reducer.sources.keys()
    said = (
        "document", "assumed", "ratio", "2000 rpm", "15 rpm", "thesis data", "the ", "as ", "Palmgren", "rollers by Palmgren", "moment rigidity", "ISO 6336",
        "one pair of teeth", "greased steel", "boundary friction", "no-load torque", "input inertia",
    )  # fmt: skip
    assert all(s.startswith(said) for s in reducer.sources.values())


def test_numbers_are_converted_to_si():
    reducer = load_reducer("RV20E-121")
    assert reducer.starts["pin_radius"] == pytest.approx(2e-3)
    assert reducer.starts["input_speed"] == pytest.approx(209.4395102)
    assert reducer.starts["run_in_time"] == pytest.approx(1.08e6)


@pytest.mark.parametrize("before, after, said", [
    ("[pin]\nradius = ", "[pin]\nradus = ", r"\[pin\] radus is not a parameter.*did you mean pin.radius"),
    ('radius = { value = 2.0, unit = "mm"', "radius = { value = 2.0", "pin.radius.unit"),
    ('value = 2.0, unit = "mm"', 'value = -2.0, unit = "mm"', r"\[pin\] radius = -2 mm.*out of range"),
    ('value = 2.0, unit = "mm"', 'value = 2.0, unit = "kg"', r"\[pin\] radius = 2 kg: unit 'kg' does not fit"),
    ('value = 2.0, unit = "mm"', 'value = 2.0, unit = "mmm"', "unit 'mmm' is not known"),
    ('value = 2.0, unit = "mm"', 'value = nan, unit = "mm"', "not a finite number"),
    ('value = 2.0, unit = "mm"', 'value = "two", unit = "mm"', "is not a number"),
    ("pins = 40", "pins = 41", r"pins = 41, lobes = 39: the pins do not close the ring.*set pins = 40"),
    ("load_torque =", "# load_torque =", "output.load_torque: missing"),
    ('name = "RV20E-121"', 'name = "../x"', "reducer.name"),
    ("discs = 2", "discs = 0", "topology.discs = 0"),
    ("[topology]", "[topologie]", r"section \[topology\] is missing"),
    ("[pin]", "[pin", "not a TOML file"),
    ('radius = { value = 2.0, unit = "mm", source = "document, table 1" }', "radius = 2.0", "has no unit"),
    ('source = "document, table 1" }\ncircle', 'source = "" }\ncircle', "pin.radius.source"),
])  # fmt: skip
def test_bad_file_is_told_file_key_value_and_remedy(tmp_path, before, after, said):
    text = load_reducer("RV20E-121").path.read_text(encoding="utf-8")
    assert before in text
    path = tmp_path / "mine.toml"
    path.write_text(text.replace(before, after, 1), encoding="utf-8")
    with pytest.raises(InputFault, match=said) as fault:
        load_reducer(path)
    assert "mine.toml" in str(fault.value)


def test_three_cranks_are_a_matter_of_the_file(tmp_path):
    text = load_reducer("RV20E-121").path.read_text(encoding="utf-8").replace("cranks = 2", "cranks = 3")
    path = tmp_path / "three.toml"
    path.write_text(text, encoding="utf-8")
    assert load_reducer(path).plant.by_name["roller_force"].shape == (2, 3, 16)


def test_descriptions_say_whose_speed_the_rated_torque_goes_with():
    """Catalogues rate at the output's speed, and what a reducer runs at is said of the input."""
    for name in available():
        description = load_reducer(name).description
        assert "rpm" not in description or "rpm of the output" in description
