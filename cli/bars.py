"""Tasks on a terminal: a bar for each, gone when it is done."""

import sys

from rich.console import Console, RenderableType
from rich.progress import BarColumn, Progress, TaskID, TextColumn

from fmu_src.progress import Task


class Rows(Progress):
    """Bars whose text is made anew each time that they are drawn."""

    def __init__(self) -> None:
        self.rows: dict[Task, TaskID] = {}
        super().__init__(TextColumn("{task.fields[text]}", markup=False), BarColumn(), console=Console(stderr=True), transient=True)

    def get_renderable(self) -> RenderableType:
        for task, row in list(self.rows.items()):
            done = task.done if task.total else min(task.passed, task.about or task.before or 0.0)
            self.update(row, completed=done, text=task.sentence())
        return super().get_renderable()


class Bars:
    """Listens to tasks; draws only while there are some."""

    def __init__(self) -> None:
        self.drawn: Rows | None = None

    def begin(self, task: Task) -> None:
        if self.drawn is None:
            self.drawn = Rows()
            self.drawn.start()
        self.drawn.rows[task] = self.drawn.add_task("", total=task.total or task.about or task.before, text=task.sentence())

    def end(self, task: Task) -> None:
        assert self.drawn is not None
        self.drawn.remove_task(self.drawn.rows.pop(task))
        if not self.drawn.rows:
            self.drawn.stop()
            self.drawn = None

    def say(self, text: str) -> None:
        if self.drawn is None:
            print(text, file=sys.stderr, flush=True)
        else:
            self.drawn.console.print(text, highlight=False, markup=False)
