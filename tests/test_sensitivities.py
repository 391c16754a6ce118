"""The transmission error beside a known run: to first order, so its relative error vanishes with the change."""

import numpy as np
import pytest

from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.units import Condition

RATED = Condition(209.44, 167.0)
ANGLES = np.linspace(0.3, 0.8, 40)


@pytest.fixture(scope="module")
def bench():
    return Bench(load_model("RV20E-121-rigid").reducer, {})


def changes(bench, base, name, step):
    """(first order, exact) change of the transmission error [rad] by a step of one parameter."""
    stepped = {**base, name: base.get(name, 0.0) + step}
    first = [bench.error_beside(RATED, v, ANGLES, base, ANGLES) for v in (base, stepped)]
    exact = [bench.running(RATED, v, ANGLES)[:, 1] for v in (base, stepped)]
    return first[1] - first[0], exact[1] - exact[0]


@pytest.mark.parametrize("name, step", [("planet_runout", 5e-6), ("needle_clearance_added", 2e-7), ("mesh_stiffness", 5e3)])
@pytest.mark.parametrize("base", [{}, {"disc_ovality": 5e-7, "disc_ovality_angle": 0.4}], ids=["ideal", "oval discs"])
def test_relative_error_vanishes_with_the_change(bench, base, name, step):
    base = {**base, name: bench.starts[0][name]}
    errors = []
    for part in (1.0, 1.0 / 16.0):
        first, exact = changes(bench, base, name, part * step)
        errors.append(np.std(first - exact) / np.std(exact))
    # Where a roller is about to lift its force bends sharply.
    assert errors[1] < 0.03
    assert errors[1] < 0.3 * errors[0] or errors[0] < 2e-3


def test_angles_may_be_counted_from_elsewhere(bench):
    """A shift of the angles against the known run is a change like any other."""
    shift = 1e-6
    first = bench.error_beside(RATED, {}, ANGLES + shift, {}, ANGLES)
    assert np.abs(first - bench.running(RATED, {}, ANGLES + shift)[:, 1]).max() < 1e-10
