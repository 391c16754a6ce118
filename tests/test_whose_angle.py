"""Whose an angle was is seen in how a large error shows itself: at the output's angle, which turns with it, or at the input's over the ratio."""

import numpy as np
import pytest
from zero_campaign import ARCSEC, REDUCER, written

from discrepancy.campaign.load import load_campaign
from discrepancy.doubts.calibrated_doubts import lag_doubts
from discrepancy.doubts.whose_angle import gained_as_input
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.model_file import load_model
from discrepancy.prediction.physical_model import PhysicalModel


def as_output(path):
    """The same run as an encoder on the output writes it."""
    angle, error = np.loadtxt(path, delimiter=",", skiprows=1).T
    np.savetxt(path, np.column_stack([angle + np.degrees(error * ARCSEC), error]), delimiter=",", header="angle,error", comments="", fmt="%.6f")


@pytest.mark.parametrize(("of_output", "sign"), [(False, 1.0), (True, -1.0)])
def test_a_large_error_says_whose_its_angle_was(tmp_path, of_output, sign):
    folder = written(tmp_path)
    text = (folder / "campaign.toml").read_text()
    (folder / "campaign.toml").write_text(text.replace('angle_of = "input"', 'angle_of = "output"'))
    if of_output:
        for path in folder.glob("*.csv"):
            as_output(path)
    better = tmp_path / "better.toml"
    better.write_text(f'[model]\nname = "better"\nreducer = "{REDUCER}"\n\n[effects.disc_tooth_errors]\nrunout = "6 um"\nrunout_angle = "0.4 rad"\n')
    model = PhysicalModel(load_model(better), load_campaign(folder))
    doctor = Diagnostician(model)
    doctor.prepare()
    assert (doctor.space.base.values["lag_share"] < 0.2) != of_output
    assert sign * gained_as_input(model, doctor.space, doctor.space.base) > 25.0


@pytest.mark.parametrize(("gained", "words"), [
    (500.0, "it was the input's over the ratio, which explains the errors better by 500"), (-500.0, "set to 0 under the load of each run (it is no"),
    (5.0, "either it was the input's"),
])  # fmt: skip
def test_a_lag_that_hardly_lags_is_told_by_it(gained, words):
    (text,) = lag_doubts(0.02, 0.01, as_input=lambda: gained)
    assert words in text
    assert not lag_doubts(1.0, 0.01, as_input=lambda: gained)
