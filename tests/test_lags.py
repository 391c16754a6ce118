"""What an effect adds to the output's lag moves the samples of an encoder there, whatever the load."""

import numpy as np
import pytest

from discrepancy.prediction.by_effects import with_most
from discrepancy.prediction.conditions import LAG_SHARE, angle_zero, lag_added, zero_of
from discrepancy.prediction.lags import NEAR, Lags
from discrepancy.problem import Record

NOTHING, CLEARANCE = frozenset(), frozenset({"clearance"})


class Bench:
    """Lags by its load, and by its clearance."""

    ratio, rated_speed, rated_load, zeros = 121.0, 100.0, 167.0, {}

    def average(self, name, condition, values):
        assert name == "transmission_error"
        return -1e-6 * condition.load - 20.0 * values.get("clearance", 0.0)

    def lag(self, condition):
        return self.average("transmission_error", condition, {})


def record(load=100.0, of_output=True):
    angle = np.linspace(0.0, 1.0, 5)
    return Record("r", "transmission_error", "rad", f"at {load:g}", 1, np.zeros(5), {"angle": angle}, {"load": load}, of_output=of_output)


def test_a_clearance_adds_the_same_at_any_load():
    low, high = record(40.0), record(160.0)
    lags = Lags(Bench(), [low, high])
    assert lags.taken(CLEARANCE) == {}
    assert lags.place(CLEARANCE, {"clearance": 3e-6})
    assert lags.taken(CLEARANCE) == {lag_added(low): pytest.approx(-6e-5), lag_added(high): pytest.approx(-6e-5)}
    assert lags.taken(NOTHING) == {} and lags.taken(CLEARANCE | {"drag"}) == lags.taken(CLEARANCE)
    # What is near stays.
    assert not lags.place(CLEARANCE, {"clearance": 3e-6 + 0.4 * NEAR / 20.0})
    assert lags.are_elsewhere(CLEARANCE, {"clearance": 3e-6 + 2.0 * NEAR / 20.0})


def test_samples_of_an_encoder_on_the_output_are_placed_by_it():
    values = {angle_zero(record()): 0.01, LAG_SHARE: 1.2, lag_added(record()): -6e-5}
    assert zero_of(Bench(), record(), values) == pytest.approx(0.01 + 1.2 * (1e-4 + 6e-5))
    assert zero_of(Bench(), record(of_output=False), values) == 0.01


def test_angles_of_the_input_have_no_lag():
    lags = Lags(Bench(), [record(of_output=False)])
    assert not lags.place(CLEARANCE, {"clearance": 3e-6})


def test_of_several_sets_that_with_the_most_effects():
    found = {NOTHING: 0, CLEARANCE: 1, CLEARANCE | {"play"}: 2}
    assert [with_most(found, CLEARANCE | more, -1) for more in (NOTHING, {"drag"}, {"drag", "play"})] == [1, 1, 2]
    assert with_most({CLEARANCE: 1}, frozenset({"drag"}), -1) == -1
