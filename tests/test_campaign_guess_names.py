"""A campaign from file names, options and answers: what is guessed is what was meant, and what is needed is said."""

import json
import re
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCSEC, DEPTH, ERROR, HOURS, KGM, TORQUE, TURN, TWIST, binary, write

from cli.main import main
from discrepancy.campaign.angle_doubts import turns_text
from discrepancy.campaign.guess.file_names import proposed
from discrepancy.campaign.guess.given_names import by_pattern
from discrepancy.campaign.guess.header_units import unit_in
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import campaign_text, checked, write_campaign
from discrepancy.campaign.load import load_campaign
from discrepancy.compare import incomplete
from fmu_src.faults import InputFault
from reducers.library import named_in

ROOT = Path(__file__).resolve().parents[1]


def existing(folder: Path) -> dict:
    with (folder / "campaign.toml").open("rb") as file:
        return tomllib.load(file)


def by_file(content: dict) -> dict[str, tuple]:
    return {r["file"]: (r["quantity"], r["replicate"], {k: c["column"] for k, c in r["columns"].items()}, r.get("tags", {})) for r in content["runs"]}


def partition(content: dict) -> set[frozenset[str]]:
    conditions: dict[str, set[str]] = {}
    for run in content["runs"]:
        conditions.setdefault(run["condition"], set()).add(run["file"])
    return set(map(frozenset, conditions.values()))


def same(folder: Path) -> None:
    """Quantities, columns, units, tags, repetitions and what belongs to one condition are those of the folder's campaign."""
    kept = existing(folder)
    text = campaign_text(propose(sorted(folder.glob("*.csv")), Wishes("RV20E-121")), folder)
    guessed = tomllib.loads(text)
    assert by_file(guessed) == by_file(kept)
    assert partition(guessed) == partition(kept)
    units = [{r["file"]: {k: c["unit"] for k, c in r["columns"].items()} for r in content["runs"]} for content in (guessed, kept)]
    assert units[0] == units[1]


def test_the_hidden_effect_is_guessed_as_it_is():
    same(ROOT / "examples" / "hidden_effect" / "campaign")


@pytest.mark.parametrize("patterned, plain", [("te_{load}Nm_{speed}rpm_{replicate}", "te_167Nm_15rpm_2"), ("TE {temperature}°C {direction} rep{replicate}", "TE 40°C fwd rep2"),
                                              ("Histéresis {load} Nm medida {replicate}", "Histéresis 50 Nm medida 2"), ("loop_{hours}h_{replicate}", "loop_1000h_2"), ("{any}_te_{load}%_{replicate}", "20240102_te_50%_2")])  # fmt: skip
def test_patterns_of_names(patterned, plain):
    said = proposed(Path(f"{plain}.csv"))
    assert said.pattern == patterned and said.replicate == 2 and not said.label
    again = by_pattern(Path(f"{plain}.csv"), patterned)
    assert (again.numbers, again.replicate, again.direction) == (said.numbers, said.replicate, said.direction)


@pytest.mark.parametrize("word", ["run", "nr", "Wdh", "essai", "Versuch", "mesure", "medida", "repetition", "M", "v", "aufbau"])
def test_repetitions_are_no_conditions(tmp_path, word):
    """Known words count; of any other it is said why."""
    for k in (1, 2, 3):
        write(tmp_path, "loop").rename(tmp_path / f"loop_35C_{word}{k}.csv")
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    assert len(proposal.conditions) == 1 and [run.replicate.value for run in proposal.runs] == [1, 2, 3]
    assert not proposal.held_out and proposal.runs[0].guessed.name.pattern == f"loop_{{temperature}}C_{word}{{replicate}}"
    said = [d for d in proposal.doubts if "aufbau1 to aufbau3 are taken for repetitions of one condition" in d.text]
    assert [d.remedy for d in said] == (["--names 'loop_{temperature}C_{condition}' if they are conditions"] if word == "aufbau" else [])
    assert len(propose([tmp_path], Wishes("RV20E-121", names=("loop_{temperature}C_{condition}",))).conditions) == 3


