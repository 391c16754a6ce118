"""Where the roller cages stood is found in loops at one locked place, and nothing of it in means over many."""

import math
from dataclasses import replace

import numpy as np
import pytest

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.cages import Cages, tells
from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.over_torque import OverTorque
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from fmu_src.threads import Threads
from reducers.reducer import load_reducer

CLEARANCE = {"needle_clearance_added": 3e-6}
ARCSEC = math.radians(1.0) / 3600.0
# Of the pitch of the rollers, and what one sample of the loops has for noise.
SHARE, NOISE = 0.37, 0.03 * ARCSEC


@pytest.fixture(scope="module")
def bench():
    return Bench(load_reducer("RV20E-121"), {})


@pytest.fixture(scope="module")
def pitch(bench):
    return bench.reducer.topology.roller_pitch


@pytest.fixture(scope="module")
def loop(bench, pitch):
    """A loop of 3 um more clearance at one place, its cages ``SHARE`` of a pitch ahead."""
    torque = bench.rated_load * np.interp(np.linspace(0.0, 4.0, 121), np.arange(5.0), [1.0, 0.0, -1.0, 0.0, 1.0])
    torque = torque[np.abs(torque) > 0.02 * bench.rated_load]
    record = Record("loop", "hysteresis", "rad", "a", 1, np.zeros(len(torque)), {"torque": torque}, {"locked_at": math.radians(50.0)})
    curve = OverTorque(bench, record, cage=SHARE * pitch)
    noise = NOISE * np.random.default_rng(5).standard_normal(len(torque))
    return replace(record, values=curve.directly(CLEARANCE) + noise)


def left(bench, loop, ripple):
    """Standard deviation [arcsec] of what a loop leaves with a ripple."""
    return float(np.std(loop.values - OverTorque(bench, loop).directly(CLEARANCE) - ripple)) / ARCSEC


def test_a_loop_at_one_place_tells_where_its_cages_stood(bench, pitch, loop):
    bench.fineness = Fineness([loop])
    cages = Cages(bench, [loop], lambda record, values: (record, dict(values)), Threads())
    assert cages.place(CLEARANCE)
    ripple = cages.ripple(loop, CLEARANCE)
    truth = OverTorque(bench, loop, cage=SHARE * pitch).directly(CLEARANCE) - OverTorque(bench, loop).directly(CLEARANCE)
    # They change the loop by more than its noise; found, nothing but noise is left, of which the place takes a little.
    assert left(bench, loop, 0.0) > 3.0 * NOISE / ARCSEC
    assert left(bench, loop, ripple) == pytest.approx(NOISE / ARCSEC, rel=0.15)
    assert np.std(ripple - truth) < 0.1 * np.std(truth)


def test_cages_stand_again_where_they_stood_a_pitch_before(bench, pitch):
    torques = bench.rated_load * np.array([0.25, 0.5, 1.0, -0.5, -1.0])
    at = Condition(bench.rated_speed, bench.rated_load, locked_at=0.001)
    here, there, between = (bench.held(replace(at, cage=share * pitch), {}, torques) for share in (0.0, 1.0, 0.5))
    assert there == pytest.approx(here, abs=1e-5 * ARCSEC)
    assert np.abs(between - here).max() > 0.02 * ARCSEC


def test_a_mean_over_positions_tells_nothing_of_cages(loop):
    assert tells(loop)
    assert not tells(replace(loop, factors={}))
    assert not tells(replace(loop, tags={"locked": "output"}))
    assert not tells(replace(loop, values=loop.values[:10], axes={"torque": loop.axes["torque"][:10]}))
