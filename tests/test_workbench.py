"""The workbench's server: files that become a campaign, jobs that outlive it, what pages are told.  No browser."""

import json
import shlex
import shutil
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from workbench_server import CSV, asked, own

from cli.main import main
from fmu_src.faults import InputFault
from workbench import jobs
from workbench.folder import Folder, opened
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


def test_what_is_wrong_is_said_in_words(served):
    _, address = served
    for path, given, words in (
        ("in/wishes", {"conditions": {"input_sped": "3 rpm"}}, "did you mean input_speed"), ("jobs/cook", {}, "no such work"), ("jobs/compare", [], "JSON object"),
        ("reducer", {"model": "../../etc/passwd.toml"}, "outside"), ("reducer/new", {"ratio": "81", "pins": "40"}, "rated torque is needed"),
    ):  # fmt: skip
        status, body, _ = asked(address, path, "POST", json.dumps(given).encode(), **own(address))
        assert status == 400 and words in json.loads(body)["fault"], (path, body)


def test_a_job_tells_the_folder_and_is_found_by_the_next_server(tmp_path):
    """A fault in words, from a process of its own; the folder is all that the next server has."""
    folder = opened(tmp_path / "b")
    jobs.start(folder, "compare", {"model": "RV20E-121"}, 1)
    end = time.monotonic() + 60.0
    while jobs.status(Folder(folder.root), "compare")["state"] == jobs.RUNNING and time.monotonic() < end:
        time.sleep(0.05)
    found = jobs.status(Folder(folder.root), "compare")
    assert found["state"] == jobs.FAILED and "campaign.toml" in found["fault"]


def test_a_job_tells_how_long_the_last_one_took_and_names_effects_as_the_page_does(tmp_path, monkeypatch):
    """The whole of a diagnosis had no estimate; one that was stopped gives none."""
    from discrepancy.inference.outlook import WHOLE
    from fmu_src.progress import say, task, told_to
    from workbench.work import Teller

    monkeypatch.setattr("fmu_src.durations.cache_folder", lambda name: tmp_path)
    folder = opened(tmp_path / "b")

    def told(passed, stopped=False):
        teller = Teller(folder, "diagnose")
        try:
            with told_to(teller), task(WHOLE) as whole, task("screening, disc_tooth_errors.ovality"):
                say("misfit: transmission_error, orders; best alone: disc_tooth_errors.ovality, beside disc_tooth_errors of entrada_bloqueada")
                teller.write(jobs.RUNNING)
                whole.begun -= passed
                if stopped:
                    raise KeyboardInterrupt
        except KeyboardInterrupt:
            pass
        beat = folder.recall("jobs/diagnose/beat")
        teller.close(jobs.DONE)
        return beat

    beat = told(600.0)
    assert beat["tasks"][0]["left"] is None and beat["tasks"][1]["sentence"] == "screening, disc tooth errors (ovality)"
    assert beat["said"] == ["misfit: transmission error, orders; best alone: disc tooth errors (ovality), beside disc tooth errors of entrada_bloqueada"]
    assert told(30.0, stopped=True)["tasks"][0]["before"] == pytest.approx(600.0, abs=2.0)
    assert told(1.0)["tasks"][0]["left"] == pytest.approx(600.0, abs=2.0)


def test_a_first_diagnosis_tells_the_folder_between_what_it_ends(tmp_path, monkeypatch):
    from fmu_src.progress import task, told_to
    from workbench.work import Teller

    monkeypatch.setattr("fmu_src.durations.cache_folder", lambda name: tmp_path)
    folder = opened(tmp_path / "b")
    teller = Teller(folder, "diagnose")
    with told_to(teller), task("whole") as whole:
        whole.foretell(80.0, 350.0)
        teller.write(jobs.RUNNING)
    assert folder.recall("jobs/diagnose/beat")["tasks"][0]["span"] == "1 to 6 min"
    teller.close(jobs.DONE)


def test_a_diagnosis_that_was_kept_is_said_to_be_found_again(tmp_path, monkeypatch):
    """It said how many minutes of computing it took, where nothing was computed."""
    from workbench import steps

    folder, made = opened(tmp_path / "b"), 1.7e9
    monkeypatch.setattr(steps, "inputs", lambda *_: (None, SimpleNamespace(folder=folder.root)))
    monkeypatch.setattr(steps, "report", lambda *_: None)
    monkeypatch.setattr(steps, "answer_data", lambda _: {})
    monkeypatch.setattr("discrepancy.remembered.diagnosed", lambda *_, jobs: SimpleNamespace(made=made, made_in="/first", profiles={}))
    for found in (made, None):
        steps.diagnose_step(folder, {"model": "RV20E-121"}, 1, tmp_path)
        told = json.loads((tmp_path / "result.json").read_text())
        assert told["found"] == found and told["found_in"] == "/first"
        made = time.time() + 60.0


