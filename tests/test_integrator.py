"""The generalised-alpha integrator against its theory, on the load swinging on the output shaft.

All other bodies stand: nothing touches, and the carrier is so heavy that it does not move.
Chung and Hulbert (1993): second order; spectral radius rho far above the step.
"""

import numpy as np
import pytest
from stand import in_motion, only

from rv_plant import plant
from rv_plant.integrator import alpha_step, keep_start, next_step_size

COMPLIANCE, INERTIA, START = 1e-4, 2.0, 1e-4
OMEGA = 1.0 / np.sqrt(COMPLIANCE * INERTIA)
EVERY_RADIUS = pytest.mark.parametrize("radius", [0.0, 0.5, 0.8, 1.0])


def at_rest(table, radius, damping_time=0.0):
    """The load turned by START out of its rest [rad]."""
    record = only(in_motion(
        table, input_speed=0.0, load_torque=0.0, bearing_clearance=5e-6, equidistant_modification=10e-6, backlash=10e-6,
        carrier_inertia=1e20, carrier_compliance=COMPLIANCE, load_inertia=INERTIA, joint_damping_time=damping_time,
        damping_law=0, spectral_radius=radius, dynamic_tolerance=1e-5,
    ))
    # The sun between the flanks.
    record.q[-2] = 0.0
    record.q[-1] = record.q[6] + START
    record.acceleration[-1] = record.smooth[-1] = -(OMEGA**2) * START
    return record


def swing(record, h, count):
    """Twist of the shaft before and after each of ``count`` steps of h."""
    twist = [record.q[-1] - record.q[6]]
    for _ in range(count):
        keep_start(record)
        assert alpha_step(record, h, 0.0, 0.0) >= 0.0
        twist.append(record.q[-1] - record.q[6])
    return np.array(twist)


def exact(time, ratio=0.0):
    """From rest at START, damping ratio below 1."""
    root = OMEGA * np.sqrt(1.0 - ratio**2)
    return START * np.exp(-ratio * OMEGA * time) * (np.cos(root * time) + ratio * OMEGA / root * np.sin(root * time))


@EVERY_RADIUS
@pytest.mark.parametrize("damping_time", [0.0, 2.0 * 0.05 / OMEGA], ids=["undamped", "ratio 0.05"])
def test_second_order(rv20e, radius, damping_time):
    duration, errors = 3.0 * 2.0 * np.pi / OMEGA, []
    for count in (100, 200, 400, 800):
        record = at_rest(rv20e.plant, radius, damping_time)
        found = swing(record, duration / count, count)
        time = duration / count * np.arange(count + 1)
        errors.append(np.abs(found - exact(time, 0.5 * OMEGA * damping_time)).max())
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders[-1] == pytest.approx(2.0, abs=0.1)
    assert errors[-1] < 6e-3 * START


def test_radius_one_keeps_the_amplitude_at_the_trapezoidal_frequency(rv20e):
    """tan(turn/2) = omega h/2, with any step."""
    for step in (0.1, 1.0, 10.0):
        found = swing(at_rest(rv20e.plant, 1.0), step / OMEGA, 60)
        turn = 2.0 * np.arctan(0.5 * step)
        assert found == pytest.approx(START * np.cos(turn * np.arange(61)), abs=1e-5 * START)


@pytest.mark.parametrize("radius", [0.0, 0.3, 0.5, 0.8])
def test_stiff_motion_decays_by_the_spectral_radius(rv20e, radius):
    """Far above the step all three roots are -rho: E^3 + 3 rho E^2 + 3 rho^2 E + rho^3 takes any series to zero."""
    found = swing(at_rest(rv20e.plant, radius), 300.0 / OMEGA, 12)
    left = found[3:] + 3 * radius * found[2:-1] + 3 * radius**2 * found[1:-2] + radius**3 * found[:-3]
    assert np.abs(left[1:]).max() < 1e-4 * np.abs(found).max()
    assert np.abs(found[10:]).max() < 200 * max(radius, 0.05) ** 10 * np.abs(found).max()


@EVERY_RADIUS
@pytest.mark.parametrize("step", [0.3, 2.0])
def test_decay_is_that_of_the_amplification_matrix(rv20e, radius, step):
    """Of Chung and Hulbert, equations 3 to 6, written for d, h v, h^2 a of M a + K d = 0."""
    am, af = (2 * radius - 1) / (radius + 1), radius / (radius + 1)
    gamma, beta = 0.5 - am + af, 0.25 * (1 - am + af) ** 2
    w = step**2
    new = np.array([[1, 0, -beta], [0, 1, -gamma], [(1 - af) * w, 0, 1 - am]])
    old = np.array([[1, 1, 0.5 - beta], [0, 1, 1 - gamma], [-af * w, 0, -am]])
    matrix = np.linalg.solve(new, old)
    state, expected = np.array([START, 0.0, -w * START]), [START]
    for _ in range(40):
        state = matrix @ state
        expected.append(state[0])
    found = swing(at_rest(rv20e.plant, radius), step / OMEGA, 40)
    assert found == pytest.approx(expected, abs=1e-5 * START)


def test_error_estimate_falls_with_the_third_power(rv20e):
    """Hence the rule for the next step."""
    estimates = []
    for h in (0.04, 0.02, 0.01):
        record = at_rest(rv20e.plant, 0.5)
        swing(record, h / OMEGA, round(1.0 / h))
        keep_start(record)
        estimates.append(alpha_step(record, h / OMEGA, 0.0, 0.0))
    assert np.log2(estimates[0] / estimates[1]) == pytest.approx(3.0, abs=0.15)
    assert np.log2(estimates[1] / estimates[2]) == pytest.approx(3.0, abs=0.1)
    assert next_step_size(record, 1e-3, 1.0) == pytest.approx(0.9e-3, rel=1e-12, abs=0)
    assert next_step_size(record, 1e-3, 8.0) == pytest.approx(0.45e-3, rel=1e-12, abs=0)
    assert next_step_size(record, 1e-3, 0.0) == 2e-3
    assert next_step_size(record, 1e-3, 1e9) == pytest.approx(0.2e-3, rel=1e-12, abs=0)


def test_driven_sun_follows_its_ramp(rv20e):
    """Speed at the communication points is the input's, the angle its integral."""
    records = in_motion(rv20e.plant, input_speed=20.0)
    angle = float(records["q"][0, -2])
    for i in range(20):
        records["input_speed"] = 20.0 + 10.0 * (i + 1)
        assert plant.step(records, i * 1e-3, 1e-3) == 0
        assert records["v"][0, -2] == pytest.approx(30.0 + 10.0 * i, rel=1e-12, abs=0)
        angle += 1e-3 * (25.0 + 10.0 * i)
        assert records["q"][0, -2] == pytest.approx(angle, rel=1e-12, abs=0)
