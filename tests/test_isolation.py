"""Units in processes of their own: the same results, and a crash that stays where it is."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from shared import gone
from small_fmus import build_sleeper

from fmu_src import framing
from fmu_src.faults import InputFault, RunFault
from orchestrator.call_limits import CallLimits, parse_limits
from orchestrator.fmu import Fmu
from orchestrator.isolation import Isolated
from orchestrator.master import StepControl
from orchestrator.system import connect, load

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
    unit = Isolated("a", spring, CallLimits(step=1.0))
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


@pytest.fixture(scope="module")
def sleeper(tmp_path_factory):
    """A unit in C that hangs where the environment says: no Python in it that lets others run."""
    if os.name != "posix" or not shutil.which("cc"):
        pytest.skip("no C compiler, or no POSIX")
    return build_sleeper(tmp_path_factory.mktemp("sleeper"))


LIMIT = 0.4


def use_all(path, limits):
    unit = Isolated("a", path, limits)
    try:
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
        for k in range(2):
            unit.step(0.1 * k, 0.1)
        unit.set("u", 1.0)
        assert unit.get("x") == pytest.approx(0.2)
        kept = unit.snapshot()
        unit.revert(kept)
        unit.forget(kept)
    finally:
        unit.close()


@pytest.mark.parametrize("function, said", [
    ("fmi2Instantiate", "its start"), ("fmi2EnterInitializationMode", "initialisation at time 0 s"),
    ("fmi2ExitInitializationMode", "initialisation at time 0 s"), ("fmi2DoStep", "the step of 0.1 s at time 0.1 s"),
    ("fmi2GetReal", "reading values at time 0.2 s"), ("fmi2SetReal", "writing values at time 0.2 s"),
    ("fmi2GetFMUstate", "saving its state at time 0.2 s"), ("fmi2SetFMUstate", "restoring a state at time 0.2 s"),
    ("fmi2FreeFMUstate", "freeing a state at time 0.2 s"),
])  # fmt: skip
def test_unit_that_hangs_in_any_call_is_ended_and_named(sleeper, monkeypatch, function, said):
    monkeypatch.setenv("HANG_IN", function)
    monkeypatch.setenv("HANG_FROM", "0" if "nst" in function or "Init" in function else "0.1" if "Step" in function else "0.2")
    limits = CallLimits(start=20.0 if function != "fmi2Instantiate" else 1.5).with_changes(dict.fromkeys(("initialise", "step", "values", "state"), LIMIT))
    with pytest.raises(RunFault) as caught:
        use_all(sleeper, limits)
    limit = 1.5 if function == "fmi2Instantiate" else LIMIT
    assert f"a (Sleeper.fmu): the process of this unit gave no answer for {limit:g} s and was ended during {said}. The other" in str(caught.value)


def test_unit_that_hangs_when_it_is_freed_is_ended(sleeper, monkeypatch):
    monkeypatch.setenv("HANG_IN", "fmi2FreeInstance")
    unit = Isolated("a", sleeper, CallLimits(end=0.3))
    started = time.monotonic()
    unit.close()
    assert time.monotonic() - started < 3.0 and unit.process.returncode == -signal.SIGKILL


def test_limits_are_set_by_scenario_system_and_command_line(sleeper, tmp_path, monkeypatch, capsys):
    from cli.main import main

    scenario = """
[scenario]
name = "s"
step = { value = 0.1, unit = "s" }
duration = { value = 0.5, unit = "s" }
call_limit = 30
[components.a]
fmu = "%s"
isolate = %s
call_limit = { step = 0.5 }
"""
    path = tmp_path / "s.toml"
    path.write_text(scenario % (sleeper, "true"))
    monkeypatch.setenv("HANG_IN", "fmi2DoStep")
    for options, limit in (((), 0.5), (("--call-limit", "step=0.3"), 0.3)):
        assert main(["run", str(path), "--record", "a.x", "--output", str(tmp_path / "s.nc"), *options]) == 1
        assert f"gave no answer for {limit:g} s and was ended during the step of 0.1 s at time 0 s" in capsys.readouterr().err
    with pytest.raises(RunFault, match=r"for 0.6 s .* at time 0 s"):
        load(sleeper, 0.1, isolate=True, call_limit={"step": 0.6}).run(0.2)
    path.write_text(scenario % (sleeper, "false"))
    assert main(["run", str(path)]) == 2
    assert "components.a.call_limit = {'step': 0.5}: only a unit in a process of its own can be ended; set isolate = true" in capsys.readouterr().err
    assert main(["run", str(sleeper), "--step", "0.1", "--call-limit", "5"]) == 2
    assert "give isolate (--isolate) too" in capsys.readouterr().err


@pytest.mark.parametrize("texts, said", [(["stop=3"], "there is no such call; did you mean step"), (["fast"], "write seconds"), (["-1"], "a positive number"),
                                         (["nan"], "a positive number")])  # fmt: skip
def test_bad_limit_is_told(texts, said):
    with pytest.raises(InputFault, match=said):
        CallLimits().with_changes(parse_limits(texts))


MASTER = """
import os, sys
from orchestrator.isolation import Isolated

