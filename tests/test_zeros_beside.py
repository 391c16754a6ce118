"""Zeros of angles are looked for anew beside an effect that is far larger than the base model's own pattern."""

import math

import numpy as np
import pytest

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.prediction.angle_zeros import best_zeros
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.curves import signal
from discrepancy.prediction.over_angle import OverAngle
from discrepancy.problem import Parameter, Record
from reducers.reducer import load_reducer

NAME, WAVE = "angle_zero[1]", 2.0 * math.pi / 80.0
OVAL = {"disc_ovality": 4e-6}
ARCSEC = math.radians(1.0 / 3600.0)


def test_the_zero_is_that_of_the_pattern_with_the_effect():
    bench, angle = Bench(load_reducer("RV20E-121"), {}), np.linspace(0.0, 2.0 * math.pi, 721)
    record = Record("te", "transmission_error", "rad", "c", 1, np.zeros(721), {"angle": angle}, {"speed": 100.0, "load": 100.0})
    there = -0.21 * WAVE
    measured = Record(**{**record.__dict__, "values": signal(OverAngle(bench, record, "transmission_error"), {**OVAL, NAME: there})
                         + 0.3 * ARCSEC * np.random.default_rng(2).standard_normal(721)})  # fmt: skip

    def own(_, values):
        return dict(values)

    left, zeros = best_zeros(bench, [measured], WAVE, own, OVAL, [NAME])
    assert abs(math.remainder(zeros[NAME] - there, WAVE)) < WAVE / 40.0
    # Far better than any without the effect, or with its oval turned; nothing for a zero that the model knows.
    assert left < 0.3 * min(best_zeros(bench, [measured], WAVE, own, {**OVAL, "disc_ovality_angle": turned}, [NAME])[0] for turned in (0.8, 1.6))
    assert best_zeros(bench, [measured], WAVE, own, OVAL, []) == (0.0, {})


class Lines:
    """Two records of a line through 0."""

    def __init__(self):
        x = np.linspace(1.0, 2.0, 30)
        rng = np.random.default_rng(1)
        self.records = [Record(str(k), "te", "rad", str(k // 2), k, 2.0 * x + 0.1 * rng.standard_normal(30), {"x": x}, {}) for k in range(4)]
        self.nuisances, self.candidates = (Parameter("slope", "1", 0.0, -10.0, 10.0, 1.0),), ()

    def predict(self, values, which=None):
        return [values.get("slope", 0.0) * np.linspace(1.0, 2.0, 30) for _ in (range(4) if which is None else which)]


def test_a_workspace_of_some_records_leaves_the_others_out():
    space = Workspace(Lines())
    space.fit_base()
    some = space.only([0, 1])
    whole = space.residual({"slope": 1.0})
    assert space.base.values["slope"] == pytest.approx(2.0, abs=0.05)
    assert some.residual({"slope": 1.0}) == pytest.approx(whole[: len(whole) // 2])
    assert len(space.residual({"slope": 1.0})) == len(whole)