@pytest.mark.parametrize("names", [("T50", "T100"), ("a1", "b2"), ("x2", "x3"), ("x1_20C", "x2_30C"), ("M10", "M50")])
def test_other_numbers_are_conditions(tmp_path, names):
    for name in names:
        write(tmp_path, "loop").rename(tmp_path / f"loop_{name}.csv")
    assert len(propose([tmp_path], Wishes("RV20E-121")).conditions) == 2


def test_names_that_do_not_fit_are_said(tmp_path):
    with pytest.raises(InputFault, match=r"no field \{lod\}.*did you mean load"):
        by_pattern(Path("te_1.csv"), "te_{lod}")
    with pytest.raises(InputFault, match=r"--names 'x_\{load\}' fits none of the 1 files \(te_1.parquet"):
        propose([binary(tmp_path, "parquet")], Wishes(names=("x_{load}",)))


@pytest.mark.parametrize("header, unit", [("te [\"]", "arcsec"), ("M / Nm", "N.m"), ("误差(角秒)", "arcsec"), ("n [min⁻¹]", "rpm"), ("Speed in rpm", "rpm"), ("T_in", None), ("phi", None)])
def test_units_in_headers(header, unit):
    assert (unit_in(header) or (None,))[0] == unit


def test_one_command(tmp_path, capsys):
    for load in (50, 100, 167):
        for k in (1, 2):
            pd.DataFrame({"Winkel [°]": np.degrees(ANGLE), "te [arcsec]": ERROR / ARCSEC + 0.1 * k * np.cos(ANGLE)}).to_csv(tmp_path / f"te_{load}Nm_15rpm_{k}.csv", index=False)
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--dry-run", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert not told["written"] and not (tmp_path / "campaign.toml").exists()
    assert list(told["held_out"]) == ["100N.m"] and "inside the range" in told["held_out"]["100N.m"]["reason"]
    assert told["runs"][0]["columns"]["angle"]["unit"] == {"value": "deg", "reason": "[°] in its header", "sure": True}
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121"]) == 0
    assert capsys.readouterr().out.rstrip().endswith(f"rvwear compare RV20E-121 {tmp_path}")
    campaign = load_campaign(tmp_path)
    assert len(campaign.records) == 6 and len(campaign.held_out) == 2
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121"]) == 2
    assert "exists already" in capsys.readouterr().err


@pytest.mark.parametrize("options, said", [
    (["--condition", "speeed=15 rpm"], "--condition speeed: there is no such thing"), (["--quantity", "hysteresi"], "did you mean hysteresis"),
    (["--unit", "x"], "--unit x: write NAME=VALUE"), (["--counts", "x=many"], "a whole number"), (["--held-out", "nowhere"], "there is no condition|no such condition"),
    (["--condition", "b:hours=0 h"], "there is no condition b"),
])  # fmt: skip
def test_wrong_options_are_said(tmp_path, capsys, options, said):
    write(tmp_path, "plain")
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--dry-run", *options]) == 2
    assert re.search(said, capsys.readouterr().err)


def test_guesses_are_overruled(tmp_path):
    write(tmp_path, "loop_bare")
    wishes = Wishes("RV20E-121", units={"*:y": "arcsec", "x": "kgf.m"}, tags={"locked": "output"}, conditions={"output_speed": "10 rpm"})
    record = checked(propose([tmp_path], wishes)).records[0]
    assert record.values == pytest.approx(TWIST / 60.0, abs=1e-8) and record.tags["locked"] == "output"
    assert record.axes["torque"] == pytest.approx(TORQUE * KGM, abs=1e-4)


def test_a_logger_with_many_channels(tmp_path):
    noise = np.random.default_rng(1).normal(0.0, 0.5, len(ANGLE))
    pd.DataFrame({
        "Zeit [s]": np.arange(len(ANGLE)) / 100, "Winkel Abtrieb [°]": np.degrees(ANGLE), "Winkel Antrieb [°]": 121 * np.degrees(ANGLE),
        "Drehmoment Abtrieb Soll [Nm]": 167.0, "Drehmoment Abtrieb [Nm]": 167 + noise, "Drehzahl Antrieb [1/min]": 1815 + noise, "Drehfehler [arcsec]": ERROR / ARCSEC,
        "Zustand": "ok", "rep": 1,
    }).to_csv(tmp_path / "te_3.csv", sep=";", decimal=",", index=False)  # fmt: skip
    record = checked(propose([tmp_path], Wishes("RV20E-121"))).records[0]
    assert record.quantity == "transmission_error" and record.values == pytest.approx(ERROR) and record.replicate == 3
    assert record.axes["load"] == pytest.approx(167 + noise) and record.axes["speed"] == pytest.approx((1815 + noise) * TURN / 60)
    assert record.axes.keys() == {"angle", "time", "load", "speed"}


