"""Ctrl-C in a diagnosis: what is known by then is an answer, nothing is half written, and the same command goes on from there."""

import itertools
import json
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.campaign.load import load_campaign
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.refit.refits import Refits
from discrepancy.inference.screening import screen as screening
from discrepancy.inference.verdict import ONE, STOPPED, Interrupted, Settings
from discrepancy.model_file import load_model
from discrepancy.remembered import place_of
from fmu_src.progress import told_to
from fmu_src.source_hash import ROOT
from fmu_src.threads import Threads
from tests.test_base_off import bench

# Stops at the fourth refit until somebody interrupts.
WAITING = """
import sys, time
from discrepancy.inference.refit.refits import Refits
fit, count = Refits.fit, 0
def slow(self, *given, **more):
    global count
    count += 1
    if count == 4:
        print("HERE", file=sys.stderr, flush=True)
        for _ in range(1200):
            time.sleep(0.05)
            self.space.threads.check()
    return fit(self, *given, **more)
Refits.fit = slow
from cli.main import main
sys.exit(main(sys.argv[1:]))
"""


def impatient(monkeypatch, last):
    """The user presses Ctrl-C at the ``last`` refit."""
    fit, count = Refits.fit, itertools.count(1)

    def one(refits, *given, **more):
        if next(count) == last:
            signal.raise_signal(signal.SIGINT)
        return fit(refits, *given, **more)

    monkeypatch.setattr(Refits, "fit", one)


def test_what_is_known_so_far_is_told_and_the_diagnosis_goes_on(monkeypatch):
    doctor = Diagnostician(bench({"play": 4.0}))
    impatient(monkeypatch, 3)
    with pytest.raises(Interrupted) as stop:
        doctor.run()
    found = stop.value.found
    assert found.verdict == STOPPED and "stopped while fitting effects alone" in found.reason and "2 fits" in found.reason
    assert found.rejected and found.localisation["findings"] and len(found.effects) <= 1
    fits, predictions = dict(doctor.refits.fitted), doctor.space.predictions
    known = sum(len(v) for v in predictions.store.values())
    # As it would be in another process: nothing of what was found is lost.
    again = pickle.loads(pickle.dumps(doctor))  # noqa: S301 - made here
    assert sum(len(v) for v in again.space.predictions.store.values()) == known and again.refits.fitted.keys() == fits.keys()
    whole, plain = again.run(), Diagnostician(bench({"play": 4.0})).run()
    assert whole.verdict == plain.verdict == ONE
    assert whole.effects[0].parameters["play"]["value"] == pytest.approx(plain.effects[0].parameters["play"]["value"], rel=1e-6)
    # When all is over, what only the search needed goes.
    assert not again.space.predictions.unfinished


def test_hours_between_two_commands_are_no_computing(monkeypatch):
    doctor = Diagnostician(bench({}))
    kept, clock, spent = pickle.dumps(doctor), time.perf_counter, time.perf_counter() - doctor.started
    monkeypatch.setattr(time, "perf_counter", lambda: clock() + 7200.0)
    assert time.perf_counter() - pickle.loads(kept).started == pytest.approx(spent, abs=60.0)  # noqa: S301 - made here


def test_interrupted_before_the_base_is_fitted_nothing_is_known(monkeypatch):
    doctor = Diagnostician(bench({}))
    monkeypatch.setattr(doctor.space, "fit_base", lambda: signal.raise_signal(signal.SIGINT))
    with pytest.raises(KeyboardInterrupt) as stop:
        doctor.run()
    assert not isinstance(stop.value, Interrupted)


def test_interrupted_while_screening_the_localisation_is_told(monkeypatch):
    doctor = Diagnostician(bench({"play": 4.0}))
    monkeypatch.setattr(screening, "_blocks", lambda *_: signal.raise_signal(signal.SIGINT))
    with pytest.raises(Interrupted) as stop:
        doctor.run()
    assert "while screening" in stop.value.found.reason and stop.value.found.effects == [] and stop.value.found.localisation["findings"]


class Ears:
    """Hears all that is told."""

    def __init__(self):
        self.tasks, self.sentences, self.open = [], set(), threading.Lock()

    def begin(self, task):
        self.tasks.append(task)

    def end(self, task):
        with self.open:
            self.sentences.add(task.sentence())

    def say(self, text):
        pass


def test_a_diagnosis_tells_what_it_tries():
    ears = Ears()
    with told_to(ears):
        Diagnostician(bench({"play": 4.0})).run()
    told = " | ".join(ears.sentences)
    assert "screening, " in told and "4 of 4" in told
    assert "fitting alone, " in told and "fitting in earnest, play: " in told


