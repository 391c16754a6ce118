"""How the command ends: exit codes that do not lie, and nothing left behind."""

import os
import select
import signal
import sys
from types import FrameType

INTERRUPTED, TERMINATED = 130, 143


class Terminated(KeyboardInterrupt):
    """SIGTERM: what runs is left as for Ctrl-C, so that it takes away what it has unpacked and lets go of its processes."""


def hear_termination() -> None:
    """SIGTERM raises Terminated; where a signal cannot be heard, nothing changes."""
    try:
        signal.signal(signal.SIGTERM, terminate)
    except ValueError:
        # Not in the first thread: whoever calls the tool as a function has his own signals.
        return


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
