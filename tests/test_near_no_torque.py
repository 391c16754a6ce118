"""Samples of a loop near no torque, where the output floats: counted, said, and exported without a prediction; and what a prediction was calibrated to."""

import json

import numpy as np
import pandas as pd
import pytest

from cli.main import main

RATED = 167.0
TORQUE = RATED * np.sin(np.linspace(0.0, 2.5 * np.pi, 300))


@pytest.fixture(scope="module")
def bench(tmp_path_factory):
    folder = tmp_path_factory.mktemp("bench")
    rng = np.random.default_rng(1)
    for k in (1, 2):
        twist = TORQUE / 45 + 0.2 * np.sign(np.gradient(TORQUE)) + rng.normal(0.0, 0.02, len(TORQUE))
        pd.DataFrame({"torque [N.m]": TORQUE, "twist [arcmin]": twist}).to_csv(folder / f"loop_{k}.csv", index=False)
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121", "--tag", "locked=input"]) == 0
    return folder


def test_samples_that_are_not_compared_are_counted_and_exported_without_a_prediction(bench, tmp_path, capsys):
    few = int((np.abs(TORQUE) <= 0.01 * RATED).sum())
    assert main(["compare", "RV20E-121", str(bench), "--json", "--export", str(tmp_path / "e.csv")]) == 0
    told = json.loads(capsys.readouterr().out)
    assert few > 1 and [(run["samples"], run["near_no_torque"]) for run in told["runs"]] == [(300 - few, few)] * 2
    assert f"{2 * few} samples of 2 runs not compared: within 1 % of the rated torque from no torque the output floats," in " ".join(told["warnings"])
    place = tmp_path / "e_hysteresis_locked_input.csv"
    table, calibrated = pd.read_csv(place), pd.read_csv(tmp_path / "e_calibrated.csv")
    assert "model_error[hysteresis]" in set(calibrated["parameter"])
    rows = table[table["run"] == "loop_1"]
    near = np.abs(rows["torque [N.m]"]) <= 0.01 * RATED
    assert rows["torque [N.m]"].to_numpy() == pytest.approx(TORQUE) and rows["measured [arcmin]"].notna().all()
    assert rows.loc[near, ["predicted [arcmin]", "noise [arcmin]"]].isna().all(axis=None) and rows.loc[~near, ["predicted [arcmin]", "noise [arcmin]"]].notna().all(axis=None)


def test_a_diagnosis_says_standing_notes_in_few_words():
    """The same three long notes stood below every command."""
    from discrepancy.words.standing_notes import floating_text, shortened

    whole = floating_text({"loop_1": 29, "loop_2": 29})
    assert whole.startswith("58 samples of 2 runs not compared") and len(whole) < 260
    told = shortened([whole, "another reducer"], {whole: "58 samples of 2 runs near no torque not compared"})
    assert told == ["another reducer", "as before: 58 samples of 2 runs near no torque not compared (`rvwear compare` says these whole)"]
    assert shortened(["another reducer"], {whole: ""}) == ["another reducer"]
