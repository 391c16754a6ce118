"""What takes a while, told to whoever listens; without a listener nothing happens.

The command line listens (``cli.progress``).  What computes says ``with task("equilibria", total=72) as
advance`` and calls ``advance()`` at each step, and need not know who looks.
"""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Protocol


@dataclass(eq=False)
class Task:
    """``total`` steps if they can be counted; ``about`` seconds if it is known how long it takes."""

    what: str
    total: int | None = None
    about: float | None = None
    done: int = 0
    begun: float = field(default_factory=time.monotonic)

    def advance(self, steps: int = 1) -> None:
        self.done += steps

    @property
    def passed(self) -> float:
        """Seconds since its beginning."""
        return time.monotonic() - self.begun

    @property
    def left(self) -> float | None:
        """Seconds that it will still take, at the pace so far; None if nobody knows."""
        if self.total and self.done:
            return self.passed * (self.total - self.done) / self.done
        return None if self.about is None else max(0.0, self.about - self.passed)


class Listener(Protocol):
    def begin(self, task: Task) -> None: ...

    def end(self, task: Task) -> None: ...


_listeners: list[Listener] = []


@contextmanager
def told_to(listener: Listener) -> Iterator[None]:
    """Whatever is done inside is told to the listener."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


@contextmanager
def task(what: str, total: int | None = None, about: float | None = None) -> Iterator[Callable[..., None]]:
    """Something that may take a while; gives the function that counts its steps."""
    begun = Task(what, total, about)
    heard = list(_listeners)
    for listener in heard:
        listener.begin(begun)
    try:
        yield begun.advance
    finally:
        for listener in heard:
            listener.end(begun)
