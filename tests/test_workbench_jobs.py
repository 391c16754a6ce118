"""The workbench's server: jobs that outlive it, and what they tell.  No browser."""

import json
import shlex
import subprocess
import sys
import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from workbench_server import asked, own

from cli.main import main
from fmu_src.faults import InputFault
from workbench import jobs
from workbench.folder import Folder, opened

pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')


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
    from discrepancy.campaign.unplaced import QUESTION
    from discrepancy.doubts.calibrated_doubts import OF_INPUT
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
