"""A unit's complete state as one block of bytes, the same in every flavour of its FMU.

A header (what unit and build, phase, time, checksums), then the record's leading cells.
``shell/state.c`` has the same layout: a state saved by one flavour of an FMU is
restored by another.
"""

import struct
from dataclasses import dataclass

import numpy as np

from fmu_src.arrays import Floats

MAGIC = b"RVstate3"
HEADER = struct.Struct("<8s40sqqqdd")
SUMS = struct.Struct("<QQ")
HEADER_SIZE = HEADER.size + SUMS.size

INSTANTIATED, INITIALISING, STEPPING, TERMINATED = range(4)


class StateFault(ValueError):
    """Bytes that are not a state of the unit."""


@dataclass(frozen=True)
class State:
    cells: Floats
    phase: int
    time: float


def sums(block: bytes) -> bytes:
    """Plain and weighted sum of the words, header and cells each counted from 1."""
    total = weighted = 0
    for part in (block[:HEADER.size] + bytes(SUMS.size), block[HEADER_SIZE:]):
        words = np.frombuffer(part, "<u8")
        total += int(words.sum(dtype="u8"))
        weighted += int((words * np.arange(1, len(words) + 1, dtype="u8")).sum(dtype="u8"))
    return SUMS.pack(total % 2**64, weighted % 2**64)


def pack(identity: str, state: State) -> bytes:
    """The block of a state; ``identity`` is the unit's guid."""
    header = HEADER.pack(MAGIC, identity.encode(), len(state.cells), state.phase, 1, state.time, np.inf)
    block = header + bytes(SUMS.size) + state.cells.tobytes()
    return header + sums(block) + block[HEADER_SIZE:]


def unpack(identity: str, block: bytes, cell_count: int) -> State:
    """The state in a block; StateFault if it is foreign, cut off or damaged."""
    expected = HEADER_SIZE + 8 * cell_count
    if len(block) < HEADER_SIZE or not block.startswith(MAGIC):
        raise StateFault(f"{len(block)} bytes that are not a state of this kind of unit")
    _, stored, cells, phase, _, time, _ = HEADER.unpack_from(block)
    stored = stored.rstrip(b"\0").decode("ascii", "replace")
    if stored != identity:
        raise StateFault(f"the state is of unit {stored}, this is {identity}: it must come from the same build")
    if len(block) != expected or cells != cell_count:
        raise StateFault(f"{len(block)} bytes of a state that has {expected}: it was cut off or added to")
    if sums(block) != block[HEADER.size:HEADER_SIZE]:
        raise StateFault("the state is damaged, its checksum does not fit")
    return State(np.frombuffer(block, "f8", offset=HEADER_SIZE), phase, time)
