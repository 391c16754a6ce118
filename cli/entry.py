"""Where the command ``rvwear`` begins: SIGTERM is heard from the first line to the last.

Loading the commands takes a fifth of a second, and so does Python's own end: a command that is terminated then has done or says nothing
that must be taken away, but ends with the code of one that was terminated, or with its own if that is decided.
"""

import atexit
import contextlib
import gc
import os
import signal
import sys
from types import FrameType

# As in ``ending``, which takes longer to load.
INTERRUPTED, TERMINATED = 130, 143
# Objects between two looks for garbage: libraries make hundreds of thousands that stay, among which looks after every 700, as Python has it, take a
# twentieth of a diagnosis.
MANY_OBJECTS = 50_000


def main() -> int:
    gc.set_threshold(MANY_OBJECTS)
    if os.name == "posix" and signal.getsignal(signal.SIGTERM) is signal.SIG_DFL:
        signal.signal(signal.SIGTERM, end_at_once)
        # The first to be registered is the last to run: Python gives signals back to the system next.
        atexit.register(signal.signal, signal.SIGTERM, signal.SIG_IGN)
    try:
        from cli.main import main as command

        return command()
    except KeyboardInterrupt:
        # Before or after what the command itself hears.
        return INTERRUPTED


def end_at_once(_: int, __: FrameType | None) -> None:
    with contextlib.suppress(Exception):
        sys.stdout.flush()
    os._exit(TERMINATED)
