"""The workbench's server: files that become a campaign.  No browser."""

import json
import shlex
import shutil
from pathlib import Path

import numpy as np
import pytest
from workbench_server import CSV, asked, own

from cli.main import main
from fmu_src.faults import InputFault
from workbench.folder import opened
from workbench.intake import save, view

ROOT = Path(__file__).resolve().parents[1]
pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')


def test_dropped_files_become_the_campaign_of_the_command_line(served):
    """Guesses with reasons, a correction, and the file that ``rvwear campaign from`` writes."""
    from discrepancy.campaign.guess.propose import propose
    from discrepancy.campaign.guess.wishes import Wishes
    from discrepancy.campaign.guess.write import campaign_text

    folder, address = served
    for name in ("loop_10degC_1.csv", "loop_10degC_2.csv", "loop_40degC_1.csv"):
        status, body, _ = asked(address, f"files/{name}", "PUT", CSV.encode(), **own(address))
        assert status == 200, body
    told = json.loads(asked(address, "in")[1])
    runs = told["proposal"]["runs"]
    assert [run["quantity"]["value"] for run in runs] == ["hysteresis"] * 3
    assert runs[0]["columns"]["value"]["unit"] == {"value": "arcsec", "reason": "[arcsec] in its header", "sure": True}
    assert [len(told["columns"][run["file"]][0]["curve"]) for run in runs] == [22] * 3
    wishes = {"reducer": "RV20E-121", "conditions": {"10degC:load_torque": "167 N.m"}, "tags": {"locked": "output"}}
    status, body, _ = asked(address, "in/wishes", "POST", json.dumps(wishes).encode(), **own(address))
    assert status == 200 and json.loads(body)["proposal"]["runs"][0]["tags"]["locked"]["value"] == "output"
    assert asked(address, "in/save", "POST", b"{}", **own(address))[0] == 200
    same = propose(folder.measurements(), Wishes("RV20E-121", conditions=wishes["conditions"], tags=wishes["tags"]), "my bench")
    assert folder.campaign.read_text(encoding="utf-8") == campaign_text(same, folder.root)


def test_the_printed_command_writes_what_the_page_saves(tmp_path, capsys):
    """With files in folders below, a reducer file beside them, and names that were corrected since."""
    from workbench.intake import wish

    folder = opened(tmp_path / "my bench")
    shutil.copy(ROOT / "reducers" / "RV20E-121.toml", folder.root / "own.toml")
    for name in ("loop_10degC_1.csv", "cold/loop_0degC_1.csv", "cold/old_5degC_1.csv"):
        (folder.root / name).parent.mkdir(exist_ok=True)
        (folder.root / name).write_text(CSV)
    given = {"reducer": "own.toml", "names": ["loop_{temperature}degC_{replicate}", "old_{temperature}degC_{replicate}"], "tags": {"locked": "output"}}
    wish(folder, given | {"names": ["{any}_{temperature}degC_{replicate}", *given["names"]]})
    assert view(folder)["command"].count("--names") == 1
    wish(folder, given)
    (folder.root / "cold/old_5degC_1.csv").unlink()
    found = view(folder)
    assert found["gone"] == ["names old_{temperature}degC_{replicate}: no file fits any more; it is left out"]
    save(folder)
    assert main([*shlex.split(found["command"])[1:], "--overwrite"]) == 0
    assert folder.campaign.read_text(encoding="utf-8") == found["text"] and len(found["proposal"]["runs"]) == 2


@pytest.mark.parametrize("reducer", [None, "RV20E-121"])
def test_a_copy_is_told_before_anything_is_saved(tmp_path, reducer):
    """The check of the saved campaign alone told it."""
    from workbench.intake import wish

    folder = opened(tmp_path / "b")
    torque = np.concatenate([np.linspace(0.0, 100.0, 30), np.linspace(100.0, -100.0, 60), np.linspace(-100.0, 0.0, 30)])
    for k, noise in ((1, 0.0), (2, 0.0), (3, 0.01)):
        turning = 0.01 * torque + noise * np.sin(np.arange(len(torque)))
        rows = "\n".join(f"{t:.4f},{y:.6f}" for t, y in zip(torque, turning))
        folder.new_file(f"loop_20degC_{k}.csv", f"torque [N.m],turning [arcmin]\n{rows}\n".encode())
    wish(folder, {"reducer": reducer, "tags": {"locked": "input"}})
    assert view(folder)["copied"] == {
        "loop_20degC_2.csv": "it holds the same numbers as loop_20degC_1.csv: a copy is no repetition, it counts once and says nothing of the noise"
    }


