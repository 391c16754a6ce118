"""FMI 2.0 calls on arrays prepared once: a vector of hundreds of values moves in one call.

The functions that run every step are bound past fmpy's wrappers (``bound_calls``), whose bookkeeping costs
as much as a native unit needs to copy three hundred values.
"""

import ctypes
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from fmpy.fmi2 import (
    FMU2Slave,
    defaultCallbacks,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)

from orchestrator.bound_calls import address, bound, bound_step
from orchestrator.component import Snapshot
from orchestrator.model_description import Described

TYPE = {"f8": "Real", "i8": "Integer", "?": "Boolean"}


class Fmi2:
    """One instance; where the unit refuses, ``refuse(function, status)`` is to raise."""

    def __init__(
        self, name: str, described: Described, folder: Path, log: Callable[[str], None], refuse: Callable[[str, int], None]
    ):
        description = described.description
        self.slave = FMU2Slave(
            instanceName=name, guid=description.guid, unzipDirectory=str(folder),
            modelIdentifier=description.coSimulation.modelIdentifier, requireFunctions=False,
        )  # fmt: skip
        self.described, self.refuse = described, refuse
        self.callbacks = make_callbacks(log)
        # A unit that can restore its state is told that the master may do so.
        self.keeps_state = int(not description.coSimulation.canGetAndSetFMUstate)

    def instantiate(self) -> None:
        self.slave.instantiate(callbacks=self.callbacks, loggingOn=True)
        self.step = bound_step(self.slave.dll, "fmi2DoStep", self.slave.component, (ctypes.c_int(self.keeps_state),), self.refuse)

    def bound(self, function: str, *arguments: Any) -> Callable[[], None]:
        return bound(self.slave.dll, function, self.slave.component, arguments, self.refuse)

    def values(self, verb: str, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        """fmi2GetReal and its like on a buffer of the width that FMI wants."""
        kind = TYPE["?" if buffer.dtype == bool else buffer.dtype.str[1:]]
        native = buffer if kind == "Real" else np.zeros(len(references), np.int32)
        numbers = (ctypes.c_uint * len(references))(*references)
        call = self.bound(f"fmi2{verb}{kind}", numbers, ctypes.c_size_t(len(references)), address(native))
        return call if native is buffer else copied(call, verb, native, buffer)

    def reader(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        return self.values("Get", references, buffer)

    def writer(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        return self.values("Set", references, buffer)

    def derivative_writer(self, references: tuple[int, ...], order: int, buffer: np.ndarray) -> Callable[[], None]:
        n = len(references)
        numbers, orders = (ctypes.c_uint * n)(*references), (ctypes.c_int * n)(*[order] * n)
        return self.bound("fmi2SetRealInputDerivatives", numbers, ctypes.c_size_t(n), orders, address(buffer))

    def set_text(self, reference: int, text: str) -> None:
        self.slave.setString([reference], [text])

    def enter_initialisation(self, start_time: float) -> None:
        self.slave.setupExperiment(startTime=start_time)
        self.slave.enterInitializationMode()

    def exit_initialisation(self) -> None:
        self.slave.exitInitializationMode()

    def snapshot(self) -> Snapshot:
        return self.slave.getFMUstate()

    def revert(self, snapshot: Snapshot) -> None:
        self.slave.setFMUstate(snapshot)

    def forget(self, snapshot: Snapshot) -> None:
        self.slave.freeFMUstate(snapshot)

    def serialise(self, snapshot: Snapshot) -> bytes:
        return bytes(self.slave.serializeFMUstate(snapshot))

    def deserialise(self, state: bytes) -> Snapshot:
        return self.slave.deSerializeFMUstate(state)


def copied(call: Callable[[], None], verb: str, native: np.ndarray, buffer: np.ndarray) -> Callable[[], None]:
    """A transfer through an array of another width."""

    def read() -> None:
        call()
        buffer[:] = native

    def write() -> None:
        native[:] = buffer
        call()

    return read if verb == "Get" else write


def make_callbacks(log: Callable[[str], None]) -> fmi2CallbackFunctions:
    """fmpy's callbacks, with messages kept for the error text instead of printed."""

    def logger(environment: object, instance: bytes, status: int, category: bytes, message: bytes) -> None:
        log(message.decode("utf-8", "replace").strip())

    callbacks = fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(logger)
    callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(defaultCallbacks.allocateMemory)
    callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(defaultCallbacks.freeMemory)
    return callbacks
