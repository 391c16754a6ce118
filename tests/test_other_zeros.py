"""A large effect and a zero of angles that looked alike without it: where the discs have changed places, what is off about them has turned with them."""

import math
from dataclasses import replace

import pytest
from zero_campaign import HIDDEN, NAME, REDUCER, TURNED, ZERO, written

from discrepancy.campaign.load import load_campaign
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.model_file import load_model
from discrepancy.prediction.physical_model import PhysicalModel


@pytest.fixture(scope="module")
def doctor(tmp_path_factory):
    """Of transmission errors of a reducer with discs off centre, the encoder a little off the model's zero."""
    place = written(tmp_path_factory.mktemp("zeros"))
    doctor = Diagnostician(PhysicalModel(load_model(REDUCER), load_campaign(place)))
    doctor.prepare()
    doctor.screened([c for c in doctor.candidates if c.name == NAME])
    return doctor


def test_discs_that_have_changed_places_have_turned(doctor):
    result, wave = doctor.refits.widened(doctor.refits.fit([NAME])), doctor.space.model.wave
    right = result.fit.values | HIDDEN | {ZERO: TURNED}
    wrong = right | {ZERO: TURNED - wave, "disc_runout_angle": HIDDEN["disc_runout_angle"] - math.pi}
    for values in (right, wrong):
        found = doctor.refits.at_its_zero(replace(result, fit=replace(result.fit, values=values))).fit.values
        assert found[ZERO] == pytest.approx(TURNED, abs=2e-4)
        assert math.remainder(found["disc_runout_angle"] - HIDDEN["disc_runout_angle"], 2.0 * math.pi) == pytest.approx(0.0, abs=0.01)