def test_a_file_that_cannot_be_read_takes_nothing_from_the_others(tmp_path, capsys):
    from workbench.intake import wish

    folder = opened(tmp_path / "b")
    for k in (1, 2):
        folder.new_file(f"loop_20degC_{k}.csv", CSV.encode())
    folder.new_file("loop_1.csv", b"nothing\n")
    (folder.root / "cold").mkdir()
    (folder.root / "cold" / "words.csv").write_text("a,b\nx,y\n")
    wish(folder, {"reducer": "RV20E-121", "tags": {"locked": "output"}})
    found = view(folder)
    assert [run["file"] for run in found["proposal"]["runs"]] == ["loop_20degC_1.csv", "loop_20degC_2.csv"]
    assert found["unread"].keys() == {"loop_1.csv", "cold/words.csv"} and "no table of numbers" in found["unread"]["loop_1.csv"]
    # A correction that would lose a file that can be read is refused still.
    with pytest.raises(InputFault, match=r"loop_20degC_2\.csv.*no quantity"):
        wish(folder, {"reducer": "RV20E-121", "quantities": {"loop_20degC_2.csv": "efficiency"}})
    save(folder)
    assert main([*shlex.split(found["command"])[1:], "--overwrite"]) == 0
    assert folder.campaign.read_text(encoding="utf-8") == found["text"]


def test_a_reducer_that_the_files_name_is_taken_until_another_is_chosen(tmp_path, capsys):
    from workbench.intake import wish

    folder = opened(tmp_path / "b")
    for k in (1, 2):
        folder.new_file(f"loop_20degC_{k}.csv", f"Reductor: RV-20E-121\n\n{CSV}".encode())
    found = view(folder)
    assert found["proposal"]["reducer"] == "RV20E-121" and not found["proposal"]["needs"] and "--reducer RV20E-121" in found["command"]
    save(folder)
    assert main([*shlex.split(found["command"])[1:], "--overwrite"]) == 0
    assert folder.campaign.read_text(encoding="utf-8") == found["text"]
    wish(folder, {"reducer": "RV20E-121-rigid"})
    assert view(folder)["proposal"]["reducer"] == "RV20E-121-rigid"
    wish(folder, {"reducer": ""})
    assert not view(folder)["proposal"]["reducer"]


def test_no_folder_is_made_of_a_mistyped_path(tmp_path):
    (tmp_path / "bench").mkdir()
    (tmp_path / "c.csv").write_text(CSV)
    with pytest.raises(InputFault, match=r"there is no folder .*bnch; did you mean .*bench\?; make it first"):
        opened(tmp_path / "bnch" / "new")
    with pytest.raises(InputFault, match=r"c\.csv is a file; give the folder"):
        opened(tmp_path / "c.csv")
    assert opened(tmp_path / "bench" / "new").root.is_dir() and not (tmp_path / "bnch").exists()


def test_a_file_that_was_edited_by_hand_is_not_written_over(tmp_path):
    folder = opened(tmp_path / "b")
    for k in (1, 2):
        folder.new_file(f"loop_20degC_{k}.csv", CSV.encode())
    folder.remember("wishes", {"reducer": "RV20E-121"})
    save(folder)
    save(folder)
    folder.campaign.write_text(folder.campaign.read_text(encoding="utf-8") + "# mine\n", encoding="utf-8")
    with pytest.raises(InputFault, match="not overwritten"):
        save(folder)
    assert folder.campaign.read_text(encoding="utf-8").endswith("# mine\n")


def test_corrections_of_conditions_that_are_gone_are_said_and_left_out(tmp_path):
    folder = opened(tmp_path / "b")
    folder.new_file("loop_20degC_1.csv", CSV.encode())
    folder.remember("wishes", {"reducer": "RV20E-121", "conditions": {"30degC:load_torque": "10 N.m"}, "held_out": ["30degC"]})
    found = view(folder)
    assert found["proposal"]["conditions"].keys() == {"20degC"} and "30degC" in found["gone"][0]


def angle_file(folder, name, head="Winkel [deg]"):
    """Two turns of the output in eight seconds, as the motor's encoder counts them."""
    rows = "\n".join(f"{0.02 * k:.2f};{217.8 * k:.1f};{k % 7}" for k in range(401))
    folder.new_file(name, f"Zeit [s];{head};Drehfehler [arcsec]\n{rows}\n".replace(".", ",").encode())


