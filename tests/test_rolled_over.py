"""An effect that acts as each roller passes (a spall) shows another curve with each place of the cages, which nobody knows."""

import math
from dataclasses import replace

import numpy as np
import pytest

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.cages import Cages
from discrepancy.prediction.curves import signal
from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.over_angle import CAGES, QUARTERS, OverAngle
from discrepancy.problem import Record
from fmu_src.threads import Threads
from reducers.reducer import load_reducer
from rv_plant.effects import EFFECTS

ERROR = "transmission_error"
SPALL = {"spall_depth": 8e-6}
ARCSEC = math.radians(1.0 / 3600.0)
SHARE, NOISE = 0.37, 0.2 * ARCSEC


@pytest.fixture(scope="module")
def bench():
    return Bench(load_reducer("RV20E-121"), {})


@pytest.fixture(scope="module")
def pitch(bench):
    return bench.reducer.topology.roller_pitch


@pytest.fixture(scope="module")
def record(bench, pitch):
    """A turn with a spall, cages ``SHARE`` of a pitch ahead."""
    angle = np.linspace(0.0, 2.0 * math.pi, 1500, endpoint=False)
    empty = Record("te", ERROR, "rad", "c", 1, np.zeros(len(angle)), {"angle": angle}, {"speed": 100.0, "load": 130.0})
    shown = OverAngle(bench, empty, ERROR, SHARE * pitch).directly(SPALL)
    return replace(empty, values=shown - shown.mean() + NOISE * np.random.default_rng(4).standard_normal(len(angle)))


def test_where_nobody_looked_the_mean_over_all_places_of_the_cages_is_changed(bench, pitch, record):
    shown, plain = (OverAngle(bench, record, ERROR).directly(values) for values in (SPALL, {}))
    by_place = [OverAngle(bench, record, ERROR, share * pitch) for share in QUARTERS]
    changes = [curve.directly(SPALL) - curve.directly({}) for curve in by_place]
    assert shown == pytest.approx(plain + np.mean(changes, axis=0), abs=1e-12)
    # They differ by more than the mean itself.
    assert np.std(changes[0] - changes[2]) > 2.0 * np.std(np.mean(changes, axis=0))
    at = replace(record, factors={**record.factors, CAGES: 0.5 * pitch})
    assert OverAngle(bench, at, ERROR).directly(SPALL) == pytest.approx(OverAngle(bench, record, ERROR, 0.5 * pitch).directly(SPALL), abs=1e-15)


def test_cages_are_found_beside_the_spall_and_it_is_seen_with_them_there(bench, pitch, record):
    other = Bench(bench.reducer, {})
    other.fineness = Fineness([record])
    cages = Cages(other, [record], lambda record, values: (record, dict(values)), Threads())
    cages.amplitudes = {"spall_depth": 0.0}
    assert cages.place(SPALL)
    effects = cages.effects(SPALL)
    placed = cages.placed(record, effects, SPALL)
    assert abs(math.remainder(placed.factors[CAGES] / pitch - SHARE, 1.0)) < 0.01
    left = record.values - signal(OverAngle(other, placed, ERROR), SPALL)
    assert np.std(left) == pytest.approx(NOISE, rel=0.1)
    # It is in the curve already; other effects keep the ripple that they had.
    assert cages.ripple(record, SPALL) is None and cages.placed(record, frozenset(), {}) is record
    # A pit further on is met at the same time by cages that are as far ahead.
    further = cages.placed(record, effects, {**SPALL, "spall_angle": 4.8124})
    assert further.factors[CAGES] - placed.factors[CAGES] == pytest.approx(0.1)


def test_how_finely_a_spall_is_computed_is_found_where_it_shows(bench, record):
    """Where no load reaches it nothing changes, and few nodes would do: they would serve for a spall in the loaded zone, too."""
    other = Bench(bench.reducer, {})
    other.fineness = Fineness([record])
    shapes = {p.variable.name for p in EFFECTS["race_spall"].parameters if p.kind == "shape"}
    other.fineness.shapes, other.fineness.steep = set(shapes), shapes
    curve = OverAngle(other, record, ERROR, 0.2)
    signal(curve, {**SPALL, "spall_angle": 1.5708})
    exact = OverAngle(Bench(bench.reducer, {}), record, ERROR, 0.2).directly(SPALL)
    assert np.std(signal(curve, SPALL) - exact) < 0.02 * ARCSEC
