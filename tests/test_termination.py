"""SIGTERM at any moment between a command's first line and its last: its exit code is that of a terminated command, or its own if it was done."""

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from fmu_src.source_hash import ROOT

# Bit of SIGTERM in the mask of signals that a process hears.
HEARD = 1 << (signal.SIGTERM - 1)
pytestmark = pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="asks Linux whether a process hears a signal")


def hears(process):
    """Whether the process has said that it hears SIGTERM; a process that is gone hears nothing."""
    try:
        lines = Path(f"/proc/{process.pid}/status").read_text().splitlines()
    except OSError:
        return False
    return any(int(line.split()[1], 16) & HEARD for line in lines if line.startswith("SigCgt:"))


def ended(words, wait):
    """(exit code, stderr) of a command that is terminated ``wait`` [s] after it began to hear."""
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    with subprocess.Popen([sys.executable, "-m", "cli", *words], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        while not hears(process) and process.poll() is None:
            time.sleep(0.001)
        time.sleep(wait)
        process.send_signal(signal.SIGTERM)
        said = process.communicate(timeout=60)[1]
    return process.returncode, said


def check(tmp_path, trial, longest):
    words = ("life", "--hours", "1e7", "--tolerance", "1e-5", "--positions", "400", "--no-report", "--output", str(tmp_path / f"{trial}.nc"))
    code, said = ended(words, random.Random(trial).uniform(0.0, longest))
    assert code == 143 and "Traceback" not in said, (trial, code, said)


@pytest.mark.parametrize("trial", range(4))
def test_a_life_that_is_terminated_while_it_starts_says_so(tmp_path, trial):
    check(tmp_path, trial, 0.3)


@pytest.mark.campaign
@pytest.mark.parametrize("trial", range(40))
def test_a_life_that_is_terminated_at_any_time_says_so(tmp_path, trial):
    check(tmp_path, 100 + trial, 1.5)


@pytest.mark.parametrize("trial", range(4))
def test_a_command_that_is_terminated_at_its_end_has_its_code_or_that_of_the_terminated(trial):
    """``example`` prints a list and ends; what it takes is nearly all start and end."""
    code, said = ended(("example", "--json"), random.Random(trial).uniform(0.1, 0.4))
    assert code in (0, 143) and "Traceback" not in said, (trial, code, said)


def test_termination_is_heard_before_anything_is_loaded():
    program = "import signal, sys, cli.entry; print(sorted({'cli.main', 'numpy', 'argparse'} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


LOST = """
import signal, sys, time
from cli.ending import exit_code, termination_heard

class Given:
    def __del__(self):
        # Nothing can be raised in here.
        signal.raise_signal(getattr(signal, sys.argv[1]))

try:
    with termination_heard():
        Given()
        time.sleep(30.0)
except KeyboardInterrupt as interruption:
    sys.exit(exit_code(interruption))
"""


@pytest.mark.parametrize(("asked", "code"), [("SIGTERM", 143), ("SIGINT", 130)])
def test_an_interruption_that_python_cannot_raise_where_it_comes_is_asked_for_once_more(asked, code):
    done = subprocess.run([sys.executable, "-c", LOST, asked], cwd=ROOT, capture_output=True, text=True, timeout=60, check=False)
    assert (done.returncode, done.stderr) == (code, "")
