"""Predictions shared between processes by condition.

Each process keeps to its conditions, so that a run that it made stands ready when the next
one starts beside it.  Processes are forked with the model as it stands, this one does a share too.
"""

import multiprocessing
import signal
import weakref
from collections.abc import Callable, Sequence

import numpy as np

from discrepancy.problem import Record

# Equilibria that a sample asks for, roughly: a locked loop is averaged over positions of the cranks, a mean over a turn
# runs through one, a life through some wear cycles.
DEAR = {"hysteresis": 8, "wear_depth": 300, "wear_profile": 30, "mass_loss": 300, "debris_iron": 300}
DEAR_NUMBER = 20
FEW = 8


class Crew:
    """``jobs`` processes, this one among them, that answer ``predict(record index, arguments)``."""

    def __init__(self, records: Sequence[Record], predict: Callable[..., np.ndarray], jobs: int):
        self.predict = predict
        self.worker_of = shares(records, jobs)
        context = multiprocessing.get_context("fork")
        self.pipes, self.processes = [], []
        for _ in range(1, jobs):
            here, there = context.Pipe()
            # A copy of the other pipes' ends would keep them open when this process ends.
            process = context.Process(target=serve, args=(there, predict, [here, *self.pipes]), daemon=True)
            process.start()
            there.close()
            self.pipes.append(here)
            self.processes.append(process)
        self.close = weakref.finalize(self, dismiss, self.pipes, self.processes)

    def __call__(self, which: Sequence[int], arguments: tuple) -> list[np.ndarray]:
        """Predictions of the records ``which``, in their order."""
        parts: dict[int, list[int]] = {}
        for i in which:
            parts.setdefault(self.worker_of[i], []).append(i)
        own = parts.pop(0, [])
        for worker, indices in parts.items():
            self.pipes[worker - 1].send((indices, arguments))
        fault, found = None, {}
        try:
            found.update((i, self.predict(i, *arguments)) for i in own)
        except Exception as problem:  # noqa: BLE001 - raised below, when the others' answers are in
            fault = problem
        for worker in parts:
            answer = self.pipes[worker - 1].recv()
            if isinstance(answer, Exception):
                fault = fault or answer
            else:
                found.update(answer)
        if fault:
            raise fault
        return [found[i] for i in which]


def shares(records: Sequence[Record], jobs: int) -> list[int]:
    """Process of each record: whole conditions, the dearest first to whoever has least."""
    cost: dict[str, float] = {}
    for record in records:
        size = len(record.values)
        each = DEAR.get(record.quantity, 1 if size > FEW and "angle" in record.axes else DEAR_NUMBER)
        # Runs of one condition that differ by nothing but noise cost once; most are so.
        cost[record.condition] = max(cost.get(record.condition, 0.0), float(each * size))
    loads, owner = [0.0] * jobs, {}
    for condition in sorted(cost, key=lambda c: (-cost[c], c)):
        owner[condition] = int(np.argmin(loads))
        loads[owner[condition]] += cost[condition]
    return [owner[record.condition] for record in records]


def serve(pipe, predict: Callable[..., np.ndarray], others: list) -> None:
    """A forked process: answers until its pipe is closed.  Ctrl-C is for the first process to hear."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for other in others:
        other.close()
    while True:
        try:
            indices, arguments = pipe.recv()
        except EOFError:
            return
        try:
            answer = [(i, predict(i, *arguments)) for i in indices]
        except Exception as problem:  # noqa: BLE001 - sent to whoever asked
            answer = problem
        pipe.send(answer)


def dismiss(pipes: list, processes: list) -> None:
    for pipe in pipes:
        pipe.close()
    for process in processes:
        process.join(timeout=1.0)
        if process.is_alive():
            process.terminate()