unit = Isolated("a", sys.argv[1])
print(unit.process.pid, flush=True)
unit.enter_initialisation(0.0)
unit.exit_initialisation()
unit.step(0.0, 0.1)
"""


@pytest.mark.parametrize("function", ["fmi2DoStep", "none"])
def test_no_unit_outlives_a_master_that_is_killed(sleeper, tmp_path, function):
    """Neither one that hangs in its own code nor one that waits."""
    text = MASTER + ("" if function == "fmi2DoStep" else "sys.stdin.read()")
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).resolve().parents[1]), "HANG_IN": function}
    with subprocess.Popen([sys.executable, "-c", text, sleeper], stdout=subprocess.PIPE, stdin=subprocess.PIPE, text=True, env=environment) as master:
        unit = int(master.stdout.readline())
        time.sleep(0.5)
        os.kill(unit, 0)
        master.kill()
    assert gone(unit)


@pytest.mark.parametrize("hangs", [False, True])
def test_termination_leaves_nothing_unpacked_and_ends_what_hangs(sleeper, tmp_path, hangs):
    """In this process: the unit is unpacked beside it; one that hangs in its own code hears nothing, and is ended all the same."""
    (tmp_path / "temporary").mkdir()
    environment = os.environ | {"PYTHONPATH": str(Path(__file__).resolve().parents[1]), "TMPDIR": str(tmp_path / "temporary")}
    environment |= {"HANG_IN": "fmi2DoStep"} if hangs else {}
    words = ["run", str(sleeper), "--step", "1e-3", "--duration", "5e3", "--output", str(tmp_path / "x.nc")]
    with subprocess.Popen([sys.executable, "-m", "cli", *words], env=environment, stderr=subprocess.PIPE, text=True) as process:
        while process.poll() is None and not list((tmp_path / "temporary").glob("*/binaries/*/*")):
            time.sleep(0.05)
        time.sleep(1.0)
        process.send_signal(signal.SIGTERM)
        assert "Traceback" not in process.communicate(timeout=30)[1]
    assert process.returncode == 143
    assert hangs or not list((tmp_path / "temporary").iterdir())


VALUES = [None, True, False, 0, -(2**63), 1.5, float("inf"), "", "\u00e4\ud800", b"\0\xff", (), ((1, "a"), {"k": (b"", None)}), {}]


@pytest.mark.parametrize("value", VALUES)
def test_messages_come_back_as_they_were(value):
    assert framing.decode(framing.encode(value)) == value


def test_arrays_come_back_as_they_were_and_others_do_not_go():
    array = np.arange(6.0).reshape(2, 3)
    assert np.array_equal(framing.decode(framing.encode((1, array)))[1], array)
    for value in (object(), np.array([object()]), {1, 2}):
        with pytest.raises(ValueError, match="is no data"):
            framing.encode(value)


def test_bytes_that_are_no_message_are_told():
    """Whatever a unit answers is a value or a fault, never code."""
    whole, chance = framing.encode([*VALUES, np.arange(3)]), random.Random(1)
    for _ in range(3000):
        bad = bytearray(whole[: chance.randrange(len(whole) + 1)] + bytes(chance.randrange(3)))
        for _ in range(chance.randrange(3)):
            if bad:
                bad[chance.randrange(len(bad))] = chance.randrange(256)
        try:
            framing.decode(bytes(bad))
        except framing.FrameFault:
            continue