def test_a_note_on_loops_or_an_angle_knows_the_cell_that_answers_it():
    from discrepancy.calibrated_doubts import OF_INPUT
    from discrepancy.campaign.unplaced import QUESTION
    from discrepancy.problem import Record
    from workbench.doubts import cells_of

    loops = [Record(name, "hysteresis", "rad", name, 1, np.zeros(3), {"torque": np.zeros(3)}, {}, tags={"locked": "input"}) for name in ("cold", "warm")]
    campaign = SimpleNamespace(records=loops)
    of_warm, of_all, angle = f"loops in warm: {QUESTION}; state it", f"2 loops: {QUESTION}.", f"it lags hardly; state {OF_INPUT}"
    cells = cells_of([of_warm, of_all, angle, "the noise is large"], campaign)  # type: ignore[arg-type]
    told = "it lags hardly; choose 'the input, over the ratio' as 'angle of' under In"
    assert cells == {of_warm: ["warm", "locked_at"], of_all: ["cold", "locked_at"], told: ["angle"]}
    # An effect that is missing lets an angle look like another's: before a diagnosis the way leads there.
    assert cells_of([of_warm, angle], campaign, diagnosed=False) == {of_warm: ["warm", "locked_at"], told: ["diagnose"]}  # type: ignore[arg-type]


def test_a_job_that_is_silent_is_gone(tmp_path):
    folder = opened(tmp_path)
    folder.remember("jobs/life/job", {"kind": "life", "given": {}, "begun": time.time() - 100.0})
    folder.remember("jobs/life/beat", {"state": jobs.RUNNING, "at": time.time() - 50.0, "tasks": []})
    assert jobs.status(folder, "life")["state"] == jobs.GONE


def test_a_job_whose_process_lives_is_only_slow(tmp_path, monkeypatch):
    folder = opened(tmp_path)
    folder.remember("jobs/life/job", {"kind": "life", "given": {}, "begun": time.time() - 100.0})
    process = subprocess.Popen([sys.executable, "-c", "input()"], stdin=subprocess.PIPE)
    monkeypatch.setitem(jobs.LIVING, jobs.place_of(folder, "life"), process)
    assert jobs.status(folder, "life")["state"] == jobs.RUNNING
    process.communicate(b"\n")
    assert jobs.status(folder, "life")["state"] == jobs.GONE


def test_a_report_has_the_colours_of_the_page_around_it(served):
    folder, address = served
    place = jobs.place_of(folder, "life")
    place.mkdir(parents=True)
    plain = ":root { color-scheme: light dark } @media screen and (prefers-color-scheme: dark) { }"
    (place / "report.html").write_text(plain)
    found = {colours: asked(address, f"results/life/report{colours}")[1].decode() for colours in ("", "?colours=dark", "?colours=light")}
    assert found[""] == plain
    assert found["?colours=dark"] == ":root { color-scheme: dark } @media screen and (min-width: 0px) { }"
    assert found["?colours=light"] == ":root { color-scheme: light } @media screen and (max-width: 0px) { }"


def test_stop_asks_and_ends_nobody_by_number(tmp_path):
    folder = opened(tmp_path)
    folder.remember("jobs/life/job", {"kind": "life", "given": {}, "begun": time.time()})
    jobs.place_of(folder, "life").mkdir(parents=True, exist_ok=True)
    jobs.stop(folder, "life")
    assert (jobs.place_of(folder, "life") / "stop").exists()


# what the page is told ------------------------------------------------------------------------
@pytest.mark.parametrize(("said", "told"), [
    ("count them, and give --pins", "count them, and give 'pins in the ring'"),
    ("--ratio 3 with --pins 40: look at --lost-motion", "ratio 3 with 'pins in the ring' 40: look at 'lost motion of the catalogue'"),
    ("--known pin.radius=2: give a number with its unit, for instance --known pin.radius=3mm",
     "pin.radius = 2 in 'Every number of its file' below: give a number with its unit, for instance 3mm"),
    ("diameter 5 mm: must lie from 20 to 2000 mm", "'outer diameter of the housing' 5 mm: must lie from 20 to 2000 mm"),
    ("A and B. rvwear next proposes what would.", "A and B. 'Propose the next experiment' proposes what would."),
    ("correct it (rvwear extend), or see `rvwear compare`", "correct it ('Add it'), or see Look"),
    # Nothing on the page does these, and a line to type is one.
    ("rvwear hysteresis and bench give them without it", "rvwear hysteresis and bench give them without it"),
    ("completed anew by: rvwear reducer new --ratio 121 --pins 40", "completed anew by: rvwear reducer new --ratio 121 --pins 40"),
])  # fmt: skip
def test_what_commands_and_page_share_names_fields_and_buttons_on_the_page(said, told):
    """"give --pins" stood where nobody has typed a command."""
    from workbench.reducers import plainly

    assert plainly(said) == told


