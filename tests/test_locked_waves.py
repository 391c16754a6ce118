"""Of the waves of a pattern that look alike in transmission errors, loops of known places tell from which their places count."""

import math

import numpy as np
import pytest

from discrepancy.held_names import LOCKED_AT
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.locked_waves import LockedWaves
from discrepancy.prediction.over_torque import OverTorque
from discrepancy.problem import Record
from reducers.reducer import load_reducer

NAME, WAVE = "angle_zero[1]", 2.0 * math.pi * 121.0 / 80.0
NOTHING, OVAL = frozenset(), frozenset({"disc_ovality"})
ARCSEC, REST = math.radians(1.0 / 3600.0), np.zeros(4)
TORQUE = 160.0 * np.interp(np.linspace(0.0, 4.0, 41), np.arange(5.0), [0, 1, 0, -1, 0])


def loop(place=1.0, values=REST, **more):
    return Record("loop", "hysteresis", "rad", "c", 1, values, {"torque": np.arange(float(len(values)))}, **{"factors": {LOCKED_AT: place}, **more})


def shown(record):
    """What a loop of two waves in turn would show."""
    return np.arange(4.0) * math.cos(math.pi * record.factors[LOCKED_AT] / WAVE)


def as_it_is(record):
    return record


def test_the_wave_is_that_of_the_loop_that_was_measured():
    record = loop(0.1 * WAVE, shown(loop(1.1 * WAVE)))
    waves = LockedWaves([record], [NAME], WAVE, 2)
    assert waves.placed(record, OVAL) is record and waves.counts(record)
    assert waves.are_elsewhere(OVAL, shown, as_it_is) and waves.place(OVAL, shown, as_it_is)
    moved = waves.placed(record, OVAL)
    assert moved.factors[LOCKED_AT] == pytest.approx(1.1 * WAVE)
    # With further effects too; without the effect it stays.
    assert waves.placed(record, OVAL | {"drag"}).factors == moved.factors and waves.placed(record, NOTHING) is record
    assert not waves.are_elsewhere(OVAL, shown, as_it_is) and not waves.place(OVAL, shown, as_it_is)


def test_a_place_that_is_tried_goes_its_own_way():
    """Records of places that are tried live for a moment, and the next one has the address of one before."""
    waves = LockedWaves([loop()], [NAME], WAVE, 2)
    waves.found[OVAL] = {NAME: 1}
    tried = [0.01 * k for k in range(50)]
    moved = [waves.placed(loop(place), OVAL).factors[LOCKED_AT] for place in tried]
    assert moved == pytest.approx([place + WAVE for place in tried])


def test_a_wave_that_is_hardly_better_is_not_taken():
    record = loop(0.1 * WAVE, np.array([0.0, 1.0, -1.0, 0.5]))
    waves = LockedWaves([record], [NAME], WAVE, 2)
    assert not waves.place(OVAL, shown, as_it_is)


def test_places_in_rows_go_along():
    record = loop(0.1 * WAVE, shown(loop(1.1 * WAVE)))
    rows = Record("k", "torsional_stiffness", "N.m/rad", "c", 1, np.zeros(2), {LOCKED_AT: np.array([0.0, 1.0])}, {})
    waves = LockedWaves([record, rows], [NAME], WAVE, 2)
    waves.place(NOTHING, shown, as_it_is)
    np.testing.assert_allclose(waves.placed(rows, OVAL).axes[LOCKED_AT], np.array([0.0, 1.0]) + WAVE)


@pytest.mark.parametrize("record", [loop(factors={}), loop(mounting="2"), loop(held_out=True)], ids=["at no place", "of another mounting", "held out"])
def test_what_tells_nothing_chooses_nothing(record):
    waves = LockedWaves([record], [NAME], WAVE, 2)
    assert not waves.loops and not waves.place(OVAL, shown, as_it_is)


def test_oval_discs_show_in_a_loop_which_of_them_is_where():
    """2 arcsec: half a turn of the cranks on, where the transmission error is the same, pins and lobes mesh half a pitch apart."""
    bench, oval = Bench(load_reducer("RV20E-121"), {}), {"disc_ovality": 4e-6}

    def predicted(record):
        return OverTorque(bench, record).directly(oval)

    def at(place, values):
        return Record("loop", "hysteresis", "rad", "c", 1, values, {"torque": TORQUE}, {LOCKED_AT: place})

    here, further = (predicted(at(place, np.zeros(len(TORQUE)))) for place in (36.0, 36.0 + WAVE))
    assert np.std(further - here) > 1.0 * ARCSEC
    measured = further + 0.2 * ARCSEC * np.random.default_rng(5).standard_normal(len(TORQUE))
    waves = LockedWaves([at(36.0, measured)], [NAME], WAVE, 2)
    waves.place(OVAL, predicted, as_it_is)
    assert waves.taken(OVAL) == {NAME: 1}
