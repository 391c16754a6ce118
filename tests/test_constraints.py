"""The two formulations of the joints: springs and constraints with multipliers."""

import numpy as np
import pytest

from orchestrator.settings import parse_setting
from studies.pair import make_pair
from studies.solve import record_turn


def turn(reducer, *texts, positions=72):
    settings = [parse_setting(t, [reducer.plant]) for t in ("fidelity=dynamic", *texts)]
    pair = make_pair(reducer, settings)
    pair.master.run(36)
    return record_turn(pair, positions), pair.plant


@pytest.mark.parametrize("name", ["rv20e", "bx40e"])
def test_formulations_agree_where_joints_are_rigid(name, request):
    reducer = request.getfixturevalue(name)
    springs, _ = turn(reducer)
    constraints, plant = turn(reducer, "numerics.joints=constrained")
    # Springs of 1e12 N/m give way by a few nm: 0.05 % of the lag.
    assert constraints["lag"] == pytest.approx(springs["lag"], rel=0.005)
    assert constraints["largest_pin_force"] == pytest.approx(springs["largest_pin_force"], rel=0.01)
    assert constraints["largest_roller_force"] == pytest.approx(springs["largest_roller_force"], rel=0.01)
    assert abs(plant.get("energy_error")) < 1e-3


def test_constraints_drift_less_than_a_nanometre(rv20e):
    _, plant = turn(rv20e, "numerics.joints=constrained")
    assert 0.0 < plant.get("constraint_drift") < 1e-9


def test_stabilisation_is_what_holds_the_drift(rv20e):
    _, held = turn(rv20e, "numerics.joints=constrained")
    _, free = turn(rv20e, "numerics.joints=constrained", "numerics.baumgarte_rate=0")
    assert held.get("constraint_drift") < free.get("constraint_drift")


def test_multipliers_are_the_joints_forces(rv20e):
    """On average the seats carry the output torque (with the teeth's share), the ring T (1 - 1/121)."""
    _, plant = turn(rv20e, "numerics.joints=constrained", "input.speed=50rpm")
    multiplier = plant.record()["multiplier"][0]
    torque = 0.0
    record = plant.record()
    carrier = 6
    for crank in range(2):
        x, y = record["q"][0][carrier + 3 + 3 * crank], record["q"][0][carrier + 4 + 3 * crank]
        torque += x * multiplier[2 * crank + 1] - y * multiplier[2 * crank]
    assert abs(torque) == pytest.approx(167.0, rel=0.01)
    assert abs(multiplier[6]) == pytest.approx(167.0 * (1 - 1 / 121), rel=0.01)
    assert plant.get("reaction_torque") == pytest.approx(167.0 * (1 - 1 / 121), rel=0.01)
    assert np.abs(multiplier[4:6]).max() < 50.0