def test_the_remedy_of_a_scale_is_said_in_words_of_the_page():
    from discrepancy.campaign.model import Source
    from discrepancy.known_factors import known_factor
    from workbench.page_words import on_page

    factor = known_factor(3438.0, "arcmin", "rad", None)
    for header in ("y", "two words"):
        remedy = factor.remedy(Source("a.csv", f"column {header}", "arcmin", 2.9e-4), "rad")
        told = on_page(remedy)
        assert f"takes it out, typed under In as the scale of column {header}, or in each of its runs in campaign.toml: columns.value" in told
        assert "--" in remedy and "--" not in told and "rvwear" not in told


def test_a_file_that_is_no_measurement_says_what_to_do_without_options(tmp_path):
    """"give units by unit 'COLUMN=UNIT'" stood in its row, which has no such field."""
    folder = opened(tmp_path / "b")
    folder.new_file("notes.csv", b"time [s]\n1\n3\n5\n")
    folder.new_file("loop_20degC_1.csv", CSV.encode())
    (reason,) = view(folder)["unread"].values()
    assert "fits; write units into the heads of its columns" in reason and "lost motion" in reason and "COLUMN" not in reason


def test_signals_in_what_a_page_says_have_one_form():
    from discrepancy.page.amounts import with_titles

    said = "misfit: hysteresis[locked=input], along torque; wear_depth[hours=9,surface=inner_race] in errors.pin[2]=7um"
    assert with_titles(said) == "misfit: hysteresis (locked input), along torque; wear depth (hours 9, surface inner race) in errors.pin[2]=7um"


def test_numbers_in_what_a_page_says_have_a_minus_and_names_their_hyphen():
    """-22.95 um under Diagnose stood beside −22.95 in tables."""
    from discrepancy.page.amounts import with_minus

    assert with_minus("y = a + b x, a = -0.01 (-.02 to 1e-05), RV20E-121 at half-load") == "y = a + b x, a = −0.01 (−.02 to 1e−05), RV20E-121 at half-load"


def test_numbers_have_as_many_decimals_as_their_noise():
    from workbench.look import decimals_of, text_of

    assert [decimals_of(noise) for noise in (22.0, 1.9, 0.0073, 0.0)] == [0, 1, 4, 4]
    assert text_of(-0.011412, decimals_of(0.0082)) == "−0.0114" and text_of(1440.951, 0) == "1,441"
    # Neither many digits nor many zeros, however far measurement and noise lie apart.
    told = [text_of(value, decimals_of(noise)) for value, noise in ((424.77270608, 1.9e-7), (4.18e-6, 1.9e-7), (57_276_516.0, 744_836.0), (2e-7, 744_836.0), (-0.004, 0.1))]
    assert told == ["424.773", "4.18·10⁻⁶", "5.728·10⁷", "0", "0.00"]


def test_look_has_the_errors_of_a_signal_as_compare_has_them():
    from discrepancy.compare import by_signal
    from workbench.look import errors_of

    runs = [{"signal": signal, "held_out": held_out, "unit": "rad", "error": error, "noise_floor": floor}
            for signal, held_out, error, floor in (("te", True, 6.0, 2.0), ("te", False, 3.0, 1.0), ("te", False, 4.0, 7.0), ("loop", False, 1.0, 1.0))]  # fmt: skip
    assert [(error["held_out"], round(error["ratio"], 6)) for error in errors_of("te", by_signal(runs))] == [(False, 0.707107), (True, 3.0)]


def test_a_slider_reaches_as_far_as_a_bench_is_likely_to_meet():
    from discrepancy.problem import Parameter
    from workbench.trying import around, slider

    bounded = slider(Parameter("clearance", "m", 0.0, 0.0, 1e-3, 2e-6, 1), True)
    assert (bounded["low"], round(bounded["high"], 9), bounded["unit"], bounded["bounds"]) == (0.0, 10.0, "µm", [0.0, 1000.0])
    assert bounded["of"] == ""
    assert slider(Parameter("drift", "1", 0.0, -5.0, 5.0, 0.01, description="drift in a run over the mean size (0: off)"), True)["of"] == "drift in a run over the mean size"
    carried = slider(around(Parameter("expansion", "1/K", 8e-6, -1e-4, 1e-4, 5e-7, 1), 0.0), True)
    assert carried["low"] < 0.0 < carried["off"] < carried["high"]
    # A phase error of 1.3" was told in arcsec by the diagnosis, in arcmin here.
    assert slider(Parameter("phase", "rad", 0.0, -1e-2, 1e-2, 5e-4), True)["unit"] == "arcsec"


