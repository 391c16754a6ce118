"""A model that sets single elements (one larger pin) carries them wherever it goes: as a reducer, in an FMU's description and in its records."""

from xml.etree.ElementTree import Element

import numpy as np

from discrepancy.model_file import extended_reducer, load_model
from discrepancy.named_reducer import named_reducer
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.units import Condition
from fmu_src.description import add_variables
from fmu_src.unit import started
from reducers.reducer import load_reducer

CONDITION, ANGLES = Condition(speed=188.5, load=100.0), np.linspace(0.0, 6.2, 60)
MODEL = '[model]\nname = "pin"\nreducer = "RV20E-121"\n[settings]\nerrors.pin.radius = "1 um"\n"errors.pin.radius[3]" = "6 um"\n'


def test_one_pin_is_larger_in_all_that_is_made_of_a_model(tmp_path):
    path = tmp_path / "pin.toml"
    path.write_text(MODEL)
    wanted = np.full(40, 1e-6)
    wanted[2] = 6e-6
    reducer = extended_reducer(load_model(path))
    assert np.array_equal(reducer.plant.new_records()["pin_radius_error"][0], wanted)
    assert np.array_equal(named_reducer(path).plant.new_records()["pin_radius_error"][0], wanted)
    # What makes an FMU of it, and what a tool reads of that.
    table = started(load_reducer("RV20E-121").plant, reducer.specification("rv_plant"))
    assert np.array_equal(table.new_records()["pin_radius_error"][0], wanted)
    root = Element("root")
    add_variables(root, table, [v for v in table.variables if table.is_visible(v)])
    pins = [v for v in root.iter("ScalarVariable") if v.get("name").startswith("errors.pin.radius[")]
    assert [float(v.find("Real").get("start")) for v in pins] == wanted.tolist()


def test_an_element_that_is_not_there_is_none():
    table = load_reducer("RV20E-121").plant
    assert table.start_of(table.by_name["pin_radius_error"]).shape == (40,)
    assert np.array_equal(table.with_starts({}, {}).new_records(), table.new_records())


def test_a_prediction_knows_of_one_larger_pin(tmp_path):
    path = tmp_path / "pin.toml"
    path.write_text(MODEL)
    file = load_model(path)
    seen = Bench(file.reducer, file.values()).column("transmission_error", CONDITION, {}, ANGLES)
    as_start = Bench(extended_reducer(file), {}).column("transmission_error", CONDITION, {}, ANGLES)
    alike = Bench(file.reducer, {"pin_radius_error": 1e-6}).column("transmission_error", CONDITION, {}, ANGLES)
    assert np.array_equal(seen, as_start)
    assert np.ptp(seen - alike) > 1e-6
