"""Whose angle a transmission error stands over is not certain from a head: it is doubted, and said by an option."""

import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCSEC, ERROR

from cli.main import main
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.whose_angle import REMEDY, TEXT
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import campaign_text, checked
from fmu_src.faults import InputFault
from workbench.file_words import in_fields
from workbench.folder import Folder
from workbench.intake import view


@pytest.fixture
def bench(tmp_path):
    for load in (80, 167):
        table = pd.DataFrame({"position sortie [°]": np.degrees(ANGLE), 'erreur de transmission ["]': ERROR / ARCSEC + 0.001 * load * np.cos(ANGLE)})
        table.to_csv(tmp_path / f"te_{load}Nm_15rpm_1.csv", index=False)
    return tmp_path


def test_it_is_doubted_once_with_the_option_that_says_otherwise(bench):
    proposal = propose([bench], Wishes("RV20E-121"))
    assert [doubt.place for doubt in proposal.doubts if doubt.text == TEXT] == ["te_167Nm_15rpm_1.csv and 1 more"]
    assert "--angle-of input" in REMEDY and not proposal.angle_of.sure and all(record.of_output for record in checked(proposal).records)
    assert proposal.as_json()["angle_of"]["value"] == "output"


@pytest.mark.parametrize(("said", "of_output"), [("input", False), ("output", True)])
def test_what_is_said_of_it_is_written_and_doubted_no_more(bench, said, of_output):
    proposal = propose([bench], Wishes("RV20E-121", angle_of=said))
    assert TEXT not in [doubt.text for doubt in proposal.doubts] and {record.of_output for record in checked(proposal).records} == {of_output}
    assert f'angle_of = "{said}"' in campaign_text(proposal, bench)


def test_nothing_is_doubted_that_no_load_or_a_second_encoder_tells(bench):
    assert TEXT not in [doubt.text for doubt in propose([bench], Wishes("RV20E-121", conditions={"load_torque": "0 N.m"}, names=("te_{any}Nm_{speed}rpm_{replicate}",))).doubts]
    both = bench / "both"
    both.mkdir()
    pd.DataFrame({"output angle [deg]": np.degrees(ANGLE), "motor angle [deg]": 121 * np.degrees(ANGLE - ERROR)}).to_csv(both / "te_167Nm_15rpm_1.csv", index=False)
    proposal = propose([both], Wishes("RV20E-121"))
    assert proposal.angle_of.sure and TEXT not in [doubt.text for doubt in proposal.doubts]


@pytest.mark.parametrize(("turned", "sure"), [(1.0, True), (-1.0, True), (0.0, False)])
def test_steps_as_uneven_as_the_error_are_the_output_s(bench, turned, sure):
    """Sampled at equal times, with the digits and the noise that a bench writes."""
    rng = np.random.default_rng(4)
    for path in bench.glob("*.csv"):
        table = pd.read_csv(path)
        angle, error = table.columns
        noise = rng.normal(0.0, 0.2, len(table))
        table[angle] = np.round(table[angle] + turned * (table[error] + noise) / 3600.0, 5)
        table.to_csv(path, index=False)
    proposal = propose([bench], Wishes("RV20E-121"))
    assert (proposal.angle_of.value, proposal.angle_of.sure) == ("output", sure)
    assert (TEXT in [doubt.text for doubt in proposal.doubts]) != sure and ("uneven" in proposal.angle_of.reason) == sure


@pytest.mark.parametrize(("turned", "value"), [(0.0, "input"), (1.0, "output")])
def test_an_angle_of_the_input_beside_it_tells_whether_the_output_s_was_measured(bench, turned, value):
    """An "output angle" that is the input's over the ratio to the last digit knows nothing of the error beside it."""
    for path in bench.glob("*.csv"):
        table = pd.read_csv(path)
        _, error = table.columns
        of_input = pd.DataFrame({"Input angle (rev)": (121.0 * ANGLE / (2.0 * np.pi)).round(4), "Output angle (deg)": (np.degrees(ANGLE) + turned * table[error] / 3600.0).round(5)})
        of_input.assign(TE=table[error]).rename(columns={"TE": "TE (arcsec)"}).to_csv(path, index=False)
    proposal = propose([bench], Wishes("RV20E-121"))
    assert (proposal.angle_of.value, proposal.angle_of.sure) == (value, True)
    assert {record.of_output for record in checked(proposal).records} == {value == "output"}


def test_an_option_that_nothing_follows_is_told(tmp_path, bench):
    with pytest.raises(InputFault, match="--angle-of motor"):
        Wishes(angle_of="motor")
    (bench / "loops").mkdir()
    pd.DataFrame({"torque [Nm]": [0, 50, 0, -50, 0] * 9, "twist [arcmin]": [0, 1, 0, -1, 0] * 9}).to_csv(bench / "loops" / "loop.csv", index=False)
    assert any("--angle-of input says nothing" in doubt.text for doubt in propose([bench / "loops"], Wishes("RV20E-121", angle_of="input")).doubts)


def test_command_and_workbench_say_the_same(bench, capsys):
    assert main(["campaign", "from", str(bench), "--reducer", "RV20E-121", "--dry-run"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "--angle-of input" in said
    # Of the curve, too, it is said what is meant.
    assert "times over the file, as a transmission error does" in said and "swings" not in said
    folder = Folder(bench)
    folder.remember("wishes", {"reducer": "RV20E-121"})
    assert in_fields(TEXT) in [doubt["text"] for doubt in view(folder)["proposal"]["doubts"]] and in_fields(TEXT).startswith("'an encoder on the output' is assumed")
    folder.remember("wishes", {"reducer": "RV20E-121", "angle_of": "input"})
    found = view(folder)
    assert in_fields(TEXT) not in [doubt["text"] for doubt in found["proposal"]["doubts"]] and "--angle-of input" in found["command"] and 'angle_of = "input"' in found["text"]


@pytest.mark.parametrize("header", ["Ángulo de entrada / i [°]", "input angle / ratio [deg]", "Antriebswinkel / 121 [°]", "angle moteur / i (deg)"])
def test_an_angle_of_the_input_over_the_ratio_turns_as_the_output_does(tmp_path, header):
    """It was divided by 121 again, its orders lay at 9,680, and nothing doubted it."""
    table = pd.DataFrame({header: np.degrees(ANGLE), "error [arcsec]": ERROR / ARCSEC})
    table.to_csv(tmp_path / "te_167Nm_15rpm_1.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    (record,) = checked(proposal).records
    assert record.axes["angle"] == pytest.approx(ANGLE) and not record.of_output
    assert proposal.angle_of.value == "input" and proposal.angle_of.sure and TEXT not in [doubt.text for doubt in proposal.doubts]
