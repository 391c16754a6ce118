"""An angle that says where something stands is told in degrees, however small it is; an error of an angle in the unit of its size."""

import math

import pytest

from discrepancy import as_told
from discrepancy.model_file import every_effect, parameter_variable
from discrepancy.page import amounts
from discrepancy.prediction.candidates import parameter_of
from discrepancy.scales import estimate_texts, of_variable
from discrepancy.written_number import written_entry

ARCMIN = math.radians(1.0 / 60.0)
SMALL = -6.915 * ARCMIN
# As a diagnosis has it.
PHASE = {"value": SMALL, "interval": [-72.26 * ARCMIN, 58.43 * ARCMIN], "unit": "rad", "direction": True}


def test_directions_are_those_of_what_stands_somewhere():
    found = {p.variable.name: parameter_of(p, 0.0).is_direction for e in every_effect().values() for p in e.parameters if p.variable.unit == "rad"}
    assert all(found[name] for name in ("first_stage_phase", "pin_ring_ovality_angle", "unbalance_angle", "spall_angle", "pin_seat_direction"))
    assert not any(found[name] for name in ("lobe_phase_error_1", "misalignment", "encoder_cos1", "presliding_angle"))


def test_a_phase_is_told_in_degrees_everywhere():
    assert estimate_texts(PHASE) == ("-0.1152", "-1.204 to 0.9738", "deg")
    assert amounts.estimate(PHASE) == ("−0.115", "−1.20 to 0.974", "°")
    told = as_told.parameter(PHASE)
    assert told["unit"] == "deg" and told["value"] == pytest.approx(-0.11525) and told["si"]["value"] == SMALL
    variable = parameter_variable(every_effect()["first_stage_error"], "first_stage_phase")
    assert of_variable(variable, 1e-6).unit == "deg"
    assert written_entry(variable, {"value": SMALL, "unit": "rad"})["unit"] == "deg"
    kept = as_told.added("first_stage_error", "first_stage_phase", {"value": SMALL, "unit": "rad"})
    assert kept["unit"] == "deg" and kept["si"]["value"] == SMALL
    assert estimate_texts({**PHASE, "direction": False})[2] == "arcmin"


def test_a_slider_of_a_phase_goes_all_round():
    from workbench.trying import slider

    phase = next(p for p in every_effect()["first_stage_error"].parameters if p.variable.name == "first_stage_phase")
    shown = slider(parameter_of(phase, 0.0), False)
    assert (shown["low"], shown["high"], shown["unit"], shown["all_round"]) == (pytest.approx(-180.0), pytest.approx(180.0), "°", True)
    seat = next(p for p in every_effect()["pin_seats"].parameters if p.variable.name == "pin_seat_direction")
    assert slider(parameter_of(seat, 0.7), False)["all_round"] is False