def test_orders_are_shown_by_their_amplitude():
    import numpy as np

    from workbench.look import amplitudes_of

    assert amplitudes_of(np.array([78.0, 1.0, 78.0, 1.0]), np.array([3.0, 0.0, 4.0, -2.0])).tolist() == [2.0, 5.0]


def test_only_what_there_is_is_exported(tmp_path):
    from workbench.steps import STEPS, export_step

    assert set(STEPS) == set(jobs.KINDS)
    with pytest.raises(InputFault, match="csv, xlsx"):
        export_step(opened(tmp_path), {"what": "compare", "ending": "exe"}, 1, tmp_path)


def test_of_many_samples_one_turn_is_tried():
    import numpy as np

    from discrepancy.problem import Record
    from workbench.thinned import FEW, thinned

    angle = np.linspace(0.0, 20.0 * np.pi, 50_001)
    many = Record("r", "transmission_error", "rad", "c", 1, np.sin(78 * angle), {"angle": angle}, {"direction": 1})
    few = thinned(many)
    assert 0.8 * FEW < len(few.values) <= FEW and few.axes["angle"].max() < 2.0 * np.pi
    assert np.allclose(few.values, np.sin(78 * few.axes["angle"])) and thinned(few) is few


def test_results_are_told_without_numbers_that_json_lacks(tmp_path):
    import numpy as np

    from workbench.told import write_json

    write_json(tmp_path / "a.json", {"x": [1.0, float("nan"), np.float64(np.inf)], "y": np.arange(2)})
    assert json.loads((tmp_path / "a.json").read_text()) == {"x": [1.0, None, None], "y": [0, 1]}


def test_columns_of_a_comparison_are_read_without_parsing():
    import numpy as np

    from workbench.look import Columns

    columns = Columns()
    places = [columns.add(np.array(row)) for row in ([1.0, 2.0], [3.0])]
    found = np.frombuffer(columns.bytes(), "<f4")
    assert [found[p["from"] : p["from"] + p["count"]].tolist() for p in places] == [[1.0, 2.0], [3.0]]


def test_a_run_with_dropouts_and_a_sample_far_off_is_drawn_over_its_samples():
    import numpy as np

    from discrepancy.page.runs import Run
    from discrepancy.problem import Record
    from workbench.look import Columns, drawn

    angle = np.linspace(0.0, 6.0, 100)
    record = Record("r", "transmission_error", "rad", "c", 1, np.zeros(100), {"angle": angle}, {}, far_off=(50,))
    kept = np.arange(100) >= 10
    told = drawn(Run(record, kept, np.ones(90), np.zeros(90), np.full(90, 0.5), ~record.counted[kept]), 1.0, Columns(), {})
    assert told["samples"] == told["residual"]["count"] == 90 and told["aside"] == [40] and told["noise"] == 0.5


def test_what_is_left_in_try_is_told_without_samples_far_off():
    import numpy as np

    from discrepancy.problem import Record
    from workbench.trying import error_of

    record = Record("r", "transmission_error", "rad", "c", 1, np.array([1.0, 100.0, -1.0]), {}, {}, far_off=(1,))
    assert error_of(record, np.zeros(3)) == 1.0


def test_a_reducer_says_at_which_speed_it_runs_beside_that_of_its_rating(tmp_path):
    from workbench.reducers import shown

    found = shown(opened(tmp_path), "RV20E-121")["reducer"]
    assert "at 15 rpm" in found["lead"] and found["speed"] == (
        "runs at 2,000 rpm at the input, 16.5 rpm at the output (document, table 2; the catalogue rates at 15 rpm of the output)"
    )