@pytest.mark.parametrize("columns, quantity", [
    ({"time_s": ANGLE, "acc_x [m/s2]": ERROR}, "vibration"), ({"order": np.arange(99.0), "amp [m/s^2]": np.sin(np.arange(99.0))}, "vibration_order"),
    ({"time [h]": HOURS, "T_housing [degC]": 20 + HOURS}, "temperature"), ({"angle [deg]": np.arange(360.0), "depth [um]": np.sin(np.arange(360.0) / 60)}, "wear_profile"),
    ({"hours": HOURS, "lost motion [arcsec]": 40 + HOURS}, "lost_motion"), ({"load": HOURS, "efficiency [%]": 60 + HOURS / 100}, "efficiency"),
    ({"hours": HOURS, "Fe [ppm]": HOURS}, "debris_iron"), ({"t": np.arange(601), "Torque (Nm)": TORQUE, "Output (deg)": TWIST, "Motor pos (deg)": 0 * TWIST}, "hysteresis"),
])  # fmt: skip
def test_other_quantities(tmp_path, columns, quantity):
    pd.DataFrame(columns).to_csv(tmp_path / "a.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121", conditions={"output_speed": "15 rpm"}))
    assert proposal.runs[0].guessed.quantity.value == quantity and proposal.runs[0].guessed.quantity.sure


def test_a_speed_that_is_given_for_all_is_none_of_loops(tmp_path):
    """It was written to their conditions, too; what is shared with a file that has one, or given for a condition by its name, stays."""
    for name, kind in (("te_167Nm_1", "plain"), ("loop_20C_1", "loop"), ("loop_40C_1", "loop")):
        write(tmp_path, kind).rename(tmp_path / f"{name}.csv")
    given = {"output_speed": "15 rpm", "load_torque": "100 N.m", "temperature": "20 degC"}
    proposal = propose([tmp_path], Wishes("RV20E-121", conditions=given))
    by_run = {run.name: proposal.conditions[run.condition] for run in proposal.runs}
    assert by_run["loop_20C_1"] == {"temperature": "20 degC"} and by_run["loop_40C_1"] == {"temperature": "40 degC"}
    assert by_run["te_167Nm_1"] == {"output_speed": "15 rpm", "load_torque": "167 N.m", "temperature": "20 degC"}
    loop = next(run.condition for run in proposal.runs if run.name == "loop_20C_1")
    assert propose([tmp_path], Wishes("RV20E-121", conditions={**given, f"{loop}:output_speed": "1 rpm"})).conditions[loop]["output_speed"] == "1 rpm"


def test_one_is_not_many(tmp_path, capsys):
    write(tmp_path, "loop")
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--dry-run"]) == 0 and ": 1 run " in capsys.readouterr().out
    assert turns_text(1.0) == "1 turn" and turns_text(0.999) == "0.999 turns" and turns_text(121.0) == "121 turns"


def test_a_motor_that_turns_on_shows_its_torque_and_no_loop(tmp_path):
    k = np.arange(601)
    columns = {"TIME": 1.72e18 + 1e7 * k, "POSITION": k / 20, "TORQUE": 2 + np.sin(k / 50), "MOTOR_TEMPERATURE": 20 + k / 200}
    pd.DataFrame(columns).to_csv(tmp_path / "run.csv", index=False)
    run = propose([tmp_path], Wishes("RV20E-121", conditions={"output_speed": "15 rpm", "load_torque": "0 N.m"})).runs[0].guessed
    # With load or without, no file says.
    assert run.quantity.value == "input_torque" and not run.quantity.sure and "no_load_torque" in run.quantity.reason
    assert run.columns["time"].unit.value == "ns" and run.columns["time"].keys == {"from_start": True}


