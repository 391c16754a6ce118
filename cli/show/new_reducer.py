"""A completed reducer on the screen."""

from pathlib import Path

from rich.table import Table

from cli.screen import console, styled
from reducers.completion.complete import Completion


def show(completion: Completion, name: str, file: Path) -> None:
    """Numbers with ranges and rules, then doubts."""
    table = Table(title=f"{name}: completed by design rules", title_justify="left")
    for head in ("number", "value", "unit", "range", "by"):
        table.add_column(head, justify="right" if head in ("value", "range") else "left", overflow="fold")
    for number in completion.numbers.values():
        span = f"{number.low:.4g} to {number.high:.4g}" if number.low < number.high else ""
        table.add_row(number.name, f"{number.value:.5g}", "" if number.unit == "1" else number.unit, span, number.source)
    console(160).print(table)
    for doubt in completion.doubts:
        console().print(styled(("doubtful: ", "yellow"), doubt))
    console().print(f"written: {file}; read and checked as any other reducer file")
