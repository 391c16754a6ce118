"""Runs that repeat each other a little apart are computed once, and a large effect where its zero is."""

from dataclasses import replace

import numpy as np
import pytest

from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.conditions import angles_of
from discrepancy.prediction.curves import signal
from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.over_angle import OverAngle
from discrepancy.prediction.stations import own_stations, shared_stations
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from studies.coupled import COLUMNS

ERROR, COLD = "transmission_error", Condition(209.44, 60.0)
ANGLE, NOISE = np.linspace(0.0, 2.0 * np.pi, 360, endpoint=False), 3e-6
SPACING = ANGLE[1]


def recorded(name, angle, seed=3, load=60.0, **factors):
    rng = np.random.default_rng(seed)
    return Record(name, ERROR, "rad", "te", 1, NOISE * rng.standard_normal(len(angle)), axes={"angle": angle},
                  factors={"speed": COLD.speed, "load": load, "temperature": COLD.temperature, **factors}, mounting="1")


def stations(*records):
    return shared_stations(records, lambda record: record.axes["angle"])


def bench_for(*records):
    bench = Bench(load_model("RV20E-121-rigid").reducer, {})
    bench.fineness = Fineness(records)
    bench.stations = shared_stations(records, lambda record: angles_of(bench, record, 0.0))
    return bench


@pytest.fixture
def repeated():
    """Three runs whose angles an encoder shows a little apart."""
    rng = np.random.default_rng(5)
    return [recorded(f"te {k}", ANGLE + 0.002 * SPACING * rng.standard_normal(360), k) for k in range(3)]


def test_runs_a_little_apart_share_their_stations(repeated):
    found = stations(*repeated)
    first = found[repeated[0].axes["angle"].tobytes()]
    for record in repeated:
        there = found[record.axes["angle"].tobytes()]
        assert np.array_equal(there.angles, first.angles) and len(there.sharers) == 3
        assert np.allclose(there.angles[there.place] + there.off, record.axes["angle"], atol=1e-15)


@pytest.mark.parametrize("other", [
    recorded("half a sample on", ANGLE + 0.5 * SPACING), recorded("twice as many", np.linspace(0.0, 2.0 * np.pi, 720, endpoint=False)),
    recorded("another load", ANGLE + 0.001 * SPACING, load=120.0), recorded("backwards", ANGLE + 0.001 * SPACING, direction=-1.0),
    recorded("further", ANGLE + 3.0 * SPACING), recorded("one angle", np.array([0.0])),
    recorded("twice in one place", np.sort(np.append(ANGLE[:-1], ANGLE[7] + 1e-4 * SPACING))),
], ids=lambda record: record.name)  # fmt: skip
def test_others_have_their_own(repeated, other):
    found = stations(*repeated, other)
    there = found.get(other.axes["angle"].tobytes())
    assert there is None or (not there.off.any() and there.sharers == [other])


def test_a_shorter_run_has_places_among_a_longer_ones(repeated):
    part = recorded("part", repeated[0].axes["angle"][4:350] + 1e-3 * SPACING)
    there = stations(*repeated, part)[part.axes["angle"].tobytes()]
    assert len(there.angles) == 360 and there.place[0] == 4 and np.allclose(there.off, 1e-3 * SPACING)


def test_samples_in_any_order_find_their_places():
    shuffled = np.random.default_rng(1).permutation(ANGLE)
    own = own_stations(shuffled)
    assert np.array_equal(own.samples(np.sin(own.angles), 0.0), np.sin(shuffled))


@pytest.mark.parametrize("values", [{}, {"disc_runout": 6e-6}], ids=["plain", "discs off centre"])
def test_repeated_runs_are_computed_once_and_as_exactly_as_noise_asks(repeated, values):
    bench = bench_for(*repeated)
    zero = {"angle_zero[1]": 0.0123}
    for record in repeated:
        seen = signal(OverAngle(bench, record, ERROR), {**values, **zero})
        exact = bench.running(COLD, values, record.axes["angle"] + 0.0123)[:, COLUMNS.index(ERROR)]
        assert np.std(seen - exact) < 0.5 * bench.allowed(record)
    # The exact ones are each their own.
    whole = {key[3] for key in bench.runs.found if key[0] == "running" and len(key[3]) == ANGLE.nbytes and dict(key[2]) == values}
    assert len(whole) - len(repeated) <= 2


def test_a_large_effect_is_computed_where_its_zero_is():
    """Interpolated from an anchor a little beside, kinks of discs off centre by 6 um showed as a direction 0.03 deg off."""
    record = recorded("te", ANGLE)
    bench = bench_for(record)
    curve = OverAngle(bench, record, ERROR)
    zero = {"angle_zero[1]": 0.45 * curve.anchors() + 7.0 * curve.anchors()}
    values = {"disc_runout": 6e-6, **zero}
    exact = bench.running(COLD, values, ANGLE + zero["angle_zero[1]"])[:, COLUMNS.index(ERROR)]
    assert np.abs(curve.directly(values) - exact).max() < 1e-9
    # A search may share runs.
    rough = replace(curve, bench=bench.rougher)
    assert rough.anchored(values)[1] != 0.0 == curve.anchored(values)[1]
