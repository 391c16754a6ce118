"""Which way an effect goes is told only where its opposite would show otherwise."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.verdict import ONE, STOPPED
from discrepancy.model_file import ModelFile
from discrepancy.opposite_sign import sign_doubts
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from reducers.reducer import load_reducer
from tests.test_next_run import CAMPAIGN

FACTORS = {"speed": 209.44, "load": 167.0, "temperature": 293.15, "direction": 1.0}


@pytest.fixture(scope="module")
def space():
    """A loop of a reducer with two cranks in which nothing is missing, twice, locked at one angle."""
    reducer = load_reducer("RV20E-121-rigid")
    rng = np.random.default_rng(1)
    torque = 167.0 * np.concatenate([np.linspace(0.05, 1.0, 12), np.linspace(0.97, -1.0, 24), np.linspace(-0.97, 0.02, 12)])
    records = tuple(Record(f"r{k}", "hysteresis", "rad", "a", k, 1e-7 * rng.standard_normal(len(torque)), {"torque": torque},
                           FACTORS | {"locked_at": 0.0}, tags={"locked": "input"}, stated_noise=1e-7) for k in (1, 2))  # fmt: skip
    model = PhysicalModel(ModelFile(reducer.name, reducer), replace(CAMPAIGN, reducer=reducer, records=records), zeros={})
    found = Workspace(model)
    found.fit_base()
    return found


def doubts(space, name, values, verdict=ONE):
    (candidate,) = [c for c in space.model.candidates if c.name == name]
    member = SimpleNamespace(name=name, candidates=(candidate,), own=candidate.parameters, fit=SimpleNamespace(values=values))
    found = SimpleNamespace(verdict=verdict, fits=SimpleNamespace(members=[member], space=space))
    return sign_doubts([{"candidates": [name]}], found)


def test_a_crank_seat_shows_its_size_in_a_loop_and_not_which_way(space):
    values = {"carrier_seat_shift": 7e-6, "carrier_seat_radial": 0.0}
    (text,) = doubts(space, "hole_position_errors.carrier", values)
    assert text.startswith("hole_position_errors.carrier: with the opposite sign it shows the same")
    assert not doubts(space, "hole_position_errors.carrier", values, STOPPED)


def test_what_can_only_go_one_way_or_shows_otherwise_is_not_doubted(space):
    assert not doubts(space, "needle_clearance", {"needle_clearance_added": 3e-6})
    # A gap that is larger lets the output turn further.
    assert not doubts(space, "profile_modification", {"equidistant_added": -5e-6, "shift_added": 0.0})
