"""What was computed with other numbers than the sources' says so wherever it goes: in tables and pictures, as on the page."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from exports.tables import Table
from pages.look import Figure


def note_of(changes: Sequence[str], is_moved: bool = True) -> str:
    """Empty where nothing was changed; ``is_moved``: whether what it stands beside is other than with the sources' numbers."""
    if not changes:
        return ""
    told = "conclusions drawn from those need not hold" if is_moved else "nothing here is moved by that"
    return f"with {', '.join(changes)} instead of the sources' numbers: {told}"


def noted_tables(tables: Sequence[Table], note: str) -> list[Table]:
    return [replace(table, note=note) for table in tables]


def noted_figure(figure: Figure, note: str) -> Figure:
    """The figure with the note below its axis; a polar one, or one to scale, which have none, with it in the legend."""
    if not note:
        return figure
    axis = figure.layout.get("xaxis", {})
    is_polar = any(trace.get("type") == "scatterpolar" for trace in figure.data)
    if is_polar or not axis.get("visible", True):
        nowhere: dict[str, Any] = {"type": "scatterpolar", "theta": [], "r": []} if is_polar else {"type": "scatter", "x": [], "y": []}
        said = nowhere | {"mode": "lines", "name": note, "line": {"color": "#ffffff"}}
        return replace(figure, data=[*figure.data, said], layout=figure.layout | {"showlegend": True})
    title = axis.get("title", "")
    words = title.get("text", "") if isinstance(title, dict) else title
    return replace(figure, layout=figure.layout | {"xaxis": axis | {"title": {"text": f"{words}\n{note}".strip()}}})
