"""Noise of a torque meter in the noise of loops: told from steep and flat places, weighed sample by sample."""

import numpy as np
import pytest

from discrepancy.inference.noise.axis_noise import axis_noise_of, slopes_of
from discrepancy.inference.noise.noise import estimate
from discrepancy.problem import Record

ENCODER = 2e-6


def turning(torque):
    """Of a reducer with lost motion: twenty times as steep about no torque as away from it."""
    return 1e-6 * torque + 1e-4 * np.tanh(torque / 5.0)


def loops(meter, seed=0, samples=1200, runs=2):
    rng = np.random.default_rng(seed)
    torque = 100.0 * np.sin(2.0 * np.pi * np.arange(samples) / samples)
    found = []
    for k in range(runs):
        read = torque + meter * rng.standard_normal(samples)
        values = turning(torque) + ENCODER * rng.standard_normal(samples)
        found.append(Record(f"loop {k}", "hysteresis", "rad", "bench", k, values, {"torque": read}, {}))
    return found


def noise_of(records):
    predictions = [turning(np.asarray(r.axes["torque"])) for r in records]
    residuals = [r.values - p for r, p in zip(records, predictions)]
    return estimate(records, residuals, predictions), residuals


@pytest.mark.parametrize("meter", [0.2, 0.4])
def test_noise_of_the_torque_is_told_from_steep_places(meter):
    records = loops(meter)
    noise, residuals = noise_of(records)
    stream = noise.streams["hysteresis"]
    assert stream.axis * stream.scale == pytest.approx(meter, rel=0.3)
    assert stream.scale == pytest.approx(ENCODER, rel=0.1)
    steep = np.abs(np.asarray(records[0].axes["torque"])) < 3.0
    plain = noise.whiteners[0].innovate(residuals[0][:, None])[:, 0]
    assert np.std(plain[steep]) == pytest.approx(1.0, abs=0.3)
    assert np.std(plain[~steep]) == pytest.approx(1.0, abs=0.1)


def test_torque_without_noise_makes_none():
    found = [noise_of(loops(0.0, seed))[0].streams["hysteresis"] for seed in range(8)]
    steepest = 2.1e-5
    assert all(np.hypot(1.0, s.axis * steepest) < 1.3 for s in found)
    assert np.median([s.axis for s in found]) == 0.0


def test_few_samples_tell_nothing_of_the_torque():
    noise, _ = noise_of(loops(0.4, samples=40))
    assert noise.streams["hysteresis"].axis == 0.0


def test_an_offset_is_the_same_all_over_a_loop_whatever_the_noise_of_its_samples():
    records = [Record(r.name, r.quantity, r.unit, r.condition, r.replicate, r.values + 3e-6 * k, r.axes, {}) for k, r in enumerate(loops(0.4, runs=3))]
    noise, _ = noise_of(records)
    stream, w = noise.streams["hysteresis"], noise.whiteners[0]
    assert stream.axis > 0.0 and stream.patterns["offset"] > 0.0 and not stream.length and not stream.taps.size
    columns = np.random.default_rng(1).standard_normal((1200, 3))
    x = np.arange(1200.0) - 599.5
    x /= np.sqrt(np.mean(x**2))
    patterns = {"offset": np.ones(1200), "drift": x}
    assert set(stream.patterns) == set(patterns)
    covariance = np.diag(w.scale**2 / w.weight**2)
    for name, variance in stream.patterns.items():
        covariance += variance * stream.scale**2 * np.outer(patterns[name], patterns[name])
    assert w(columns).T @ w(columns) == pytest.approx(columns.T @ np.linalg.solve(covariance, columns), rel=1e-6)


def test_slopes_do_not_reach_across_samples_that_were_left_out():
    torque = np.concatenate([np.linspace(-50.0, -2.0, 100), np.linspace(2.0, 50.0, 100)])
    record = Record("loop", "hysteresis", "rad", "bench", 1, torque, {"torque": torque}, {})
    assert slopes_of(record, 1e-6 * torque + 1e-4 * np.sign(torque)) == pytest.approx(1e-6, rel=1e-9)


def test_what_runs_over_an_angle_has_none():
    angle = np.linspace(0.0, 6.0, 500)
    record = Record("error", "transmission_error", "rad", "bench", 1, angle, {"angle": angle}, {})
    assert not np.any(slopes_of(record, np.sin(angle)))
    rng = np.random.default_rng(0)
    assert axis_noise_of([rng.standard_normal(500)], [np.zeros(500)], [1.0]) == 0.0
