"""Predictions shared between processes: the same numbers, faults that arrive, nothing left behind."""

import contextlib
import multiprocessing
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from crew_work import RECORDS, Deaf, dying, interrupted, predict, telling
from shared import gone

from discrepancy.campaign.load import load_campaign
from discrepancy.model_file import load_model
from discrepancy.prediction.crew import HOW, WAYS, Crew, shares
from discrepancy.prediction.physical_model import PhysicalModel
from fmu_src.faults import InputFault, RunFault
from fmu_src.progress import told_to

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(params=WAYS)
def way(request, monkeypatch):
    """How processes begin."""
    if request.param not in multiprocessing.get_all_start_methods():
        pytest.skip("no such processes on this system")
    monkeypatch.setenv(HOW, request.param)
    return request.param


def test_a_condition_stays_with_one_process_and_work_is_even():
    owner = shares(RECORDS, 2)
    assert owner[0] == owner[2] != owner[1] == owner[3]


def test_answers_come_in_the_order_asked_and_faults_arrive(way):
    crew = Crew(RECORDS, predict, 2)
    found = crew([3, 0, 2, 1], (2.0, None))
    assert [y[0] for y in found] == [6.0, 0.0, 4.0, 2.0]
    for fails in range(4):
        with pytest.raises(ValueError, match=f"record {fails}"):
            crew([0, 1, 2, 3], (1.0, fails))
        # No answer of the failed round is taken for one of the next.
        assert [y[0] for y in crew([1, 0], (1.0, None))] == [1.0, 0.0]
    processes = crew.processes
    crew.close()
    assert not any(p.is_alive() for p in processes)


def test_a_crew_that_is_forgotten_ends_its_processes(way):
    crew = Crew(RECORDS, predict, 3)
    processes = crew.processes
    del crew
    for process in processes:
        process.join(timeout=5.0)
    assert not any(p.is_alive() for p in processes)


def test_a_way_that_does_not_exist_is_refused(monkeypatch):
    monkeypatch.setenv(HOW, "clone")
    with pytest.raises(InputFault, match="RVWEAR_PROCESSES = 'clone': processes begin by"):
        Crew(RECORDS, predict, 2)


def test_a_process_that_dies_is_told(way):
    crew = Crew(RECORDS, dying, 2)
    with pytest.raises(RunFault, match="ended with exit code 3"):
        crew([0, 1, 2, 3], (1.0, None))
    crew.close()


def test_answers_of_an_interrupted_round_are_passed_over(way):
    crew = Crew(RECORDS, interrupted, 2)
    with pytest.raises(KeyboardInterrupt):
        crew([0, 1, 2, 3], (1.0, 0))
    assert [y[0] for y in crew([3, 1], (2.0, None))] == [6.0, 2.0]
    crew.close()


def test_only_the_first_process_tells_how_far_it_is(way):
    with told_to(Deaf()):
        crew = Crew(RECORDS, telling, 2)
        assert [y[0] for y in crew([3, 1], (2.0, None))] == [6.0, 2.0]
    crew.close()


def test_spawned_processes_predict_the_same_to_the_bit(monkeypatch):
    """A model with runs that repeat each other, of the reducer and of the measuring chain."""
    monkeypatch.setenv(HOW, "spawn")
    file, campaign = load_model("BX-40E"), load_campaign(ROOT / "examples" / "hidden_effect" / "campaign")
    alone, shared = (PhysicalModel(file, campaign, jobs=jobs) for jobs in (1, 2))
    base = {p.name: p.off for p in alone.nuisances}
    amplitudes = {c.amplitudes[0].name: c.amplitudes[0].off + c.amplitudes[0].scale for c in alone.candidates[:3]}
    which = range(len(alone.records))
    for values in ({}, amplitudes):
        one, other = (model.predict(base | values) for model in (alone, shared))
        assert all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))
        one, other = (model.predict_beside(base | values, base, which) for model in (alone, shared))
        assert all(np.array_equal(a, b) for a, b in zip(one, other, strict=True))
    assert shared.crew is not None
    shared.crew.close()


WAITING = """
import os
import time
import numpy as np
from discrepancy.prediction.crew import Crew
from discrepancy.problem import Record

def wait(i):
    os.write(1, b"waiting\\n")
    time.sleep(60.0)

if __name__ == "__main__":
    records = [Record(str(i), "lost_motion", "rad", str(i), 1, np.zeros(1), {}, {}) for i in range(2)]
    Crew(records, wait, 2)([0, 1], ())
"""


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="no groups of processes on this system")
@pytest.mark.parametrize("heard_by, begun", [("all", 2), ("the first", 2), ("all", 1)])
def test_ctrl_c_ends_all_processes_with_one_traceback(way, tmp_path, heard_by, begun):
    """Also while one of them is still about to begin."""
    script = tmp_path / "waiting.py"
    script.write_text(WAITING, encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    process = subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env=environment, start_new_session=True)  # fmt: skip
    assert [process.stdout.readline() for _ in range(begun)] == begun * ["waiting\n"]
    errors = ""
    # Python drops an interrupt that arrives within a callback of its own, once in a few hundred times; one presses again.
    for patience in (10, 20):
        if heard_by == "all":
            # As a terminal does.
            os.killpg(process.pid, signal.SIGINT)
        else:
            process.send_signal(signal.SIGINT)
        with contextlib.suppress(subprocess.TimeoutExpired):
            errors = process.communicate(timeout=patience)[1]
            break
    else:
        process.kill()
        process.communicate()
    assert errors.count("Traceback") == 1 and "KeyboardInterrupt" in errors
    assert gone(process.pid)