def test_the_reducer_of_a_model_file_is_the_model_with_its_effects_and_their_numbers_stand_in_the_list(tmp_path):
    """Title and text were the base reducer's, and what the effect carries stood nowhere; what is set on it was the reducer's, too."""
    from workbench.reducers import shown

    folder = opened(tmp_path)
    base = """[model]
name = "RV20E-121"
reducer = "RV20E-121"
[settings]
bearing.clearance = "3 um"
"""
    (folder.root / "without.toml").write_text(base, encoding="utf-8")
    (folder.root / "model.toml").write_text(base + """[effects.hole_position_errors]
disc_hole_shift_1 = {value = 4.0, unit = "um", low = 3.995, high = 4.005}
[effects.sensor_drift]
sensor_drift = { value = 0.02 }
""", encoding="utf-8")  # fmt: skip
    found = shown(folder, "model.toml")["reducer"]
    effects = "RV20E-121 with hole position errors, sensor drift"
    assert found["title"] == "model.toml (RV20E-121) with hole position errors, sensor drift" and found["lead"].startswith(f"The model is {effects}. Of the reducer: ")
    rows = {row["name"]: (row["value"], row["unit"], row["source"]) for row in (*found["added"], *found["numbers"])}
    assert rows["effects.hole_position_errors.disc_hole_shift_1"] == ("4.0000", "um", "model.toml, interval 3.9950 to 4.0050")
    assert rows["effects.sensor_drift.sensor_drift"] == ("0.020000", "", "model.toml")
    assert rows["bearing.clearance"] == ("3.0000", "um", "model RV20E-121")
    plain = shown(folder, "RV20E-121")["reducer"]
    # Drawn with the forces that it has.
    carried = [int(shown(folder, name)["reducer"]["figures"][1]["caption"].split()[5]) for name in ("without.toml", "model.toml")]
    assert carried[1] > carried[0] + 5
    assert plain["title"] == "RV20E-121" and plain["added"] == [] and not plain["lead"].startswith("The model is")


def test_numbers_given_are_counted_as_the_command_line_does(tmp_path):
    from workbench.reducers import completed

    page = completed(opened(tmp_path), {"ratio": "121", "pins": "40", "rated": "167", "known": {"pin.radius": "2mm"}})["page"]
    assert page["finding"].startswith("5 numbers given, "), page["finding"]


def test_a_reducer_is_completed_as_stiff_as_its_catalogue_and_its_stiffness_stands_beside_it(tmp_path):
    """The command's number, by the command's units; without one the form says that nobody asked for it."""
    from workbench.reducers import completed

    folder, asked = opened(tmp_path), {"ratio": "153", "rated": "0,784kNm", "cranks": "3"}

    def stiffness(found):
        return next((c["value"], c["note"]) for c in found["page"]["cards"] if c["label"] == "torsional stiffness")

    by_rules = completed(folder, asked)
    assert float(stiffness(by_rules)[0]) > 300.0 and stiffness(by_rules)[1].startswith("not given") and "--stiffness" not in by_rules["command"]
    found = completed(folder, {**asked, "stiffness": "212Nm/arcmin"})
    assert float(stiffness(found)[0]) == pytest.approx(212.0, rel=2e-3) and stiffness(found)[1] == "212 asked for"
    # What the rules leave open is none where it was given.
    assert [any("scatters by a third" in text for text in one["page"]["warnings"]) for one in (by_rules, found)] == [True, False]
    assert "--rated 784 " in found["command"] and "--stiffness 212 " in found["command"] and "support_compliance" not in found["command"]
    assert any("give 'outer diameter of the housing' if the catalogue has it" in text for text in found["page"]["warnings"])
    with pytest.raises(InputFault, match="torsional stiffness of the catalogue"):
        completed(folder, {**asked, "stiffness": "212kg"})
    # Far beyond the rules it is a mistaken unit, here as on the command line.
    with pytest.raises(InputFault, match=r"^'torsional stiffness of the catalogue' 212\.5 Nm/deg is 3\.54167 N\.m/arcmin: it asks for .* did you mean 212\.5 N\.m/arcmin\?"):
        completed(folder, {**asked, "stiffness": "212,5 Nm/deg", "save": True})
    assert not folder.models()


def test_a_gap_that_makes_the_lost_motion_is_no_measured_one_on_the_page(tmp_path):
    from workbench.reducers import completed

    folder, asked = opened(tmp_path), {"ratio": "129", "rated": "1568", "meets_lost_motion": True}
    found = completed(folder, asked)
    (gap,) = [row for row in found["numbers"] if row["name"] == "disc.equidistant_modification"]
    assert not gap["given"] and gap["range"].startswith("0 to ") and "--lost-motion 1 " in found["command"]
    (card,) = [card for card in found["page"]["cards"] if card["label"] == "lost motion"]
    assert float(card["value"]) == pytest.approx(1.0, rel=5e-3) and card["note"] == f"1 of the catalogue; taken for it: {gap['name']} = {float(gap['value']):.3g} µm"
    with pytest.raises(InputFault, match="^'refuse where no gap.*' is ticked and disc.equidistant_modification is typed in 'Every number"):
        completed(folder, {**asked, "known": {"disc.equidistant_modification": "3um"}})


