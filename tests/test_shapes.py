"""Shapes of effects: where a search looks for them, which are held, and that it is said."""

from dataclasses import replace

import numpy as np
import pytest

from discrepancy.model_file import every_effect, load_model
from discrepancy.prediction.candidates import candidates
from discrepancy.problem import Record
from discrepancy.words.held_shapes import held_text
from fmu_src.effect import Effect, amplitude, shape

# What the catalogue holds: conditions that others state, and numbers that no campaign of these signals shows.
HELD = {
    "disc_pairing", "churning_speed", "viscosity_reference", "grease_age", "thermal_time", "thermal_reference", "tilting_compliance", "disc_spacing",
    "activation_reference", "grease_mass", "debris_settling", "grease_change", "oil_viscosity", "oil_viscosity_slope", "threshold_sharpness",
    "wear_growth_time", "ripple_order", "ripple_damping", "distortion_order",
}  # fmt: skip


@pytest.mark.parametrize("unit, start, low, high, grid", [
    ("rad/s", 30.0, 1.0, 300.0, (10.0, 30.0, 90.0)), ("rad/s", 30.0, 12.0, 60.0, (30.0,)), ("K", -3.0, -100.0, 0.0, (-1.0, -3.0, -9.0)),
    ("1", 0.0, -1.0, 1.0, (-0.2, 0.0, 0.2)), ("1", 0.0, 0.0, 2.0, (0.0, 0.2)), ("rad", 0.0, 0.0, 6.28319, (0.0, 1.5708, 3.1416, 4.7124)),
])  # fmt: skip
def test_a_shape_without_a_grid_is_looked_for_about_its_start(unit, start, low, high, grid):
    assert shape("s", unit, "", start, low, high, "").grid == pytest.approx(grid, abs=1e-4)


def test_the_catalogue_holds_what_it_held():
    assert {p.variable.name for e in every_effect().values() for p in e.parameters if p.is_held} == HELD


def test_shapes_of_an_effect_are_candidates_unless_they_are_held(monkeypatch):
    own = Effect(0, "lip", "", "", "", (amplitude("lip_torque", "N.m", "a", 0.1, 0.0, 5.0, sign=1), shape("lip_speed", "rad/s", "n0", 30.0, 1.0, 300.0, ""),
                                        shape("lip_power", "1", "p", 1.0, 0.5, 2.0, "", held=True)), signals=("input_torque",))  # fmt: skip
    monkeypatch.setattr("discrepancy.prediction.candidates.every_effect", lambda: {"lip": own})
    record = Record("a", "input_torque", "N.m", "a", 1, np.zeros(3), {}, {})
    (found,) = candidates([record], {}, set(), [])
    assert [p.name for p in found.shapes] == ["lip_speed"]
    assert [point["lip_speed"] for point in found.shape_grid] == pytest.approx([10.0, 30.0, 90.0])


@pytest.mark.parametrize(("pins", "ways", "count"), [(40, 2, 20), (41, 1, 41)])
def test_of_the_pins_that_may_be_proud_those_are_tried_that_show_another_curve(pins, ways, count):
    record = Record("a", "transmission_error", "rad", "a", 1, np.zeros(3), {"angle": np.arange(3.0)}, {})
    (found,) = (c for c in candidates([record], {}, set(), ["1"], pins=pins, ways=ways) if c.name == "pin_position_errors.proud")
    assert [point["proud_pin_number"] for point in found.shape_grid] == [float(k) for k in range(1, count + 1)]
    assert [(p.lower, p.upper) for p in found.shapes] == [(0.0, pins)]


def test_what_is_held_is_said_with_the_values_of_the_model():
    model = load_model("RV20E-121-rigid")
    assert held_text("disc_tooth_errors", model) == "held, not fitted: effects.disc_tooth_errors.pairing = 1 (0: both discs carry the same error, 1: opposed ones)"
    assert held_text("drag", model) == "held, not fitted: effects.drag.churning_speed = 2000 rpm, effects.drag.viscosity_reference = 20 degC"
    assert "effects.drag.churning_speed = 1000 rpm" in held_text("drag", replace(model, settings={"churning_speed": 104.71976}))
    assert held_text("unbalance", model) == held_text("nothing", model) == ""