def test_work_in_threads_is_told_item_by_item():
    ears = Ears()
    with told_to(ears):
        assert Threads(2).told("fitting", lambda k: k * k, [1, 2, 3], str) == [1, 4, 9]
    (task,) = ears.tasks
    assert task.done == task.total == 3 and task.what.startswith("fitting, ")


def campaign_folder(folder):
    """Torsional stiffness at three temperatures, a sixteenth of it missing; on disk."""
    k = 1.356e6
    random = np.random.default_rng(1)
    # No diagnosis of it may be kept from before.
    text = [f'[campaign]\nname = "stiff {time.time_ns()}"\nreducer = "RV20E-121"\n']
    for n, t in enumerate((20, 30, 40)):
        text.append(f'[conditions.c{n}]\ntemperature = "{t} degC"\nload_torque = "167 N.m"\noutput_speed = "15 rpm"\nhours = "0 h"\nheld_out = {str(n == 1).lower()}\n')
        for r in (1, 2, 3):
            value = k / 1.0625 * (1.0 + 0.002 * random.standard_normal())
            text.append(f'[[runs]]\nid = "s{n}{r}"\nquantity = "torsional_stiffness"\ncondition = "c{n}"\nreplicate = {r}\nvalue = "{value:.0f} N.m/rad"\n')
    folder.mkdir()
    (folder / "campaign.toml").write_text("\n".join(text))
    return folder


