"""Curves of a quantity whose zero is free are drawn at the fitted one: repetitions lie over each other, as what is left of them does."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.load import load_campaign
from discrepancy.compare import warnings_of
from discrepancy.page import series
from discrepancy.page.runs import runs_of
from discrepancy.prediction.defined_samples import defined
from discrepancy.problem import Record
from discrepancy.scales import AXES
from tests import zero_campaign

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


def test_a_mean_that_is_not_used_is_one_number_before_and_beside_a_model(tmp_path):
    """A comparison told that of the samples a model foretells: of a loop those about no torque are none, and the mean was another one."""
    campaign = load_campaign(zero_campaign.written(tmp_path, loop=True))
    loop = campaign.of("hysteresis")[0]
    # Written from another height, and more often at the one end.
    uneven = np.concatenate([np.arange(len(loop.values)), np.zeros(20, int)])
    moved = replace(loop, values=loop.values[uneven] + 0.003, axes={"torque": np.where(uneven > 0, loop.axes["torque"][uneven], 0.0)})
    campaign = replace(campaign, records=tuple(moved if r is loop else r for r in campaign.records))
    records = [defined(r, campaign) for r in campaign.records]
    assert len(records[-1].values) < len(moved.values)
    beside = warnings_of(SimpleNamespace(campaign=campaign, records=records, unpredicted=[]), [])  # type: ignore[arg-type]
    before = [f"{f.text}; {f.remedy}" for f in check_campaign(campaign).findings if f.code == "means not used" and f.text.startswith("hysteresis")]
    assert [text for text in beside if text.startswith("hysteresis: a mean of ")] == before and len(before) == 1
