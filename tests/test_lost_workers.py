"""Processes that die: their share is computed again once, then the command says so; it never ends as if all were well."""

import os
import signal
from dataclasses import dataclass

import pytest

from fmu_src.faults import RunFault
from studies.ensemble.backends import through_joblib

pytestmark = pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="no SIGKILL on this system")


@dataclass(frozen=True)
class Task:
    number: int
    marker: str


def killed_once(task):
    """The process of life 2 is killed when it comes to it for the first time."""
    if task.number == 2 and not os.path.exists(task.marker):
        open(task.marker, "w").close()
        os.kill(os.getpid(), signal.SIGKILL)
    return task.number


def killed_always(task):
    if task.number == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    return task.number


def test_share_of_a_lost_process_is_computed_again(tmp_path):
    tasks = [Task(number, str(tmp_path / "marker")) for number in range(5)]
    assert sorted(through_joblib(killed_once, tasks, 2)) == [0, 1, 2, 3, 4]


def test_process_that_dies_twice_is_a_clear_fault(tmp_path):
    arrived = []
    with pytest.raises(RunFault, match=r"processes died twice under lives .*2.*the same command with fewer --jobs goes on"):
        arrived.extend(through_joblib(killed_always, [Task(number, "") for number in range(4)], 2))
