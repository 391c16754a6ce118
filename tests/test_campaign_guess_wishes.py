"""Guesses and what is said against them: columns, units and patterns that somebody states, and angles of the input."""


import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCSEC, ERROR

from discrepancy.campaign.guess.file_names import suggested
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from fmu_src.faults import InputFault


@pytest.mark.parametrize("patterns, found", [
    (["g7_T50_{replicate}", "g7_T100_{replicate}"], "g7_T{load}_{replicate}"), (["g7_T50", "g8_T100"], None), (["g7_T50"], None),
    (["a_b", "a_c"], None), (["T50kalt", "T100kalt"], "T{load}kalt"), (["T50_x", "M50_x"], None),
])  # fmt: skip
def test_names_that_differ_by_a_number_behind_letters_are_asked_about(patterns, found):
    assert suggested(patterns, "load") == found


def test_unit_of_a_column_that_no_file_has_is_refused(tmp_path):
    (tmp_path / "loop.csv").write_text("torque [N.m],turning [arcmin]\n" + "".join(f"{t},{0.02 * t}\n" for t in range(-100, 101, 10)), encoding="utf-8")
    with pytest.raises(InputFault, match=r"--unit turnin=deg: no file has a column 'turnin' .*did you mean turning"):
        propose([tmp_path / "loop.csv"], Wishes("RV20E-121", units={"turnin": "deg"}))


def test_condition_that_a_file_says_otherwise_is_kept_and_said(tmp_path):
    (tmp_path / "te_28degC.csv").write_text("angle [deg],te [arcsec]\n" + "".join(f"{a},{a % 7}\n" for a in range(0, 360, 3)), encoding="utf-8")
    proposal = propose([tmp_path / "te_28degC.csv"], Wishes("RV20E-121", conditions={"temperature": "20 degC"}))
    assert any("28 degC, which is kept, not 20 degC" in doubt.text for doubt in proposal.doubts)


@pytest.mark.parametrize("header", ["input_angle_deg", "Antriebswinkel [°]", "motor angle [deg]", "phi_in [deg]", "input angle [deg]"])
def test_an_angle_of_the_input_is_divided_by_the_ratio(tmp_path, header):
    pd.DataFrame({header: 121 * np.degrees(ANGLE), "te_arcsec": ERROR / ARCSEC}).to_csv(tmp_path / "te_1.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    assert proposal.runs[0].guessed.columns.keys() == {"value", "input_angle"}
    record = checked(proposal).records[0]
    assert record.axes["angle"] == pytest.approx(ANGLE) and record.values == pytest.approx(ERROR)


def test_a_stated_column_wins(tmp_path):
    columns = {"phi [deg]": 121 * np.degrees(ANGLE), "out [deg]": np.degrees(ANGLE), "te_arcsec": ERROR / ARCSEC}
    pd.DataFrame(columns).to_csv(tmp_path / "te_1.csv", index=False)
    for given in ("phi [deg]", "phi"):
        proposal = propose([tmp_path], Wishes("RV20E-121", columns={"input_angle": given}))
        assert proposal.runs[0].guessed.columns["input_angle"].column.reason == "given"
        assert checked(proposal).records[0].axes["angle"] == pytest.approx(ANGLE)


@pytest.mark.parametrize("columns, said", [
    ({"winkel": "out [deg]"}, "there is no such role; choose from"), ({"angle": "ot"}, "no file has a column 'ot' .*did you mean out"),
    ({"torque": "out [deg]"}, "the files are taken for transmission_error, which has no place for this column as torque"),
])  # fmt: skip
def test_a_stated_column_that_nothing_follows_is_refused(tmp_path, columns, said):
    pd.DataFrame({"out [deg]": np.degrees(ANGLE), "te_arcsec": ERROR / ARCSEC}).to_csv(tmp_path / "te_1.csv", index=False)
    with pytest.raises(InputFault, match=said):
        propose([tmp_path], Wishes("RV20E-121", columns=columns))