@pytest.mark.skipif(sys.platform == "win32", reason="signals to other processes are sent otherwise there")
def test_control_c_at_the_command_leaves_an_answer_and_the_command_goes_on(tmp_path):
    folder = campaign_folder(tmp_path / "campaign")
    # The same was measured in the folder of an earlier run of this test.
    place_of(load_model("RV20E-121"), load_campaign(folder), Settings()).unlink(missing_ok=True)
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = ["diagnose", "RV20E-121", str(folder), "--json"]
    with subprocess.Popen([sys.executable, "-c", WAITING, *command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=environment) as running:
        for line in running.stderr:
            if "HERE" in line:
                break
        running.send_signal(signal.SIGINT)
        printed, said = running.communicate(timeout=120)
    assert running.returncode == 130, said
    answer = json.loads(printed)
    assert answer["verdict"] == "stopped" and "fits" in answer["reason"] and "goes on from there" in said
    assert answer["rejected"] and answer["key_figures"] == []
    again = subprocess.run([sys.executable, "-m", "cli.main", *command], capture_output=True, text=True, env=environment, check=False, timeout=240)
    assert again.returncode == 0, again.stderr
    assert json.loads(again.stdout)["verdict"] != "stopped" and load_model("RV20E-121").name == json.loads(again.stdout)["model"]


def test_an_extension_goes_on_after_control_c_from_what_it_had_fitted(monkeypatch, capsys, tmp_path):
    """It began anew, where ``diagnose`` went on."""
    from cli.main import main
    from discrepancy.inference.base_fit.workspace import Workspace

    folder = campaign_folder(tmp_path / "campaign")
    place = place_of(load_model("RV20E-121"), load_campaign(folder), Settings())
    for left in (place, place.with_suffix(".begun")):
        left.unlink(missing_ok=True)
    fits, fit_base = [], Workspace.fit_base
    monkeypatch.setattr(Workspace, "fit_base", lambda space: fits.append(space) or fit_base(space))
    words = ["extend", "RV20E-121", str(folder), "--effect", "support_compliance", "--output", str(tmp_path / "better.toml"), "--json"]
    with monkeypatch.context() as patience:
        impatient(patience, 3)
        assert main(words) == 130
    said = capsys.readouterr().err
    assert "better.toml is as it was; the fits so far are kept, and the same command goes on from there" in said and len(fits) == 1
    assert main(words) in (0, 3) and len(fits) == 1
    again = json.loads(capsys.readouterr().out)["step"]
    # The same as without a pause.
    for left in (place.with_suffix(".begun"), tmp_path / "better.toml"):
        left.unlink()
    main(words)
    whole = json.loads(capsys.readouterr().out)["step"]
    assert len(fits) == 2 and again["effects"] == whole["effects"] and again["training_after"] == pytest.approx(whole["training_after"])


def test_interrupted_while_the_base_is_fitted_the_command_says_that_nothing_is_known(monkeypatch, capsys, tmp_path):
    from cli.main import main
    from discrepancy import remembered, verdict

    campaign = str(ROOT / "examples" / "hidden_effect" / "campaign")
    monkeypatch.setattr(verdict.Diagnostician, "prepare", lambda self: signal.raise_signal(signal.SIGINT))
    # The process knows its own cache already, where a diagnosis of these files may lie.
    monkeypatch.setattr(remembered, "cache_folder", lambda name: tmp_path)
    assert main(["diagnose", "RV20E-121", campaign]) == 130
    assert "rvwear diagnose: interrupted (while the base model was fitted" in capsys.readouterr().err


def test_interrupted_at_the_key_figures_the_fitted_base_is_told(monkeypatch):
    from discrepancy import verdict

    doctor = SimpleNamespace(model=None, doing="", prepare=lambda: None)
    doctor.stopped = lambda: SimpleNamespace(reason=f"stopped while {doctor.doing}")
    monkeypatch.setattr(verdict, "figures_of", lambda *_: signal.raise_signal(signal.SIGINT))
    monkeypatch.setattr(verdict, "answer_of", lambda model, doctor, found, figures: found)
    with pytest.raises(verdict.AnswerSoFar, match="stopped while reading the key figures"):
        verdict.diagnose(None, None, model=SimpleNamespace(), doctor=doctor)


@pytest.mark.parametrize("more", [["extend"], ["extend", "--draft", "DIR"], ["next"], ["diagnose", "--draft", "DIR"]])
def test_commands_that_begin_with_a_diagnosis_tell_what_was_known(monkeypatch, capsys, tmp_path, more):
    """`extend --draft` ran for 16 minutes, and said "interrupted"."""
    from cli.commands import comparison
    from cli.main import main
    from discrepancy import remembered, verdict
    from discrepancy.experiment import next_run

    def stopped(*given, **how):
        raise verdict.AnswerSoFar(SimpleNamespace(reason="stopped while screening", as_json=lambda: {"verdict": STOPPED}))

    monkeypatch.setattr(comparison, "inputs", lambda options: (load_model("RV20E-121"), None))
    for module in (remembered, next_run):
        monkeypatch.setattr(module, "diagnosed", stopped)
    command, *rest = [str(tmp_path) if word == "DIR" else word for word in more]
    monkeypatch.chdir(tmp_path)
    assert main([command, "RV20E-121", "campaign", "--json", *rest]) == 130
    said = capsys.readouterr()
    assert json.loads(said.out) == {"verdict": STOPPED} | ({"draft": None} if command == "diagnose" else {}) and said.err.strip() == f"rvwear {command}: interrupted; the same command goes on from there"


def test_interrupted_after_the_diagnosis_what_is_kept_is_said(monkeypatch, capsys, tmp_path):
    from cli.commands import comparison, drafting
    from cli.main import main
    from discrepancy import extend, remembered
    from discrepancy.draft import choose
    from discrepancy.experiment import next_run

    def stop(*given, **how):
        raise KeyboardInterrupt

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(comparison, "inputs", lambda options: (load_model("RV20E-121"), None))
    for module in (remembered, next_run):
        monkeypatch.setattr(module, "diagnosed", lambda *given, **how: None)
    monkeypatch.setattr(next_run, "proposal_for", stop)
    assert main(["next", "RV20E-121", "campaign"]) == 130
    monkeypatch.setattr(extend, "extend", stop)
    # Before the base model is fitted there is nothing to keep.
    monkeypatch.setattr(remembered, "interrupted", lambda *given, **how: SimpleNamespace())
    for known in (None, SimpleNamespace(made=0.0, made_in="", diagnosis=SimpleNamespace(seconds=60.0))):
        monkeypatch.setattr(remembered, "remembered", lambda *given, known=known, **how: known)
        assert main(["extend", "RV20E-121", "campaign", "--effect", "drag"]) == 130
    monkeypatch.setattr(choose, "drafts_of", lambda *given: ([SimpleNamespace(file=tmp_path / "drag.py", text="")], []))
    monkeypatch.setattr(choose, "write", lambda draft: draft.file.write_text(draft.text))
    monkeypatch.setattr(drafting, "tried", stop)
    assert main(["extend", "RV20E-121", "campaign", "--draft", str(tmp_path)]) == 130
    weighed, anew, found, fitted, drafted = capsys.readouterr().err.splitlines()
    assert found.startswith("found again: ")
    assert "while experiments were weighed: the diagnosis is kept, and the same command goes on" in weighed and "begins anew" in anew
    assert "RV20E-121.toml is as it was; the diagnosis is kept" in fitted and "drag.py is written, the diagnosis is kept" in drafted
