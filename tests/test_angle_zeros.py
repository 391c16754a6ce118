"""The zero of an angle is looked for over a whole wave of the transmission error's pattern, however many pins and discs a reducer has."""

from dataclasses import replace

import numpy as np
import pytest

from discrepancy.model_file import ModelFile
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from reducers.reducer import load_reducer
from tests.test_other_places import campaign

# Shares of a wave: near and far from where it is looked for first.
SHARES = (0.1, 0.4, -0.35)


@pytest.mark.parametrize("name, waves", [("RV20E-121-rigid", 80), ("cycloidal-actuator", 14)])
def test_a_zero_is_found_wherever_it_is(name, waves):
    reducer = load_reducer(name)
    bench = Bench(reducer, {})
    at = Condition(bench.rated_speed, bench.rated_load)
    angles = np.linspace(0.0, 2.0 * np.pi, 12 * waves, endpoint=False)
    for share in SHARES:
        zero = share * 2.0 * np.pi / waves
        values = bench.column("transmission_error", at, {}, angles + zero)
        factors = {"speed": at.speed, "load": at.load, "temperature": at.temperature}
        record = Record("run", "transmission_error", "rad", "a", 1, values, {"angle": angles}, factors, stated_noise=1e-7)
        model = PhysicalModel(ModelFile(name, reducer), replace(campaign(), reducer=reducer, records=(record,)))
        # Between the places that are looked at: an input locked at a place that counts from there is off by it times the ratio.
        assert model.zeros["angle_zero[1]"] == pytest.approx(zero, abs=0.15 * 2.0 * np.pi / waves / 48)


def test_beside_a_large_effect_a_zero_is_found_by_the_pattern_alone():
    """An error of the discs six times as large as the pattern: places of the zero differ by less than a hundredth of all misfit."""
    reducer = load_reducer("RV20E-121-rigid")
    bench = Bench(reducer, {})
    at = Condition(bench.rated_speed, bench.rated_load)
    angles = np.linspace(0.0, 2.0 * np.pi, 1500, endpoint=False)
    zero = -0.11 * 2.0 * np.pi / 80
    noise = 1e-6 * np.random.default_rng(2).standard_normal(len(angles))
    factors = {"speed": at.speed, "load": at.load, "temperature": at.temperature}
    measured = bench.column("transmission_error", at, {"disc_runout": 5e-6}, angles + zero) + noise
    record = Record("run", "transmission_error", "rad", "a", 1, measured, {"angle": angles}, factors, stated_noise=1e-6)
    model = PhysicalModel(ModelFile(reducer.name, reducer), replace(campaign(), reducer=reducer, records=(record,)))
    # It was taken for the model's own, 0.  The effect bends the pattern a little: a fit looks for the zero a quarter of a wave to either side.
    assert model.zeros["angle_zero[1]"] == pytest.approx(zero, abs=0.125 * 2.0 * np.pi / 80)


TRILOBE = {"pin_ring_trilobe": 4e-6, "pin_ring_trilobe_angle": 0.7}


LOBE = {"lobe_throw_error_1": 4e-6}


@pytest.mark.parametrize("effect, own, zero, known, found", [
    ("pin_position_errors", TRILOBE, 13.2, None, 13.2), ("pin_position_errors", TRILOBE, -22.4, None, -22.4), ("pin_position_errors", TRILOBE, 37.3, 37.3, 37.3),
    # An error of a crank is the same every second wave: of these the nearest.
    ("crank_lobe_errors", LOBE, 23.3, None, -0.7), ("crank_lobe_errors", LOBE, 23.3, 2.9, 3.3),
    # Where cages stand elsewhere that is seen, and says nothing of the place.
    ("crank_lobe_errors", LOBE, -36.7, 2.9, 3.3), ("crank_lobe_errors", LOBE, 39.3, 2.9, 3.3),
])  # fmt: skip
def test_beside_parts_that_are_off_waves_are_told_apart(effect, own, zero, known, found):
    """A model file with an effect of a part, one of the ring first: 4.5 degrees further the pattern is nearly, but not, the same.

    It was looked for within a wave, where `extend` had found it beyond, so that what was added contradicted its measurements.  That which a step has
    stands among several that are alike: three lobes look much alike 60 degrees further.
    """
    reducer = load_reducer("RV20E-121")
    bench = Bench(reducer, {})
    at = Condition(bench.rated_speed, 0.6 * bench.rated_load)
    angles = np.linspace(0.0, 2.0 * np.pi, 1800, endpoint=False)
    wave = 2.0 * np.pi / 80
    noise = 1e-6 * np.random.default_rng(5).standard_normal(len(angles))
    factors = {"speed": at.speed, "load": at.load, "temperature": at.temperature}
    record = Record("run", "transmission_error", "rad", "a", 1, bench.column("transmission_error", at, own, angles + zero * wave) + noise,
                    {"angle": angles}, factors, stated_noise=1e-6)  # fmt: skip
    present = {effect: {name: {"value": value} for name, value in own.items()}}
    steps = ({"campaign": "a", "nuisances": {"angle_zero[1]": known * wave}},) if known else ()
    model = PhysicalModel(ModelFile(reducer.name, reducer, effects=present, steps=steps), replace(campaign(), name="a", reducer=reducer, records=(record,)))
    assert model.zeros["angle_zero[1]"] == pytest.approx(found * wave, abs=wave / 48)


@pytest.mark.parametrize("fitted", [True, False])
def test_a_zero_beside_which_the_effects_were_fitted_stays_one(fitted):
    """It was judged anew by `compare`, which took so small a one for the model's own: errors were 1.20 times the noise where `extend` said 1.06."""
    reducer = load_reducer("RV20E-121")
    bench = Bench(reducer, {})
    at = Condition(bench.rated_speed, 0.6 * bench.rated_load)
    angles = np.linspace(0.0, 2.0 * np.pi, 480, endpoint=False)
    measured = bench.column("transmission_error", at, LOBE, angles)
    record = Record("run", "transmission_error", "rad", "a", 1, measured, {"angle": angles}, {"speed": at.speed, "load": at.load, "temperature": at.temperature},
                    stated_noise=1e-6)  # fmt: skip
    present = {"crank_lobe_errors": {name: {"value": value} for name, value in LOBE.items()}}
    steps = ({"campaign": "a", "nuisances": {"angle_zero[1]": 1e-5}},) if fitted else ()
    model = PhysicalModel(ModelFile(reducer.name, reducer, effects=present, steps=steps), replace(campaign(), name="a", reducer=reducer, records=(record,)))
    assert set(model.zeros) == ({"angle_zero[1]"} if fitted else set())
