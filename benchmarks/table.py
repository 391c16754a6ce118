"""The table of all measurements: screen, JSON, HTML with plots."""

import html
import json
import math
from dataclasses import asdict
from pathlib import Path

import plotly.graph_objects as go
from rich.console import Console
from rich.table import Table

from benchmarks.ratios import Curve, Measured

VERDICT = {True: "met", False: "not met", None: ""}
RATIO_HEADS = ("work", "against", "accuracy", "ours", "theirs", "ratio", "target", "")
FIGURE_HEADS = ("figure", "value", "wanted", "")


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
        table = Table(title=title, title_justify="left")
        for head in heads:
            table.add_column(head, justify="right" if head in ("ours", "theirs", "ratio", "value", "target", "wanted") else "left")
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
    output.with_suffix(".html").write_text(page(found, machine, quick), encoding="utf-8")


def page(found: dict[str, Measured], machine: dict[str, str | float], quick: bool) -> str:
    curves = [curve for measured in found.values() for curve in measured.curves]
    plots = "".join(plot(curve).to_html(full_html=False, include_plotlyjs=i == 0) for i, curve in enumerate(curves))
    warning = "<p><b>Quick form: figures mean little.</b></p>" if quick else ""
    said = ", ".join(f"{key} {value}" for key, value in machine.items())
    return (
        "<!doctype html><meta charset=utf-8><title>rvwear: measured cost</title><style>body{font:15px sans-serif;"
        "max-width:1200px;margin:2em auto;padding:0 1em}table{border-collapse:collapse}td,th{padding:.2em .6em;text-align:left;"
        "border-bottom:1px solid #ccc}</style><h1>Measured cost</h1>"
        f"{warning}<p>{html.escape(said)}. Processor time of one process, least of several runs; each ratio is of one run."
        f"</p><h2>Others over ours</h2>{rows_html(RATIO_HEADS, ratio_rows(found))}<h2>Figures</h2>"
        f"{rows_html(FIGURE_HEADS, figure_rows(found))}<h2>Curves</h2>{plots}"
    )


def rows_html(heads: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    head = "".join(f"<th>{html.escape(h)}" for h in heads)
    return f"<table><tr>{head}" + "".join("<tr>" + "".join(f"<td>{html.escape(c)}" for c in row) for row in rows) + "</table>"


def plot(curve: Curve) -> go.Figure:
    figure = go.Figure()
    for name, points in curve.lines.items():
        points = sorted(points)
        label = f"{name} ~ x^{curve.fits[name]:.2f}" if name in curve.fits else name
        figure.add_scatter(x=[x for x, _ in points], y=[y for _, y in points], mode="lines+markers", name=label)
    figure.update_layout(title=curve.title, height=480)
    figure.update_xaxes(type="log", title=curve.x)
    figure.update_yaxes(type="log", title=curve.y)
    return figure
