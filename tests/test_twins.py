"""Conditions that show the same are computed once, and never where an effect tells them apart."""

from dataclasses import replace

import numpy as np
import pytest

from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.cage_ripples import cage_ripples
from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.held import HELD_ANGLES
from discrepancy.prediction.lives import SHORT_CYCLE
from discrepancy.prediction.over_angle import OverAngle
from discrepancy.prediction.twins import Twins, corners, places_of
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from studies.coupled import COLUMNS

COLD = Condition(209.44, 60.0)
WARM, SLOW, LOADED = replace(COLD, temperature=333.15), replace(COLD, speed=50.0), replace(COLD, load=120.0)
ANGLES = np.linspace(0.0, 0.4, 30)
WAY = 167.0 * np.concatenate([np.linspace(0.1, 1.0, 8), np.linspace(1.0, -1.0, 16)])
EXPANDING, STICKING = {"thermal_expansion": 2e-6}, {"friction_coefficient": 0.01, "presliding_angle": 1e-6}
ERROR, TORQUE = "transmission_error", "drive_torque"


@pytest.fixture
def bench():
    return Bench(load_model("RV20E-121-rigid").reducer, {})


def runs_of(bench, kind):
    """Conditions of which a whole run was made."""
    return {key[1] for key in bench.runs.found if key[0] == kind}


@pytest.mark.parametrize("values", [{}, {"disc_ovality": 1e-6}], ids=["plain", "oval discs"])
def test_what_temperature_and_speed_do_not_show_is_computed_once(bench, values):
    cold, warm, slow = (bench.column(ERROR, c, values, ANGLES) for c in (COLD, WARM, SLOW))
    assert np.array_equal(cold, warm) and np.array_equal(cold, slow)
    assert runs_of(bench, "running") == {COLD}
    # And that is what they would have shown.
    for condition in (WARM, SLOW):
        own = bench.running(condition, values, ANGLES)[:, COLUMNS.index(ERROR)]
        assert np.abs(own - cold).max() < 1e-5 * np.ptp(cold)


@pytest.mark.parametrize("values, other, column", [
    (EXPANDING, WARM, ERROR), ({"thermal_expansion": 1e-10}, WARM, ERROR), ({"churning_torque": 0.01}, SLOW, TORQUE), ({}, LOADED, ERROR),
])  # fmt: skip
def test_what_an_effect_shows_is_computed_for_itself(bench, values, other, column):
    first, second = (bench.column(column, c, values, ANGLES) for c in (COLD, other))
    assert not np.array_equal(first, second)
    assert np.array_equal(second, bench.running(other, values, ANGLES)[:, COLUMNS.index(column)])


def test_each_column_is_asked_for_itself(bench):
    """Where speed shows in the torque alone, the error still repeats."""
    values = {"churning_torque": 0.01}
    errors = [bench.column(ERROR, c, values, ANGLES) for c in (COLD, SLOW)]
    torques = [bench.column(TORQUE, c, values, ANGLES) for c in (COLD, SLOW)]
    assert np.array_equal(*errors) and not np.array_equal(*torques)


def test_sensitivities_repeat_like_their_runs(bench):
    step = {"disc_ovality": 1e-8}
    for values, shared in ((step, True), ({"thermal_expansion": 1e-8}, False)):
        cold, warm = (bench.error_beside(c, values, ANGLES, {}, ANGLES) for c in (COLD, WARM))
        assert np.array_equal(cold, warm) is shared
        fresh = Bench(bench.reducer, {})
        assert np.abs(fresh.error_beside(WARM, values, ANGLES, {}, ANGLES) - warm).max() < 1e-6 * np.ptp(warm)


@pytest.mark.parametrize("values, shared", [({}, True), (STICKING, True), ({"friction_coefficient": 0.01, **EXPANDING}, False)])
def test_loops_repeat_over_the_temperature(bench, values, shared):
    cold, warm = (bench.held(c, values, WAY) for c in (COLD, WARM))
    assert np.array_equal(cold, warm) is shared
    assert (WARM in runs_of(bench, "held")) is not shared
    own = bench.held_places(WARM, values, WAY, HELD_ANGLES, SHORT_CYCLE)[0].mean(axis=0)
    assert np.abs(own - warm).max() < 1e-6 * np.ptp(warm)


def test_loops_to_first_order_repeat(bench):
    for values, shared in (({"disc_ovality": 1e-8}, True), ({"thermal_expansion": 1e-8}, False)):
        cold, warm = (bench.held_beside(c, values, WAY, {}) for c in (COLD, WARM))
        assert np.array_equal(cold, warm) is shared


