"""A unit in a process of its own: when it crashes, the run and the other units survive.

The process talks through its standard input and output, a pickled request and a pickled
answer at a time; what the unit itself prints goes to standard error.
"""

import contextlib
import os
import pickle
import signal as signals
import struct
import subprocess
import sys
import weakref
from collections.abc import Callable, Mapping
from pathlib import Path
from threading import Timer
from typing import IO, Any

import numpy as np

from fmu_src.arrays import Records
from fmu_src.faults import InputFault, RunFault
from orchestrator.component import Component, Element, Snapshot
from orchestrator.fmu import Fmu
from orchestrator.interrupts import interrupts_later
from orchestrator.scratch import Scratch

LENGTH = struct.Struct("<Q")
FAULTS = {"InputFault": InputFault, "RunFault": RunFault}
# Attributes of a component that its stand-in shows.
SHOWN = ("signals", "can_restore", "can_vary_step", "input_derivatives", "usual_step")
CLOSING_SECONDS = 2.0
# Exit codes of Windows for crashes begin here.
WINDOWS_CRASH = 0xC0000000
START = "import ast, sys; sys.path[:] = ast.literal_eval(sys.argv[1]); from orchestrator.isolation import main; main(*sys.argv[2:])"


class Isolated(Component):
    """Stands for an FMU that lives in another process.

    ``timeout`` [s] ends a unit that hangs in a step.
    """

    def __init__(self, name: str, path: str | Path, timeout: float | None = None):
        self.name, self.path, self.timeout = name, Path(path), timeout
        self.doing = "its start"
        self.timed_out = False
        # Where the unit is unpacked: a process that crashes cannot remove it.
        self.scratch = Scratch()
        # With this process's own path: a folder named like a module where somebody happens to stand is none.
        with interrupts_later():
            self.process = subprocess.Popen(
                [sys.executable, "-P", "-c", START, repr(sys.path), name, str(self.path)],
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=os.environ | {"TMPDIR": str(self.scratch.path)},
            )  # fmt: skip
        # Also when nobody closes this: a unit that hangs would stay behind.
        self.requests, self.answers = streams(self.process)
        self.end = weakref.finalize(self, end, self.process)
        try:
            shown = self.answer()
        except (InputFault, RunFault):
            self.close()
            raise
        for key in SHOWN:
            setattr(self, key, shown[key])
        self.through: dict[Element, tuple[Element, ...]] = shown["feedthrough"]

    def call(self, method: str, *arguments: object) -> Any:
        """Have the unit do something and return what comes of it."""
        self.send(method, *arguments)
        return self.answer()

    def send(self, method: str, *arguments: object) -> None:
        try:
            write(self.requests, (method, arguments))
        except OSError:
            raise self.loss() from None

    def answer(self) -> Any:
        try:
            kind, value = read(self.answers)
        except (EOFError, OSError):
            raise self.loss() from None
        if kind in FAULTS:
            raise FAULTS[kind](value)
        return value

    def loss(self) -> RunFault:
        """What is known of a process that is gone."""
        self.process.kill()
        code = self.process.wait()
        if self.timed_out:
            end = f"gave no answer for {self.timeout:g} s and was ended"
        elif code < 0:
            end = f"crashed with signal {-code} ({signals.Signals(-code).name})"
        elif code >= WINDOWS_CRASH:
            end = f"crashed with code {code:#x}"
        else:
            end = f"ended with exit code {code}"
        return RunFault(
            f"{self.name} ({self.path.name}): the process of this unit {end} during {self.doing}. The other units are"
            " unharmed; what it printed stands above. Start it anew, with other parameters or a shorter step"
        )

    def old_names(self) -> Mapping[str, str]:
        known: Mapping[str, str] = self.call("old_names")
        return known

    def feedthrough(self) -> dict[Element, tuple[Element, ...]]:
        return self.through

    def reader(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        key = self.call("new_reader", references, buffer.dtype.str)

        def read_values() -> None:
            buffer[:] = np.frombuffer(self.call("read", key), buffer.dtype)

        return read_values

    def writer(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        key = self.call("new_writer", references, buffer.dtype.str)
        return lambda: self.call("write", key, buffer.tobytes())

    def derivative_writer(self, references: tuple[int, ...], order: int, buffer: np.ndarray) -> Callable[[], None]:
        key = self.call("new_writer", references, buffer.dtype.str, order)
        return lambda: self.call("write", key, buffer.tobytes())

    def set_text(self, name: str, text: str) -> None:
        self.call("set_text", name, text)

    def enter_initialisation(self, start_time: float) -> None:
        self.doing = "initialisation"
        self.call("enter_initialisation", start_time)

    def exit_initialisation(self) -> None:
        self.call("exit_initialisation")

    def step(self, time: float, duration: float) -> None:
        self.begin_step(time, duration)
        self.end_step()

    def begin_step(self, time: float, duration: float) -> None:
        self.doing = f"the step of {duration:.6g} s at time {time:.9g} s"
        self.send("step", time, duration)

    def end_step(self) -> None:
        if self.timeout is None:
            self.answer()
            return
        watch = Timer(self.timeout, self.give_up)
        watch.start()
        try:
            self.answer()
        finally:
            watch.cancel()

    def give_up(self) -> None:
        self.timed_out = True
        self.process.kill()

    def save(self) -> bytes:
        state: bytes = self.call("save")
        return state

    def restore(self, state: bytes) -> None:
        self.call("restore", state)

    def snapshot(self) -> Snapshot:
        return self.call("keep_snapshot")

    def revert(self, snapshot: Snapshot) -> None:
        self.call("revert_to", snapshot)

    def forget(self, snapshot: Snapshot) -> None:
        self.call("drop_snapshot", snapshot)

    def record(self) -> Records:
        record: Records = self.call("record")
        return record

    def close(self) -> None:
        self.end()
        self.scratch.remove()


def streams(process: subprocess.Popen[bytes]) -> tuple[IO[bytes], IO[bytes]]:
    """To where requests go and from where answers come."""
    assert process.stdin is not None and process.stdout is not None
    return process.stdin, process.stdout


def end(process: subprocess.Popen[bytes]) -> None:
    """Let go of a process: it ends when it comes to read, and is killed if it does not come to that."""
    requests, answers = streams(process)
    # What was not sent to a process that crashed cannot be sent any more.
    with contextlib.suppress(OSError):
        requests.close()
    try:
        process.wait(CLOSING_SECONDS)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    answers.close()


class Worker:
    """The other end: the unit, its prepared transfers and its snapshots by number."""

    def __init__(self, component: Component):
        self.component = component
        self.transfers: list[tuple[Callable[[], None], np.ndarray]] = []
        self.snapshots: dict[int, Snapshot] = {}
        self.taken = 0

    def do(self, method: str, arguments: tuple[Any, ...]) -> Any:
        own = getattr(self, method, None)
        return own(*arguments) if own is not None else getattr(self.component, method)(*arguments)

    def new_reader(self, references: tuple[int, ...], dtype: str) -> int:
        buffer = np.zeros(len(references), dtype)
        self.transfers.append((self.component.reader(references, buffer), buffer))
        return len(self.transfers) - 1

    def new_writer(self, references: tuple[int, ...], dtype: str, order: int | None = None) -> int:
        buffer = np.zeros(len(references), dtype)
        made = self.component.writer(references, buffer) if order is None else (
            self.component.derivative_writer(references, order, buffer))
        self.transfers.append((made, buffer))
        return len(self.transfers) - 1

    def read(self, key: int) -> bytes:
        transfer, buffer = self.transfers[key]
        transfer()
        return buffer.tobytes()

    def write(self, key: int, values: bytes) -> None:
        transfer, buffer = self.transfers[key]
        buffer[:] = np.frombuffer(values, buffer.dtype)
        transfer()

    def keep_snapshot(self) -> int:
        self.taken += 1
        self.snapshots[self.taken] = self.component.snapshot()
        return self.taken

    def revert_to(self, key: int) -> None:
        self.component.revert(self.snapshots[key])

    def drop_snapshot(self, key: int) -> None:
        self.component.forget(self.snapshots.pop(key))


def write(stream: IO[bytes], message: object) -> None:
    data = pickle.dumps(message)
    stream.write(LENGTH.pack(len(data)) + data)
    stream.flush()


def read(stream: IO[bytes]) -> Any:
    head = stream.read(LENGTH.size)
    if len(head) < LENGTH.size:
        raise EOFError
    return pickle.loads(stream.read(LENGTH.unpack(head)[0]))  # noqa: S301


def main(name: str, path: str) -> None:
    """Serve one unit until the master lets go of it or is gone.  Ctrl-C is for the master to hear."""
    signals.signal(signals.SIGINT, signals.SIG_IGN)
    requests = sys.stdin.buffer
    answers = os.fdopen(os.dup(1), "wb")
    # A unit may print: that must not get among the answers.
    os.dup2(2, 1)
    try:
        component = Fmu(name, path)
    except (InputFault, RunFault) as fault:
        write(answers, (type(fault).__name__, str(fault)))
        return
    worker = Worker(component)
    shown = {key: getattr(component, key) for key in SHOWN} | {"feedthrough": component.feedthrough()}
    write(answers, ("done", shown))
    while True:
        try:
            method, arguments = read(requests)
        except EOFError:
            break
        try:
            answer = ("done", worker.do(method, arguments))
        except (InputFault, RunFault) as fault:
            answer = (type(fault).__name__, str(fault))
        try:
            write(answers, answer)
        except OSError:
            break
    component.close()
