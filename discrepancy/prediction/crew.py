"""Predictions shared between processes by condition.

Each process keeps to its conditions, so that a run that it made stands ready when the next
one starts beside it.  This one does a share too.  Where processes can be forked they begin with the model as it
stands, elsewhere with a copy that is sent to them.
"""

import multiprocessing
import os
import signal
import sys
import weakref
from collections.abc import Callable, Sequence
from multiprocessing import resource_tracker
from multiprocessing.process import BaseProcess
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.faults import InputFault, RunFault
from fmu_src.progress import told_to_nobody
from orchestrator.interrupts import interrupts_later

if TYPE_CHECKING:
    from multiprocessing.connection import Connection
    from multiprocessing.context import ForkContext, SpawnContext

    Pipe = Connection[Any, Any]

Way = Literal["fork", "spawn"]

# Says how processes begin, before what is usual on this system.
HOW = "RVWEAR_PROCESSES"
WAYS: tuple[Way, ...] = ("fork", "spawn")

# Equilibria that a sample asks for, roughly: a locked loop is averaged over positions of the cranks, a mean over a turn
# runs through one, a life through some wear cycles.
DEAR = {"hysteresis": 8, "wear_depth": 300, "wear_profile": 30, "mass_loss": 300, "debris_iron": 300}
DEAR_NUMBER = 20
FEW = 8


class Crew:
    """``jobs`` processes, this one among them, that answer ``predict(record index, arguments)``."""

    def __init__(self, records: Sequence[Record], predict: Callable[..., Floats], jobs: int):
        self.predict = predict
        self.worker_of = shares(records, jobs)
        self.rounds = 0
        way = way_to_begin()
        context: ForkContext | SpawnContext = multiprocessing.get_context("fork") if way == "fork" else multiprocessing.get_context("spawn")
        if way == "spawn":
            # It begins with the first process, and its beginning lets Ctrl-C through.
            resource_tracker.ensure_running()
        self.pipes: list[Pipe] = []
        self.processes: list[BaseProcess] = []
        for _ in range(1, jobs):
            here, there = context.Pipe()
            # A forked process has a copy of the other pipes' ends, which would keep them open when this one ends.
            copied = [here, *self.pipes] if way == "fork" else []
            process = context.Process(target=serve, args=(there, predict, copied), daemon=True)
            try:
                with interrupts_later():
                    process.start()
            except OSError as problem:
                raise RunFault(
                    f"no process to share the predictions with could be started ({problem}). A script of one's own begins below"
                    ' if __name__ == "__main__": where processes are spawned'
                ) from None
            there.close()
            self.pipes.append(here)
            self.processes.append(process)
        self.close = weakref.finalize(self, dismiss, self.pipes, self.processes)

    def __call__(self, which: Sequence[int], arguments: tuple[Any, ...]) -> list[Floats]:
        """Predictions of the records ``which``, in their order."""
        parts: dict[int, list[int]] = {}
        for i in which:
            parts.setdefault(self.worker_of[i], []).append(i)
        own = parts.pop(0, [])
        self.rounds += 1
        for worker, indices in parts.items():
            self.send(worker, (self.rounds, indices, arguments))
        fault: Exception | None = None
        found: dict[int, Floats] = {}
        try:
            found.update((i, self.predict(i, *arguments)) for i in own)
        except Exception as problem:  # noqa: BLE001 - raised below, when the others' answers are in
            fault = problem
        for worker in parts:
            answer = self.answer(worker)
            if isinstance(answer, Exception):
                fault = fault or answer
            else:
                found.update(answer)
        if fault:
            raise fault
        return [found[i] for i in which]

    def send(self, worker: int, request: tuple[int, list[int], tuple[Any, ...]]) -> None:
        try:
            self.pipes[worker - 1].send(request)
        except OSError:
            raise self.loss(worker) from None

    def answer(self, worker: int) -> Any:
        """Of this round; those of a round that was interrupted are passed over."""
        while True:
            try:
                number, answer = self.pipes[worker - 1].recv()
            except (EOFError, OSError):
                raise self.loss(worker) from None
            if number == self.rounds:
                return answer

    def loss(self, worker: int) -> RunFault:
        process = self.processes[worker - 1]
        process.join(timeout=1.0)
        return RunFault(
            f"a process that makes predictions ended with exit code {process.exitcode}; what it printed stands above."
            " Look at the memory that is left, and start again"
        )


def way_to_begin() -> Way:
    """fork, or spawn where processes cannot be forked (Windows) or libraries do not survive it (macOS)."""
    chosen = os.environ.get(HOW)
    possible = [way for way in WAYS if way in multiprocessing.get_all_start_methods()]
    if not chosen:
        return "spawn" if sys.platform == "darwin" else possible[0]
    for way in possible:
        if way == chosen:
            return way
    raise InputFault(f"{HOW} = {chosen!r}: processes begin by {' or '.join(possible)} here")


def shares(records: Sequence[Record], jobs: int) -> list[int]:
    """Process of each record: whole conditions, the dearest first to whoever has least."""
    cost: dict[str, float] = {}
    for record in records:
        size = len(record.values)
        each = DEAR.get(record.quantity, 1 if size > FEW and "angle" in record.axes else DEAR_NUMBER)
        # Runs of one condition that differ by nothing but noise cost once; most are so.
        cost[record.condition] = max(cost.get(record.condition, 0.0), float(each * size))
    loads = [0.0] * jobs
    owner: dict[str, int] = {}
    for condition in sorted(cost, key=lambda c: (-cost[c], c)):
        owner[condition] = int(np.argmin(loads))
        loads[owner[condition]] += cost[condition]
    return [owner[record.condition] for record in records]


def serve(pipe: "Pipe", predict: Callable[..., Floats], others: "list[Pipe]") -> None:
    """The other process: answers until its pipe is closed.  Ctrl-C is for the first process to hear."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    told_to_nobody()
    for other in others:
        other.close()
    while True:
        try:
            number, indices, arguments = pipe.recv()
        except (EOFError, OSError):
            return
        try:
            answer: list[tuple[int, Floats]] | Exception = [(i, predict(i, *arguments)) for i in indices]
        except Exception as problem:  # noqa: BLE001 - sent to whoever asked
            answer = problem
        try:
            pipe.send((number, answer))
        except OSError:
            # Nobody waits for it any more.
            return


def dismiss(pipes: "list[Pipe]", processes: list[BaseProcess]) -> None:
    for pipe in pipes:
        pipe.close()
    for process in processes:
        process.join(timeout=1.0)
        if process.is_alive():
            process.terminate()
