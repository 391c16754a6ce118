"""What a command shows on the screen; progress goes to stderr, results to stdout."""

import json
from contextlib import contextmanager

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeRemainingColumn
from rich.progress import Progress as Bar
from rich.table import Table

from studies.figure_units import figure_unit

errors = Console(stderr=True)


def json_text(content: dict) -> None:
    """NaN and infinity are not JSON: they become null."""
    print(json.dumps(json.loads(json.dumps(content), parse_constant=lambda _: None), indent=1))


@contextmanager
def busy(text: str):
    """Say what takes a while, on a terminal only."""
    if not errors.is_terminal:
        yield
        return
    with errors.status(text):
        yield


class Progress:
    """A bar over a known number of steps."""

    def __init__(self, total: int, what: str):
        columns = (TextColumn(what), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
        self.bar = Bar(*columns, console=errors, transient=True, disable=not errors.is_terminal)
        self.task = self.bar.add_task(what, total=total)

    def __enter__(self):
        self.bar.start()
        return self

    def __exit__(self, *_):
        self.bar.stop()

    def advance(self) -> None:
        self.bar.advance(self.task)


def figures(title: str, values: dict) -> None:
    """Two columns: what and how much."""
    table = Table(title=title, title_justify="left")
    table.add_column("figure")
    table.add_column("value", justify="right")
    table.add_column("unit")
    for name, value in values.items():
        text = f"{value:.6g}" if isinstance(value, float) else str(value)
        unit = figure_unit(name)
        table.add_row(name, text, "" if unit == "1" else unit)
    Console().print(table)
