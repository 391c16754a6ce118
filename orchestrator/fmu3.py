"""An FMI 3.0 co-simulation FMU as a component.

FMI 3.0 refers to whole arrays.  The master refers to elements, so every element has a
number here: those of one variable follow each other.
"""

import ctypes
from itertools import groupby

import numpy as np
from fmpy.fmi3 import FMU3Slave, fmi3Float64, fmi3Int64, fmi3ValueReference

from orchestrator.component import Signal
from orchestrator.fmu import Fmu

KINDS = {"Float64": fmi3Float64, "Int64": fmi3Int64, "Enumeration": fmi3Int64}


class Fmu3(Fmu):
    """One instance of an FMI 3.0 FMU; variables of other types than ``KINDS`` stay unseen."""

    version = "3.0"

    @property
    def identity(self):
        return self.description.instantiationToken

    def load(self, **named):
        return FMU3Slave(**named)

    def find_signals(self):
        signals, self.elements = {}, []
        for v in self.description.modelVariables:
            if v.type not in KINDS or v.causality == "independent":
                continue
            size = int(np.prod(v.shape or (), dtype=int))
            references = tuple(range(len(self.elements), len(self.elements) + size))
            self.elements += [(v.valueReference, size, i) for i in range(size)]
            signals[v.name] = Signal(
                v.name, v.causality, v.unit or "1", references, tuple(v.shape or ()), v.type != "Float64",
                v.variability == "tunable", tuple(i.name for i in v.declaredType.items) if v.type == "Enumeration" else (),
            )
        return signals

    def instantiate(self):
        def log(environment, status, category, message):
            self.messages.append(message.decode("utf-8", "replace").strip())

        self.slave.instantiate(loggingOn=True, logMessage=log)

    def whole(self, references, buffer):
        """(place of the elements among the variables' values, arguments of fmpy's raw functions, their values)."""
        chosen = [self.elements[r] for r in references]
        variables = [(vr, size) for (vr, size), _ in groupby(chosen, key=lambda element: element[:2])]
        first, place = 0, []
        for (_, size), members in zip(variables, (list(m) for _, m in groupby(chosen, key=lambda element: element[0]))):
            place += [first + element for _, _, element in members]
            first += size
        index = np.array(place)
        values = buffer if np.array_equal(index, np.arange(first)) else np.zeros(first, buffer.dtype)
        kind = fmi3Int64 if buffer.dtype == np.int64 else fmi3Float64
        vrs = (fmi3ValueReference * len(variables))(*(vr for vr, _ in variables))
        pointer = values.ctypes.data_as(ctypes.POINTER(kind))
        return index, (self.slave.component, vrs, len(variables), pointer, first), values

    def reader(self, references, buffer):
        index, arguments, values = self.whole(references, buffer)
        get, attempt = self.slave.fmi3GetInt64 if buffer.dtype == np.int64 else self.slave.fmi3GetFloat64, self.attempt
        if values is buffer:
            return lambda: attempt(get, *arguments)

        def read():
            attempt(get, *arguments)
            np.take(values, index, out=buffer)

        return read

    def writer(self, references, buffer):
        index, arguments, values = self.whole(references, buffer)
        integers, attempt = buffer.dtype == np.int64, self.attempt
        get = self.slave.fmi3GetInt64 if integers else self.slave.fmi3GetFloat64
        put = self.slave.fmi3SetInt64 if integers else self.slave.fmi3SetFloat64
        if values is buffer:
            return lambda: attempt(put, *arguments)

        def write():
            # The other elements keep their values.
            attempt(get, *arguments)
            values[index] = buffer
            attempt(put, *arguments)

        return write

    def enter_initialisation(self, start_time):
        self.attempt(self.slave.enterInitializationMode, startTime=start_time)

    def step(self, time, duration):
        self.attempt(self.slave.doStep, time, duration)

    def save(self):
        state = self.attempt(self.slave.getFMUState)
        try:
            return bytes(self.attempt(self.slave.serializeFMUState, state))
        finally:
            self.slave.freeFMUState(state)

    def restore(self, state):
        handle = self.attempt(self.slave.deserializeFMUState, state)
        try:
            self.attempt(self.slave.setFMUState, handle)
        finally:
            self.slave.freeFMUState(handle)
