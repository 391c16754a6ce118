"""Reading foreign files of binary formats in a process of their own.

The libraries made for these formats trust them: a damaged file makes some crash, loop or ask for all memory there is.  Here that ends the
reading of this file and nothing else.  One process reads all files, one after the other; it begins with the first.
"""

import atexit
import contextlib
import importlib
import signal
import sys
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from typing import IO, Any

import numpy as np

from fmu_src.child_process import Watch, end, open_streams, started, streams
from fmu_src.faults import InputFault
from fmu_src.framing import FrameFault, read, write
from fmu_src.reading import reading

# What the reading of a file may take: seconds of one core and bytes, and more of both for each byte of it (assumed).
SECONDS, SECONDS_PER_BYTE = 9.0, 1e-6
MEMORY, MEMORY_PER_BYTE = 900_000_000, 20
# Where it waits instead of computing, and until the process is there, it may take this many times longer, and [s].
PATIENCE, START = 10.0, 120.0
# What stands before the entries of a column of texts.
TEXTS = "a column of texts"


class FarReader:
    """The process that reads."""

    def __init__(self) -> None:
        self.process, lifeline = started("fmu_src.reading_apart:main")
        self.watch = Watch(self.process, SECONDS)
        self.requests, self.answers = streams(self.process)
        self.is_over, self.lifeline = False, lifeline

    def ask(self, request: tuple[object, ...], seconds: float) -> Any:
        self.watch.until = time.monotonic() + START + PATIENCE * seconds
        try:
            write(self.requests, request)
            return read(self.answers)
        finally:
            self.watch.until = float("inf")

    def close(self) -> None:
        if not self.is_over:
            self.is_over = True
            end(self.process, self.watch, self.lifeline, 1.0)


_lock = threading.Lock()
_reader: FarReader | None = None


def read_apart(function: str, path: Path, *arguments: object, seconds_per_byte: float = SECONDS_PER_BYTE) -> Any:
    """What ``function`` ("module:name") makes of the path and the arguments, all of it data; its InputFault or ModuleNotFoundError.

    InputFault too if it crashes, takes too long, or asks for more memory than a file of this size should need.
    """
    size = path.stat().st_size
    seconds = SECONDS + seconds_per_byte * size
    with _lock:
        reader = far_reader()
        try:
            outcome, found = reader.ask((function, str(path.resolve()), arguments, seconds, MEMORY + MEMORY_PER_BYTE * size), seconds)
        except (EOFError, OSError, FrameFault, ValueError, TypeError):
            close()
            raise InputFault(f"{path}: the library that reads it {end_of(reader, seconds)}: the file is damaged, or of another format; get it anew") from None
    if outcome == "missing":
        raise ModuleNotFoundError(f"No module named {found!r}", name=str(found))
    if outcome != "done":
        raise InputFault(str(found).replace(str(path.resolve()), str(path)))
    return found


def end_of(reader: FarReader, seconds: float) -> str:
    code = reader.process.returncode
    if reader.watch.has_ended_it or code == -getattr(signal, "SIGPROF", 0):
        return f"took longer than {seconds:.3g} s"
    if code is not None and code < 0:
        return f"crashed with signal {-code} ({signal.Signals(-code).name})"
    return f"ended with exit code {code}"


def far_reader() -> FarReader:
    global _reader  # noqa: PLW0603
    if _reader is None:
        _reader = FarReader()
        atexit.register(close)
    return _reader


def close() -> None:
    """Ends the process, if there is one; the next file begins another."""
    global _reader  # noqa: PLW0603
    if _reader is not None:
        atexit.unregister(close)
        _reader.close()
        _reader = None


def plain(value: Any) -> Any:
    """Columns of texts as lists: they have no numbers that could go as they are."""
    if isinstance(value, Mapping):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray) and value.dtype.kind == "O":
        return [TEXTS, *(item if item is None or isinstance(item, (str, float, int)) else str(item) for item in value.ravel().tolist())]
    return np.ascontiguousarray(value) if isinstance(value, np.ndarray) else value


def restored(value: Any) -> Any:
    """What ``plain`` was given."""
    if isinstance(value, dict):
        return {key: restored(item) for key, item in value.items()}
    if isinstance(value, tuple) and value and isinstance(value[0], str) and value[0] == TEXTS:
        return np.array([*value[1:], None], object)[:-1]
    return tuple(restored(item) for item in value) if isinstance(value, tuple) else value


def main(lifeline: str) -> None:
    """Read what is asked for until nobody asks any more."""
    requests, answers = open_streams(lifeline)
    while True:
        try:
            function, path, arguments, seconds, memory = read(requests)
        except EOFError:
            return
        serve(answers, function, Path(path), arguments, seconds, memory)


def serve(answers: IO[bytes], function: str, path: Path, arguments: tuple[object, ...], seconds: float, memory: int) -> None:
    try:
        with reading(path, "such a file"):
            module, _, name = function.partition(":")
            # Before it counts: the library takes for itself what it takes.
            called = getattr(importlib.import_module(module), name)
            with limited(seconds, memory):
                found = plain(called(path, *arguments))
        answer = ("done", found)
    except InputFault as fault:
        answer = ("fault", str(fault))
    except ModuleNotFoundError as missing:
        answer = ("missing", missing.name or "")
    write(answers, answer)


@contextlib.contextmanager
def limited(seconds: float, memory: int) -> Any:
    """Seconds of one core and bytes of memory for what is done in the block, where the system can limit them."""
    if sys.platform == "win32":
        yield
        return
    import resource

    unlimited = resource.getrlimit(resource.RLIMIT_AS)
    if sys.platform == "linux":
        now = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
        resource.setrlimit(resource.RLIMIT_AS, (now + memory, unlimited[1]))
    # What it does to a process that does not hear it: it ends it, in the middle of a library too.
    signal.setitimer(signal.ITIMER_PROF, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        resource.setrlimit(resource.RLIMIT_AS, unlimited)
