"""Curves of a quantity whose zero is free are drawn at the fitted one: repetitions lie over each other, as what is left of them does."""

from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.page import series
from discrepancy.page.runs import runs_of
from discrepancy.problem import Record
from discrepancy.scales import AXES

ANGLE = np.linspace(0.0, 6.0, 50)
HEIGHTS = (3.0, -5.0, 0.5)


def drawn(zero_known=False, quantity="transmission_error"):
    """Three repetitions, written at several heights; the model's mean is that of each run, where it is free."""
    wave = np.sin(5.0 * ANGLE) - np.sin(5.0 * ANGLE).mean()
    records = [Record(f"r{k}", quantity, "rad", "a", k, wave + height, {"angle": ANGLE}, {}, zero_known=zero_known) for k, height in enumerate(HEIGHTS)]
    predicted = [0.9 * wave + (0.0 if zero_known else height) for height in HEIGHTS]
    whitener = SimpleNamespace(kept=np.arange(50) < 40, scale=np.full(40, 0.1), between=0.0)
    return runs_of(SimpleNamespace(records=records, noise=SimpleNamespace(whiteners=[whitener] * 3)), predicted, AXES["speed"])


def test_repetitions_lie_over_each_other():
    runs = drawn()
    for run, height in zip(runs, HEIGHTS):
        assert run.zero == pytest.approx(height)
        assert run.measured == pytest.approx(runs[0].measured) and run.predicted == pytest.approx(0.9 * run.measured)
    assert "zero of this quantity is free" in series.figure("p", "transmission_error", runs).caption


def test_a_zero_that_counts_stays_where_it_is():
    runs = drawn(zero_known=True)
    assert [float(run.measured[0]) for run in runs] == pytest.approx([runs[0].measured[0] + h - HEIGHTS[0] for h in HEIGHTS])
    assert all(run.zero == 0.0 for run in runs) and "is free" not in series.figure("p", "transmission_error", runs).caption
    assert all(run.zero == 0.0 for run in drawn(quantity="no_load_torque"))
