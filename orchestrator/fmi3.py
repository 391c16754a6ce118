"""FMI 3.0 calls: the same face as ``fmi2``, over variables that may be arrays."""

import ctypes
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from fmpy.fmi3 import FMU3Slave

from fmu_src.arrays import Integers
from orchestrator.bound_calls import ERROR, address, bound, bound_step
from orchestrator.component import Snapshot
from orchestrator.model_description import Described

NATIVE = {
    "Float64": "f8", "Float32": "f4", "Boolean": "?", "Enumeration": "i8",
    **{f"{sign}Int{bits}": f"{kind}{bits // 8}" for sign, kind in (("", "i"), ("U", "u")) for bits in (8, 16, 32, 64)},
}  # fmt: skip


@dataclass(frozen=True)
class Block:
    """Whole variables of one type, moved in one call; ``place`` is where they stand in the buffer."""

    kind: str
    numbers: ctypes.Array[ctypes.c_uint]
    values: np.ndarray
    taken: Integers
    place: Integers

    @property
    def is_whole(self) -> bool:
        return self.taken.size == self.values.size


class Fmi3:
    """One instance; where the unit refuses, ``refuse(function, status)`` is to raise."""

    def __init__(
        self, name: str, described: Described, folder: Path, log: Callable[[str], None], refuse: Callable[[str, int], None]
    ):
        description = described.description
        self.slave = FMU3Slave(
            instanceName=name, guid=description.instantiationToken, unzipDirectory=str(folder),
            modelIdentifier=description.coSimulation.modelIdentifier, requireFunctions=False,
        )  # fmt: skip
        self.described, self.log, self.refuse = described, log, refuse
        # What was judged otherwise where the unit returned early from a step.
        self.returns: list[str] = []
        self.keeps_state = not description.coSimulation.canGetAndSetFMUstate

    def instantiate(self) -> None:
        def message(environment: object, status: int, category: bytes, text: bytes) -> None:
            self.log(text.decode("utf-8", "replace").strip())

        self.slave.instantiate(loggingOn=True, logMessage=message, earlyReturnAllowed=True)
        self.judged = self.judgements()
        # event handling needed, terminate, early return (Booleans) and the last successful time.
        self.flags, self.reached = (ctypes.c_bool * 3)(), ctypes.c_double()
        first = ctypes.addressof(self.flags)
        results = [ctypes.c_void_p(place) for place in (first, first + 1, first + 2, ctypes.addressof(self.reached))]
        arguments = (ctypes.c_bool(self.keeps_state), *results)
        self.do_step = bound_step(self.slave.dll, "fmi3DoStep", self.slave.component, arguments, self.refuse)

    def call_on(self, verb: str, block: Block) -> Callable[[], None]:
        function = f"fmi3{verb}{'Int64' if block.kind == 'Enumeration' else block.kind}"
        arguments = (block.numbers, ctypes.c_size_t(len(block.numbers)), address(block.values), ctypes.c_size_t(block.values.size))
        return bound(self.slave.dll, function, self.slave.component, arguments, self.refuse)

    def blocks(self, references: tuple[int, ...], buffer: np.ndarray) -> list[Block]:
        """The variables that the elements belong to, by type; in the buffer itself if they fill it."""
        cells, layout = np.array(references), self.described.cells
        owners = layout.variable_of(cells)
        blocks = []
        for kind in sorted({layout.kind[i] for i in owners}):
            place = np.flatnonzero([layout.kind[i] == kind for i in owners])
            variables = list(dict.fromkeys(owners[place].tolist()))
            start = dict(zip(variables, np.cumsum([0, *layout.size[variables]]).tolist()))
            taken = np.array([start[i] + cells[k] - layout.first[i] for i, k in zip(owners[place].tolist(), place)])
            size = int(layout.size[variables].sum())
            fills = size == buffer.size and buffer.dtype == NATIVE[kind] and np.array_equal(taken, np.arange(size))
            numbers = (ctypes.c_uint * len(variables))(*layout.value_reference[variables].tolist())
            blocks.append(Block(kind, numbers, buffer if fills else np.zeros(size, NATIVE[kind]), taken, place))
        return blocks

    def reader(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        blocks = self.blocks(references, buffer)
        calls = [self.call_on("Get", block) for block in blocks]
        if len(blocks) == 1 and blocks[0].values is buffer:
            return calls[0]

        def read() -> None:
            for call, block in zip(calls, blocks):
                call()
                buffer[block.place] = block.values[block.taken]

        return read

    def writer(self, references: tuple[int, ...], buffer: np.ndarray) -> Callable[[], None]:
        blocks = self.blocks(references, buffer)
        calls = [self.call_on("Set", block) for block in blocks]
        if len(blocks) == 1 and blocks[0].values is buffer:
            return calls[0]
        # FMI sets arrays as a whole: elements that are not written keep what they hold.
        present = [None if block.is_whole else self.call_on("Get", block) for block in blocks]

        def write() -> None:
            for get, put, block in zip(present, calls, blocks):
                if get is not None:
                    get()
                block.values[block.taken] = buffer[block.place]
                put()

        return write

    def set_text(self, reference: int, text: str) -> None:
        self.slave.setString([reference], [text])

    def enter_initialisation(self, start_time: float) -> None:
        self.slave.enterInitializationMode(startTime=start_time)

    def exit_initialisation(self) -> None:
        self.slave.exitInitializationMode()
        for _, _, _, read in self.judged:
            read()

    def step(self, time: float, duration: float) -> None:
        self.do_step(time, duration)
        if self.flags[1]:
            self.log(f"the unit asked to end the simulation at time {self.reached.value:.9g} s")
            self.refuse("fmi3DoStep", ERROR)
        if self.flags[2]:
            self.go_on(time, duration)

    def go_on(self, time: float, duration: float) -> None:
        """The rest of a step from which the unit returned early, to say what it judges otherwise."""
        done = self.reached.value - time
        if not 0.0 < done <= duration:
            self.log(f"the unit returned early from its step at time {self.reached.value:.9g} s, which does not lie in the step")
            self.refuse("fmi3DoStep", ERROR)
        for name, choices, buffer, read in self.judged:
            before = int(buffer[0])
            read()
            if buffer[0] != before:
                self.returns.append(f"{name} became {choices[int(buffer[0])]} at time {self.reached.value:.9g} s (was {choices[before]})")
        if done < duration:
            self.step(self.reached.value, duration - done)

    def judgements(self) -> list[tuple[str, tuple[str, ...], np.ndarray, Callable[[], None]]]:
        """Outputs that are choices, of a unit that may return early from a step when they change: as last read, and their readers."""
        if not self.described.description.coSimulation.mightReturnEarlyFromDoStep:
            return []
        chosen = [s for s in self.described.signals().values() if s.causality == "output" and s.choices and not s.shape]
        buffers = [s.new_buffer() for s in chosen]
        return [(s.name, s.choices, b, self.reader(s.references, b)) for s, b in zip(chosen, buffers)]

    def snapshot(self) -> Snapshot:
        return self.slave.getFMUState()

    def revert(self, snapshot: Snapshot) -> None:
        self.slave.setFMUState(snapshot)

    def forget(self, snapshot: Snapshot) -> None:
        self.slave.freeFMUState(snapshot)

    def serialise(self, snapshot: Snapshot) -> bytes:
        return bytes(self.slave.serializeFMUState(snapshot))

    def deserialise(self, state: bytes) -> Snapshot:
        return self.slave.deserializeFMUState(state)
