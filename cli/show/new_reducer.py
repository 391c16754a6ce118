"""A completed reducer on the screen."""

from pathlib import Path

from cli.screen import WIDTH, console, dense, styled
from reducers.completion.compare import Row
from reducers.completion.complete import Completion
from studies.completed_ranges import Influence, what_matters


def show(completion: Completion, name: str, file: Path) -> None:
    """Numbers with ranges and rules, then doubts."""
    table = dense(f"{name}: completed by design rules")
    for head in ("number", "value", "unit", "range", "by"):
        table.add_column(head, justify="right" if head in ("value", "range") else "left", overflow="fold")
    for number in completion.numbers.values():
        span = f"{number.low:.4g} to {number.high:.4g}" if number.low < number.high else ""
        table.add_row(number.name, f"{number.value:.5g}", "" if number.unit == "1" else number.unit, span, number.source)
    console(WIDTH).print(table)
    for doubt in completion.doubts:
        console().print(styled(("doubtful: ", "yellow"), doubt))
    console().print(f"written: {file}; read and checked as any other reducer file")


def show_against(rows: list[Row], name: str, full: str) -> None:
    """Number by number, and how many of those that the full file has from its source lie inside."""
    table = dense(f"{name} against {full}")
    for head in ("number", "completed", "range", "in the file", "unit", "inside?", "the file has it from"):
        table.add_column(head, justify="right" if head in ("completed", "range", "in the file") else "left", overflow="fold")
    for row in rows:
        span = f"{row.low:.4g} to {row.high:.4g}" if row.low < row.high else ""
        inside = "yes" if row.inside else ("no", "red")
        unit = "" if row.unit == "1" else row.unit
        table.add_row(row.name, f"{row.completed:.4g}", span, f"{row.in_file:.4g}", unit, styled(inside), row.source)
    console(WIDTH).print(table)
    known = [row for row in rows if row.tests]
    console().print(
        f"{sum(row.inside for row in known)} of {len(known)} numbers that {full} has from its source, and that come by a published rule, lie inside;"
        f" {sum(row.inside for row in rows)} of {len(rows)} of all"
    )


def show_influences(completion: Completion, found: list[Influence]) -> None:
    """For each signal the dials whose ranges move it most."""
    meaning = {dial.name: dial.meaning for dial in completion.dials}
    table = dense("which ranges matter: the signal with a dial at either end of its range")
    for head in ("signal", "dial", "lower end", "middle", "upper end", "± %"):
        table.add_column(head, justify="left" if head in ("signal", "dial") else "right", overflow="fold")
    for signal, strongest in what_matters(found).items():
        for k, one in enumerate(strongest):
            values = [f"{value:.4g}" for value in (one.low, one.middle, one.high)]
            table.add_row("" if k else signal, meaning[one.dial], *values, f"{100.0 * one.share:.0f}", end_section=one is strongest[-1])
    console(WIDTH).print(table)
