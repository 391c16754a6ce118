"""Where the input was locked is found in loops of which nobody says it, beside an effect that explains the transmission error."""

import math
from dataclasses import replace

import numpy as np
import pytest
from zero_campaign import REDUCER, written

from discrepancy.campaign.load import load_campaign
from discrepancy.held_names import LOCKED_AT
from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.over_torque import OverTorque
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.unstated_places import MOST_TURNS, UnstatedPlaces, fewer_samples, locked
from discrepancy.problem import Record
from reducers.reducer import load_reducer

ARCSEC = math.radians(1.0 / 3600.0)
TRILOBE = {"pin_ring_trilobe": 3e-6, "pin_ring_trilobe_angle": 0.9}
OVAL, PERIOD = frozenset({"pin_ring_trilobe"}), 2.0 * math.pi * 121.0 / 40.0
TORQUE = 167.0 * np.interp(np.linspace(0.0, 4.0, 61), np.arange(5.0), [0, 1, 0, -1, 0])


@pytest.fixture(scope="module")
def bench():
    return Bench(load_reducer("RV20E-121-rigid"), {})


def measured(bench, place, noise=0.2):
    """A loop [rad] whose input was locked at ``place`` [rad], of which it says nothing, and a transmission error that the effect explains."""
    record = Record("loop", "hysteresis", "rad", "c", 1, np.zeros(len(TORQUE)), {"torque": TORQUE}, {})
    turning = OverTorque(bench, record if place is None else locked(record, place)).directly(TRILOBE)
    error = Record("te", "transmission_error", "rad", "d", 1, np.ones(4), {"angle": np.arange(4.0)}, {})
    return replace(record, values=turning + noise * ARCSEC * np.random.default_rng(3).standard_normal(len(TORQUE))), error


def places_of(bench, place):
    loop, error = measured(bench, place)
    return loop, UnstatedPlaces([loop, error], 121.0 * 2.0 * math.pi, PERIOD)


def predicted(bench):
    return lambda record, place: OverTorque(bench, record if place is None else locked(record, place)).directly(TRILOBE)


def explained(record, which):
    return np.full(len(record.values), 0.9 if which else 0.0)


def test_the_place_is_found_to_a_few_degrees_of_the_input(bench):
    there = math.radians(700.0)
    loop, places = places_of(bench, there)
    assert places.placed(loop, OVAL, {}) is loop
    assert places.place(OVAL, {}, predicted(bench), explained)
    found = places.placed(loop, OVAL, {})
    left = found.values - OverTorque(bench, found).directly(TRILOBE)
    assert np.std(left) < 0.25 * ARCSEC
    # Turns of the cranks may look alike, and so do halves of one: discs change places.
    assert abs(math.remainder(found.factors[LOCKED_AT] - there, PERIOD / 2.0)) < math.radians(8.0)
    # Once found it stays, with further effects too; without any there is none.
    assert not places.are_elsewhere(OVAL, {}, predicted(bench))
    assert places.taken(OVAL | {"drag"}, {}) == places.taken(OVAL, {}) and places.placed(loop, frozenset(), {}) is loop


def test_a_place_that_was_fitted_is_not_left_for_what_a_search_sees(bench):
    """What a fit has moved it by counts from where it was seen; a search looks again only where it is far from there."""
    loop, places = places_of(bench, math.radians(700.0))
    [parameter] = places.parameters()
    assert places.place(OVAL, {}, predicted(bench), explained)
    [seen] = places.taken(OVAL, {}).values()
    near, far = {parameter.name: math.radians(5.0)}, {parameter.name: 3.0 * parameter.scale}
    assert places.placed(loop, OVAL, near).factors[LOCKED_AT] == seen + math.radians(5.0)
    assert not places.are_elsewhere(OVAL, near, predicted(bench)) and not places.place(OVAL, near, predicted(bench), explained)
    assert places.are_elsewhere(OVAL, far, predicted(bench)) and places.place(OVAL, far, predicted(bench), explained)
    assert abs(places.taken(OVAL, far)["c"] - seen) < math.radians(1.0)


def test_the_other_place_that_looks_alike_is_half_a_turn_of_the_cranks_on(bench):
    _, places = places_of(bench, math.radians(700.0))
    places.place(OVAL, {}, predicted(bench), explained)
    [there] = places.taken(OVAL, {}).values()
    other = places.half_a_turn_on(OVAL, {}, predicted(bench))
    [further] = places.taken(OVAL, other).values()
    assert abs(abs(math.remainder(further - there, PERIOD)) - PERIOD / 2.0) < places.step
    [limit] = [p.upper for p in places.parameters()]
    assert all(abs(moved) <= limit for moved in other.values())
    assert places.half_a_turn_on(frozenset(), {}, predicted(bench)) == {}


