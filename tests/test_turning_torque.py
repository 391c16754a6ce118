"""Where a loop's torque turned back, read by a noisy meter, against ways of a known turn."""

import numpy as np
import pytest

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.conditions import held_condition
from discrepancy.prediction.over_torque import OverTorque
from discrepancy.prediction.support import reversals
from discrepancy.prediction.turning_torque import as_applied
from discrepancy.problem import Record
from reducers.reducer import load_reducer

MOST = 167.0
ARCSEC = np.radians(1.0) / 3600.0


def triangle(samples):
    quarter = samples // 4
    return np.concatenate([np.linspace(20.0, MOST, quarter, endpoint=False), np.linspace(MOST, -MOST, 2 * quarter, endpoint=False),
                           np.linspace(-MOST, -5.0, samples - 3 * quarter)])  # fmt: skip


def sine(samples):
    return MOST * np.sin(np.linspace(0.1, 2.0 * np.pi - 0.03, samples))


def dwell(samples):
    """A ramp that stands for a while where it turns."""
    return np.clip(1.05 * triangle(samples), -MOST, MOST)


@pytest.mark.parametrize("way", [triangle, sine, dwell])
@pytest.mark.parametrize("samples", [2_000, 50_000])
def test_the_turn_is_known_better_than_its_largest_reading(way, samples):
    rng = np.random.default_rng(0)
    off, read_off = [], []
    for _ in range(5):
        read = way(samples) + 0.3 * rng.standard_normal(samples)
        found = as_applied(read, reversals(read))
        off += [found.max() - MOST, found.min() + MOST]
        read_off += [read.max() - MOST, read.min() + MOST]
    # A dwell of fifty samples is no shape that is looked for: the highest mean of samples near it.
    most = 0.7 if way is dwell and samples == 2_000 else 0.25
    assert np.linalg.norm(off) < most * np.linalg.norm(read_off)


def test_a_torque_without_noise_stays_as_it_is():
    for way in (triangle(2_000), np.repeat([0.0, 50.0, 100.0, 150.0, 100.0, 50.0, 0.0], 10)):
        assert as_applied(way, reversals(way)) == pytest.approx(way, abs=1e-9)


def test_few_samples_stay_as_they_are():
    read = triangle(28) + np.random.default_rng(0).standard_normal(28)
    assert np.array_equal(as_applied(read, reversals(read)), read)


def test_only_samples_about_the_turns_change():
    rng = np.random.default_rng(1)
    read = triangle(2_000) + 0.3 * rng.standard_normal(2_000)
    changed = np.flatnonzero(as_applied(read, reversals(read)) != read)
    true = triangle(2_000)
    assert 0 < len(changed) < 30 and np.all(np.abs(true[changed]) > MOST - 2.0)


def test_a_way_back_lies_where_it_does_with_a_quiet_meter():
    """50,000 samples, read with 0.3 N m: the way back began 1 N m too high and lay 0.3 arcsec off, which a diagnosis took for friction."""
    bench = Bench(load_reducer("RV20E-121"), {})
    true = triangle(50_000)
    true = true[np.abs(true) > 2.0]
    read = true + 0.3 * np.random.default_rng(2).standard_normal(len(true))

    def curve(torques):
        return OverTorque(bench, Record("loop", "hysteresis", "rad", "a", 1, np.zeros(len(torques)), {"torque": torques}, {"load": MOST}))

    def along(begin, of):
        """The loop whose way is that of a curve's torques, from the turn down, at the same torques for both."""
        torques = of.places({})
        turn = int(np.argmax(torques))
        path = np.concatenate([np.linspace(begin, torques[turn], 30), np.linspace(160.0, 100.0, 30)])
        return bench.held(held_condition(bench, of.record), {}, path)[30:]

    quiet, noisy = along(20.0, curve(true)), along(20.0, curve(read))
    assert np.abs(noisy - quiet).max() < 0.05 * ARCSEC
