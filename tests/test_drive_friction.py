"""Friction of a drive with locked output: against the closed form for a linear spring, and what a model without it shows."""

import numpy as np
import pytest

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.candidates import candidates
from discrepancy.prediction.observe import hysteresis
from discrepancy.problem import Record
from reducers.reducer import load_reducer
from rv_plant.locked_output import ELEMENTS, locked_output_loop

COMPLIANCE = 3e-3
RAMP = np.concatenate([np.linspace(0, 4, 200), np.linspace(4, -4, 400), np.linspace(-4, 0, 200)])


def loop(friction, share, presliding=1e-6):
    torques = np.linspace(-6.0, 6.0, 41)
    found, sliders = np.zeros(len(RAMP)), np.zeros(ELEMENTS)
    for _ in range(2):
        locked_output_loop(COMPLIANCE * torques, torques, RAMP, friction, share, presliding, sliders, found)
    return found


@pytest.mark.parametrize("friction, share", [(0.7, 0.0), (0.0, 0.2), (0.5, 0.3)])
def test_both_branches_of_a_linear_spring(friction, share):
    found = loop(friction, share)
    # Driving, friction adds to the spring's torque; driven back, it takes from it.
    assert found[199] == pytest.approx(COMPLIANCE * (4.0 - friction) / (1.0 + share), rel=1e-3)
    way_back = int(np.argmin(np.abs(RAMP[200:600]))) + 200
    assert found[way_back] == pytest.approx(COMPLIANCE * (RAMP[way_back] + friction) / (1.0 - share), abs=2e-5)


def test_the_loop_closes_and_turning_stands_at_reversal():
    found = loop(1.0, 0.1, 1e-4)
    assert found[0] == pytest.approx(found[-1], abs=1e-6)
    # Just after the reversal only the elastic elements give way.
    assert abs(found[220] - found[199]) < 0.1 * COMPLIANCE * abs(RAMP[220] - RAMP[199])


def record(locked):
    return Record("ramp", "hysteresis", "rad", "a", 1, np.zeros(len(RAMP)), {"torque": RAMP}, {"direction": 1.0},
                  tags={"locked": locked})  # fmt: skip


def test_play_is_a_step_at_no_torque_and_friction_delays_it():
    bench = Bench(load_reducer("cycloidal-actuator"), {"equidistant_modification": 0.0, "output_clearance": 0.0})
    free, tight = (hysteresis(bench, record("output"), {"output_play": p}) for p in (2e-4, 0.0))
    assert np.ptp(free) - np.ptp(tight) == pytest.approx(2 * 2e-4 / 20e-3, rel=0.06)
    held = hysteresis(bench, record("output"), {"output_play": 2e-4, "drive_friction": 1.0, "drive_presliding": 1e-5})
    step = RAMP[200:600][np.argmin(np.diff(held[200:601]))]
    assert step == pytest.approx(-1.0, abs=0.1)


def test_only_drives_that_can_show_them_have_these_candidates():
    def names(locked, pins):
        return {c.name for c in candidates([record(locked)], {}, set(), [], pins)}

    new = {"drive_friction", "output_play"}
    assert names("output", 8) >= new
    assert not names("input", 0) & new
    assert names("input", 8) & new == {"output_play"}


def test_a_declared_nuisance_of_the_measuring_chain_is_no_candidate():
    found = {c.name for c in candidates([record("output")], {}, {"sensor_gain[hysteresis]"}, [], 8)}
    assert "sensor_gain.hysteresis" not in found and "sensor_drift.hysteresis" in found
