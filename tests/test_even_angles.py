"""Angles that an encoder wrote with noise, of a shaft that turned evenly, and samples that were taken unevenly."""

import math

import numpy as np
import pytest
from scipy.signal import lfilter

from discrepancy.prediction.even_angles import erring, slope_of, turning_of, with_even_angles
from discrepancy.problem import Record
from discrepancy.words.standing_notes import evened_texts

SAMPLES = 3000
STEP = 2.0 * math.pi / SAMPLES
ORDERS = ((80, 1e-5), (900, 4e-7))


def shown(angle):
    return sum(size * np.sin(order * angle + 0.3) for order, size in ORDERS)


def runs(taken, written, seed=1, noise=1e-6, count=2):
    """Runs with samples ``taken`` off an even turning and angles ``written`` off it, in steps; noise as a low pass leaves it."""
    rng = np.random.default_rng(seed)
    found = []
    for k in range(count):
        even = STEP * np.arange(SAMPLES)
        off = rng.standard_normal(SAMPLES)
        values = shown(even + taken * STEP * off) + lfilter([noise], [1.0, -1.2, 0.5], rng.standard_normal(SAMPLES))
        found.append(Record(f"run {k}", "transmission_error", "rad", "bench", k + 1, values, {"angle": even + written * STEP * off}, {}))
    return found


def test_angles_that_err_are_those_of_the_even_turning():
    records = runs(taken=0.0, written=0.15)
    for record in with_even_angles(records):
        assert np.abs(record.axes["angle"] - STEP * np.arange(SAMPLES)).max() < 0.02 * STEP
    assert erring(records)["run 0"].noise == pytest.approx(0.15 * STEP, rel=0.05)


def test_an_order_is_as_large_as_it_is_over_even_angles_and_too_small_over_written_ones():
    record = runs(taken=0.0, written=0.15, noise=1e-9)[0]
    size = 0.15 * STEP
    order, amplitude = ORDERS[1]

    def seen(angle):
        wave = np.exp(-1j * order * angle)
        return 2.0 * abs(np.mean(record.values * wave))

    assert seen(record.axes["angle"]) == pytest.approx(amplitude * (1.0 - 0.5 * (order * size) ** 2), rel=2e-2)
    even = with_even_angles(runs(taken=0.0, written=0.15, noise=1e-9))[0]
    assert seen(even.axes["angle"]) == pytest.approx(amplitude, rel=2e-3)


@pytest.mark.parametrize("seed", range(10))
def test_samples_that_were_taken_unevenly_stay_where_they_are(seed):
    records = runs(taken=0.2, written=0.2, seed=seed)
    assert with_even_angles(records) == records


def test_nothing_is_changed_that_repetitions_do_not_tell():
    alone = runs(taken=0.0, written=0.15, count=1)
    assert not erring(alone)
    # Nothing that is steep, or noise that hides it.
    assert not erring(runs(taken=0.0, written=0.15, noise=1e-2))
    assert not erring(runs(taken=0.0, written=0.0))
    assert not erring([Record("x", "transmission_error", "rad", "bench", 1, np.zeros(3), {"angle": np.arange(3.0)}, {})])


def test_runs_that_began_elsewhere_and_went_faster_are_held_against_each_other():
    first, second = runs(taken=0.0, written=0.15)
    rng = np.random.default_rng(5)
    even = 1.07 * STEP * np.arange(-200, 2500)
    values = shown(even) + lfilter([1e-6], [1.0, -1.2, 0.5], rng.standard_normal(len(even)))
    other = Record("run 1", "transmission_error", "rad", "bench", 2, values, {"angle": even + 0.15 * STEP * rng.standard_normal(len(even))}, {})
    assert set(erring([first, other])) == {"run 0", "run 1"}


def test_a_run_that_lacks_samples_tells_nothing_and_is_made_even_with_the_others():
    records = runs(taken=0.0, written=0.15, count=3)
    records[2].values[40:60] = np.nan
    assert set(erring(records)) == {"run 0", "run 1", "run 2"}
    records[0].values[7] = np.nan
    assert not erring(records)


def test_a_turning_whose_speed_drifts_is_even_nearby():
    records = []
    for record in runs(taken=0.0, written=0.0):
        rng = np.random.default_rng(record.replicate)
        even = record.axes["angle"] + 4.0 * STEP * np.sin(record.axes["angle"])
        values = shown(even) + record.values - shown(record.axes["angle"])
        records.append(Record(**{**vars(record), "values": values, "axes": {"angle": even + 0.15 * STEP * rng.standard_normal(SAMPLES)}}))
        assert np.abs(turning_of(records[-1]).even - even).max() < 0.1 * STEP
    assert len(erring(records)) == 2


def test_a_turning_there_and_back_and_shuffled_rows_are_none():
    record = runs(taken=0.0, written=0.15)[0]
    angle = np.asarray(record.axes["angle"])
    there = Record(**{**vars(record), "axes": {"angle": np.where(angle < math.pi, angle, 2.0 * math.pi - angle)}})
    shuffled = Record(**{**vars(record), "axes": {"angle": np.random.default_rng(2).permutation(angle)}})
    assert turning_of(there) is None and turning_of(shuffled) is None


def test_slopes_are_those_of_the_signal_up_to_fast_orders():
    records = runs(taken=0.0, written=0.15, noise=0.0)
    even = STEP * np.arange(SAMPLES)
    slope = sum(order * size * np.cos(order * even + 0.3) for order, size in ORDERS)
    found = slope_of(shown(even), turning_of(records[0]))
    inner = slice(50, -50)
    assert np.abs(found - slope)[inner].max() < 0.02 * np.abs(slope).max()


def test_what_was_made_even_is_said():
    [(text, short)] = evened_texts(with_even_angles(runs(taken=0.0, written=0.15))).items()
    assert text.startswith("transmission_error: the angles of 2 runs err by 0.018 deg from sample to sample")
    assert short == "transmission_error: angles of 2 runs made even"
    assert evened_texts(with_even_angles(runs(taken=0.2, written=0.2))) == {}
