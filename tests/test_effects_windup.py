"""What makes the output fall back by the torque, over the angle or with the speed: seats of pins, a carrier on its cranks, friction; a distorted encoder."""

import math
from dataclasses import replace

import numpy as np
import pytest

from discrepancy.catalogue.signature import ARCSEC, new_bench, rated
from discrepancy.effects import encoder_distortion, torque_ripple
from discrepancy.problem import Record
from studies.coupled import COLUMNS

PINS, LOBES, CRANKS, DISCS, RATIO, THROW = 40, 39, 2, 2, 121, 0.9e-3
SAMPLES = 512


@pytest.fixture(scope="module")
def bench():
    return new_bench()


def orders(bench, values, at):
    """Complex amplitudes [rad] by order that values bring into the transmission error."""
    angles = at.direction * 2.0 * np.pi * np.arange(SAMPLES) / SAMPLES
    errors = [bench.running(at, v, angles)[:, COLUMNS.index("transmission_error")] for v in (values, {})]
    change = errors[0] - errors[1]
    found = 2.0 * np.fft.rfft(change if at.direction > 0 else np.roll(change[::-1], 1)) / SAMPLES
    found[0] *= 0.5
    return found


def test_mean_seat_is_a_spring_by_castigliano(bench):
    """phi = sum c F^2/M with the forces of equal springs, by a sum over so many pins that it is an integral."""
    at = rated(bench)
    circle = bench.starts[0]["pin_circle_radius"]
    k1 = THROW * PINS / circle
    psi = (np.arange(20000) + 0.5) * math.pi / 20000
    squares = 0.5 * PINS * np.mean(np.sin(psi) ** 2 / (1.0 + k1**2 - 2.0 * k1 * np.cos(psi)))
    torque = at.load * (1.0 - 1.0 / RATIO)
    expected = 1e-8 * torque / (DISCS * (THROW * PINS) ** 2 * squares)
    assert orders(bench, {"pin_seat_compliance": 1e-8}, at)[0].real == pytest.approx(-expected, rel=2e-3)
    assert orders(bench, {"pin_seat_compliance": 1e-8}, replace(at, direction=-1))[0].real == pytest.approx(expected, rel=2e-3)


@pytest.mark.parametrize("waves", [2, 4])
def test_seats_that_differ_make_an_order_in_proportion_to_torque(bench, waves):
    at = rated(bench)
    values = {f"pin_seat_cos_{waves}": 1e-8, "pin_seat_direction": 0.6}
    found = [orders(bench, values, replace(at, load=share * at.load)) for share in (1.0, 0.25, 0.0)]
    order = waves * LOBES
    assert abs(found[0][order]) > 30.0 * np.delete(abs(found[0]), order).max()
    assert abs(found[1][order] / found[0][order]) == pytest.approx(0.25, rel=0.01)
    assert abs(found[2]).max() * ARCSEC < 1e-3
    # Soft where the eccentricity, behind which pins carry by 0.6 rad, has turned by as much beyond the soft place.
    assert np.angle(-found[0][order]) == pytest.approx(0.6 * waves, abs=0.02)
    backward = orders(bench, values, replace(at, direction=-1))[order]
    assert np.angle(backward) == pytest.approx(-0.6 * waves, abs=0.02)


def test_side_on_which_pins_carry(bench):
    """Opposing a positive turning the load presses the discs on the pins behind the eccentricity."""
    at = rated(bench)
    for direction in (1, -1):
        plants = bench.new_plant(replace(at, direction=direction), {}, 0.3)
        ahead = np.angle(np.exp(1j * (plants["pin_angle"][0] + LOBES * plants["ideal_output"][0])))
        force = plants["mesh_force_now"][0, 0]
        assert direction * float(force @ ahead / force.sum()) == pytest.approx(-1.0, abs=0.5)


def test_carrier_is_met_by_its_cranks(bench):
    at = rated(bench)
    for part, order in (("turn", CRANKS), ("crank", CRANKS * DISCS * PINS)):
        values = {f"carrier_{part}_cos": 3e-8, f"carrier_{part}_sin": 4e-8}
        forward, backward = (orders(bench, values, replace(at, direction=d)) for d in (1, -1))
        assert forward[order] == pytest.approx(-at.load * (3e-8 - 4e-8j), rel=0.01)
        assert backward[order] == pytest.approx(at.load * (3e-8 - 4e-8j), rel=0.01)
        assert abs(forward[order]) > 30.0 * np.delete(abs(forward), order).max()


def test_friction_winds_up_while_it_turns(bench):
    at = rated(bench)
    values = {"friction_windup": 1e-7, "friction_windup_speed": 50.0}
    for direction in (1, -1):
        for speed in (5.0, 100.0):
            found = orders(bench, values, replace(at, direction=direction, speed=speed))[0].real
            assert found == pytest.approx(-direction * 1e-7 * at.load * math.exp(-speed / 50.0), rel=0.01)
    torques = np.array([0.5, 1.0]) * at.load
    assert np.array_equal(bench.held(at, values, torques), bench.held(at, {}, torques))


def test_distorted_encoder():
    angle = np.linspace(0.0, 2.0 * np.pi, 50)
    record = Record("r", "transmission_error", "rad", "c", 1, np.zeros(50), {"angle": angle}, {})
    at = {"distortion_cos": 3e-5, "distortion_sin": -1e-5, "distortion_order": 3.0}.__getitem__
    assert np.allclose(encoder_distortion.change(np.zeros(50), record, at, 1.0), 3e-5 * np.cos(3 * angle) - 1e-5 * np.sin(3 * angle))
    of_loop = replace(record, quantity="hysteresis")
    assert not encoder_distortion.change(np.zeros(50), of_loop, at, 1.0).any()


def test_torque_ripple_is_a_forced_oscillator():
    """Against y'' + 2 z w0 y' + w0^2 y = w0^2 T (c cos k theta + s sin k theta), in both senses."""
    angle = np.linspace(0.0, 2.0 * np.pi, 4001)
    speed, order, frequency, damping, load = 2.0, 5.0, 1.7, 0.1, 100.0
    at = {"ripple_cos": 3e-9, "ripple_sin": -2e-9, "ripple_order": order, "ripple_frequency": frequency, "ripple_damping": damping, "output_speed": speed}
    w0 = 2.0 * math.pi * frequency
    for sense in (1.0, -1.0):
        record = Record("r", "transmission_error", "rad", "c", 1, np.zeros(len(angle)), {"angle": angle}, {"direction": sense, "load": load})
        y = torque_ripple.change(np.zeros(len(angle)), record, at.__getitem__, 1.0)
        rate = sense * speed * np.gradient(y, angle, edge_order=2)
        force = np.gradient(rate, angle, edge_order=2) * sense * speed / w0**2 + 2.0 * damping * rate / w0 + y
        expected = load * (3e-9 * np.cos(order * angle) - 2e-9 * np.sin(order * angle))
        assert np.abs(force - expected)[5:-5].max() < 1e-3 * np.abs(expected).max()
