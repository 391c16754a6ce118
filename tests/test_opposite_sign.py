"""Which way an effect goes is told only where its opposite would show otherwise."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.alike.opposite_sign import with_others
from discrepancy.alike.ring_directions import either_texts, seen_from_crank
from discrepancy.experiment import weighed_runs
from discrepancy.experiment.weighed_runs import law_of, telling_either
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.next_experiment import Proposal
from discrepancy.inference.refit.directions import half_a_turn_on
from discrepancy.inference.verdict import ONE, STOPPED
from discrepancy.model_file import ModelFile
from discrepancy.page import amounts
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from discrepancy.scales import estimate_texts
from discrepancy.words import as_told
from discrepancy.words.intervals import pins_in
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
    return either_texts(told(space, name, values, verdict), {}, space.model.file, more=False)


def told(space, name, values, verdict=ONE):
    found = found_as(space, name, values, verdict)
    (member,) = found.fits.members
    entries = {p.name: {"value": values[p.name]} | ({"direction": True} if p.is_direction else {}) for p in member.own}
    return with_others([{"name": name.partition(".")[0], "candidates": [name], "parameters": entries}], found)


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


def test_next_says_of_what_is_open_which_run_would_tell_it_or_that_none_does(space, monkeypatch):
    """Once the effect was in the model file nothing was asked about which way it goes."""
    found = SimpleNamespace(fits=SimpleNamespace(members=[], space=space))
    seat = {"carrier_seat_shift": {"value": 7e-6, "alike": -7e-6, "unit": "m"}}
    file = replace(space.model.file, effects={"hole_position_errors": seat})
    answer = SimpleNamespace(effects=[], diagnosis=found, model=SimpleNamespace(file=file))
    assert law_of(answer).values == space.base.values
    best = Proposal("loop at 90 deg", {}, 2.0, 9.0, 9.0, {}, "loop")
    for proposals, measured, says in (([best], [], "loop at 90 deg tells that, the cheapest that does (they differ there by 9.0 in chi-square, where 6 is enough)"),
                                      ([best], ["a"], "no run within the limits tells that by itself"), ([], [], "no run within the limits tells that by itself")):  # fmt: skip
        asked = []
        monkeypatch.setattr(weighed_runs, "weighed", lambda answer, campaign, rivals: asked.append(rivals) or SimpleNamespace(proposals=proposals))
        monkeypatch.setattr(weighed_runs, "measured_in", lambda proposal, campaign: measured)
        assert telling_either(answer, CAMPAIGN) == [f"which way hole position errors go: {says}"]
        assert asked[0][1].values["carrier_seat_shift"] == -7e-6 and "carrier_seat_shift" not in asked[0][0].values
    # What a symmetry hides is not asked of any run.
    turned = {"pin_ring_trilobe_angle": {"value": 0.3, "alike": 1.3, "unit": "rad"}}
    answer.model.file = replace(file, reducer=RV, effects={"pin_position_errors": turned})
    assert not telling_either(answer, CAMPAIGN)
    answer.model.file = replace(file, reducer=RV, effects={"pin_position_errors": turned, "crank_lobe_errors": {}})
    assert telling_either(answer, CAMPAIGN) == ["which of the two effects.pin_position_errors.ring_trilobe_angle is: no run within the limits tells that by itself"]


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
    ("pin_position_errors.runout", {"pin_ring_runout": 5e-6, "pin_ring_runout_angle": 0.7}, "40.11", "-139.89"),
    # Its lobes and hollows: half a turn on is sixty degrees on.
    ("pin_position_errors.trilobe", {"pin_ring_trilobe": 4e-6, "pin_ring_trilobe_angle": 0.7}, "40.11", "100.11"),
])  # fmt: skip
def test_a_ring_shows_as_well_what_is_on_its_other_side(turning, name, values, here, there):
    """One of the two was told, with an interval of half a degree."""
    (text,) = doubts(turning, name, values)
    assert f"_angle: it is in one of 2 places, which show the same: {here} or {there} deg" in text
    assert not doubts(turning, name, values, STOPPED)
    # No run of such a reducer tells; beside another effect one may.
    assert "no run of the reducer as a whole tells which of the two it is, for turned by half a turn it looks as it does; measure the ring itself" in text
    (beside,) = either_texts(told(turning, name, values), {}, turning.model.file, more=True)
    assert beside.endswith("; the runs that were fitted do not tell which of the two it is")


def test_an_oval_is_the_same_half_a_turn_on(turning):
    member = member_of(turning, "pin_position_errors.ovality", {"pin_ring_ovality": 4e-6, "pin_ring_ovality_angle": 0.7})
    assert not list(half_a_turn_on(member.candidates, member.fit.values))


def test_a_direction_is_told_with_all_places_where_it_may_be():
    """16.31 deg, 10.61 deg "which can be carried to the part", whole pitches from there and 76.3 deg stood in four places; the first was taken for a fact."""
    lobe = {"value": np.radians(16.3138), "alike": np.radians(76.3138), "direction": True, "meaning": "direction of one of the three lobes"}
    parameters = {"pin_ring_trilobe": {"value": 4e-6}, "pin_ring_trilobe_angle": lobe}
    (effect,) = seen_from_crank([{"name": "pin_position_errors", "parameters": parameters}], {"angle_zero[1]": np.radians(5.7)}, ModelFile(RV.name, RV))
    assert effect["parameters"]["pin_ring_trilobe_angle"]["meaning"] == (
        "direction of one of the three lobes; it is in one of 2 places, which show the same: 10.61 or 70.61 deg from crank 1 where mounting 1 shows angle 0, the way"
        " the output turns; that is 16.31 or 76.31 deg from pin 1, and any of the 40 pins may be pin 1"
    )
    assert effect["parameters"]["pin_ring_trilobe"] == {"value": 4e-6}
    # Where nothing was found that angles count from it counts from pin 1 alone, and an oval has no other side.
    (as_it_was,) = seen_from_crank([{"parameters": parameters}], {}, ModelFile(RV.name, RV))
    assert as_it_was["parameters"]["pin_ring_trilobe_angle"]["meaning"].endswith("2 places, which show the same: 16.31 or 76.31 deg")
    oval = {"pin_ring_ovality_angle": {"value": np.radians(-89.13), "direction": True, "meaning": "the long axis"}}
    assert seen_from_crank([{"parameters": oval}], {}, ModelFile(RV.name, RV)) == [{"parameters": oval}]
    (seen,) = seen_from_crank([{"parameters": oval}], {"angle_zero[1]": np.radians(5.7)}, ModelFile(RV.name, RV))
    assert seen["parameters"]["pin_ring_ovality_angle"]["meaning"].startswith("the long axis; -94.83 deg from crank 1 where mounting 1 shows angle 0")


def test_both_values_and_their_intervals_stand_side_by_side():
    entry = {"value": np.radians(16.3138), "interval": list(np.radians([16.18, 16.4476])), "alike": np.radians(76.3138), "unit": "rad", "direction": True}
    assert estimate_texts(entry) == ("16.31 or 76.31", "16.18 to 16.45 or 76.18 to 76.45", "deg")
    assert amounts.estimate(entry) == ("16.31 or 76.31", "16.18 to 16.45 or 76.18 to 76.45", "°")
    assert as_told.parameter(entry)["alike"] == pytest.approx(76.3138)
    seat = {"value": 7e-6, "interval": [6e-6, 9e-6], "alike": -7e-6, "unit": "m"}
    assert estimate_texts(seat) == ("7 or -7", "6 to 9 or -9 to -6", "um")


def test_a_pin_is_told_by_where_it_is_and_as_a_whole_number_with_those_that_look_alike():
    """19.002, 18.986 to 19.019, and apart from it from where pins count: which one to take out stood nowhere."""
    number = {"value": 19.00239, "interval": [18.98578, 19.019], "unit": "1", "meaning": "which pin is proud"}
    effect = {"candidates": ["pin_position_errors.proud"], "parameters": {"proud_pin": {"value": 6e-6}, "proud_pin_number": number}}
    file, zeros = ModelFile(RV.name, RV), {"angle_zero[1]": np.radians(5.7)}
    (seen,) = seen_from_crank([effect], zeros, file)
    told = seen["parameters"]["proud_pin_number"]
    assert seen["parameters"]["proud_pin"] == {"value": 6e-6} and told["value"] == 19.00239 and told["pins"] == [19, 39]
    where = "it is one of 2 pins, which show the same: 156.3 or 336.3 deg from crank 1 where mounting 1 shows angle 0, the way the output turns"
    assert told["meaning"] == f"{where}; the number counts from pin 1, and any of the 40 pins may be pin 1; which pin is proud"
    assert estimate_texts(told) == ("19 or 39", "19 or 39", "") and amounts.estimate(told) == ("19 or 39", "19 or 39", "")
    assert as_told.parameter(told)["value"] == 19.00239 and as_told.parameter(told)["pins"] == [19, 39]
    (left,) = either_texts([seen], zeros, file, more=False)
    assert where in left and left.endswith("turned from one to the other it looks as it does; measure these pins")
    assert either_texts([seen], zeros, file, more=True)[0].endswith("the runs that were fitted do not tell which of them it is")
    # An interval has the whole pins that it may be; a number between two lies there, with digits.
    assert estimate_texts({**told, "interval": [18.1, 19.6]})[1] == "18 to 20 or 38 to 40"
    (between,) = seen_from_crank([{"parameters": {"proud_pin_number": {"value": 19.4, "interval": [19.38, 19.42], "unit": "1"}}}], {}, file)
    assert estimate_texts(between["parameters"]["proud_pin_number"])[:2] == ("19.4 or 39.4", "19.38 to 19.42 or 39.38 to 39.42")
    # Nothing says where angles count from, and discs of which no turn brings one where another has stood.
    assert between["parameters"]["proud_pin_number"]["meaning"].endswith("165.6 or 345.6 deg from pin 1, the way the output turns")
    single = SimpleNamespace(reducer=SimpleNamespace(topology=replace(RV.topology, pins=41, lobes=40)))
    assert pins_in("proud_pin_number", 11.004, single.reducer) == {"pins": [11]} and either_texts([effect], {}, single, more=False) == []
