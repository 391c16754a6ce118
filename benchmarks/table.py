"""The table of all measurements: screen, JSON, HTML with plots."""

import json
import math
from dataclasses import asdict
from pathlib import Path

import numpy as np
import rich.table
from rich.console import Console

from benchmarks.ratios import Curve, Measured
from pages import charts, look
from pages.content import Page, Section, Table
from pages.render import rendered_sections, written

VERDICT = {True: "met", False: "not met", None: ""}
RATIO_HEADS = ("work", "against", "accuracy", "ours", "theirs", "ratio", "target", "")
FIGURE_HEADS = ("figure", "value", "wanted", "")
# Columns that hold numbers.
NUMBERS = ("ours", "theirs", "ratio", "value", "target", "wanted")
LOGARITHMIC = {"type": "log"}


def amount(value: float, unit: str) -> str:
    if not math.isfinite(value):
        return "-"
    if unit != "s":
        return f"{value:.4g}" + ("" if unit == "1" else f" {unit}")
    sizes = ((1.0, "s"), (1e3, "ms"), (1e6, "us"), (1e9, "ns"))
    factor, name = next((size for size in sizes if value * size[0] >= 1.0), sizes[-1])
    return f"{value * factor:.3g} {name}"


def ratio_rows(found: dict[str, Measured]) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    for measured in found.values():
        for r in measured.ratios:
            target = "" if r.target is None else f">= {r.target:g}"
            verdict = "" if not math.isfinite(r.ratio) else VERDICT[r.met]
            ratio = f"{r.ratio:.3g}" if r.ratio < 1000 else f"{r.ratio:,.0f}" if math.isfinite(r.ratio) else "-"
            rows.append((r.work, r.peer, r.error, amount(r.ours, r.unit), amount(r.peer_cost, r.unit), ratio, target,
                         "; ".join(text for text in (verdict, r.note) if text)))
    return rows


def figure_rows(found: dict[str, Measured]) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    for measured in found.values():
        for f in measured.figures:
            wanted = f"<= {f.at_most:g}" if f.at_most is not None else f">= {f.at_least:g}" if f.at_least is not None else ""
            rows.append((f.what, amount(f.value, f.unit), wanted, "; ".join(t for t in (VERDICT[f.met], f.note) if t)))
    return rows


def show(found: dict[str, Measured]) -> None:
    console = Console(width=max(Console().width, 190), markup=False)
    for title, heads, rows in (("cost of others over ours", RATIO_HEADS, ratio_rows(found)), ("figures", FIGURE_HEADS, figure_rows(found))):
        table = rich.table.Table(title=title, title_justify="left")
        for head in heads:
            table.add_column(head, justify="right" if head in NUMBERS else "left")
        for row in rows:
            table.add_row(*row)
        console.print(table) if rows else None


def write(found: dict[str, Measured], machine: dict[str, str | float], quick: bool, output: Path) -> None:
    """Both files, whole after every item."""
    output.parent.mkdir(parents=True, exist_ok=True)
    content = {"machine": machine, "quick": quick} | {
        item: {
            "ratios": [asdict(r) | {"ratio": r.ratio, "met": r.met} for r in m.ratios],
            "figures": [asdict(f) | {"met": f.met} for f in m.figures], "curves": [asdict(c) for c in m.curves],
        } for item, m in found.items()
    }  # fmt: skip
    # NaN is not JSON.
    text = json.dumps(json.loads(json.dumps(content), parse_constant=lambda _: None), indent=1)
    output.with_suffix(".json").write_text(text + "\n", encoding="utf-8")
    written(rendered_sections(page(found, machine, quick)), output.with_suffix(".html"))


def page(found: dict[str, Measured], machine: dict[str, str | float], quick: bool) -> Page:
    curves = [curve for measured in found.values() for curve in measured.curves]
    said = ", ".join(f"{key} {value}" for key, value in machine.items())
    tables = [
        Table("Others over ours", list(RATIO_HEADS), [list(row) for row in ratio_rows(found)], right_of(RATIO_HEADS)),
        Table("Figures", list(FIGURE_HEADS), [list(row) for row in figure_rows(found)], right_of(FIGURE_HEADS)),
    ]
    lead = "Processor time of one process, least of several runs; each ratio is of one run."
    return Page(
        "Measured cost", "rvwear", said, verdicts(found), [],
        [Section("costs", "Costs", lead, tables=tables),
         Section("curves", "Curves", "Cost against accuracy or size.", [plot(i, curve) for i, curve in enumerate(curves)])],
        ["Quick form: figures mean little."] if quick else [],
    )  # fmt: skip


def verdicts(found: dict[str, Measured]) -> str:
    """How many targets are met of those that could be measured, in a sentence."""
    met = [r.met for measured in found.values() for r in measured.ratios if math.isfinite(r.ratio)]
    met += [f.met for measured in found.values() for f in measured.figures]
    return f"{met.count(True)} of {met.count(True) + met.count(False)} targets are met."


def right_of(heads: tuple[str, ...]) -> tuple[int, ...]:
    return tuple(i for i, head in enumerate(heads) if head in NUMBERS)


def plot(number: int, curve: Curve) -> look.Figure:
    lines = []
    for name, points in curve.lines.items():
        label = f"{name} ~ x^{curve.fits[name]:.2f}" if name in curve.fits else name
        x, y = np.array(sorted(points)).reshape(-1, 2).T
        lines.append(charts.Curve(label, x, y, mode="lines+markers"))
    return charts.chart(f"curve{number}", curve.title, "", lines, curve.x, curve.y, 12, 480, x_axis=LOGARITHMIC, y_axis=LOGARITHMIC)
