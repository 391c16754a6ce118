"""What takes a while, told to whoever listens; without a listener nothing happens.

The command line listens (``cli.progress``).  What computes says ``with task("equilibria", total=72) as
turning`` and ``turning.advance()`` at each step, and need not know who looks.
"""

import math
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Protocol

# Until then nobody wonders how long it has been going on [s].
SOON = 3.0
# Steps differ in cost: the pace of less than this share of them, in less than so many seconds, tells nothing of the others.
FEW, LONG = 0.1, 60.0
# "About" so many seconds is as much again as this share, and a second, at most.
ABOUT = 0.25


@dataclass(eq=False)
class Task:
    """``total`` steps if they can be counted; ``about`` seconds if it is known how long it takes; ``before`` if it is known from the last time.

    ``what`` may go on to name the step that is being taken; ``name`` stays.
    """

    what: str
    total: int | None = None
    about: float | None = None
    done: int = 0
    # Seconds that it took the last time, if somebody remembers.
    before: float | None = None
    # What took so long, where that was another command than this one.
    like: str = ""
    begun: float = field(default_factory=time.monotonic)
    # Whether something ended it before its time.
    broken: bool = False
    # Seconds from its beginning between which it is to end, where that can be foretold.
    foretold: tuple[float, float] | None = None
    # Whether it is what is waited for: what is left of it is told beside its steps.
    whole: bool = False
    # What is said of what follows as long as nobody knows how long it takes.
    then: str = ""
    # Seconds from its beginning at which it ends, as was told so far: never put off.
    told: float = math.inf

    def __post_init__(self) -> None:
        self.name = self.what

    def advance(self, steps: int = 1) -> None:
        self.done += steps

    def foretell(self, low: float, high: float, more: bool = False) -> None:
        """From now on it takes between so many seconds; an end that was told is put off only where ``more`` is to be done than was known then."""
        low, high = self.passed + low, self.passed + high
        if self.foretold and not more:
            low, high = min(low, self.foretold[1]), min(high, self.foretold[1])
        self.foretold = low, high

    @property
    def span(self) -> str:
        """What is left in words, as it was foretold; empty where it was not, has turned out to be wrong, or agrees with the last time, which says it closer."""
        if self.foretold is None or self.overdue:
            return ""
        text = between(*(max(0.0, end - self.passed) for end in self.foretold))
        if self.before is None or not self.foretold[0] < self.before < self.foretold[1]:
            return text
        return "" if self.before > self.passed else f"longer than the last time, {text}"

    @property
    def overdue(self) -> bool:
        """Whether it takes longer than was told."""
        return self.passed > (self.told if self.foretold is None else self.foretold[1])

    @property
    def passed(self) -> float:
        """Seconds since its beginning."""
        return time.monotonic() - self.begun

    @property
    def left(self) -> float | None:
        """Seconds that it will still take, at the pace so far and, the fewer steps are done, as the last time; None if nobody knows.

        A guess of this moment, which rises while a dear step is taken: what is told of it is ``tell_left``.
        """
        if self.total and self.done:
            done = self.done / self.total
            at_pace = self.passed * (1.0 - done) / done
            if self.before is not None:
                return done * at_pace + (1.0 - done) * max(0.0, self.before - self.passed)
            return at_pace if done >= FEW or self.passed > LONG else None
        if self.about is not None:
            return max(0.0, self.about - self.passed)
        if self.foretold is not None and self.overdue:
            return None
        # What takes longer than the last time tells nothing of when it ends.
        return self.before - self.passed if self.before is not None and self.before > self.passed else None

    def tell_left(self) -> str:
        """``about 4 s``, and never later than was told before: ``at least`` as much where it takes longer, nothing once that is over or where nobody knows."""
        left, passed = self.left, self.passed
        if left is None:
            return ""
        self.told = min(self.told, passed + left)
        still = self.told - passed
        if still <= 0.0 < left:
            return ""
        return f"{'about' if left <= (1.0 + ABOUT) * still + 1.0 else 'at least'} {duration(still)}"

    def sentence(self) -> str:
        """``equilibria: 30 of 72, about 4 s left``."""
        count = f": {self.done} of {self.total}" if self.total else ""
        if self.total and self.done >= self.total:
            return f"{self.what}{count}"
        if self.span:
            return f"{self.what}{count}, {self.span} left"
        if not (left := self.tell_left()):
            longer = ", longer than foretold" if self.overdue else ""
            return f"{self.what}{count}" + (f", for {duration(self.passed)} now{longer}" if self.passed > SOON else "")
        guessed = f" if it takes as long as {self.like}" if self.like and not self.done and self.about is None else ""
        return f"{self.what}{count}, {left} left{guessed}"


def duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{max(1.0, seconds):.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"


def between(low: float, high: float) -> str:
    """A range [s] as roughly as it is known: ``2 to 6 min``, ``up to 40 s``."""
    step, unit = (60.0, "min") if high >= 90.0 else (5.0, "s")
    size = 1 if unit == "min" else 5
    first, last = size * round(low / step), size * max(1, round(high / step))
    return f"about {last} {unit}" if first == last else f"{first} to {last} {unit}" if first else f"up to {last} {unit}"


def left_in_all(outer: Sequence[Task]) -> str:
    """What is left of the whole, of tasks that others are part of, in words; empty where that is not known."""
    if foretold := next((task.span for task in outer if task.span), ""):
        return foretold
    return next((task.tell_left() for task in outer if task.whole), "")


def beside_text(outer: Sequence[Task]) -> str:
    """Behind the sentence of a part: what is left of the whole, or what follows where that is not known."""
    if whole := left_in_all(outer):
        return f"; in all {whole} left"
    if any(task.foretold and task.overdue for task in outer):
        return "; the whole takes longer than foretold"
    then = next((task.then for task in outer if task.then), "")
    return f"; {then}" if then else ""


class Listener(Protocol):
    def begin(self, task: Task) -> None: ...

    def end(self, task: Task) -> None: ...

    def say(self, text: str) -> None: ...


_listeners: list[Listener] = []
# Tasks that are being done, the innermost last.
_running: list[Task] = []


@contextmanager
def told_to(listener: Listener) -> Iterator[None]:
    """Whatever is done inside is told to the listener."""
    _listeners.append(listener)
    try:
        yield
    finally:
        _listeners.remove(listener)


@contextmanager
def task(what: str, total: int | None = None, about: float | None = None, whole: bool = False) -> Iterator[Task]:
    """Something that may take a while."""
    begun = Task(what, total, about, whole=whole)
    heard = list(_listeners)
    _running.append(begun)
    for listener in heard:
        listener.begin(begun)
    try:
        yield begun
    except BaseException:
        begun.broken = True
        raise
    finally:
        _running.remove(begun)
        for listener in heard:
            listener.end(begun)


def running(name: str) -> Task | None:
    """The innermost task of that name that is being done."""
    return next((known for known in reversed(list(_running)) if known.name == name), None)


def say(text: str) -> None:
    """A line that stays: a result on the way."""
    for listener in _listeners:
        listener.say(text)
