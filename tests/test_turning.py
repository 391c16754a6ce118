"""Angles that grow without end: sums that rounding does not move, and bodies in motion that leave whole turns out of their places."""

import math

import numpy as np
import pytest
from stand import in_motion, only, records_of, run_motion

from rv_plant import plant
from rv_plant.turning import TURN, add_turning

# Turns of the output in ten million steps of a 72nd of a crank turn.
LONG = 3565
FIGURES = ("drive_torque", "lag", "largest_pin_force", "largest_roller_force")


def figures(series):
    return np.array([[getattr(r, name) for name in FIGURES] for r in series])


def test_a_sum_of_many_turnings_is_exact_to_its_last_bit():
    turning, angle, rest, plain = 0.1 / 3.0, 2e4, 0.0, 2e4
    for _ in range(10_000):
        angle, rest = add_turning(angle, rest, turning)
        plain += turning
    exact = math.fsum([2e4, *[turning] * 10_000])
    assert angle == exact and abs(plain - exact) > 1e-9


def test_equilibria_do_not_drift_from_speed_times_time(rv20e):
    """Angles and forces after steps at a large angle are those of a plant that was started where exact sums lead."""
    start, count, duration = TURN * LONG, 2000, 1e-4 / 3.0
    records = records_of(rv20e.plant, ideal_output=start)
    assert plant.initialise(records) == 0
    for i in range(count):
        assert plant.step(records, i * duration, duration) == 0
    r = only(records)
    speed = float(r.input_speed) / 121.0
    turned = math.fsum([speed * duration] * count)
    assert math.fsum([r.ideal_output, r.ideal_output_rest, -start, -turned]) == pytest.approx(0.0, abs=1e-15)
    fresh = records_of(rv20e.plant, ideal_output=turned, cage=math.fsum([float(r.cage), float(r.cage_rest)]))
    assert plant.initialise(fresh) == 0
    np.testing.assert_allclose(figures([r]), figures([only(fresh)]), rtol=1e-8)


@pytest.mark.parametrize("ratio, drive", [(121.0, {}), (-39.0, {"first_stage_ratio": 0.0, "input_speed": -60.0})], ids=["sun", "crank"])
def test_motion_after_many_turns_is_that_of_the_first(rv20e, ratio, drive):
    """As many internal steps, the same forces; the places' rounding moved forces by 1e-4 and doubled the steps after ten times as many turns."""
    first, later = (run_motion(in_motion(rv20e.plant, ideal_output=TURN * turns, **drive), 0.05, 50) for turns in (0, LONG))
    assert [r.assemblies for r in later] == [r.assemblies for r in first]
    np.testing.assert_allclose(figures(later), figures(first), rtol=1e-7)
    for name, per_turn in (("input_angle", ratio), ("output_angle", 1.0), ("crank_angle", -39.0)):
        ahead = [getattr(b, name) - getattr(a, name) for a, b in zip(first, later)]
        np.testing.assert_allclose(ahead, per_turn * TURN * LONG, rtol=1e-12)


def test_nothing_jumps_where_motion_leaves_a_turn_out(rv20e):
    """Over half a turn of the output in steps, and in one step that leaves nothing out until it ends."""
    start = math.pi - 1e-3
    once = in_motion(rv20e.plant, ideal_output=start)
    steps, one = run_motion(once.copy().view(np.recarray), 0.002, 20), run_motion(once, 0.002, 1)
    assert steps[0].turns_left_out == 0.0 and steps[-1].turns_left_out == 1.0 and one[-1].turns_left_out == 0.0
    for name, speed in (("input_angle", 1.0), ("crank_angle", -39.0 / 121.0), ("output_angle", 1.0 / 121.0)):
        values = np.array([getattr(only(once), name), *(getattr(r, name) for r in steps)])
        ways = np.diff(values) / (speed * float(once["input_speed"][0]) * 1e-4)
        np.testing.assert_allclose(ways[1:], 1.0, atol=0.05, err_msg=name)
        assert values[-1] == pytest.approx(getattr(one[-1], name), rel=1e-9)
    np.testing.assert_allclose(figures(steps[-1:]), figures(one), rtol=2e-3)
