"""Damping of a contact: closed forms, derivatives, no pull, no force at rest, restitution of an impact."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from rv_plant.contact import (
    HYSTERETIC,
    MODAL,
    NO_DAMPING,
    SLOWEST_IMPACT,
    STEP,
    contact_force,
    damped_force,
    impact_speed,
)

K, N, DEPTH, IMPACT = 3.2e5 * 1000.0 ** (10 / 9), 10 / 9, 1e-6, 0.02
COEFFICIENTS = {STEP: 200.0, HYSTERETIC: 0.8, MODAL: 4e-6}
EVERY_LAW = pytest.mark.parametrize("law, coefficient", COEFFICIENTS.items(), ids=["step", "hysteretic", "modal"])
STATES = [(d, v) for d in (2e-8, 0.3e-6, 0.9e-6, 4e-6) for v in (-5e-3, 0.0, 3e-4, 2e-2)]


def law_of(law, coefficient, depth=DEPTH, impact=IMPACT):
    return lambda d, v: damped_force(d, v, K, N, law, coefficient, depth, impact)


@pytest.mark.parametrize("d, v", STATES)
def test_closed_forms(d, v):
    elastic, share = K * d**N, min(1.0, d / DEPTH)
    expected = {
        STEP: elastic + 200.0 * (3 * share**2 - 2 * share**3) * v,
        HYSTERETIC: elastic * (1 + 3 * (1 - 0.8**2) / 4 * v / IMPACT),
        MODAL: elastic * (1 + 4e-6 * N * v / d),
    }
    for law, force in expected.items():
        found = law_of(law, COEFFICIENTS[law])(d, v)
        assert found[0] == pytest.approx(max(0.0, force), rel=1e-12, abs=1e-12)
        assert found[3] == pytest.approx(elastic, rel=1e-12, abs=0)


@EVERY_LAW
@pytest.mark.parametrize("d, v", STATES)
def test_derivatives(law, coefficient, d, v):
    force = law_of(law, coefficient)
    value, by_depth, by_rate, _ = force(d, v)
    a, b = 1e-5 * d, 1e-6
    slope = (force(d + a, v)[0] - force(d - a, v)[0]) / (2 * a)
    rise = (force(d, v + b)[0] - force(d, v - b)[0]) / (2 * b)
    assert by_depth == pytest.approx(slope, rel=1e-6, abs=1e-3)
    assert by_rate == pytest.approx(rise, rel=1e-6, abs=1e-6)
    assert value > 0.0 or by_depth == by_rate == 0.0


@EVERY_LAW
def test_never_pulls_and_touches_only_when_it_penetrates(law, coefficient):
    force = law_of(law, coefficient)
    for d in np.geomspace(1e-10, 1e-5, 40):
        pulled = [force(d, v)[0] for v in -np.geomspace(1e-5, 10.0, 40)]
        assert min(pulled) >= 0.0 and np.all(np.diff(pulled) <= 0.0)
        assert pulled[-1] == 0.0 or d < 1e-7
    for d in (0.0, -1e-12, -1e-6):
        assert force(d, 1.0) == (0.0, 0.0, 0.0, 0.0)


@EVERY_LAW
@pytest.mark.parametrize("d", [1e-9, 1e-7, 1e-6, 3e-6])
def test_without_rate_it_is_the_elastic_law_to_the_bit(law, coefficient, d):
    assert law_of(law, coefficient)(d, 0.0)[:2] == contact_force(d, K, N)
    assert law_of(NO_DAMPING, coefficient)(d, 0.7) == (*contact_force(d, K, N), 0.0, contact_force(d, K, N)[0])


def test_step_law_begins_at_zero_and_is_full_at_its_depth():
    force = law_of(STEP, 200.0)
    assert force(1e-12, 0.1)[2] < 1e-8
    assert force(0.5e-6, 0.1)[2] == pytest.approx(100.0, rel=1e-12, abs=0)
    assert force(1e-6, 0.1)[2] == force(5e-6, 0.1)[2] == 200.0


def test_elastic_impact_does_not_depend_on_restitution_one():
    assert law_of(HYSTERETIC, 1.0)(1e-6, 0.5)[0] == contact_force(1e-6, K, N)[0]


def test_speed_at_first_touch():
    assert impact_speed(0.0, 0.3) == 0.3 and impact_speed(0.1, 0.3) == 0.1
    assert impact_speed(0.0, -0.3) == impact_speed(1e-9, 0.3) == SLOWEST_IMPACT


def rebound(force, speed, mass=0.1):
    """Speed after over speed before of a mass that runs into the contact."""

    def leaves(_, state):
        return state[0] + 1e-15

    leaves.terminal, leaves.direction = True, -1
    end = 20 * (mass / (K * (speed**2 * mass / K) ** 0.05)) ** 0.5
    run = solve_ivp(lambda t, y: [y[1], -force(y[0], y[1])[0] / mass], (0.0, end), [0.0, speed], events=leaves,
                    rtol=1e-10, atol=1e-14, max_step=end / 400)
    assert run.status == 1
    return -run.y[1, -1] / speed


@pytest.mark.parametrize("speed", [2e-3, 0.02, 0.2])
@pytest.mark.parametrize("restitution", [0.5, 0.8, 0.9, 0.95, 0.98])
def test_impact_comes_back_as_the_law_says(restitution, speed):
    """m v dv/(1 + a v) = -K d^n d(d), speeds over the first one, integrates to a v - ln(1 + a v): equal at
    first and last touch whatever the exponent."""
    a = 0.75 * (1.0 - restitution**2)
    back = brentq(lambda v: a - np.log1p(a) + a * v + np.log1p(-a * v), 1e-3, min(1.0, 0.999999 / a))
    assert rebound(law_of(HYSTERETIC, restitution, impact=speed), speed) == pytest.approx(back, rel=1e-6, abs=0)


@pytest.mark.parametrize("restitution", [0.9, 0.95, 0.98])
def test_impact_comes_back_with_the_coefficient_of_restitution(restitution):
    """Lankarani and Nikravesh (1990): valid near 1, their factor is the first term in 1 - ce."""
    found = rebound(law_of(HYSTERETIC, restitution), IMPACT)
    assert found == pytest.approx(restitution, abs=1.5 * (1.0 - restitution) ** 2)