def test_an_angle_of_the_motor_is_doubted_in_its_row_and_mended(tmp_path, capsys):
    """As proposed, unsaved; then as saved, which stays saved; the page's command writes the same."""
    from workbench.intake import wish
    from workbench.mending import mend

    folder = opened(tmp_path / "b")
    angle_file(folder, "Drehfehler_50Nm_15rpm_40C_1.csv")
    angle_file(folder, "Drehfehler_50Nm_15rpm_60C_1.csv")
    assert view(folder)["doubts"] == []
    wish(folder, {"reducer": "RV20E-121"})
    (doubt,) = view(folder)["doubts"]
    assert "121 times the stated 15 rpm" in doubt["text"] and (doubt["column"], doubt["role"], doubt["title"]) == ("Winkel [deg]", "input_angle", "angle of the input (motor)")
    assert "--" not in doubt["remedy"] and doubt["title"] in doubt["remedy"]
    save(folder)
    mend(folder, {"column": "Winkel [deg]", "role": "input_angle"})
    found = view(folder)
    assert found["doubts"] == [] and found["same"] and "columns.input_angle" in found["text"]
    assert {run["names"] for run in found["proposal"]["runs"]} == {"Drehfehler_{load}Nm_{speed}rpm_{temperature}C_{replicate}"}
    assert main([*shlex.split(found["command"])[1:], "--overwrite"]) == 0
    assert folder.campaign.read_text(encoding="utf-8") == found["text"]
    # What was not saved is not saved by it.
    wish(folder, {**found["wishes"], "conditions": {"40degC:hours": "5 h"}})
    mend(folder, {"column": "Winkel [deg]", "role": "angle"})
    assert not view(folder)["same"] and view(folder)["wishes"]["columns"] == {"angle": "Winkel [deg]"}


def test_a_position_that_nobody_says_is_asked_before_and_after_saving(tmp_path):
    from workbench.intake import wish

    folder = opened(tmp_path / "b")
    folder.new_file("loop_1.csv", CSV.encode())
    wish(folder, {"reducer": "RV20E-121", "tags": {"locked": "input"}})
    question = "nobody says where the input was locked"
    assert [d["place"] for d in view(folder)["proposal"]["doubts"] if question in d["text"]] == ["single"]
    assert [d.get("cell") for d in view(folder)["proposal"]["doubts"] if question in d["text"]] == [["single", "locked_at"]]
    save(folder)
    (finding,) = (f for f in view(folder)["findings"] if question in f["text"])
    assert finding["cell"] == ["single", "locked_at"] and finding["text"].startswith("loops in single: ") and "'locked at' of the condition under In" in finding["remedy"] and "--" not in finding["remedy"]
    wish(folder, {"reducer": "RV20E-121", "tags": {"locked": "input"}, "conditions": {"single:locked_at": "40 deg"}})
    save(folder)
    found = view(folder)
    assert not any(question in said["text"] for said in (*found["proposal"]["doubts"], *found["findings"]))


def test_units_of_a_condition_are_read_or_refused_where_they_were_typed(tmp_path):
    from discrepancy.campaign.load import load_campaign
    from workbench.intake import wish

    folder = opened(tmp_path / "b")
    folder.new_file("loop_20degC_1.csv", CSV.encode())
    given = {"reducer": "RV20E-121", "tags": {"locked": "input"}, "conditions": {"20degC:temperature": "77 F", "20degC:locked_at": "mean"}}
    wish(folder, given)
    save(folder)
    assert load_campaign(folder.root).conditions["20degC"].factors["temperature"] == pytest.approx(298.15)
    for text, said in (("77 X", "unit 'X' is not known"), ("1478 in-lbf", "does not fit"), ("warm", "is not a number with a unit")):
        with pytest.raises(InputFault, match=said) as fault:
            wish(folder, {**given, "conditions": {"20degC:temperature": text}})
        assert "--" not in str(fault.value) and view(folder)["wishes"] == given


@pytest.mark.parametrize(("text", "rpm"), [("750 giri", 750.0), ("15 U", 15.0), ("1500,5 tours", 1500.5), ("750 giri/min", 750.0)])
def test_turns_in_the_field_of_a_speed_are_those_a_minute(tmp_path, text, rpm):
    """As in names of files: "750giri" was read there and refused where it was typed."""
    from discrepancy.campaign.load import load_campaign
    from workbench.form import in_unit
    from workbench.intake import wish

    folder = opened(tmp_path / "b")
    folder.new_file("torque_1.csv", b"speed [rpm],drag torque [N.m]\n" + b"\n".join(b"%d,%.3f" % (100 * k, 0.1 + 0.01 * k) for k in range(1, 30)))
    assert in_unit(text, "rpm", "rated output speed") == pytest.approx(rpm)
    folder.new_file("loop_20degC_1.csv", CSV.encode())
    wish(folder, {"reducer": "RV20E-121", "tags": {"locked": "input"}, "conditions": {"input_speed": text.replace(",", ".")}})
    save(folder)
    stated = [c.factors.get("speed") for c in load_campaign(folder.root).conditions.values()]
    assert any(speed == pytest.approx(rpm * np.pi / 30.0) for speed in stated), view(folder)["text"]