def test_worn_reducers_have_no_twins():
    asked = []
    twins = Twins()
    for condition in (COLD, WARM):
        old = replace(condition, hours=3.6e6)
        assert twins.of("run", old, places_of(100), lambda other, places: asked.append(other) or True) == old
    assert not asked


def recorded(bench, noise):
    angle = np.linspace(0.0, 2.0 * np.pi, 360, endpoint=False)
    rng = np.random.default_rng(3)
    record = Record("te", ERROR, "rad", "te", 1, noise * rng.standard_normal(360), axes={"angle": angle},
                    factors={"speed": COLD.speed, "load": COLD.load, "temperature": COLD.temperature}, mounting="1")
    bench.fineness = Fineness([record])
    return record


def test_zeros_near_each_other_share_a_run(bench):
    record = recorded(bench, 3e-6)
    curve = OverAngle(bench, record, ERROR)
    distance = curve.anchors()
    zeros = distance * np.array([-0.45, 0.1, 0.3, 0.48])
    before = len(bench.runs.found)
    found = [curve.directly({"angle_zero[1]": zero}) for zero in zeros]
    assert len(bench.runs.found) == before
    for zero, curve_there in zip(zeros, found):
        exact = bench.running(COLD, {}, record.axes["angle"] + zero)[:, COLUMNS.index(ERROR)]
        assert np.std(exact - curve_there) < 0.5 * bench.allowed(record)


def test_anchors_stand_closer_where_noise_is_less(bench):
    loud = OverAngle(bench, recorded(bench, 3e-6), ERROR).anchors()
    other = Bench(bench.reducer, {})
    assert OverAngle(other, recorded(other, 1e-6), ERROR).anchors() < 0.5 * loud
    # Where hardly anything may be missed every zero has its own run.
    still = Bench(bench.reducer, {})
    assert OverAngle(still, recorded(still, 1e-9), ERROR).anchors() == 0.0


@pytest.mark.parametrize("noise", [1e-5, 1e-8])
def test_ripple_of_the_cages_errs_less_than_noise_shows(bench, noise):
    record = recorded(bench, noise)
    pitch = bench.reducer.topology.roller_pitch
    [found] = cage_ripples(bench, record, {}, [0.5 * pitch])
    exact, there = (bench.running(COLD, {}, record.axes["angle"], cage)[:, COLUMNS.index(ERROR)] for cage in (0.5 * pitch, 0.0))
    error = np.std(found - (exact - there))
    assert error < bench.allowed(record)
    assert error < 0.5 * np.std(exact - there)
    if noise < 1e-7:
        assert error < 1e-12


def test_forces_on_the_housing_repeat_but_for_unbalance(bench):
    """They cancel to rounding, which is no difference; unbalance goes with the speed."""
    for values, shared in (({"disc_ovality": 1e-6}, True), ({"unbalance": 1e-5}, False)):
        rated, slow = (bench.column("housing_force_x", c, values, ANGLES) for c in (COLD, SLOW))
        assert np.array_equal(rated, slow) is shared


MANY = [replace(COLD, speed=speed, temperature=temperature) for speed in (50.0, 100.0, 150.0, 209.44) for temperature in (293.15, 313.15, 333.15)]


def test_means_between_conditions_that_agree_are_theirs(bench):
    bench.plan(MANY)
    inner = replace(COLD, speed=100.0, temperature=313.15)
    for values, computed in (({"disc_ovality": 2e-6}, 4), ({"seal_torque": 0.05}, 4), ({"friction_viscous": 0.3}, 12), ({"thermal_expansion": 2e-6}, 12)):
        for condition in MANY:
            bench.average("drive_torque", condition, values)
        relevant = bench.relevant(values, False)
        assert len({key[1] for key in bench.runs.found if key[0] == "means" and key[2] == relevant}) == computed, values
        fresh = Bench(bench.reducer, {})
        assert bench.average("drive_torque", inner, values) == pytest.approx(fresh.average("drive_torque", inner, values), rel=1e-7)


def test_corners_are_those_of_the_same_load_around_a_condition():
    inner = replace(COLD, speed=100.0, temperature=313.15)
    assert {(c.speed, c.temperature) for c in corners(inner, [*MANY, LOADED])} == {(50.0, 293.15), (50.0, 333.15), (209.44, 293.15), (209.44, 333.15)}
    for outside in (replace(inner, speed=300.0), replace(inner, load=120.0), replace(inner, hours=1.0), MANY[0]):
        assert corners(outside, MANY) == []
    assert corners(inner, MANY[:4]) == []
