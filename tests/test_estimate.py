"""RvReducer's estimate of lost motion and remaining life by inspections."""

import numpy as np
import pytest
from test_reducer_unit import make_unit, run

from rv_reducer import estimate
from studies.pair import crank_turn_time

RATE, NOISE, HOUR = 6e-12, 1e-6, 3600.0
STATES = tuple(v.name for v in estimate.variables() if v.role in ("output", "state"))


def records(**given):
    """A record of the filter's cells, as its kernels see them."""
    cells = {
        "lost_motion": 2e-4, "lost_motion_limit": 3e-4, "operating_time": 0.0, "own_rate": 0.0, "measured_lost_motion": 0.0, "expected_rate": RATE,
        "rate_deviation": 0.8, "rate_drift": 0.0, "reading_noise": NOISE, **dict.fromkeys(STATES, 0.0), **given,
    }  # fmt: skip
    found = np.zeros(1, [(name, float) for name in cells]).view(np.recarray)
    for name, value in cells.items():
        found[name] = value
    return found


def inspected(r, hours, value):
    r["operating_time"], r["measured_lost_motion"] = hours * HOUR, value
    estimate.estimate(r[0])


def test_filter_is_least_squares():
    """Without drift the filter's level and rate are those of a straight line through all readings, with what was known before as further readings."""
    r = records(measured_lost_motion=2.1e-4)
    estimate.start_estimate(r[0])
    hours, values = np.array([0.0, 500.0, 1200.0, 3000.0]), np.array([2.1e-4, 2.27e-4, 2.55e-4, 3.1e-4])
    for t, v in zip(hours[1:], values[1:]):
        inspected(r, t, v)
    design = np.vstack([np.column_stack([np.ones(4), hours * HOUR]) / NOISE, [[1.0 / (0.3 * 2e-4), 0.0], [0.0, 1.0 / (0.8 * RATE)]]])
    seen = np.concatenate([values / NOISE, [2e-4 / (0.3 * 2e-4), 1.0 / 0.8]])
    level, rate = np.linalg.lstsq(design * [1.0, RATE], seen, rcond=None)[0] * [1.0, RATE]
    assert r["estimated_rate"][0] == pytest.approx(rate, rel=1e-6)
    assert r["estimated_lost_motion"][0] == pytest.approx(level + rate * 3000.0 * HOUR, rel=1e-6)
    assert r["estimated_remaining"][0] == 0.0 and r["rate_variance"][0] > 0.0


def test_between_readings_it_goes_on_and_an_old_reading_counts_once():
    r = records(measured_lost_motion=2.1e-4)
    estimate.start_estimate(r[0])
    before = r["level_variance"][0]
    inspected(r, 1000.0, 2.1e-4)
    assert r["estimated_lost_motion"][0] == pytest.approx(2.1e-4 + RATE * 1000.0 * HOUR, rel=1e-3) and r["level_variance"][0] > before
    assert r["estimated_remaining"][0] == pytest.approx((3e-4 - r["estimated_lost_motion"][0]) / RATE)


def test_without_a_rate_estimates_are_those_of_the_unit(rv20e):
    unit = make_unit(rv20e, acceleration=1e6)
    run(unit, 144, crank_turn_time(rv20e, unit) / 72)
    assert unit.get("estimated_lost_motion") == unit.get("lost_motion")
    assert 0.0 < unit.get("estimated_remaining") <= estimate.LONGEST_LIFE


def test_a_reading_reaches_the_unit(rv20e):
    unit = make_unit(rv20e, acceleration=1e6, expected_rate=RATE, measured_lost_motion=2.5e-4)
    step = crank_turn_time(rv20e, unit) / 72
    run(unit, 1, step)
    assert unit.get("estimated_lost_motion") == pytest.approx(2.5e-4, rel=1e-3)
    unit.set("measured_lost_motion", 3.2e-4)
    run(unit, 150, step, start=1)
    # The filter does not believe in all of so sudden a growth.
    assert 2.6e-4 < unit.get("estimated_lost_motion") < 3.2e-4
    assert unit.get("estimated_remaining") < (unit.get("lost_motion_limit") - 2.5e-4) / RATE
