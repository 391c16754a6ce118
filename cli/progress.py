"""Tasks on the screen: bars on a terminal, a line now and then in a pipe or a log; always on stderr."""

import sys
import threading
from typing import TYPE_CHECKING

from fmu_src.progress import Task

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

# What is over sooner is not spoken of in a pipe, and no line follows another sooner [s].
SOON, PAUSE = 0.7, 3.0


def new_screen() -> "Bars | Lines":
    return Bars() if sys.stderr.isatty() else Lines()


class Lines:
    """What is done, how far it is and about how long it still takes, every few seconds."""

    def __init__(self) -> None:
        self.tasks: list[Task] = []
        self.changed = threading.Condition()
        self.teller: threading.Thread | None = None

    def begin(self, task: Task) -> None:
        with self.changed:
            self.tasks.append(task)
            if self.teller is None:
                self.teller = threading.Thread(target=self.tell, daemon=True)
                self.teller.start()

    def end(self, task: Task) -> None:
        with self.changed:
            self.tasks.remove(task)
            self.changed.notify()

    def tell(self) -> None:
        """Runs beside the work and ends with the last task."""
        spoken: dict[Task, float] = {}
        while True:
            with self.changed:
                if not self.tasks:
                    self.teller = None
                    return
                # The innermost is what is being done.
                task = self.tasks[-1]
                if task.passed > SOON and task.passed - spoken.get(task, -PAUSE) >= PAUSE:
                    spoken[task] = task.passed
                    print(f"rvwear: {sentence(task)}", file=sys.stderr, flush=True)
                self.changed.wait(0.2)


def sentence(task: Task) -> str:
    """``equilibria: 30 of 72, about 4 s left``."""
    count = f": {task.done} of {task.total}" if task.total else ""
    if task.left is None:
        return f"{task.what}{count}" + (f", for {task.passed:.0f} s now" if task.passed > PAUSE else "")
    return f"{task.what}{count}, about {duration(task.left)} left"


def duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{max(1.0, seconds):.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"


class Bars:
    """A bar for each task, gone when it is done."""

    def __init__(self) -> None:
        self.bars: Progress | None = None
        self.rows: dict[Task, TaskID] = {}

    def begin(self, task: Task) -> None:
        from rich.console import Console
        from rich.progress import BarColumn, Progress, TextColumn

        if self.bars is None:
            console = Console(stderr=True)
            self.bars = Progress(TextColumn("{task.fields[text]}"), BarColumn(), console=console, transient=True)
            # The text is made anew at each refresh, which is when it is looked at.
            self.bars.get_renderable = self.renderable  # type: ignore[method-assign]
            self.bars.start()
        self.rows[task] = self.bars.add_task("", total=task.total or task.about, text=sentence(task))

    def renderable(self) -> object:
        assert self.bars is not None
        for task, row in list(self.rows.items()):
            done = task.done if task.total else min(task.passed, task.about or 0.0)
            self.bars.update(row, completed=done, text=sentence(task))
        return self.bars.make_tasks_table(self.bars.tasks)

    def end(self, task: Task) -> None:
        assert self.bars is not None
        self.bars.remove_task(self.rows.pop(task))
        if not self.rows:
            self.bars.stop()
            self.bars = None
