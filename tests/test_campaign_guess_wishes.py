"""Guesses and what is said against them: columns, units and patterns that somebody states, and angles of the input."""


import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCMIN, ARCSEC, ERROR, TORQUE, TWIST

from cli.main import main
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.unread_numbers import suggested
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from fmu_src.faults import InputFault


@pytest.mark.parametrize("patterns, found", [
    (["g7_T50_{replicate}", "g7_T100_{replicate}"], ["g7_T{load}_{replicate}"]), (["g7_T50"], []),
    (["a_b", "a_c"], []), (["T50kalt", "T100kalt"], ["T{load}kalt"]), (["T50_x", "M50_x"], []),
    # Of several numbers each is named; a word that differs besides stays a condition.
    (["g7_T50", "g8_T100"], ["g{load}_{condition}", "{condition}_T{load}"]), (["te_50_new", "te_100_worn"], ["te_{load}_{condition}"]),
    (["te_1_50", "te_1_100", "te_2_167"], ["te_{condition}_{load}", "te_{load}_{condition}"]),
    # Names of two kinds, each with its own.
    (["te_50", "te_100", "loop_x_50", "loop_x_100"], ["te_{load}", "loop_x_{load}"]),
])  # fmt: skip
def test_names_that_differ_by_a_number_behind_letters_are_asked_about(patterns, found):
    assert [pattern for pattern, _ in suggested(patterns, "load")] == found


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


def loop_and_error(folder):
    """A loop and a transmission error, each with a column of the housing's temperature."""
    warm = {"T_housing [degC]": 35.0 + 0.001 * np.arange(len(TORQUE))}
    pd.DataFrame({"torque [N.m]": TORQUE, "twist [arcmin]": TWIST / ARCMIN, **warm}).to_csv(folder / "loop_1.csv", index=False)
    warm = {"T_housing [degC]": 35.0 + 0.001 * np.arange(len(ANGLE))}
    pd.DataFrame({"angle [deg]": np.degrees(ANGLE), "te [arcsec]": ERROR / ARCSEC, **warm}).to_csv(folder / "te_50Nm_15rpm_1.csv", index=False)
    return folder


def test_a_number_of_the_condition_is_a_column_of_every_quantity_and_changes_none(tmp_path):
    """Loops became input torques, whose load was asked for."""
    folder = loop_and_error(tmp_path)
    plain = propose([folder], Wishes("RV20E-121", tags={"locked": "output"}))
    assert [run.guessed.left_out for run in plain.runs] == [("T_housing [degC]",), ()]
    proposal = propose([folder], Wishes("RV20E-121", columns={"temperature": "T_housing"}, tags={"locked": "output"}))
    assert [run.guessed.quantity.value for run in proposal.runs] == ["hysteresis", "transmission_error"] and not proposal.needs and proposal.doubts == plain.doubts
    assert [run.guessed.quantity.value for run in plain.runs] == ["hysteresis", "transmission_error"]
    for record in checked(proposal).records:
        assert record.axes["temperature"] == pytest.approx(273.15 + 35.0 + 0.001 * np.arange(len(record.values)))
    assert propose([folder], Wishes("RV20E-121", columns={"temperature": "T_housing", "value": "twist"})).runs[0].guessed.columns.keys() == {"value", "torque", "temperature"}


def test_where_each_row_s_input_was_locked_is_a_column(tmp_path):
    table = {"torque [N.m]": TORQUE, "twist [arcmin]": TWIST / ARCMIN, "motor [deg]": np.full(len(TORQUE), 40.0)}
    pd.DataFrame(table).to_csv(tmp_path / "loop.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121", columns={"locked_at": "motor [deg]"}, tags={"locked": "input"}))
    assert not proposal.doubts and checked(proposal).records[0].axes["locked_at"] == pytest.approx(np.radians(40.0))


def test_a_column_of_some_files_only(tmp_path):
    folder = loop_and_error(tmp_path)
    (folder / "loop_2.csv").write_text((folder / "loop_1.csv").read_text())
    proposal = propose([folder], Wishes("RV20E-121", columns={"loop_2*:temperature": "T_housing"}))
    assert ["temperature" in run.guessed.columns for run in proposal.runs if run.guessed.quantity.value == "hysteresis"] == [False, True]
    for key, column, said in (
        ("lop*:temperature", "T_housing", r"--column lop\*:temperature=T_housing: no file is named lop\*; there are loop_1.csv"),
        ("loop*:temprature", "T_housing", "there is no such role.*did you mean temperature"), ("loop*:temperature", "te", "no file has a column 'te' of numbers; there are T_housing"),
    ):  # fmt: skip
        with pytest.raises(InputFault, match=said):
            propose([folder], Wishes("RV20E-121", columns={key: column}))


def test_columns_without_a_part_are_named(tmp_path, capsys):
    assert main(["campaign", "from", str(loop_and_error(tmp_path)), "--reducer", "RV20E-121", "--dry-run"]) == 0
    out = capsys.readouterr().out
    assert out.count("left out: ") == 1 and "left out: 'T_housing [degC]'; --column 'ROLE=COLUMN' gives one a part" in out


def test_what_some_conditions_lack_is_asked_of_them_alone_and_nothing_is_made_up(tmp_path, capsys):
    folder = loop_and_error(tmp_path)
    (folder / "te_kalt.csv").write_text((folder / "te_50Nm_15rpm_1.csv").read_text())
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121"]) == 1
    command = capsys.readouterr().out.rstrip().splitlines()[-1]
    assert command.endswith("--overwrite --condition 'kalt:output_speed=...' --condition 'kalt:load_torque=...'")
