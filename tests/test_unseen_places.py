"""Loops of which nobody knows where they were taken hold no effect that transmission errors tell, as long as they have no place."""

import numpy as np
import pytest

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.directions import half_a_turn_on
from discrepancy.inference.refit.effect_fit import fit_effects
from discrepancy.inference.refit.refit import refit
from discrepancy.inference.refit.unseen_places import without_unseen
from discrepancy.problem import Candidate, Parameter, Record

ANGLE, TORQUE = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False), np.linspace(-1.0, 1.0, 80)
WAVE, TURNING = 1e-5 * np.sin(3.0 * ANGLE), 1e-4 * TORQUE
RING = Candidate("ring", "ring", (Parameter("ring", "1", 0.0, -9.0, 9.0, 1.0),))
SPRING = Candidate("spring", "spring", (Parameter("spring", "1", 0.0, -9.0, 9.0, 1.0),), signals=("hysteresis",))


class Bench:
    """A ring shows twice as large in the error; as the mean over positions it turns a loop one way, at the place of that loop it went the other way."""

    nuisances = ()
    candidates = (RING, SPRING)

    def __init__(self, unseen):
        random = np.random.default_rng(4)
        shown = [2.0 * WAVE + 1e-7 * random.standard_normal(200) for _ in range(2)] + [5.0 * TURNING + 1e-6 * random.standard_normal(80) for _ in range(2)]
        axes = [{"angle": ANGLE}, {"angle": ANGLE}, {"torque": TORQUE}, {"torque": TORQUE}]
        names = ["transmission_error", "transmission_error", "hysteresis", "hysteresis"]
        self.records = [Record(f"{q}/{k}", q, "rad", q, k % 2 + 1, y, a, {}) for k, (q, y, a) in enumerate(zip(names, shown, axes))]
        self.places_unknown = unseen

    def predict(self, values, which=None):
        ring, spring = values.get("ring", 0.0), values.get("spring", 0.0)
        every = [ring * WAVE, ring * WAVE, (spring - ring) * TURNING, (spring - ring) * TURNING]
        return [every[i] for i in (range(4) if which is None else which)]

    def unseen(self, values):
        assert any(values.values())
        return self.places_unknown

    def unplaced(self):
        return self.places_unknown

    placed_anew = otherwise = elsewhere = waves_on = places = put = unplaced


def fitting(candidate, start):
    return lambda space, least: fit_effects(space, [candidate], [start], False, least)


def workspace(unseen):
    space = Workspace(Bench(unseen))
    space.fit_base()
    return space


def test_what_else_was_measured_tells():
    space = workspace([2, 3])
    # By all runs the loops hold it.
    held = fit_effects(space, [RING], [{"ring": 1.0}], False, np.inf)
    assert held.values["ring"] < 0.5
    free = without_unseen(space, [RING], fitting(RING, {"ring": 1.0}), np.inf)
    assert free.values["ring"] == pytest.approx(2.0, rel=1e-3)
    # One of all runs, in which the loops are as the base model has them.
    rows = slice(space.rows[2].start, space.rows[3].stop)
    assert np.array_equal(free.residual[rows], space.base.residual[rows]) and not free.jacobian[rows].any()
    assert free.chi2 == pytest.approx(float(free.residual @ free.residual))
    # Which of the two leaves less is taken.
    assert refit(space, [RING], [], {"ring": 1.0}).fit.chi2 == pytest.approx(min(held.chi2, free.chi2))


@pytest.mark.parametrize(("unseen", "candidate"), [([], RING), ([2, 3], SPRING), ([0, 1], RING)], ids=["all have a place", "shows in loops alone", "no error"])
def test_where_nothing_else_tells_all_runs_do(unseen, candidate):
    assert without_unseen(workspace(unseen), [candidate], fitting(candidate, {candidate.name: 1.0}), np.inf) is None


@pytest.mark.parametrize(("waves", "there"), [(1, 0.5 - np.pi), (2, None), (3, 0.5 + np.pi / 3.0)], ids=["off centre", "oval", "three lobes"])
def test_half_a_turn_on_directions_alone_are_turned(waves, there):
    grid = tuple({"angle": 2.0 * np.pi * k / 4 / waves} for k in range(4))
    shape = Parameter("angle", "rad", 0.0, -20.0, 20.0, 0.3)
    found = half_a_turn_on([Candidate("ring", "ring", RING.amplitudes, (shape,), grid)], {"ring": 3e-6, "angle": 0.5})
    assert [(p.name, pytest.approx(other)) for p, other in found] == ([] if there is None else [("angle", there)])