def test_a_reducer_is_completed_refused_and_saved_once(tmp_path):
    from workbench.reducers import completed

    folder = opened(tmp_path)
    asked = {"ratio": "121", "pins": "40", "rated": "167", "known": {"pin.radius": "2mm"}, "name": "mine"}
    with pytest.raises(InputFault, match="^ratio 8100: must lie"):
        completed(folder, {**asked, "ratio": "8100"})
    # "meet lost motion ... give known bearing.clearance=..." stood there, and the path of a file that is not there.
    with pytest.raises(InputFault, match=r"^'refuse where no gap.*'lost motion of the catalogue', or type bearing.clearance in 'Every"):
        completed(folder, {**asked, "lost_motion": "0.1", "meets_lost_motion": True})
    with pytest.raises(InputFault, match=r"^\[bearing\] clearance = 9000 um: "):
        completed(folder, {**asked, "known": {"bearing.clearance": "9mm"}})
    assert completed(folder, {**asked, "save": True})["saved"] == "mine.toml"
    with pytest.raises(InputFault, match="not overwritten"):
        completed(folder, {**asked, "save": True})
    assert folder.models() == ["mine.toml"]


def test_the_file_of_an_ensemble_is_that_of_the_form(tmp_path):
    from studies.ensemble.ensemble_file import load_ensemble
    from workbench.ensemble_step import text_of

    row = {"name": "bearing.clearance", "unit": "um", "distribution": "normal", "first": "2,5", "second": 0.4}
    given = {"model": "RV20E-121", "hours": "3000", "samples": "4", "scatters": [row], "limits": {"disc_flank_um": "5"}}
    (tmp_path / "ensemble.toml").write_text(text_of(opened(tmp_path), given), encoding="utf-8")
    # No model, though it names a reducer.
    assert opened(tmp_path).models() == []
    drawn = load_ensemble(tmp_path / "ensemble.toml")
    assert (drawn.samples, drawn.hours, drawn.limits, [s.name for s in drawn.scatters]) == (4, 3000.0, {"disc_flank_um": 5.0}, ["bearing_clearance"])
    with pytest.raises(InputFault, match="power of two"):
        text_of(opened(tmp_path), given | {"samples": 5})
    with pytest.raises(InputFault, match="no such distribution"):
        text_of(opened(tmp_path), given | {"scatters": [row | {"name": 'a" = 1'}]})
    with pytest.raises(InputFault, match="base samples: 4.5 is no whole number"):
        text_of(opened(tmp_path), given | {"samples": 4.5})
    with pytest.raises(InputFault, match="what scatters: there is no such"):
        text_of(opened(tmp_path), given | {"scatters": [row | {"name": ""}]})
    with pytest.raises(InputFault, match="x = 3: there is no such limit"):
        text_of(opened(tmp_path), given | {"limits": {"x = 3": "1"}})
    # With all digits.
    assert "hours = 123456.75\n" in text_of(opened(tmp_path), given | {"hours": "123456.75"})


def test_numbers_of_a_form_are_said_where_they_are_wrong():
    from workbench.form import exactly, number, whole
    from workbench.life_step import positive

    assert (number(" 2,5 ", "x"), whole("40", "pins"), positive({"hours": ""}, "hours"), exactly(123456.75)) == (2.5, 40, None, "123456.75")
    for text, said in (("a", "'a' is no number"), ("nan", "a finite number is needed"), ("1.5", "'1.5' is no whole number")):
        with pytest.raises(InputFault, match=f"pins: {said}"):
            whole(text, "pins")
    with pytest.raises(InputFault, match="torque = -1: must lie above 0"):
        positive({"torque": "-1"}, "torque")


def test_a_life_says_which_stiffness_it_shows():
    """44.3 of a life stood beside 50.0 of a loop without a word."""
    from workbench.life_step import PANES, curves

    shown = curves([0.0], [{name: 1.0 for _, _, lines in PANES for name, _ in lines}])
    assert "running, between half and all of the torque; with the input held" in shown["how"]
    assert [line["name"] for line in shown["panes"][-1]["lines"]] == ["running stiffness"]


def test_a_life_that_runs_says_which_pass_it_is_and_why_in_the_words_of_the_terminal():
    """Hours went from 10,000 back to 69 without a word, and the last of them were others than those of the result."""
    from cli.show.life import telling
    from studies.life import Life, LifeSettings
    from workbench.life_step import LATEST, PANES, so_far

    figures = {name: 1.0 for _, _, lines in PANES for name, _ in lines}
    begun = Life(LifeSettings(90.0), [0.0, 90.0], [figures] * 2, jumps=3, passes=1)
    again = Life(LifeSettings(90.0), [0.0, 2.5], [figures] * 2, jumps=6, passes=2, coarse=[[1.0]] * 4, over_turn=[[0.0, 6.0], [1.0, 7.0]])
    said = []
    tell = telling(said.append)
    for life in (begun, again):
        tell(life)
    first, second = (so_far(life, False) for life in (begun, again))
    assert (first["pass"], first["why"], second["pass"]) == (1, "", 2) and second["why"] in said and second["how"].endswith(LATEST)
    again.over_turn.append([2.5, 8.0])
    last = so_far(again, True)
    assert last["ended"] and last["panes"][2]["lines"][0]["values"][-1] == 8.0 and LATEST not in last["how"]


