"""Tasks on the screen: bars on a terminal, a line now and then in a pipe or a log; always on stderr."""

import math
import sys
import threading
import time
from functools import cached_property
from typing import TYPE_CHECKING

from fmu_src.progress import Listener, Task, beside_text
from fmu_src.unit_words import unit_on_screen

if TYPE_CHECKING:
    from fmu_src.durations import Durations

# What is over sooner is not spoken of in a pipe, no line follows another sooner, none of the same task [s], and the longer that takes the rarer they get.
SOON, PAUSE, SAME, GROWTH = 0.7, 3.0, 10.0, 0.4
# What is foreseen to take less in all [s] gets no line: it is over when that is read.
SHORT = 2.0


def new_screen(words: list[str]) -> Listener:
    """``words``: the command line, by which durations are remembered."""
    if not sys.stderr.isatty():
        return Remembering(Lines(), words)
    # Drawn only where somebody looks.
    from cli.bars import Bars

    return Remembering(Bars(), words)


class Remembering:
    """A listener that tells tasks how long they took before."""

    def __init__(self, inner: Listener, words: list[str]):
        self.inner, self.words = inner, words

    @cached_property
    def durations(self) -> "Durations":
        from fmu_src.durations import Durations

        return Durations(self.words)

    def begin(self, task: Task) -> None:
        self.durations.begin(task)
        self.inner.begin(task)

    def end(self, task: Task) -> None:
        self.inner.end(task)
        self.durations.end(task)

    def say(self, text: str) -> None:
        self.inner.say(unit_on_screen(text))


class Lines:
    """What is done, how far it is and about how long it still takes: a line for each task that takes long, and further ones now and then."""

    def __init__(self) -> None:
        self.tasks: list[Task] = []
        # When a line was last printed, of each task and at all; tasks of which others are part.
        self.spoken: dict[Task, float] = {}
        self.last = -math.inf
        self.outer: set[Task] = set()
        self.changed = threading.Condition()
        self.teller: threading.Thread | None = None

    def begin(self, task: Task) -> None:
        with self.changed:
            self.outer.update(self.tasks)
            self.tasks.append(task)
            if self.teller is None:
                self.teller = threading.Thread(target=self.tell, daemon=True)
                self.teller.start()

    def end(self, task: Task) -> None:
        with self.changed:
            self.tasks.remove(task)
            self.spoken.pop(task, None)
            self.outer.discard(task)
            self.changed.notify()

    def say(self, text: str) -> None:
        # Python writes a line and its end apart: another may come in between.
        with self.changed:
            print(text, file=sys.stderr, flush=True)

    def tell(self) -> None:
        """Runs beside the work and ends with the last task."""
        while True:
            with self.changed:
                if not self.tasks:
                    self.teller = None
                    return
                # The innermost is what is being done.
                task, now = self.tasks[-1], time.monotonic()
                if self.is_due(task, now):
                    self.spoken[task] = self.last = now
                    print(f"rvwear: {task.sentence()}{beside_text(self.tasks[:-1])}", file=sys.stderr, flush=True)
                self.changed.wait(0.2)

    def is_due(self, task: Task, now: float) -> bool:
        """Whether a line of the innermost task is to be printed."""
        if task in self.spoken:
            return now - self.spoken[task] >= max(SAME, GROWTH * task.passed)
        if task.left is not None and task.passed + task.left < SHORT:
            return False
        # Between two of its parts a task is the innermost for a moment, which is no news.
        return task.passed > SOON and now - self.last >= (SAME if task in self.outer else PAUSE)
