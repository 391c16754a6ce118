"""Ensembles on several workers: a Dask scheduler and two workers on this machine, workers killed on the way.

Every life must arrive, once, and be the same to the last bit as in one process.
"""

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import process_time

from benchmarks import memory
from benchmarks.ratios import Figure, Measured
from studies.ensemble.backends import through_dask, through_joblib
from studies.ensemble.ensemble_file import load_ensemble
from studies.ensemble.member import Task, run
from studies.ensemble.sampling import tasks_of
from studies.ensemble.store import Store

TEXT = """
reducer = "RV20E-121"
hours = 400
tolerance = 0.1
[parameters]
bearing_clearance = { distribution = "normal", mean = 2.5, deviation = 0.4, unit = "um" }
load_torque = { distribution = "uniform", low = 120, high = 200, unit = "N.m" }
"""


@dataclass(frozen=True)
class Killed:
    """What came of an ensemble whose workers were killed."""

    lives: int
    killed: int
    lost: int
    twice: int
    different: int


@contextmanager
def cluster(folder: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """(address, processes of the workers); all are ended at the end."""
    file = folder / "scheduler.json"
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
               "--scheduler-file", str(file)]
    scheduler = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    workers: list[subprocess.Popen[bytes]] = []
    try:
        while not file.exists():
            assert scheduler.poll() is None, "the Dask scheduler did not start"
            time.sleep(0.1)
        time.sleep(0.2)
        address = json.loads(file.read_text())["address"]
        workers += [worker(address) for _ in range(2)]
        yield address, workers
    finally:
        for process in (*workers, scheduler):
            process.kill()
            process.wait()


def worker(address: str) -> subprocess.Popen[bytes]:
    """One that nobody starts again."""
    command = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
    return subprocess.Popen(command, stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


def killed_workers(samples: int = 8, kills: int = 3) -> Killed:
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "e.toml").write_text(TEXT)
        tasks = tasks_of(load_ensemble(folder / "e.toml", samples))
        store, killed, twice = Store(folder / "e.lives", {}), 0, 0
        with cluster(folder) as (address, workers):
            for count, life in enumerate(through_dask(run, tasks, address), 1):
                twice += not store.add(life)
                # Spread over the run, in the midst of the next lives; a new worker comes for each.
                if killed < kills and count * (kills + 1) >= (killed + 1) * len(tasks):
                    workers[killed].kill()
                    workers.append(worker(address))
                    killed += 1
        kept = Store(folder / "e.lives", {}).lives
        alone = {life["number"]: life for life in map(run, tasks)}
        return Killed(len(tasks), killed, sum(n not in kept for n in alone), twice,
                      sum(kept.get(n) != json.loads(json.dumps(life)) for n, life in alone.items()))  # fmt: skip


@dataclass(frozen=True)
class Shared:
    """The same lives in one process and in two whose kernels are loaded."""

    alone: float  # processor time of a life in one process [s]
    beside: float  # the same in one of two processes [s]
    start: float  # wall time until two new processes have done a short life each [s]
    efficiency: float  # wall time of one process over twice that of two
    busy: float  # share of the two processes' wall time in which they computed
    memory: float  # most memory of a process [byte]


def clocked(task: Task) -> tuple[float, float]:
    """(processor time [s], most memory so far [byte]) of one life, taken where it runs."""
    begun = process_time()
    run(task)
    return process_time() - begun, memory.most()


def shared(samples: int) -> Shared:
    with tempfile.TemporaryDirectory() as temporary:
        (file := Path(temporary) / "e.toml").write_text(TEXT)
        tasks = tasks_of(load_ensemble(file, samples))
    clocked(tasks[0])
    begun = time.perf_counter()
    list(through_joblib(clocked, tasks[:2], 2))
    start = time.perf_counter() - begun
    begun = time.perf_counter()
    alone = sum(seconds for seconds, _ in map(clocked, tasks))
    one = time.perf_counter() - begun
    begun = time.perf_counter()
    found = list(through_joblib(clocked, tasks, 2))
    two = time.perf_counter() - begun
    beside = sum(seconds for seconds, _ in found)
    return Shared(alone / len(tasks), beside / len(tasks), start, one / (2.0 * two), beside / (2.0 * two), max(m for _, m in found))


def measure(quick: bool = False) -> Measured:
    found = killed_workers(2 if quick else 8, 1 if quick else 3)
    text = f"{found.lives} lives on a Dask cluster, {found.killed} workers killed"
    both = shared(2 if quick else 8)
    return Measured(figures=[
        Figure("many machines", f"{text}: lost", found.lost, "1", at_most=0.0),
        Figure("many machines", f"{text}: counted twice", found.twice, "1", at_most=0.0),
        Figure("many machines", f"{text}: not as in one process, to the last bit", found.different, "1", at_most=0.0),
        Figure("many machines", "processor time of an ensemble's life of 400 h", both.alone, "s"),
        Figure("many machines", "efficiency of two joblib processes, by wall time", both.efficiency, "1", at_least=0.9,
               note=f"other load on the machine counts against it; the two computed in {both.busy:.0%} of the time"),
        Figure("many machines", "efficiency of two joblib processes, by processor time", both.alone / both.beside, "1", at_least=0.9,
               note="the same life alone and beside another"),
        Figure("many machines", "start of two processes until each has done one life, wall time", both.start, "s"),
        Figure("many machines", "most memory of a worker", both.memory / 1e6, "MB"),
    ])  # fmt: skip
