"""Natural frequencies: closed forms, scaling, and the free oscillation of the moving plant."""

import math

import numpy as np
import pytest

from orchestrator.settings import parse_setting
from studies.modes import modes
from studies.solve import ARCMIN


def run(reducer, *texts):
    return modes(reducer, [parse_setting(t, [reducer.plant]) for t in texts])


def test_load_on_a_soft_shaft_is_a_simple_oscillator(rv20e):
    found = run(rv20e, "effects.support_compliance.carrier_compliance=1e-4", "load.inertia=2")
    # The shaft is 150 times softer than the reducer behind it, which adds its own compliance.
    shaft = math.sqrt(1e4 / 2.0) / (2 * math.pi)
    assert found[0].frequency_Hz == pytest.approx(shaft, rel=0.01)
    assert found[0].frequency_Hz < shaft
    assert found[0].energy_share["load"] == pytest.approx(1.0, abs=1e-3)


def test_frequency_goes_with_the_root_of_the_load_inertia(rv20e):
    light, heavy = run(rv20e, "load.inertia=5"), run(rv20e, "load.inertia=20")
    assert light[0].frequency_Hz == pytest.approx(2 * heavy[0].frequency_Hz, rel=1e-3)


def test_lowest_mode_follows_the_tangent_stiffness(rv20e):
    stiffness = (2 * math.pi * run(rv20e)[0].frequency_Hz) ** 2 * 5.0 / ARCMIN
    # Secant stiffness between half and full torque is 382 N m/arcmin at the cranks, 395 at the sun; the tangent more.
    assert 395.0 < stiffness < 460.0


def test_shares_add_up_and_damping_is_that_of_greased_contacts(rv20e):
    found = run(rv20e)
    assert np.all(np.diff([m.frequency_Hz for m in found]) >= 0.0)
    for mode in found:
        assert sum(mode.energy_share.values()) == pytest.approx(1.0, rel=1e-9)
    # Published for meshes of reducers: 0.02 to 0.07.
    assert all(0.005 < m.damping_ratio < 0.1 for m in found[1:])


def test_without_damping_no_mode_is_damped(rv20e):
    for mode in run(rv20e, "contact.damping_law=none", "contact.joint_damping_time=0"):
        assert mode.damping_ratio == pytest.approx(0.0, abs=1e-9)
