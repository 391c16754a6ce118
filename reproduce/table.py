"""The claims on the screen and as plain data."""

import math
from collections.abc import Sequence
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from exports.tables import Table as Export
from exports.tables import rows_table
from fmu_src.percent import percent
from pages.look import Figure
from reproduce.claim import CONDITIONAL, CONTRADICTED, FALLEN, NOT_TESTABLE, REPRODUCED, Audited, Claim, Number, counts_of

# Wide enough for the table, also where the output goes to a file.
WIDTH = 100
STYLES = {REPRODUCED: "green", CONDITIONAL: "yellow", CONTRADICTED: "red", NOT_TESTABLE: "dim", FALLEN: "magenta"}


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


def off_text(number: Number) -> str:
    """How far the number is off the independent check, and in brackets what is allowed; nothing where that is 0."""
    return "" if math.isnan(number.off) else f"{percent(number.off, 3, '+')} ({percent(number.tolerance, 3)})"


def print_table(claims: list[Claim]) -> None:
    """One row per claim, their figures and ours, and below what the independent check does not confirm."""
    console = Console(width=max(Console().width, WIDTH), markup=False)
    table = Table(title="Claims of the sources against the computation", title_justify="left", show_lines=True, expand=True)
    for head in ("id", "claim", "verdict", "cause"):
        table.add_column(head, ratio={"claim": 3, "verdict": 2, "cause": 7}.get(head))
    for claim in claims:
        verdict = claim.told if claim.stands else f"{claim.told} (was: {claim.verdict})"
        condition = f"{claim.condition}. " if claim.condition else ""
        condition = f"Condition: {condition}" if condition else ""
        of = f"\nof {', '.join(claim.reducers)}" if claim.reducers else ""
        table.add_row(claim.id, f"{claim.title}{of}", Text(verdict, STYLES[claim.outcome]), condition + claim.cause)
    console.print(table)
    if any(claim.held for claim in claims):
        console.print(figures_table(claims))
    counts = "  ".join(f"{name} {count}" for name, count in counts_of(claims).items())
    console.print(f"other numbers: {counts}" if any(claim.altered for claim in claims) else counts, highlight=False)
    if any(claim.discrepancies for claim in claims):
        console.print(unconfirmed_table(claims))


def figures_table(claims: list[Claim]) -> Table:
    """A row for each figure of a source: ours, theirs, the range of ours, and the claim's verdict; its cause stands with the claim."""
    heads = {"figure": 5, "ours": 2, "range": 3, "theirs": 3, "unit": 2}
    return judged_table("Their figures and ours", heads, [
        (claim, [(n.label, ours_text(n), range_text(n), span_text(n.published), unit_text(n)) for n in claim.held]) for claim in claims
    ])  # fmt: skip


def unconfirmed_table(claims: list[Claim]) -> Table:
    """A row for each number that an independent solver found otherwise, with the verdict of its claim, which ours carries."""
    heads = {"number": 5, "ours": 2, "check": 2, "unit": 2, "off (allowed)": 3}
    table = judged_table("Not confirmed by the independent check", heads, [
        (claim, [(n.label, value_text(n.found), audited_text(n), unit_text(n), off_text(n)) for n in claim.discrepancies]) for claim in claims
    ])  # fmt: skip
    table.caption, table.caption_justify = "the verdicts are carried by ours, under the conditions that the page lists, and not by the check", "left"
    return table


def judged_table(title: str, heads: dict[str, int], rows: Sequence[tuple[Claim, Sequence[tuple[str, ...]]]]) -> Table:
    """Rows of numbers, claim by claim, the first of each with the claim's verdict in its colour; ``heads``: column -> share of the width."""
    table = Table(title=title, title_justify="left", expand=True)
    for head, ratio in {"id": None, **heads, "verdict": 3}.items():
        table.add_column(head, ratio=ratio)
    for claim, lines in rows:
        for k, cells in enumerate(lines):
            verdict = Text(claim.told, STYLES[claim.outcome]) if k == 0 else Text("")
            table.add_row(claim.id if k == 0 else "", *cells, verdict, end_section=k == len(lines) - 1)
    return table


def as_json(claims: list[Claim]) -> dict[str, Any]:
    """Everything but the figures as plain data."""
    return {"claims": [claim_data(c) for c in claims], "verdicts": counts_of(claims)}


def claim_data(c: Claim) -> dict[str, Any]:
    numbers = [
        {"label": n.label, "unit": n.unit, "value": plain(n.value), "printed": plain(n.printed),
         "theirs": plain(n.published), "low": plain(n.low), "high": plain(n.high), "independent_check": plain(n.audited), "agrees": n.agrees,
         "off": None if math.isnan(n.off) else float(n.off)}
        for n in c.numbers
    ]  # fmt: skip
    return {
        "id": c.id, "source": c.source, "title": c.title, "says": c.says, "verdict": c.verdict, "told": c.told,
        "reducers": list(c.reducers), "condition": c.condition,
        "why": c.cause, "stands": c.stands, "numbers": numbers,
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
        {"claim": c.id, "source": c.source, "title": c.title, "says": c.says, "verdict": c.told, "condition": c.condition, "why": c.cause,
         "reducers": ", ".join(c.reducers)}
        for c in claims
    ]  # fmt: skip
    numbers = [
        {"claim": c.id, "number": n.label, "unit": n.unit, "computed": nan(n.value), "low": nan(n.low), "high": nan(n.high), "theirs": span_text(n.published),
         "printed_formula": nan(n.printed), "independent_check": audited_text(n), "verdict": c.told, "cause": c.cause,
         "reducers": ", ".join(c.reducers)}
        for c in claims for n in c.numbers
    ]  # fmt: skip
    return [rows_table("numbers", numbers, {}), rows_table("verdicts", verdicts, {}), *(curves_of(figure) for claim in claims for figure in claim.figures)]


def holdings(claims: list[Claim]) -> dict[str, str]:
    """What each of these tables holds, by its name."""
    return {
        "numbers": "numbers of the claims, a row each: computed, range, theirs, printed formula, independent check, verdict, cause and of which reducers",
        "verdicts": "the claims, a row each: what the source says, verdict, condition, why and of which reducers",
    } | {figure.name: f"curves of \"{figure.title}\", a row a point" for claim in claims for figure in claim.figures}


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
