"""Messages between processes as data: texts, numbers, bytes, lists and tables of these, arrays of numbers, times and texts.

Nothing that is read can do anything: a message is either one of these or a FrameFault.  A frame is its length (8 bytes) and the value: a
sign for its kind, then its content, little-endian.
"""

import re
import struct
from typing import IO, Any

import numpy as np

LENGTH = struct.Struct("<Q")
INTEGER, REAL = struct.Struct("<q"), struct.Struct("<d")
# Bytes of a message and how deep its lists may be (assumed: the largest state that is known takes a hundredth).
MOST, DEEPEST = 4_000_000_000, 12
NUMBERS = "fiubcmMSU"
KIND = re.compile(rf"[<>|=]?[{NUMBERS}][0-9]{{0,9}}(\[[0-9]{{0,9}}[a-zA-Z]{{1,2}}\])?")


class FrameFault(ValueError):
    """Bytes that are no message."""


def encode(value: object) -> bytes:
    """ValueError for what is no data."""
    parts: list[bytes] = []
    put(value, parts)
    return b"".join(parts)


def put(value: object, parts: list[bytes]) -> None:
    if value is None or isinstance(value, (bool, np.bool_)):
        parts.append(b"N" if value is None else b"T" if value else b"F")
    elif isinstance(value, (int, np.integer)):
        parts.append(b"i" + INTEGER.pack(value))
    elif isinstance(value, (float, np.floating)):
        parts.append(b"d" + REAL.pack(value))
    elif isinstance(value, (str, bytes)):
        content = value.encode("utf-8", "surrogatepass") if isinstance(value, str) else value
        parts += [b"s" if isinstance(value, str) else b"b", LENGTH.pack(len(content)), content]
    elif isinstance(value, np.ndarray) and value.dtype.kind in NUMBERS:
        put(value.dtype.str, parts)
        parts[-3] = b"a"
        put(value.shape, parts)
        put(value.tobytes(), parts)
    elif isinstance(value, (tuple, list)):
        parts.append(b"l" + LENGTH.pack(len(value)))
        for item in value:
            put(item, parts)
    elif isinstance(value, dict):
        parts.append(b"m" + LENGTH.pack(len(value)))
        for key, item in value.items():
            put(key, parts)
            put(item, parts)
    else:
        raise ValueError(f"a {type(value).__name__} is no data")


def decode(data: bytes) -> Any:
    """The value that was encoded; lists come as tuples.  FrameFault if the bytes are none."""
    reader = Reader(data)
    try:
        value = reader.take(0)
    except (struct.error, UnicodeDecodeError, ValueError, TypeError) as problem:
        raise FrameFault(str(problem)) from None
    if reader.place != len(data):
        raise FrameFault(f"{len(data) - reader.place} bytes too many")
    return value


class Reader:
    """Takes values from bytes, one behind the other."""

    def __init__(self, data: bytes):
        self.data, self.place = data, 0

    def next(self, count: int) -> bytes:
        if count > len(self.data) - self.place:
            raise FrameFault("cut off")
        self.place += count
        return self.data[self.place - count : self.place]

    def length(self) -> int:
        size: int = LENGTH.unpack(self.next(LENGTH.size))[0]
        return size

    def take(self, depth: int) -> Any:
        if depth > DEEPEST:
            raise FrameFault("nested too deeply")
        kind = self.next(1)
        match kind:
            case b"N" | b"T" | b"F":
                return {b"N": None, b"T": True, b"F": False}[kind]
            case b"i":
                return INTEGER.unpack(self.next(8))[0]
            case b"d":
                return REAL.unpack(self.next(8))[0]
            case b"s":
                return self.next(self.length()).decode("utf-8", "surrogatepass")
            case b"b":
                return self.next(self.length())
            case b"l":
                # Every item takes a byte at least: a list is no longer than what is left.
                return tuple(self.take(depth + 1) for _ in range(self.count()))
            case b"m":
                return {self.take(depth + 1): self.take(depth + 1) for _ in range(self.count())}
            case b"a":
                return self.array(depth)
        raise FrameFault(f"no kind of value: {kind!r}")

    def count(self) -> int:
        count = self.length()
        if count > len(self.data) - self.place:
            raise FrameFault("cut off")
        return count

    def array(self, depth: int) -> np.ndarray:
        kind = self.next(self.length()).decode("ascii")
        # As NumPy writes them; it would take other texts for fields of a structure and evaluate them.
        if not KIND.fullmatch(kind):
            raise FrameFault(f"an array of {kind[:20]!r}")
        dtype = np.dtype(kind)
        shape, content = self.take(depth + 1), self.take(depth + 1)
        if not isinstance(content, bytes):
            raise FrameFault(f"an array of {dtype} without its numbers")
        return np.frombuffer(content, dtype).reshape(shape).copy()


def write(stream: IO[bytes], value: object) -> None:
    data = encode(value)
    stream.write(LENGTH.pack(len(data)) + data)
    stream.flush()


def read(stream: IO[bytes]) -> Any:
    """EOFError at the end, FrameFault for what is no message."""
    head = stream.read(LENGTH.size)
    if len(head) < LENGTH.size:
        raise EOFError
    size: int = LENGTH.unpack(head)[0]
    if size > MOST:
        raise FrameFault(f"a message of {size} bytes")
    data = stream.read(size)
    if len(data) < size:
        raise EOFError
    return decode(data)
