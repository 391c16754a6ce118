"""How the command ends: exit codes that do not lie, and nothing left behind."""

import os
import select
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from types import FrameType

INTERRUPTED, TERMINATED = 130, 143
# How long what runs may take to be left [s].
GRACE = 5.0
# How long after it was lost an interruption is asked for once more [s].
AGAIN = 0.01


class Terminated(KeyboardInterrupt):
    """SIGTERM: what runs is left as for Ctrl-C, so that it takes away what it has unpacked and lets go of its processes."""


@contextmanager
def termination_heard() -> Iterator[None]:
    """SIGTERM raises Terminated in the block; where a signal cannot be heard, nothing changes."""
    if os.name != "posix" or threading.current_thread() is not threading.main_thread():
        yield
        return
    before, told_before = signal.signal(signal.SIGTERM, terminate), sys.unraisablehook
    sys.unraisablehook = partial(ask_again, told_before)
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    woken = signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    threading.Thread(target=insist, args=(reader,), name="rvwear ending", daemon=True).start()
    try:
        yield
    finally:
        signal.set_wakeup_fd(woken)
        signal.signal(signal.SIGTERM, before)
        sys.unraisablehook = told_before
        # The thread ends with it.
        os.close(writer)


def ask_again(told: Callable[["sys.UnraisableHookArgs"], object], lost: "sys.UnraisableHookArgs") -> None:
    """Where Python lets nothing be raised (a weak reference's callback, __del__), an interruption is lost: it is asked for once more.

    Such callbacks belong to imports and to memory that is given back; both come at any time.
    """
    if not isinstance(lost.exc_value, KeyboardInterrupt):
        told(lost)
        return
    asked = signal.SIGTERM if isinstance(lost.exc_value, Terminated) else signal.SIGINT
    again = threading.Timer(AGAIN, signal.pthread_kill, (threading.main_thread().ident, asked))
    again.daemon = True
    again.start()


def insist(signals: int) -> None:
    """Ends a process that does not come to hear SIGTERM: one that hangs in a unit's own code."""
    with os.fdopen(signals, "rb", buffering=0) as stream:
        while heard := stream.read(1):
            # In time, the block ends, and with it the stream.
            if heard[0] == signal.SIGTERM and not select.select([stream], [], [], GRACE)[0]:
                os._exit(TERMINATED)


def terminate(_: int, __: FrameType | None) -> None:
    raise Terminated


def exit_code(interruption: BaseException | None) -> int:
    """By what came first: others may have said more of it on the way."""
    while interruption is not None:
        if isinstance(interruption, Terminated):
            return TERMINATED
        interruption = interruption.__cause__ or interruption.__context__
    return INTERRUPTED


def reader_is_gone() -> bool:
    """Whether nobody reads what this process prints any more (rvwear ... | head)."""
    try:
        sys.stdout.flush()
        if hasattr(select, "poll"):
            asked = select.poll()
            asked.register(sys.stdout.fileno(), 0)
            return any(event & (select.POLLERR | select.POLLHUP) for _, event in asked.poll(0))
    except BrokenPipeError:
        return True
    except (OSError, ValueError):
        # Standard output is closed, or none of the system's files.
        return False
    return False


def silence() -> None:
    """Keeps Python from complaining at exit of what it could not print."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
