"""Processes that work for this one: they never outlive it, and end when they take too long or when nobody needs them any more.

They talk through their standard input and output, a request and an answer at a time, both data (``framing``); what they print goes to
standard error.
"""

import contextlib
import math
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import IO, Any

# How often the clock is looked at [s], and how much of a limit may pass in between.
PAUSE, SHARE = 0.25, 0.1


@contextmanager
def interrupts_later() -> Iterator[None]:
    """Ctrl-C waits meanwhile: a terminal sends it to all processes, and it is for the first to hear.

    A process that begins here never hears it (where it inherits that, not on Windows).
    """
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def command_of(main: str, path: Sequence[str], *arguments: str) -> list[str]:
    """What calls ``main`` ("module:function") with the arguments in another Python that finds its modules along ``path`` and nowhere else:
    a folder named like a module where somebody happens to stand is none."""
    module, _, function = main.partition(":")
    text = f"import ast, sys; sys.path[:] = ast.literal_eval(sys.argv[1]); from {module} import {function}; {function}(*sys.argv[2:])"
    return [sys.executable, "-P", "-c", text, repr(list(path)), *arguments]


def started(main: str, *arguments: str, environment: dict[str, str] | None = None) -> tuple["subprocess.Popen[bytes]", int]:
    """A process that calls ``main`` ("module:function") with the arguments and a handle for ``end_with_master``; and what ends it when it is closed
    (-1 where the system has no such thing)."""
    held = passed = -1
    more: dict[str, Any] = {}
    if os.name == "posix":
        passed, held = os.pipe()
        # A group of its own: it is ended with all that it started.
        more = {"pass_fds": (passed,), "process_group": 0}
    try:
        with interrupts_later():
            process = subprocess.Popen(
                command_of(main, sys.path, *arguments, str(passed)),
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=os.environ | (environment or {}), **more,
            )  # fmt: skip
    finally:
        if passed >= 0:
            os.close(passed)
    return process, held


def streams(process: "subprocess.Popen[bytes]") -> tuple[IO[bytes], IO[bytes]]:
    """To where requests go and from where answers come."""
    assert process.stdin is not None and process.stdout is not None
    return process.stdin, process.stdout


class Watch:
    """Ends a process that takes too long.  A thread looks at the clock, so that setting a limit costs nothing."""

    def __init__(self, process: "subprocess.Popen[bytes]", least: float):
        self.process = process
        self.pause = min(PAUSE, SHARE * least)
        self.until = math.inf
        self.has_ended_it = self.is_over = False
        threading.Thread(target=self.look, name="rvwear limits", daemon=True).start()

    def look(self) -> None:
        while not self.is_over:
            time.sleep(self.pause)
            if time.monotonic() > self.until and not self.is_over:
                self.has_ended_it = True
                self.process.kill()
                return


def end(process: "subprocess.Popen[bytes]", watch: Watch, lifeline: int, seconds: float) -> None:
    """Let go of a process: it ends when it comes to read, and is killed if it does not come to that."""
    watch.is_over = True
    requests, answers = streams(process)
    # What was not sent to a process that crashed cannot be sent any more.
    with contextlib.suppress(OSError):
        requests.close()
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    answers.close()
    if lifeline >= 0:
        os.close(lifeline)


# In the process itself


def open_streams(lifeline: str) -> tuple[IO[bytes], IO[bytes]]:
    """From where requests come and where answers go; what is printed goes to standard error.  Ctrl-C is for the master to hear."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if int(lifeline) >= 0:
        end_with_master(int(lifeline))
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return sys.stdin.buffer, answers


def end_with_master(lifeline: int) -> None:
    """The master holds the other end of this pipe and never writes: its end is the end of this process and of all that it started.

    The kernel sees to it where it can (Linux), whatever this process is doing; elsewhere a thread does, as far as it is let run.
    """
    if sys.platform == "linux":
        import fcntl

        fcntl.fcntl(lifeline, fcntl.F_SETOWN, -os.getpgrp())
        fcntl.fcntl(lifeline, fcntl.F_SETSIG, signal.SIGKILL)
        fcntl.fcntl(lifeline, fcntl.F_SETFL, fcntl.fcntl(lifeline, fcntl.F_GETFL) | os.O_ASYNC)

    def wait() -> None:
        while os.read(lifeline, 1):
            pass
        os._exit(1)

    # Also where the master was gone before the kernel was asked.
    threading.Thread(target=wait, daemon=True).start()
