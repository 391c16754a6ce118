"""Which way an effect goes is told only where its opposite would show otherwise."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.directions import half_a_turn_on
from discrepancy.inference.verdict import ONE, STOPPED
from discrepancy.model_file import ModelFile
from discrepancy.opposite_sign import direction_doubts, sign_doubts
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from discrepancy.ring_directions import ring_texts, seen_from_crank
from reducers.reducer import load_reducer
from tests.test_next_run import CAMPAIGN

RV = load_reducer("RV20E-121")
FACTORS = {"speed": 209.44, "load": 167.0, "temperature": 293.15, "direction": 1.0}


@pytest.fixture(scope="module")
def space():
    """A loop of a reducer with two cranks in which nothing is missing, twice, locked at one angle."""
    reducer = load_reducer("RV20E-121-rigid")
    rng = np.random.default_rng(1)
    torque = 167.0 * np.concatenate([np.linspace(0.05, 1.0, 12), np.linspace(0.97, -1.0, 24), np.linspace(-0.97, 0.02, 12)])
    records = tuple(Record(f"r{k}", "hysteresis", "rad", "a", k, 1e-7 * rng.standard_normal(len(torque)), {"torque": torque},
                           FACTORS | {"locked_at": 0.0}, tags={"locked": "input"}, stated_noise=1e-7) for k in (1, 2))  # fmt: skip
    model = PhysicalModel(ModelFile(reducer.name, reducer), replace(CAMPAIGN, reducer=reducer, records=records), zeros={})
    found = Workspace(model)
    found.fit_base()
    return found


def doubts(space, name, values, verdict=ONE):
    return sign_doubts([{"candidates": [name]}], found_as(space, name, values, verdict))


def found_as(space, name, values, verdict=ONE):
    return SimpleNamespace(verdict=verdict, fits=SimpleNamespace(members=[member_of(space, name, values)], space=space))


def member_of(space, name, values):
    (candidate,) = [c for c in space.model.candidates if c.name == name]
    return SimpleNamespace(name=name, candidates=(candidate,), own=candidate.parameters, fit=SimpleNamespace(values=values))


def test_a_crank_seat_shows_its_size_in_a_loop_and_not_which_way(space):
    values = {"carrier_seat_shift": 7e-6, "carrier_seat_radial": 0.0}
    (text,) = doubts(space, "hole_position_errors.carrier", values)
    assert text.startswith("hole_position_errors.carrier: with the opposite sign it shows the same")
    assert not doubts(space, "hole_position_errors.carrier", values, STOPPED)


def test_what_can_only_go_one_way_or_shows_otherwise_is_not_doubted(space):
    assert not doubts(space, "needle_clearance", {"needle_clearance_added": 3e-6})
    # A gap that is larger lets the output turn further.
    assert not doubts(space, "profile_modification", {"equidistant_added": -5e-6, "shift_added": 0.0})


@pytest.fixture(scope="module")
def turning():
    """Transmission errors over a turn of the output, twice."""
    reducer = load_reducer("RV20E-121")
    rng, angle = np.random.default_rng(1), np.linspace(0.0, 2.0 * np.pi, 900, endpoint=False)
    records = tuple(Record(f"r{k}", "transmission_error", "rad", "a", k, 1e-7 * rng.standard_normal(900), {"angle": angle}, FACTORS, stated_noise=1e-7)
                    for k in (1, 2))  # fmt: skip
    model = PhysicalModel(ModelFile(reducer.name, reducer), replace(CAMPAIGN, reducer=reducer, records=records), zeros={})
    found = Workspace(model)
    found.fit_base()
    return found


@pytest.mark.parametrize("name, values, here, there", [
    ("pin_position_errors.runout", {"pin_ring_runout": 5e-6, "pin_ring_runout_angle": 0.7}, "40.1 deg", "-139.9 deg"),
    # Its lobes and hollows: half a turn on is sixty degrees on.
    ("pin_position_errors.trilobe", {"pin_ring_trilobe": 4e-6, "pin_ring_trilobe_angle": 0.7}, "40.1 deg", "100.1 deg"),
])  # fmt: skip
def test_a_ring_shows_as_well_what_is_on_its_other_side(turning, name, values, here, there):
    """One of the two was told, with an interval of half a degree."""
    (text,) = direction_doubts([{"candidates": [name]}], found_as(turning, name, values), turning.model.bench.tables)
    assert f"{there} shows the same in the runs that were fitted as {here}" in text and "_angle: " in text
    assert not direction_doubts([{"candidates": [name]}], found_as(turning, name, values, STOPPED), turning.model.bench.tables)


def test_an_oval_is_the_same_half_a_turn_on(turning):
    member = member_of(turning, "pin_position_errors.ovality", {"pin_ring_ovality": 4e-6, "pin_ring_ovality_angle": 0.7})
    assert not list(half_a_turn_on(member.candidates, member.fit.values))


def test_directions_round_the_ring_are_told_from_a_part_that_can_be_found():
    effect = {"parameters": {"pin_ring_runout": {}, "pin_ring_runout_angle": {"direction": True}}}
    (text,) = ring_texts([effect], {"angle_zero[1]": 0.1, "pin_ring_runout": 5e-6}, ModelFile(RV.name, RV))
    assert "count from its pin 1" in text and "crank 1 stands at 5.7 deg where mounting 1 shows angle 0" in text
    of_discs = {"parameters": {"disc_runout_angle": {"direction": True}}}
    assert not ring_texts([effect], {"pin_ring_runout": 5e-6}, ModelFile(RV.name, RV)) and not ring_texts([of_discs], {"angle_zero[1]": 0.1}, ModelFile(RV.name, RV))


def test_a_direction_is_told_from_the_crank_at_the_zero_of_the_encoder_too():
    """-89.13 deg of an interval of 0.06 deg counted from a pin that is known to 9 deg; what is carried to the part had to be computed from a note."""
    parameters = {"pin_ring_ovality": {"value": 4e-6}, "pin_ring_ovality_angle": {"value": np.radians(-89.13), "direction": True, "meaning": "the long axis"}}
    (effect,) = seen_from_crank([{"name": "pin_position_errors", "parameters": parameters}], {"angle_zero[1]": np.radians(5.7)})
    assert "the long axis, from pin 1" in effect["parameters"]["pin_ring_ovality_angle"]["meaning"]
    assert "that is -94.83 deg from crank 1 where mounting 1 shows angle 0" in effect["parameters"]["pin_ring_ovality_angle"]["meaning"]
    assert effect["parameters"]["pin_ring_ovality"] == {"value": 4e-6}
    (as_it_was,) = seen_from_crank([{"parameters": parameters}], {})
    assert as_it_was["parameters"] == parameters


def test_a_pin_is_told_with_those_that_look_alike_and_from_where_it_counts():
    effect = {"parameters": {"proud_pin": {"value": 5e-6}, "proud_pin_number": {"value": 10.996}}}
    alike, counted = ring_texts([effect], {"angle_zero[1]": 0.1}, ModelFile(RV.name, RV))
    assert alike == "pin 11 shows the same as pin 31: turned there, the reducer looks as it does"
    assert counted.startswith("pins round the ring count from its pin 1") and counted.endswith("and the pin with it)")
    # Discs of which no turn brings one where another has stood, and nothing that says where angles count from.
    assert ring_texts([effect], {}, SimpleNamespace(reducer=SimpleNamespace(topology=replace(RV.topology, pins=41, lobes=40)))) == []
