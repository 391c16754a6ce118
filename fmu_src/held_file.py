"""Places where two processes must not write at once: who holds one is said to the others."""

import contextlib
import os
import socket
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from fmu_src.checked_file import write_fault
from fmu_src.faults import InputFault


@contextlib.contextmanager
def held(place: Path) -> Iterator[None]:
    """Nobody else holds ``place`` meanwhile; InputFault says who does.  A process that is gone holds nothing."""
    lock = place.with_name(f".{place.name}.lock")
    try:
        lock.parent.mkdir(parents=True, exist_ok=True)
        handle = acquired(lock, place)
    except OSError as problem:
        raise write_fault(place, problem) from None
    try:
        yield
    finally:
        # Removed while it is held: whoever waits for it finds that it is gone, and makes a new one.
        with contextlib.suppress(OSError):
            lock.unlink()
        os.close(handle)


def acquired(lock: Path, place: Path) -> int:
    while True:
        handle = os.open(lock, os.O_RDWR | os.O_CREAT, 0o666)
        try:
            if not locked(handle):
                who = os.read(handle, 1000).decode("utf-8", "replace").strip() or "another process"
                raise InputFault(f"{place} is in the hands of {who}: wait for it, end it, or give another output")
            if os.name != "posix" or is_still(handle, lock):
                os.ftruncate(handle, 0)
                started = time.strftime("%Y-%m-%d %H:%M:%S")
                os.write(handle, f"process {os.getpid()} on {socket.gethostname()} ({command()}), since {started}\n".encode())
                return handle
        except BaseException:
            os.close(handle)
            raise
        os.close(handle)


def locked(handle: int) -> bool:
    """Whether the file is ours now; a file system without locks keeps nobody out."""
    if sys.platform == "win32":
        import msvcrt

        # Far behind the end: what stands in the file stays readable.
        os.lseek(handle, 1 << 30, os.SEEK_SET)
        try:
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        finally:
            os.lseek(handle, 0, os.SEEK_SET)
        return True
    import fcntl

    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    except OSError:
        return True
    return True


def is_still(handle: int, lock: Path) -> bool:
    """Whether the file that was locked is the one of this name, and not one that was removed meanwhile."""
    try:
        return os.path.samestat(os.fstat(handle), lock.stat())
    except FileNotFoundError:
        return False


def command() -> str:
    words = " ".join([Path(sys.argv[0]).name if sys.argv else "", *sys.argv[1:]])
    return words if len(words) < 200 else words[:200] + " ..."