def test_a_life_of_a_model_file_is_called_after_it_and_its_command_names_it(tmp_path, monkeypatch):
    """It was called as one of its reducer, and stood where that one's does; the command spelled every number of the model."""
    from discrepancy.model_file import load_model
    from studies import kept_life
    from workbench.life_step import command, life

    def stop(path, wanted, *_):
        lives.append((path.name, wanted))
        raise kept_life.Paused(0.0)

    folder, lives = opened(tmp_path), []
    monkeypatch.setattr(kept_life, "live_to", stop)
    numbers = '[settings]\n"errors.pin.radius[3]" = "1 um"\n[effects.needle_clearance]\nadded = "2.1 um"\n'
    for name, model in (("model.toml", "RV20E-121"), ("gearbox 7.toml", "gearbox 7")):
        (tmp_path / name).write_text(f'[model]\nname = "{model}"\nreducer = "RV20E-121"\n{numbers}', "utf-8")
    for name in ("model.toml", "gearbox 7.toml", "RV20E-121"):
        assert life(folder, {"model": name, "hours": "10"}, 1, tmp_path)
    assert [(path, wanted.reducer.name) for path, wanted in lives] == [
        ("RV20E-121-model_life.nc", "RV20E-121-model"), ("gearbox 7_life.nc", "gearbox 7"), ("RV20E-121_life.nc", "RV20E-121"),
    ]  # fmt: skip
    wanted = lives[0][1]
    assert wanted.reducer.starts["needle_clearance_added"] == 2.1e-6 and wanted.reducer.starts["pin_radius_error[3]"] == 1e-6 and not wanted.settings
    texts = ["output.load_torque=100.0N.m"]
    assert command(load_model(tmp_path / "gearbox 7.toml"), 10.0, texts, tmp_path / "a.nc") == (
        f"rvwear life --reducer '{tmp_path / 'gearbox 7.toml'}' --hours 10 --set output.load_torque=100.0N.m --output {tmp_path / 'a.nc'}"
    )
    assert command(load_model("RV20E-121"), 10.0, [], tmp_path / "a.nc") == f"rvwear life --reducer RV20E-121 --hours 10 --output {tmp_path / 'a.nc'}"


def test_a_life_runs_at_the_load_and_the_speed_of_its_fields():
    """There was no field for the speed."""
    from workbench.life_step import settings_of

    assert settings_of({}) == [] and settings_of({"torque": "120", "speed": "900"}) == ["output.load_torque=120.0N.m", "input.speed=900.0rpm"]
    assert settings_of({"speed": "25 Hz"}) == ["input.speed=1500.0rpm"]
    with pytest.raises(InputFault, match="speed = -5: must lie above 0"):
        settings_of({"speed": "-5"})


def test_of_two_starts_at_once_one_counts(tmp_path, monkeypatch):
    from concurrent.futures import ThreadPoolExecutor

    folder, begun = opened(tmp_path), []
    monkeypatch.setattr(jobs.subprocess, "Popen", lambda *words, **how: begun.append(words) or type("Process", (), {"wait": lambda self: 0})())

    def start(kind):
        try:
            jobs.start(folder, kind, {}, 1)
        except InputFault as fault:
            return str(fault)
        return ""

    with ThreadPoolExecutor(8) as pool:
        said = list(pool.map(start, jobs.KINDS))
    assert len(begun) == 1 and said.count("") == 1 and all("is being computed" in text for text in said if text)


def test_what_begins_anew_shows_nothing_of_before(tmp_path, monkeypatch):
    """A life of another model showed the curves of the one before until its own first jump; one that goes on has its own."""
    folder = opened(tmp_path)
    monkeypatch.setattr(jobs.subprocess, "Popen", lambda *words, **how: type("Process", (), {"wait": lambda self: 0})())
    for before, kept in (({"model": "RV20E-121"}, False), ({"model": "BX-40E"}, True)):
        folder.remember("jobs/life/job", {"kind": "life", "given": before, "begun": 0.0})
        folder.remember("jobs/life/beat", {"state": jobs.STOPPED})
        folder.remember("jobs/life/live", {"now": {"hours": [0.0, 500.0]}})
        jobs.start(folder, "life", {"model": "BX-40E"}, 1)
        assert bool(folder.recall("jobs/life/live")) == kept