def test_a_scale_is_said_of_a_column_and_a_unit_that_cannot_be_read_is_refused_at_once(tmp_path, capsys):
    """The factor survives saving, and the page's command writes the same; a factor in a unit is none."""
    from workbench.intake import wish

    folder = opened(tmp_path / "b")
    folder.new_file("loop_20degC_1.csv", CSV.encode())
    given = {"reducer": "RV20E-121", "tags": {"locked": "output"}}
    header = view(folder)["proposal"]["runs"][0]["columns"]["value"]["header"]
    for part, text, words in (("units", "arcsec/3437.75", "is not known.*a factor is no part of a unit"), ("units", "parsnip", "'parsnip' is not known"), ("scales", "much", "is no number"),
                              ("scales", "0", "other than 0")):  # fmt: skip
        with pytest.raises(InputFault, match=words) as refused:
            wish(folder, {**given, part: {f"loop_20degC_1.csv:{header}": text}})
        assert "--" not in str(refused.value)
    wish(folder, {**given, "scales": {f"loop_20degC_1.csv:{header}": "1/8"}})
    save(folder)
    found = view(folder)
    assert found["same"] and found["proposal"]["runs"][0]["columns"]["value"]["scale"] == 0.125 and "scale = 0.125" in found["text"]
    assert main([*shlex.split(found["command"])[1:], "--overwrite"]) == 0
    assert folder.campaign.read_text(encoding="utf-8") == found["text"]


def test_what_is_wrong_with_numbers_stands_open_and_in_is_told_all_that_the_check_says(tmp_path, capsys):
    """A scale, which takes a model, is asked for apart and kept; what of the page is open is of numbers alone."""
    from workbench.intake import wish
    from workbench.scales import scales

    folder = opened(tmp_path / "b")
    rows = "\n".join(f"{t},{3000 * t + 40 * (t % 7)}" for t in range(-160, 170, 4))
    folder.new_file("loop_20degC_1.csv", f"torque [Nm],turning [arcsec]\n{rows}\n".encode())
    assert scales(folder) == {"findings": []}
    wish(folder, {"reducer": "RV20E-121", "tags": {"locked": "output"}})
    save(folder)
    (scale,) = scales(folder)["findings"]
    assert scale["open"] and scale["text"].startswith("run loop_20degC_1: hysteresis varies by") and folder.recall("scales")["findings"] == [scale]
    told = [scale, *view(folder)["findings"]]
    assert [finding["text"] for finding in told if finding["open"]] == [scale["text"]]
    capsys.readouterr()
    main(["campaign", "check", str(folder.root), "--json"])
    said = json.loads(capsys.readouterr().out)
    assert {finding["text"] for finding in told} == {finding["text"] for finding in (*said["problems"], *said["warnings"])}
    folder.campaign.write_text(folder.campaign.read_text().replace('unit = "arcsec"', 'unit = "urad", scale = 0.01'))
    assert scales(folder) == {"findings": []}


def test_a_head_that_says_motor_needs_no_mending(tmp_path):
    from workbench.intake import wish

    for k, head in enumerate(("Winkel Motor [deg]", "Antriebswinkel [deg]", "Position moteur [deg]", "Codeur entrée [deg]", "input angle [deg]")):
        folder = opened(tmp_path / str(k))
        angle_file(folder, "te_50Nm_15rpm_40C_1.csv", head)
        wish(folder, {"reducer": "RV20E-121"})
        assert view(folder)["proposal"]["runs"][0]["columns"].keys() == {"value", "input_angle", "time"} and view(folder)["doubts"] == [], head


def test_a_correction_that_nothing_can_be_made_of_changes_nothing(tmp_path):
    from workbench.intake import wish

    folder = opened(tmp_path / "b")
    folder.new_file("loop_20degC_1.csv", CSV.encode())
    folder.new_file("Schleife_30.csv", CSV.encode())
    wish(folder, {"reducer": "RV20E-121", "names": ["loop_{temperature}degC_{replicate}", "Schleife_{temperature}"]})
    with pytest.raises(InputFault, match="^names 'Scleife_.*' fits none of the 2 files"):
        wish(folder, {"reducer": "RV20E-121", "names": ["loop_{temperature}degC_{replicate}", "Scleife_{temperature}"]})
    assert view(folder)["proposal"]["conditions"].keys() == {"20degC", "30degC"}
