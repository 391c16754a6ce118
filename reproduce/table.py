"""The claims on the screen and as plain data."""

from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from exports.tables import Table as Export
from exports.tables import rows_table
from pages.look import Figure
from reproduce.claim import CONDITIONAL, CONTRADICTED, NOT_TESTABLE, REPRODUCED, VERDICTS, Audited, Claim, Number

# Wide enough for the table, also where the output goes to a file.
WIDTH = 100
STYLES = {REPRODUCED: "green", CONDITIONAL: "yellow", CONTRADICTED: "red", NOT_TESTABLE: "dim"}


def value_text(value: float | None) -> str:
    """A number with four digits; nothing for None."""
    if value is None:
        return ""
    if value != 0.0 and not 1e-3 <= abs(value) < 1e5:
        return f"{value:.3g}"
    return f"{value:.4g}" if abs(value) < 1e4 else f"{value:,.0f}"


def span_text(value: Audited | None) -> str:
    """A number, a range, or nothing."""
    if isinstance(value, tuple):
        return " to ".join(value_text(v) for v in value)
    return value_text(value)


def audited_text(number: Number) -> str:
    """What the independent check has."""
    return span_text(number.audited)


def ours_text(number: Number) -> str:
    """What is computed here, a dash where nothing can be."""
    return value_text(number.printed if number.value is None else number.value) or "-"


def range_text(number: Number) -> str:
    """Ours over what is not known."""
    return "" if number.low is None or number.high is None else span_text((number.low, number.high))


def unit_text(number: Number) -> str:
    return "" if number.unit == "1" else number.unit


def print_table(claims: list[Claim], checked: bool = True) -> None:
    """One row per claim, their figures and ours, and below what the independent check does not confirm, where it is one of these numbers."""
    console = Console(width=max(Console().width, WIDTH), markup=False)
    table = Table(title="Claims of the sources against the computation", title_justify="left", show_lines=True, expand=True)
    for head in ("id", "claim", "verdict", "cause"):
        table.add_column(head, ratio={"claim": 3, "verdict": 2, "cause": 7}.get(head))
    for claim in claims:
        verdict = claim.verdict if claim.stands else f"{claim.verdict}: NO LONGER CARRIED BY THE NUMBERS"
        condition = f"{claim.condition}. " if claim.condition else ""
        condition = f"Condition: {condition}" if condition else ""
        table.add_row(claim.id, claim.title, Text(verdict, STYLES[claim.verdict]), condition + claim.why)
    console.print(table)
    if any(claim.held for claim in claims):
        console.print(figures_table(claims))
    counts = {verdict: sum(c.verdict == verdict for c in claims) for verdict in VERDICTS}
    console.print("  ".join(f"{name} {count}" for name, count in counts.items()), highlight=False)
    for claim in claims:
        for number in claim.discrepancies if checked else ():
            console.print(f"{claim.id} {number.label}: {value_text(number.found)} {number.unit}, independent check"
                          f" {audited_text(number)}", highlight=False)


def figures_table(claims: list[Claim]) -> Table:
    """A row for each figure of a source: ours, theirs, the range of ours, and the claim's verdict; its cause stands with the claim."""
    table = Table(title="Their figures and ours", title_justify="left", expand=True)
    for head in ("id", "figure", "ours", "range", "theirs", "unit", "verdict"):
        table.add_column(head, ratio={"figure": 5, "range": 3, "theirs": 3, "verdict": 3, "unit": 2, "ours": 2}.get(head))
    for claim in claims:
        for k, number in enumerate(claim.held):
            verdict = Text(claim.verdict if claim.stands else "FALLEN", STYLES[claim.verdict]) if k == 0 else Text("")
            table.add_row(claim.id if k == 0 else "", number.label, ours_text(number), range_text(number), span_text(number.published),
                          unit_text(number), verdict, end_section=number is claim.held[-1])
    return table


def as_json(claims: list[Claim]) -> dict[str, Any]:
    """Everything but the figures as plain data."""
    return {"claims": [claim_data(c) for c in claims],
            "verdicts": {v: sum(c.verdict == v for c in claims) for v in VERDICTS}}


def claim_data(c: Claim) -> dict[str, Any]:
    numbers = [
        {"label": n.label, "unit": n.unit, "value": plain(n.value), "printed": plain(n.printed),
         "theirs": plain(n.published), "low": plain(n.low), "high": plain(n.high), "independent_check": plain(n.audited), "agrees": n.agrees}
        for n in c.numbers
    ]  # fmt: skip
    return {
        "id": c.id, "source": c.source, "title": c.title, "says": c.says, "verdict": c.verdict,
        "condition": c.condition,
        "why": c.why, "stands": c.stands, "numbers": numbers,
        "grounds": [{"text": text, "holds": holds} for text, holds in c.grounds],
    }  # fmt: skip


def plain(value: Audited | None) -> float | list[float] | None:
    """NumPy scalars as Python numbers."""
    if value is None:
        return None
    return [float(v) for v in value] if isinstance(value, tuple) else float(value)


def tables_of(claims: list[Claim]) -> list[Export]:
    """Verdicts, and every number computed, published, printed and checked, for other programs."""
    verdicts = [
        {"claim": c.id, "source": c.source, "title": c.title, "says": c.says, "verdict": c.verdict, "condition": c.condition, "why": c.why} for c in claims
    ]  # fmt: skip
    numbers = [
        {"claim": c.id, "number": n.label, "unit": n.unit, "computed": nan(n.value), "low": nan(n.low), "high": nan(n.high), "theirs": span_text(n.published),
         "printed_formula": nan(n.printed), "independent_check": audited_text(n), "verdict": c.verdict, "cause": c.why}
        for c in claims for n in c.numbers
    ]  # fmt: skip
    return [rows_table("numbers", numbers, {}), rows_table("verdicts", verdicts, {}), *(curves_of(figure) for claim in claims for figure in claim.figures)]


def curves_of(figure: Figure) -> Export:
    """The curves of a figure, a row a point, under the titles of its axes."""
    across, up = (str(figure.layout.get(axis, {}).get("title", {}).get("text", "")) or axis[0] for axis in ("xaxis", "yaxis"))
    rows = [
        {"curve": str(trace.get("name", "")), across: x, up: nan(y)}
        for trace in figure.data for x, y in zip(trace.get("x", ()), trace.get("y", ())) if isinstance(y, float | int | None)
    ]  # fmt: skip
    return rows_table(figure.name, rows, {})


def nan(value: float | None) -> float:
    return float("nan") if value is None else value