def test_other_turns_of_the_cranks_are_told_where_the_ring_makes_them_differ(bench):
    """Three lobes of a ring show nearly the same thirteen turns on, and half a one: the true place is among those that are looked at closely."""
    there = math.radians(700.0)
    loop, places = places_of(bench, there)
    places.found[OVAL] = {"c": there + 13.0 * PERIOD}
    turns = places.in_other_turns(OVAL, {}, predicted(bench))
    assert 1 < len(turns) <= MOST_TURNS
    assert min(abs(math.remainder(turn["c"] - there, 121.0 * 2.0 * math.pi)) for turn in turns) < math.radians(8.0)
    # Without an effect of the ring all turns are alike, and without a place there is none.
    plain = lambda record, place: OverTorque(bench, record if place is None else locked(record, place)).directly({})
    assert places.in_other_turns(OVAL, {}, plain) == [] == places.in_other_turns(frozenset(), {}, predicted(bench))


def test_the_same_effect_at_another_part_is_tried_with_the_places_of_the_first(bench):
    """Which place was found beside one lobe holds for the other, which looks alike: else its loops are means over positions, and look like nothing."""
    loop, places = places_of(bench, math.radians(700.0))
    places.place(OVAL, {}, predicted(bench), explained)
    other = frozenset({"at another part"})
    with places.tried(other, OVAL):
        assert places.taken(other, {}) == places.taken(OVAL, {}) != {}
        [there], [further] = (places.taken(other, values).values() for values in ({}, places.other({})))
        assert further - there == pytest.approx(PERIOD / 2.0)
    assert places.taken(other, {}) == {}


def test_a_mean_over_positions_has_no_place(bench):
    loop, places = places_of(bench, None)
    assert not places.place(OVAL, {}, predicted(bench), explained)
    assert places.placed(loop, OVAL, {}) is loop


def test_nothing_is_looked_for_beside_what_explains_no_transmission_error(bench):
    _, places = places_of(bench, 0.0)
    assert not places.place(OVAL, {}, predicted(bench), lambda record, which: np.zeros(len(record.values)))


def test_what_is_stated_is_not_looked_for(bench):
    loop, error = measured(bench, 0.0)
    for stated in (locked(loop, 1.0), replace(loop, of_positions=True), replace(loop, tags={"locked": "output"})):
        assert not UnstatedPlaces([stated, error], 1.0, 1.0).loops


def test_the_samples_that_are_looked_at_keep_where_torque_turns():
    torque = 100.0 * np.sin(np.linspace(0.0, 4.0 * np.pi, 997))
    few = fewer_samples(Record("l", "hysteresis", "rad", "c", 1, np.arange(997.0), {"torque": torque}, {}))
    assert len(few.values) < 60 and few.axes["torque"].max() == torque.max() and few.axes["torque"].min() == torque.min()
    assert np.array_equal(torque[few.values.astype(int)], few.axes["torque"])


def test_effects_of_a_model_file_itself_tell_the_place(tmp_path):
    """What ``extend`` wrote is held against the loops as the diagnosis was."""
    folder = written(tmp_path, loop=True)
    stated = (folder / "campaign.toml").read_text()
    (folder / "campaign.toml").write_text(stated.replace('locked_at = "0 deg"', ""))
    extended = tmp_path / "better.toml"
    extended.write_text(f'[model]\nname = "better"\nreducer = "{REDUCER}"\n\n[effects.disc_tooth_errors]\nrunout = "6 um"\nrunout_angle = "0.4 rad"\n')
    campaign = load_campaign(folder)
    plain, better = (PhysicalModel(load_model(name), campaign) for name in (REDUCER, extended))
    assert plain.unstated_places.taken(frozenset(), {}) == {}
    [place] = better.unstated_places.taken(frozenset(), {}).values()
    # It counts from the encoder's 0; discs change places with half a turn of the cranks.
    assert abs(math.remainder(place, PERIOD / 2.0)) < math.radians(8.0)
    [loop] = [r for r in better.records if r.quantity == "hysteresis"]
    [found] = better.predict(better.standing(), [better.records.index(loop)])
    assert np.std(found - loop.values) < 1.0 * ARCSEC
