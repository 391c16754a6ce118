"""Units in processes of their own: the same results, and a crash that stays where it is."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from shared import gone

from fmu_src.faults import InputFault, RunFault
from orchestrator.fmu import Fmu
from orchestrator.isolation import Isolated
from orchestrator.master import StepControl
from orchestrator.system import connect

RING = [("a.x", "b.u"), ("b.x", "a.u")]


def pair(spring, **options):
    system = connect({"a": spring, "b": spring}, RING, 0.1, **options)
    system["a.x"] = 1.0
    return system


@pytest.mark.parametrize("options", [{}, {"scheme": "jacobi"}, {"step_control": StepControl(1e-3), "extrapolation": 1}])
def test_isolated_units_give_the_same_trajectory(spring, options):
    systems = [pair(spring, isolate=isolate, **options) for isolate in (False, True)]
    one, other = (system.run(2.0, record=["a.x", "b.v"]) for system in systems)
    assert all(np.array_equal(one[name], other[name]) for name in one)
    assert one["b.v"].any()
    for system in systems:
        system.close()


def test_saved_isolated_unit_is_restored_elsewhere(spring):
    system = pair(spring, isolate=True)
    system.run(1.0)
    state, x = system.master.components["a"].save(), system["a.x"]
    here = Fmu("a", spring)
    here.restore(state)
    assert here.get("x") == x
    here.close()
    system.close()


def test_crashed_process_is_a_clear_fault_and_the_others_survive(spring, capfd):
    system = pair(spring, isolate=True)
    system["a.mode"] = 1
    with pytest.raises(RunFault, match=r"a \(Spring.fmu\): the process.*signal 11 \(SIGSEGV\).*at time 0.2 s"):
        system.run(1.0)
    other = system.master.components["b"]
    assert other.get("k") == 1.0
    other.step(0.2, 0.1)
    other.save()
    with pytest.raises(RunFault, match="crashed"):
        system["a.x"]
    system.close()


def test_hanging_unit_is_ended(spring):
    unit = Isolated("a", spring, timeout=1.0)
    unit.set("mode", 2)
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    unit.step(0.0, 0.1)
    with pytest.raises(RunFault, match="gave no answer for 1 s"):
        unit.step(0.2, 0.1)
    unit.close()


def test_refusal_is_told_as_in_process_and_leaves_the_process_alive(spring):
    unit = Isolated("a", spring)
    unit.set("mode", 3)
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    with pytest.raises(RunFault, match="fmi2DoStep failed with status 2"):
        unit.step(0.2, 0.1)
    assert unit.get("k") == 1.0
    with pytest.raises(InputFault, match="no variable 'y'"):
        unit.get("y")
    unit.close()


def test_what_a_unit_prints_does_not_disturb(spring, capfd):
    system = pair(spring, isolate=True)
    system["a.loud"] = True
    system.run(0.3)
    system.close()
    assert "a step" in capfd.readouterr().err


def test_missing_fmu_is_told(tmp_path):
    with pytest.raises(InputFault, match="no FMU at"):
        Isolated("a", tmp_path / "none.fmu")


def test_folders_named_like_modules_are_none(spring, tmp_path, monkeypatch):
    """Where somebody happens to stand is no place to import from."""
    for name in ("orchestrator", "numpy"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text("raise RuntimeError('foreign')", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    Isolated("a", spring).close()


HANGING = """
import os, sys
from orchestrator.isolation import Isolated

unit = Isolated("a", sys.argv[1])
unit.set("mode", 2)
unit.enter_initialisation(0.0)
unit.exit_initialisation()
os.write(1, b"stepping\\n")
unit.step(0.2, 0.1)
"""


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="no groups of processes on this system")
def test_ctrl_c_ends_a_unit_that_hangs_with_one_traceback(spring, tmp_path):
    script = tmp_path / "hanging.py"
    script.write_text(HANGING, encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).resolve().parents[1])}
    process = subprocess.Popen([sys.executable, script, spring], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               env=environment, start_new_session=True)  # fmt: skip
    assert process.stdout.readline() == "stepping\n"
    os.killpg(process.pid, signal.SIGINT)
    errors = process.communicate(timeout=30)[1]
    assert errors.count("Traceback") == 1 and "KeyboardInterrupt" in errors
    assert gone(process.pid)
