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


def audited_text(number: Number) -> str:
    """What the independent check has."""
    if isinstance(number.audited, tuple):
        return " to ".join(value_text(v) for v in number.audited)
    return value_text(number.audited)


def print_table(claims: list[Claim], checked: bool = True) -> None:
    """One row per claim, and below what the independent check does not confirm, where it is one of these numbers."""
    console = Console(width=max(Console().width, WIDTH), markup=False)
    table = Table(title="Claims of the sources against the computation", title_justify="left", show_lines=True)
    for head in ("id", "claim", "verdict", "why"):
        table.add_column(head, ratio={"claim": 3, "verdict": 2, "why": 7}.get(head))
    for claim in claims:
        verdict = claim.verdict if claim.stands else f"{claim.verdict}: NO LONGER CARRIED BY THE NUMBERS"
        condition = f"{claim.condition}. " if claim.condition else ""
        condition = f"Condition: {condition}" if condition else ""
        table.add_row(claim.id, claim.title, Text(verdict, STYLES[claim.verdict]), condition + claim.why)
    console.print(table)
    counts = {verdict: sum(c.verdict == verdict for c in claims) for verdict in VERDICTS}
    console.print("  ".join(f"{name} {count}" for name, count in counts.items()), highlight=False)
    for claim in claims:
        for number in claim.discrepancies if checked else ():
            console.print(f"{claim.id} {number.label}: {value_text(number.found)} {number.unit}, independent check"
                          f" {audited_text(number)}", highlight=False)


def as_json(claims: list[Claim]) -> dict[str, Any]:
    """Everything but the figures as plain data."""
    return {"claims": [claim_data(c) for c in claims],
            "verdicts": {v: sum(c.verdict == v for c in claims) for v in VERDICTS}}


def claim_data(c: Claim) -> dict[str, Any]:
    numbers = [
        {"label": n.label, "unit": n.unit, "value": plain(n.value), "printed": plain(n.printed),
         "independent_check": plain(n.audited), "agrees": n.agrees}
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
    """Verdicts, and every number computed, printed and checked, for other programs."""
    verdicts = [
        {"claim": c.id, "source": c.source, "title": c.title, "says": c.says, "verdict": c.verdict, "condition": c.condition, "why": c.why} for c in claims
    ]  # fmt: skip
    numbers = [
        {"claim": c.id, "number": n.label, "unit": n.unit, "computed": nan(n.value), "printed_formula": nan(n.printed), "independent_check": audited_text(n)}
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
