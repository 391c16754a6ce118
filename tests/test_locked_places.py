"""Where inputs were locked follows the zero that an effect is found with."""

import math

import numpy as np
import pytest
from zero_campaign import ARCSEC, HIDDEN, REDUCER, written

from discrepancy.campaign.load import load_campaign
from discrepancy.held_names import LOCKED_AT
from discrepancy.model_file import load_model
from discrepancy.prediction.locked_places import NEAR, LockedPlaces
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record

RATIO, ZERO, NAME = 121.0, 0.012, "angle_zero[1]"
NOTHING, OVAL = frozenset(), frozenset({"ovality"})
FACTORS = {LOCKED_AT: math.pi / 2.0, "load": 100.0}


def loop(**more):
    return Record("loop", "hysteresis", "rad", "c", 1, np.zeros(4), {"torque": np.arange(4.0)}, **{"factors": FACTORS, **more})


def test_a_zero_that_moves_takes_the_place_along():
    record = loop()
    places = LockedPlaces([record], {NAME: ZERO}, -RATIO)
    assert places.placed(record, OVAL) is record
    assert places.place(OVAL, {NAME: ZERO + 0.003})
    moved = places.placed(record, OVAL)
    assert moved.factors == {LOCKED_AT: pytest.approx(math.pi / 2.0 + 0.003 * RATIO), "load": 100.0}
    # The same one each time, for what is kept of it; without the effect it stays.
    assert places.placed(record, OVAL).factors == moved.factors
    assert places.placed(record, NOTHING) is record


def test_rows_with_places_of_their_own_move_too():
    record = Record("k", "torsional_stiffness", "N.m/rad", "c", 1, np.zeros(3), {LOCKED_AT: np.array([0.0, 1.0, 2.0])}, {})
    places = LockedPlaces([record], {NAME: 0.0}, RATIO)
    places.place(OVAL, {NAME: 0.01})
    np.testing.assert_allclose(places.placed(record, OVAL).axes[LOCKED_AT], np.array([0.0, 1.0, 2.0]) + 0.01 * RATIO)


def test_further_effects_stand_where_the_most_of_them_do():
    record = loop()
    places = LockedPlaces([record], {NAME: 0.0}, RATIO)
    places.place(NOTHING, {NAME: 0.001})
    places.place(OVAL, {NAME: 0.004})
    assert places.taken(OVAL | {"drag"}) == {NAME: 0.004}
    assert places.taken(frozenset({"drag"})) == {NAME: 0.001}


def test_what_hardly_moves_stays():
    record = loop()
    places = LockedPlaces([record], {NAME: 0.0}, RATIO)
    assert not places.place(OVAL, {NAME: 0.5 * NEAR / RATIO})
    assert places.are_elsewhere(OVAL, {NAME: 2.0 * NEAR / RATIO})


@pytest.mark.parametrize("record", [loop(factors={}), loop(mounting="2")], ids=["at no place", "of another mounting"])
def test_what_counts_from_nowhere_stays(record):
    places = LockedPlaces([record], {NAME: 0.0}, RATIO)
    assert not places.place(OVAL, {NAME: 0.1})
    assert places.placed(record, OVAL) is record


def test_closely_the_place_follows_the_values_without_being_taken():
    record = loop()
    places = LockedPlaces([record], {NAME: ZERO}, -RATIO)
    there = {NAME: ZERO + 0.1 * NEAR / RATIO}
    assert places.placed(record, OVAL, there).factors[LOCKED_AT] == pytest.approx(math.pi / 2.0 + 0.1 * NEAR, rel=1e-12)
    # Of the base model, and where values say nothing of the zero, it stays.
    assert places.placed(record, NOTHING, there) is record
    assert places.placed(record, OVAL, {"disc_runout": 6e-6}) is record


def test_loops_move_with_the_zero_of_a_fit_beside_an_effect(tmp_path):
    """A zero that loops do not feel holds the effect where they were placed."""
    model = PhysicalModel(load_model(REDUCER), load_campaign(written(tmp_path, loop=True)))
    [held] = [i for i, r in enumerate(model.records) if r.quantity == "hysteresis"]
    here = {**HIDDEN, NAME: model.zeros[NAME]}
    there = {**here, NAME: model.zeros[NAME] + 0.5 * NEAR / model.bench.ratio}
    moved = model.predict(there, [held])[0] - model.predict(here, [held])[0]
    assert np.std(moved) > 0.01 * ARCSEC
    [beside], [base] = model.predict_beside(there, here, [held]), model.predict_beside(here, here, [held])
    # Slopes go the way by long steps of torque.
    assert np.std(beside - base - moved) < 0.5 * np.std(moved)
    # A search leaves them.
    assert np.array_equal(model.predict_roughly(there, [held])[0], model.predict_roughly(here, [held])[0])