def test_the_first_hours_of_a_wear_test_have_the_unit_of_the_others(tmp_path):
    for k, scale in enumerate((0.005, 1.0, 1.0), 1):
        pd.DataFrame({"hours": HOURS, "y": scale * DEPTH / 1e-6}).to_csv(tmp_path / f"life{k}_wear_depth_flank_1.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    assert [run.guessed.columns["value"].unit.value for run in proposal.runs] == ["um"] * 3
    assert all("taken for um" in doubt.text for doubt in proposal.doubts)


def test_words_that_part_rows_are_said(tmp_path):
    rows = "".join(f"{state};{angle};{angle % 7}\n" for state in ("rated", "half") for angle in range(0, 720, 2))
    (tmp_path / "te.csv").write_text("test;phi_out [deg];te [arcsec]\n" + rows)
    assert any("'test' holds words (half, rated)" in doubt.text for doubt in propose([tmp_path], Wishes()).doubts)


def test_many_columns_without_names_are_asked(tmp_path):
    pd.DataFrame(np.random.default_rng(0).random((50, 6)), columns=list("abcdef")).to_csv(tmp_path / "x.csv", index=False)
    with pytest.raises(InputFault, match="no quantity of a campaign fits; give units by --unit"):
        propose([tmp_path], Wishes())


def test_the_reducer_is_asked_for(tmp_path, capsys):
    write(tmp_path, "plain")
    for dry in (["--dry-run"], []):
        assert main(["campaign", "from", str(tmp_path), "--json", *dry]) == 1
        told = json.loads(capsys.readouterr().out)
        assert [need["remedy"] for need in told["needs"]][-1].startswith("--reducer") and (tmp_path / "campaign.toml").is_file() == (not dry)


def test_folders_below_count_and_names_that_fit_nothing_are_refused(tmp_path):
    for folder in ("cold", "results", ".hidden"):
        (tmp_path / folder).mkdir()
        write(tmp_path / folder, "loop")
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    assert [run.guessed.path.parent.name for run in proposal.runs] == ["cold"]
    assert load_campaign(write_campaign(proposal, tmp_path).parent).records
    with pytest.raises(InputFault, match=r"--names 'x_\{load\}' fits none of the 1 files \(loop_167Nm_15rpm_1.csv"):
        propose([tmp_path], Wishes("RV20E-121", names=("loop_{load}Nm_{speed}rpm_{replicate}", "x_{load}")))
    (tmp_path / "empty").mkdir()
    with pytest.raises(InputFault, match=r"no files: .*empty holds none of .*\.csv"):
        propose([tmp_path / "empty"], Wishes("RV20E-121"))


def test_no_table_is_said(tmp_path):
    (tmp_path / "a.csv").write_text("nothing\nto see\n")
    with pytest.raises(InputFault, match=r"a\.csv.*no table of numbers"):
        propose([tmp_path], Wishes())


def test_what_is_needed_is_said_with_the_command_that_says_it(tmp_path, capsys, monkeypatch):
    """And once it is said, the file is written anew; a comparison in between tells what it took instead."""
    monkeypatch.chdir(tmp_path)
    write(tmp_path, "plain")
    (tmp_path / "te_167Nm_15rpm_1.csv").rename(tmp_path / "run_1.csv")
    assert main(["campaign", "from", "run_1.csv", "--reducer", "RV20E-121"]) == 1
    shown = capsys.readouterr().out
    assert "lacks what is needed" in shown and "rvwear campaign from run_1.csv --reducer RV20E-121 --overwrite --condition 'output_speed=...' --condition 'load_torque=...'" in shown
    assert any("states no load, which run_1 need" in text and "the model's own is taken" in text for text in incomplete(load_campaign(tmp_path)))
    said = ["campaign", "from", "run_1.csv", "--reducer", "RV20E-121", "--condition", "load_torque=100 N.m", "--condition", "output_speed=15 rpm"]
    assert main(said) == 2 and "give --overwrite to have it written anew" in capsys.readouterr().err
    assert main([*said, "--overwrite"]) == 0
    capsys.readouterr()
    assert main(["campaign", "from", "run_1.csv", "--reducer", "RV20E-121", "--overwrite", "--json"]) == 1
    told = json.loads(capsys.readouterr().out)
    assert told["written"] and [need["text"].rpartition(" ")[2] for need in told["needs"]] == ["output_speed", "load_torque"]
    assert main([*said, "--overwrite"]) == 0
    assert not incomplete(load_campaign(tmp_path)) and load_campaign(tmp_path).records[0].factors["load"] == pytest.approx(100.0)


def test_a_reducer_named_above_the_tables_is_proposed(tmp_path, capsys):
    """The name is no answer: it may be the rigid one that is meant, or a file of one's own."""
    lines = ["试验台,3号", "减速器型号,RV-20E-121", "", "输入转角(°),输出转角(°),传动误差(″)", *(f"{121 * k},{k},{np.sin(k):.3f}" for k in range(60))]
    file = tmp_path / "传动误差_84Nm_600rpm_第1次.csv"
    file.write_text("\n".join(lines), encoding="gb18030")
    proposal = propose([file], Wishes(None))
    [need] = [need for need in proposal.needs if "which reducer" in need.text]
    assert need.text.endswith("lines above the tables say RV20E-121") and need.remedy.startswith("--reducer RV20E-121 ")
    assert proposal.named == "RV20E-121" and not propose([file], Wishes("RV20E-121-rigid")).needs
    [doubt] = [doubt for doubt in propose([file], Wishes("BX-40E")).doubts if doubt.place == "campaign"]
    assert doubt.text == "lines above the tables say RV20E-121, not BX-40E" and doubt.remedy.startswith("--reducer RV20E-121")
    # The command takes it, and says so.
    assert main(["campaign", "from", str(file), "--output", str(tmp_path / "made")]) == 0
    assert "reducer RV20E-121: as lines above the tables say" in capsys.readouterr().out
    assert load_campaign(tmp_path / "made").reducer.name == "RV20E-121"
    # Of one that was given it says that it was.
    assert main(["campaign", "from", str(file), "--reducer", "RV20E-121", "--output", str(tmp_path / "given")]) == 0
    assert "reducer RV20E-121: given; lines above the tables say the same\n" in capsys.readouterr().out
    # By its name the output's, but a multiple of the input's beside it to the last digit: nobody has to be asked.
    assert not any("whose the angle is" in doubt.text for doubt in proposal.doubts) and proposal.angle_of.value == "input"
    said = ("i=121", ", ratio 121", " 1:121", "; i = 121", ", Übersetzung 121", ", rapport de réduction: 1/121", "; rapporto di riduzione;121", " 减速比：121")
    assert {named_in([f"Riduttore: RV-20E {ratio}"]) for ratio in said} == {"RV20E-121"} and named_in(["RV20E 1:121"]) == "RV20E-121"
    assert named_in(["RV-20E i=81, 121 runs"]) is None and named_in(["RV-20E, relación 1:81"]) is None and named_in(["BX-40E i=121"]) == "BX-40E"
    # Not by the beginning of another number.
    assert not any(map(named_in, (["RV20E i=1210"], ["RV-20E-1210"], ["RV-20E i=12.1"], ["RV-20E i=121.5"], ["CRV-20E-121"], ["BX-400E"])))
    # Model and ratio on lines of their own.
    for label in ("Rapport : 121", "Rapporto di riduzione;121", "# ratio = 121", "i=121", "Übersetzung: 1:121", "减速比：121"):
        assert named_in(["Modèle : RV-20E", "Opérateur : 12", label]) == "RV20E-121"
    for label in ("Rapport : 1210", "Rapport : 81", "Rapport : 121,5", "couple : 121", "1/121"):
        assert named_in(["Modèle : RV-20E", label]) is None
    assert named_in(["Modèle : RV-20E-81", "Rapport : 121"]) is None and named_in(["Modèle : RV-20E, i = 81", "i : 121"]) is None
    assert named_in(["unit: BX 40E"]) == "BX-40E" and named_in(["RV20E"]) is None and named_in(["RV20E-121 or BX-40E"]) is None
