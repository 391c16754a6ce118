"""The far end of an isolated unit: a process that does what the master asks for, and never outlives it."""

import json
from collections.abc import Callable
from typing import Any

import numpy as np

from fmu_src.child_process import open_streams
from fmu_src.faults import InputFault, RunFault
from fmu_src.framing import read, write
from orchestrator.component import Component, Snapshot
from orchestrator.fmu import Fmu

# Attributes of a component that its stand-in shows.
SHOWN = ("can_restore", "can_vary_step", "input_derivatives", "usual_step")


class Worker:
    """The unit, its prepared transfers and its snapshots by number."""

    def __init__(self, component: Fmu):
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

    def record_cells(self) -> tuple[str, bytes]:
        """What the unit was built from, and its cells: whoever knows the first can read the second."""
        record = self.component.record()
        return json.dumps(self.component.specification()), record.tobytes()


def shown(component: Component) -> dict[str, Any]:
    """What the master needs to know of a unit, as data."""
    signals_of = []
    for signal in component.signals.values():
        plain = vars(signal) | {"base_unit": None if signal.base_unit is None else tuple(vars(signal.base_unit).values())}
        signals_of.append(plain)
    return {key: getattr(component, key) for key in SHOWN} | {
        "signals": signals_of, "old_names": dict(component.old_names()), "feedthrough": tuple(component.feedthrough().items()),
    }  # fmt: skip


def main(name: str, path: str, lifeline: str) -> None:
    """Serve one unit until the master lets go of it or is gone."""
    requests, answers = open_streams(lifeline)
    try:
        component = Fmu(name, path)
    except (InputFault, RunFault) as fault:
        write(answers, (kind_of(fault), str(fault)))
        return
    worker = Worker(component)
    write(answers, ("done", shown(component)))
    while True:
        try:
            method, arguments = read(requests)
        except EOFError:
            break
        try:
            answer = ("done", worker.do(method, arguments))
        except (InputFault, RunFault) as fault:
            answer = (kind_of(fault), str(fault))
        try:
            write(answers, answer)
        except OSError:
            break
    component.close()


def kind_of(fault: InputFault | RunFault) -> str:
    return "RunFault" if isinstance(fault, RunFault) else "InputFault"
