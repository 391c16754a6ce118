"""A large effect and a zero of angles that looked alike without it: where the discs have changed places, what is off about them has turned with them."""

import math
from dataclasses import replace

import numpy as np
import pytest

from discrepancy.campaign.load import load_campaign
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.units import Condition

ARCSEC, REDUCER = math.pi / 648000.0, "RV20E-121"
NAME, HIDDEN = "disc_tooth_errors.runout", {"disc_runout": 6e-6, "disc_runout_angle": 0.4}
ZERO = "angle_zero[1]"
CONDITION = """
[conditions.at_{load}]
input_speed = "1500 rpm"
load_torque = "{load} N.m"
"""
REPETITION = """
[[runs]]
id = "at_{load}_{k}"
quantity = "transmission_error"
condition = "at_{load}"
replicate = {k}
file = "{load}_{k}.csv"
columns.angle = {{ column = "angle", unit = "deg" }}
columns.value = {{ column = "error", unit = "arcsec" }}
"""


@pytest.fixture(scope="module")
def doctor(tmp_path_factory):
    """Of transmission errors of a reducer with discs off centre, the encoder a little off the model's zero."""
    place = tmp_path_factory.mktemp("zeros")
    bench, rng = Bench(load_model(REDUCER).reducer, {}), np.random.default_rng(3)
    angle = np.linspace(0.0, 2.0 * math.pi / 3.0, 360, endpoint=False)
    text = f'[campaign]\nname = "zeros"\nreducer = "{REDUCER}"\n[quantities.transmission_error]\nangle_of = "input"\n'
    text += '[nuisances.encoder_phase]\nunit = "deg"\nlower = -180\nupper = 180\nper = "mounting"\n'
    for load in (60, 160):
        error = bench.column("transmission_error", Condition(1500.0 * math.pi / 30.0, float(load)), HIDDEN, angle + 0.01)
        text += CONDITION.format(load=load)
        for k in (1, 2):
            rows = np.column_stack([np.degrees(angle), error / ARCSEC + rng.normal(0.0, 0.05, len(angle))])
            np.savetxt(place / f"{load}_{k}.csv", rows, delimiter=",", header="angle,error", comments="", fmt="%.6f")
            text += REPETITION.format(load=load, k=k)
    (place / "campaign.toml").write_text(text)
    doctor = Diagnostician(PhysicalModel(load_model(REDUCER), load_campaign(place)))
    doctor.prepare()
    doctor.screened([c for c in doctor.candidates if c.name == NAME])
    return doctor


def test_discs_that_have_changed_places_have_turned(doctor):
    result, wave = doctor.refits.widened(doctor.refits.fit([NAME])), doctor.space.model.wave
    right = result.fit.values | HIDDEN | {ZERO: 0.01}
    wrong = right | {ZERO: 0.01 - wave, "disc_runout_angle": HIDDEN["disc_runout_angle"] - math.pi}
    for values in (right, wrong):
        found = doctor.refits.at_its_zero(replace(result, fit=replace(result.fit, values=values))).fit.values
        assert found[ZERO] == pytest.approx(0.01, abs=2e-4)
        assert math.remainder(found["disc_runout_angle"] - HIDDEN["disc_runout_angle"], 2.0 * math.pi) == pytest.approx(0.0, abs=0.01)
