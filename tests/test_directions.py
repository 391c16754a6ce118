"""An angle that says where something stands is told in degrees, however small it is; an error of an angle in the unit of its size."""

import math
from pathlib import Path

import pytest

from discrepancy.campaign.load import load_campaign
from discrepancy.inference.refit.directions import half_a_turn_on, period
from discrepancy.model_file import every_effect, load_model, parameter_variable
from discrepancy.page import amounts
from discrepancy.prediction.candidates import parameter_of
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.scales import estimate_texts, of_variable
from discrepancy.words import as_told
from discrepancy.words.written_number import written_entry

EXAMPLE = Path(__file__).parents[1] / "examples" / "hidden_effect" / "campaign"
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
    spall = next(p for p in every_effect()["race_spall"].parameters if p.variable.name == "spall_angle")
    # The number stood at 270, the knob at the end of its way.
    assert slider(parameter_of(spall, spall.variable.start), False)["off"] == pytest.approx(-90.0, abs=1e-3)
    seat = next(p for p in every_effect()["pin_seats"].parameters if p.variable.name == "pin_seat_direction")
    assert slider(parameter_of(seat, 0.7), False)["all_round"] is False


def test_only_what_is_looked_through_in_even_steps_of_a_turn_has_another_side():
    """A phase of several waves and a width had one that was none: "0.9 deg shows the same as 0.9 deg"."""
    model = PhysicalModel(load_model("RV20E-121"), load_campaign(EXAMPLE))
    candidate = {f"{c.name}.{p.name}": (c, p) for c in model.candidates for p in c.shapes}
    turns = {name: 2.0 * math.pi / again for name, (c, p) in candidate.items() if (again := period(c, p))}
    assert turns["disc_tooth_errors.ovality.disc_ovality_angle"] == 2 and turns["pin_position_errors.trilobe.pin_ring_trilobe_angle"] == pytest.approx(3)
    assert turns["pin_position_errors.runout.pin_ring_runout_angle"] == 1
    assert "first_stage_error.sun.first_stage_phase" not in turns and "race_spall.spall_width" not in turns
    sun, oval = (candidate[name] for name in ("first_stage_error.sun.first_stage_phase", "disc_tooth_errors.ovality.disc_ovality_angle"))
    assert not list(half_a_turn_on([sun[0], oval[0]], {sun[1].name: 0.1, oval[1].name: 0.1}))
