"""An FMU (FMI 2.0 co-simulation) as a component; ``fmu3`` has FMI 3.0.

Written over fmpy's functions with arrays prepared once: a vector of hundreds of values
moves in one call.
"""

import contextlib
import ctypes
import json
import shutil
from collections.abc import Callable
from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import (
    FMU2Slave,
    defaultCallbacks,
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)

from fmu_src.slaves.kernel_slave import STAMP
from fmu_src.source_hash import source_hash
from fmu_src.state import unpack
from fmu_src.unit import make_unit
from orchestrator.component import Component, Signal
from orchestrator.faults import InputFault, RunFault


def open_fmu(name: str, path: str | Path) -> "Fmu":
    """One instance of an FMU of either version."""
    from orchestrator.fmu3 import Fmu3

    with contextlib.suppress(Exception):
        if fmpy.read_model_description(str(path), validate=False).fmiVersion.startswith("3."):
            return Fmu3(name, path)
    # Also says what is wrong with a path that is no FMU.
    return Fmu(name, path)


class Fmu(Component):
    """One instance of an FMI 2.0 FMU."""

    version = "2.0"

    def __init__(self, name: str, path: str | Path):
        self.name = name
        self.path = Path(path)
        if not self.path.is_file():
            raise InputFault(f"no FMU at {self.path}; build it with: rvwear build")
        try:
            self.description = fmpy.read_model_description(str(self.path))
        except Exception as problem:
            raise InputFault(f"{self.path} is not an FMU: {problem}") from None
        if self.description.coSimulation is None or self.description.fmiVersion != self.version:
            raise InputFault(f"{self.path}: not an FMI {self.version} co-simulation unit")
        self.folder = Path(fmpy.extract(str(self.path)))
        self.require_same_sources()
        self.messages: list[str] = []
        try:
            self.slave = self.load(
                instanceName=name, guid=self.identity, unzipDirectory=str(self.folder),
                modelIdentifier=self.description.coSimulation.modelIdentifier,
            )
        except Exception as problem:
            # fmpy raises a bare Exception for a library that is missing or does not load.
            raise InputFault(f"{self.path} has nothing to run on this machine: {problem}") from None
        self.signals = self.find_signals()
        try:
            self.instantiate()
        except Exception as problem:
            # fmpy raises a bare Exception here; the reason is in what the FMU logged.
            raise RunFault(f"{self.name} ({self.path}): {problem}: {self.last_messages()}") from None

    @property
    def identity(self) -> str:
        return self.description.guid

    def load(self, **named):
        """fmpy's face of the FMU's library."""
        return FMU2Slave(**named)

    def find_signals(self) -> dict[str, Signal]:
        return signals_of(self.description)

    def make_callbacks(self) -> fmi2CallbackFunctions:
        """fmpy's callbacks, with messages kept for the error text instead of printed."""

        def log(environment, instance, status, category, message):
            self.messages.append(message.decode("utf-8", "replace").strip())

        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(log)
        callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(defaultCallbacks.allocateMemory)
        callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(defaultCallbacks.freeMemory)
        return callbacks

    def instantiate(self) -> None:
        self.callbacks = self.make_callbacks()
        self.slave.instantiate(callbacks=self.callbacks, loggingOn=True)

    def last_messages(self) -> str:
        return "; ".join(self.messages[-3:]) or "it logged nothing"

    def attempt(self, function: Callable, *arguments, **named):
        """Call fmpy; on an FMI error raise RunFault with what the FMU logged."""
        try:
            return function(*arguments, **named)
        except FMICallException as problem:
            raise RunFault(f"{self.name} ({self.path.name}): {problem}: {self.last_messages()}") from None

    def prepared(self, references, buffer):
        """(value references, count, pointer to the buffer) as fmpy's raw functions take them."""
        n = len(references)
        kind = ctypes.c_int if buffer.dtype == np.int32 else ctypes.c_double
        return (ctypes.c_uint * n)(*references), n, buffer.ctypes.data_as(ctypes.POINTER(kind))

    def reader(self, references, buffer):
        if buffer.dtype == np.int64:
            narrow = np.zeros(len(references), np.int32)
            vrs, n, pointer = self.prepared(references, narrow)

            def read_integers():
                self.attempt(self.slave.fmi2GetInteger, self.slave.component, vrs, n, pointer)
                buffer[:] = narrow

            return read_integers
        vrs, n, pointer = self.prepared(references, buffer)
        get, instance, attempt = self.slave.fmi2GetReal, self.slave.component, self.attempt
        return lambda: attempt(get, instance, vrs, n, pointer)

    def writer(self, references, buffer):
        if buffer.dtype == np.int64:
            narrow = np.zeros(len(references), np.int32)
            vrs, n, pointer = self.prepared(references, narrow)

            def write_integers():
                narrow[:] = buffer
                self.attempt(self.slave.fmi2SetInteger, self.slave.component, vrs, n, pointer)

            return write_integers
        vrs, n, pointer = self.prepared(references, buffer)
        put, instance, attempt = self.slave.fmi2SetReal, self.slave.component, self.attempt
        return lambda: attempt(put, instance, vrs, n, pointer)

    def enter_initialisation(self, start_time):
        self.attempt(self.slave.setupExperiment, startTime=start_time)
        self.attempt(self.slave.enterInitializationMode)

    def exit_initialisation(self):
        try:
            self.attempt(self.slave.exitInitializationMode)
        except RunFault as fault:
            raise InputFault(str(fault)) from None

    def step(self, time, duration):
        self.attempt(self.slave.fmi2DoStep, self.slave.component, time, duration, 1)

    def save(self):
        state = self.attempt(self.slave.getFMUstate)
        try:
            return bytes(self.attempt(self.slave.serializeFMUstate, state))
        finally:
            self.slave.freeFMUstate(state)

    def restore(self, state):
        handle = self.attempt(self.slave.deSerializeFMUstate, state)
        try:
            self.attempt(self.slave.setFMUstate, handle)
        finally:
            self.slave.freeFMUstate(handle)

    def stamp(self) -> dict | None:
        """What this project writes into its FMUs; None for an FMU made by others."""
        path = self.folder / "resources" / STAMP
        return json.loads(path.read_text(encoding="utf-8")) if path.exists() else None

    def require_same_sources(self) -> None:
        """This project's editable FMUs share this process's modules: they must be of its sources.

        So must native ones, whose states are read by the tables of those modules.
        """
        stamp = self.stamp()
        if stamp is not None and stamp["source_hash"] != source_hash():
            raise InputFault(f"{self.path} was built from other sources than those installed; run: rvwear build")

    def specification(self) -> dict:
        """What this project's FMU was built from, see fmu_src.unit."""
        stamp = self.stamp()
        if stamp is None:
            raise InputFault(f"{self.path} is not one of this project's FMUs; build them with: rvwear build")
        return stamp["specification"]

    def record(self):
        table = make_unit(self.specification()).table
        records = table.new_records()
        table.cells(records)[: table.state_cells] = unpack(self.identity, self.save(), table.state_cells).cells
        return records

    def close(self):
        with contextlib.suppress(FMICallException):
            # Refused before initialisation; it is freed all the same.
            self.slave.terminate()
        self.slave.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


def signals_of(description) -> dict[str, Signal]:
    """Signals of a model description; ``name[i,j]`` scalars joined to arrays."""
    groups: dict[str, list] = {}
    for v in description.modelVariables:
        if v.type in ("Real", "Integer", "Enumeration") and v.causality != "local":
            groups.setdefault(v.name.partition("[")[0], []).append(v)
    signals = {}
    for base, members in groups.items():
        first = members[0]
        shape: tuple[int, ...] = ()
        if first.name != base:
            shape = tuple(int(i) for i in members[-1].name.partition("[")[2].rstrip("]").split(","))
            if int(np.prod(shape)) != len(members):
                shape = (len(members),)
        signals[base] = Signal(
            base, first.causality, first.unit or "1", tuple(v.valueReference for v in members), shape,
            first.type != "Real", first.variability == "tunable",
            tuple(item.name for item in first.declaredType.items) if first.type == "Enumeration" else (),
        )
    return signals