@pytest.mark.parametrize(("kept", "chosen"), [(True, "model.toml"), (False, "RV20E-121")])
def test_once_the_effect_is_in_the_model_that_model_is_the_chosen_one(tmp_path, monkeypatch, kept, chosen):
    """The first life after "Add it" was one of the base model."""
    from discrepancy import extend
    from discrepancy.model_file import load_model
    from workbench import steps

    folder, file = opened(tmp_path), load_model("RV20E-121")
    step = {"campaign": "c", "effects": ["drag"], "verdict": extend.HELPED, "reason": "so", "kept": kept, "signals": [], "nuisances": {},
            "training_before": 2.0, "training_after": 1.0, "held_out_before": 2.0, "held_out_after": 1.0}  # fmt: skip
    monkeypatch.setattr(steps, "inputs", lambda folder, given: (file, None))
    monkeypatch.setattr("discrepancy.remembered.remembered", lambda *given, **more: None)
    monkeypatch.setattr("discrepancy.remembered.interrupted", lambda *given, **more: "what was known")
    asked = []
    monkeypatch.setattr(extend, "extend", lambda *given, **more: asked.append(more) or extend.Extension(replace(file, steps=(step,)), step, extend.HELPED))
    folder.remember("view", {"model": "RV20E-121", "theme": "dark"})
    place = jobs.place_of(folder, "extend")
    place.mkdir(parents=True)
    assert steps.extend_step(folder, {"model": "RV20E-121", "effects": ["drag"]}, 1, place) is False
    assert folder.recall("view") == {"model": chosen, "theme": "dark"}
    # The file is there by now, and the command asks for what was done here.
    assert folder.recall("jobs/extend/result")["command"].endswith(f"--output {shlex.quote(str(folder.root / 'model.toml'))} --overwrite")
    # After a stop it goes on from there.
    assert asked[0]["answer"] is None and asked[0]["doctor"] == "what was known"


def test_the_command_printed_below_the_units_builds_them(tmp_path, monkeypatch):
    """Of a model file it named ``extend``, which has nothing to add and builds nothing."""
    from studies import building
    from workbench import steps

    folder = opened(tmp_path / "my bench")
    text = '[model]\nname = "better"\nreducer = "RV20E-121"\n[settings]\n\"bearing.clearance\" = "7 um"\n'
    (folder.root / "model.toml").write_text(text, encoding="utf-8")
    asked = []
    monkeypatch.setattr(building, "build_units", lambda reducer, place, *wanted: asked.append((reducer, place)) or ([], []))
    place = jobs.place_of(folder, "build")
    place.mkdir(parents=True)
    steps.build_step(folder, {"model": "model.toml"}, 1, place)
    command = folder.recall("jobs/build/result")["command"]
    assert main(shlex.split(command)[1:]) == 0
    assert asked[0] == asked[1] and pytest.approx(7e-6) in asked[0][0].starts.values()


def moved(angle, by):
    import numpy as np

    return 10.0 * np.sin(angle) + 3.0 * np.sin(80.0 * (angle + by))


@pytest.mark.parametrize("named, free", [("lag_share", True), ("angle_zero[1]", True), ("sensor_gain", False)])
def test_a_tried_curve_stands_from_its_own_zero_where_that_is_free(named, free):
    """A tried effect that moves the lag was held against the measurement with the lag of the base model, and looked worse than it is."""
    import numpy as np

    from discrepancy.problem import ERROR, Parameter, Record
    from workbench.own_zero import at_own_zero
    from workbench.trying import error_of

    angle = np.linspace(0.0, 2.0 * np.pi, 1200, endpoint=False)
    record = Record("r", ERROR, "rad", "c", 1, moved(angle, 2e-3), {"angle": angle}, {"direction": 1}, mounting="1", of_output=True)
    nuisances = [Parameter(named, "1", 0.0, -1.0, 1.0, 0.1, 0)]
    before, after = error_of(record, moved(angle, 0.0)), error_of(record, at_own_zero(record, moved(angle, 0.0), nuisances))
    assert before > 0.3 and (after < 0.1 * before if free else after == before)


def test_nothing_else_is_moved_in_try():
    import numpy as np

    from discrepancy.problem import Parameter, Record
    from workbench.own_zero import at_own_zero

    torque = np.linspace(-1.0, 1.0, 50)
    loop = Record("r", "hysteresis", "rad", "c", 1, torque + 1.0, {"torque": torque}, {"direction": 1}, mounting="1")
    assert at_own_zero(loop, torque, [Parameter("angle_zero[1]", "rad", 0.0, -1.0, 1.0, 0.1, 0)]) is torque
