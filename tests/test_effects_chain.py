"""Effects of the measuring chain: what sensors add, by their formulas."""

from dataclasses import replace

import numpy as np
import pytest

from discrepancy.catalogue.examples import Case
from discrepancy.catalogue.signature import ARCSEC, amplitudes, changed, conditions, new_bench, turn
from discrepancy.effects import MODULES, STAGES
from discrepancy.prediction.candidates import candidates
from discrepancy.problem import Record

ANGLE = np.linspace(0.0, 2.0 * np.pi, 720, endpoint=False)


def shown(name, values, size=1.0, quantity="transmission_error", axis=ANGLE, kind="angle", **parameters):
    record = Record("", quantity, "", "", 1, values, {kind: axis}, {})
    return MODULES[name].change(values, record, lambda p: parameters.get(p, 0.0), size)


def test_every_module_has_its_stage():
    assert set(STAGES) == set(MODULES)


def test_gain_offset_and_drift():
    signal = 3.0 + np.sin(40.0 * ANGLE)
    assert np.allclose(shown("sensor_gain", signal, sensor_gain=0.05), 1.05 * signal)
    assert np.allclose(shown("sensor_offset", signal, size=3.0, sensor_offset=0.05), signal + 0.15)
    drift = shown("sensor_drift", signal, size=3.0, sensor_drift=0.1) - signal
    assert drift.mean() == pytest.approx(0.0, abs=1e-12) and np.allclose(np.diff(drift), 0.3 / len(ANGLE))


def test_slipping_clock_stretches_the_axis():
    """Phases run away in proportion to the order."""
    slip = 1e-3
    for order in (5, 40):
        found = shown("clock_slip", np.sin(order * ANGLE), clock_slip=slip)
        inside = ANGLE * (1.0 + slip) < ANGLE[-1]
        assert np.allclose(found[inside], np.sin(order * ANGLE * (1.0 + slip))[inside], atol=2e-3)
    time = np.linspace(0.0, 1.0, 500)
    found = shown("clock_slip", time**2, axis=time, kind="time", clock_slip=-slip)
    assert np.allclose(found, (time * (1.0 - slip)) ** 2, atol=1e-5)


@pytest.mark.parametrize("order", [5, 78, 120])
def test_a_clock_that_is_fast_moves_the_curve_as_one_that_is_slow_does_to_the_other_side(order):
    """Six samples of a wave: by straight lines between them the two changes had a cosine of 0.2, and one was not seen by the other's."""
    signal = np.sin(order * ANGLE)
    fast, slow = (shown("clock_slip", signal, clock_slip=slip) - signal for slip in (1e-5, -1e-5))
    assert -fast @ slow / np.linalg.norm(fast) / np.linalg.norm(slow) > 0.98
    # Samples that lie on each other, or nearly, tell nothing of slopes.
    twice = np.sort(np.concatenate([ANGLE, ANGLE[::7], ANGLE[::11] + 1e-10]))
    moved = shown("clock_slip", np.sin(order * twice) + np.random.default_rng(0).normal(0.0, 1e-9, len(twice)), axis=twice, clock_slip=1e-5)
    inside = slice(None, -2)
    assert np.allclose(moved[inside], np.sin(order * twice * (1.0 + 1e-5))[inside], atol=4e-4)


def test_encoder_off_centre_is_order_1_at_any_load():
    """2 eps/D: 5 um on 50 mm is 41 arcsec; other quantities know nothing of it."""
    bench, case = new_bench(), Case("", {"encoder_cos1": 2 * 5e-6 / 50e-3, "encoder_sin2": 1e-5})
    for c in ("rated", "load 25 %", "speed 200 %", "40 K warmer"):
        at = conditions(bench)[c]
        series = turn(bench, at, {})
        added = amplitudes(changed(bench, "encoder_eccentricity", case, "transmission_error", at, series) - series) * ARCSEC
        assert added[1] == pytest.approx(41.25, rel=1e-3) and added[2] == pytest.approx(1e-5 * ARCSEC, rel=1e-6)
        assert np.delete(added, [1, 2]).max() < 1e-6
    assert np.array_equal(changed(bench, "encoder_eccentricity", case, "input_torque", at, series), series)


def test_offset_is_looked_for_where_the_zero_is_known():
    free = Record("free", "transmission_error", "rad", "a", 1, np.zeros(50), {"angle": ANGLE[:50]}, {})
    names = {c.name for c in candidates([free], {}, set(), ["1"])}
    assert "sensor_offset.transmission_error" not in names and "sensor_gain.transmission_error" in names
    # One run that counts from a known zero is enough.
    known = {c.name for c in candidates([free, replace(free, name="known", zero_known=True)], {}, set(), ["1"])}
    assert "sensor_offset.transmission_error" in known
