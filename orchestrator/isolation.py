"""A unit in a process of its own: when it crashes or hangs, the run and the other units survive.

The process talks through its standard input and output, a request and an answer at a time, both data (``fmu_src.framing``); what the unit
itself prints goes to standard error.
"""

import json
import math
import signal as signals
import time as clock
import weakref
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from fmu_src.arrays import Records
from fmu_src.child_process import Watch, end, started, streams
from fmu_src.faults import InputFault, RunFault
from fmu_src.framing import FrameFault, read, write
from fmu_src.reading import reading
from fmu_src.units import BaseUnit
from orchestrator.call_limits import USUAL_LIMITS, CallLimits
from orchestrator.component import Component, Element, Signal, Snapshot, unit_of
from orchestrator.isolated_unit import SHOWN
from orchestrator.scratch import Scratch

FAULTS = {"InputFault": InputFault, "RunFault": RunFault}
# Exit codes of Windows for crashes begin here.
WINDOWS_CRASH = 0xC0000000
# Method -> (which limit holds for it, what it is called in a fault).
CALLS = {
    "new_reader": ("values", "reading values"), "new_writer": ("values", "writing values"), "read": ("values", "reading values"),
    "write": ("values", "writing values"), "set_text": ("values", "writing a text"), "cautions": ("values", "reading values"),
    "enter_initialisation": ("initialise", "initialisation"), "exit_initialisation": ("initialise", "initialisation"),
    "save": ("state", "saving its state"), "restore": ("state", "restoring a state"), "keep_snapshot": ("state", "saving its state"),
    "revert_to": ("state", "restoring a state"), "drop_snapshot": ("state", "freeing a state"), "record_cells": ("state", "saving its state"),
}  # fmt: skip


class Isolated(Component):
    """Stands for an FMU that lives in another process; ``limits`` end one that hangs in a call."""

    def __init__(self, name: str, path: str | Path, limits: CallLimits = USUAL_LIMITS):
        self.name, self.path, self.limits = name, Path(path), limits
        self.time, self.doing, self.limit = math.nan, "its start", limits.start
        # Where the unit is unpacked: a process that crashes cannot remove it.
        self.scratch = Scratch()
        self.process, lifeline = started("orchestrator.isolated_unit:main", name, str(self.path), environment={"TMPDIR": str(self.scratch.path)})
        self.watch = Watch(self.process, limits.least)
        self.requests, self.answers = streams(self.process)
        # Also when nobody closes this: a unit that hangs would stay behind.
        self.end = weakref.finalize(self, end, self.process, self.watch, lifeline, limits.end)
        try:
            shown = self.answer()
            with reading(self.path, "what a unit says of itself"):
                self.take(shown)
        except (InputFault, RunFault):
            self.close()
            raise

    def take(self, shown: dict[str, Any]) -> None:
        """What the unit told of itself."""
        for key in SHOWN:
            setattr(self, key, shown[key])
        self.through: dict[Element, tuple[Element, ...]] = dict(shown["feedthrough"])
        self.known_old_names: Mapping[str, str] = shown["old_names"]
        self.signals = {}
        for plain in shown["signals"]:
            base = plain["base_unit"]
            self.signals[plain["name"]] = Signal(**plain | {"base_unit": None if base is None else BaseUnit(*base)})

    def call(self, method: str, *arguments: object) -> Any:
        """Have the unit do something and return what comes of it."""
        kind, self.doing = CALLS[method]
        self.limit = getattr(self.limits, kind)
        self.send(method, *arguments)
        return self.answer()

    def send(self, method: str, *arguments: object) -> None:
        self.watch.until = clock.monotonic() + self.limit
        try:
            write(self.requests, (method, arguments))
        except OSError:
            raise self.loss() from None
        finally:
            self.watch.until = math.inf

    def answer(self) -> Any:
        # It counts from now on: meanwhile the unit may have waited for the master.
        self.watch.until = clock.monotonic() + self.limit
        try:
            kind, value = read(self.answers)
        except (EOFError, OSError):
            raise self.loss() from None
        except (FrameFault, TypeError, ValueError) as problem:
            raise self.loss(f"gave an answer that is none ({problem}) and was ended") from None
        finally:
            self.watch.until = math.inf
        if kind in FAULTS:
            raise FAULTS[kind](str(value))
        return value

    def loss(self, known: str = "") -> RunFault:
        """What is known of a process that is gone."""
        self.process.kill()
        code = self.process.wait()
        if known:
            how = known
        elif self.watch.has_ended_it:
            how = f"gave no answer for {self.limit:g} s and was ended"
        elif code < 0:
            how = f"crashed with signal {-code} ({signals.Signals(-code).name})"
        elif code >= WINDOWS_CRASH:
            how = f"crashed with code {code:#x}"
        else:
            how = f"ended with exit code {code}"
        longer = ", or with a longer call limit" if self.watch.has_ended_it else ""
        when = "" if math.isnan(self.time) or " at time " in self.doing else f" at time {self.time:.9g} s"
        return RunFault(
            f"{self.name} ({self.path.name}): the process of this unit {how} during {self.doing}{when}. The other units are"
            f" unharmed; what it printed stands above. Start it anew, with other parameters or a shorter step{longer}"
        )

    def old_names(self) -> Mapping[str, str]:
        return self.known_old_names

    def feedthrough(self) -> dict[Element, tuple[Element, ...]]:
        return self.through

    def reader(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        key = self.call("new_reader", references, buffer.dtype.str)

        def read_values() -> None:
            values = self.call("read", key)
            if not isinstance(values, bytes) or len(values) != buffer.nbytes:
                raise self.loss("gave other values than it was asked for and was ended")
            buffer[:] = np.frombuffer(values, buffer.dtype)

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
        self.time = start_time
        self.call("enter_initialisation", start_time)

    def exit_initialisation(self) -> None:
        self.call("exit_initialisation")

    def step(self, time: float, duration: float) -> None:
        self.begin_step(time, duration)
        self.end_step()

    def begin_step(self, time: float, duration: float) -> None:
        self.time, self.limit = time + duration, self.limits.step
        self.doing = f"the step of {duration:.6g} s at time {time:.9g} s"
        self.send("step", time, duration)

    def end_step(self) -> None:
        self.answer()

    def save(self) -> bytes:
        state = self.call("save")
        if not isinstance(state, bytes):
            raise self.loss("gave a state that is none and was ended")
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
        specification, cells = self.call("record_cells")
        with reading(self.path, "a unit of this project"):
            records = unit_of(json.loads(specification)).table.new_records()
            records.view("u1")[:] = np.frombuffer(cells, "u1")
        return records

    def cautions(self) -> list[str]:
        return [str(text) for text in self.call("cautions")]

    def close(self) -> None:
        self.end()
        self.scratch.remove()
