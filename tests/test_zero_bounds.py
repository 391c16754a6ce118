"""What a campaign states of where its angles count from is held to, or refused."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from zero_campaign import REDUCER, TURNED, ZERO, written

from discrepancy.campaign.load import load_campaign
from discrepancy.compare import compare
from discrepancy.doubts.locked_zeros import bound_texts
from discrepancy.model_file import load_model
from discrepancy.prediction.zero_bounds import ZeroBounds
from fmu_src.faults import InputFault

WHOLE = 'unit = "deg"\nlower = -180\nupper = 180\nper = "mounting"\n'
# Of the pattern of 40 pins and 2 discs [deg of the output].
WAVE = 4.5


def stated(place, text):
    path = written(place, hidden={}) / "campaign.toml"
    path.write_text(path.read_text().replace(WHOLE, text))
    return load_campaign(place)


@pytest.mark.parametrize("text, zero", [
    (WHOLE, math.degrees(TURNED)),
    ('unit = "deg"\nlower = 3\nstart = 4\nupper = 6\n', math.degrees(TURNED) + WAVE),
    ('unit = "rad"\nlower = -0.01\nupper = 0.005\n', math.degrees(0.005)),
])  # fmt: skip
def test_a_zero_lies_within_its_bounds(text, zero, tmp_path):
    found = compare(load_model(REDUCER), stated(tmp_path, text))
    assert math.degrees(found.nuisances[ZERO]) == pytest.approx(zero, abs=0.05)
    assert any("stands at the bound that nuisances.encoder_phase" in warning for warning in found.warnings) == ("0.005" in text)


@pytest.mark.parametrize("text, told", [
    (WHOLE + "prior = 2\n", r"campaign.toml: nuisances.encoder_phase.prior = 2 deg: .* leave prior out"),
    (WHOLE.replace("mounting", "run"), r'campaign.toml: nuisances.encoder_phase.per = "run": .* write per = "mounting"'),
    (WHOLE.replace("deg", "mm"), r"campaign.toml: nuisances.encoder_phase.unit = 'mm'"),
    (WHOLE.replace("-180", "10"), r"lower = 10, start = 0, upper = 180 deg: must rise in this order; start is 0 where it is not given"),
])  # fmt: skip
def test_what_a_zero_cannot_have_is_refused(text, told, tmp_path):
    with pytest.raises(InputFault, match=told):
        stated(tmp_path, text)


def test_searches_keep_to_the_bounds():
    shares, wave = np.linspace(-0.5, 0.5, 48, endpoint=False), math.radians(WAVE)
    bounds = ZeroBounds(math.radians(-3.0), math.radians(8.0))
    waves = bounds.waves(shares, wave, 0.0)
    assert (waves.shape, np.degrees([waves.min(), waves.max()])) == ((3, 48), pytest.approx([-3.0, 8.0]))
    assert math.degrees(bounds.nearest(math.radians(1.0), wave, math.radians(12.0))) == pytest.approx(5.5)
    assert np.degrees(bounds.in_a_wave(shares, wave)) == pytest.approx(WAVE * shares)
    assert ZeroBounds().waves(shares, wave, 0.0).shape == (80, 48)
    model = SimpleNamespace(zero_bounds=bounds, zeros={ZERO: 0.0})
    assert bound_texts(model, SimpleNamespace(values={ZERO: bounds.upper})) and not bound_texts(model, SimpleNamespace(values={ZERO: 0.1}))
