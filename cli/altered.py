"""What was computed with other numbers than the sources' says so wherever it goes: in tables and pictures, as on the page."""

from collections.abc import Sequence
from dataclasses import replace

from exports.tables import Table
from pages.look import Figure


def note_of(changes: Sequence[str]) -> str:
    """Empty where nothing was changed."""
    return f"with {', '.join(changes)} instead of the sources' numbers: what these carry need not hold" if changes else ""


def noted_tables(tables: Sequence[Table], note: str) -> list[Table]:
    return [replace(table, note=note) for table in tables]


def noted_figure(figure: Figure, note: str) -> Figure:
    """The figure with the note below its axis; a polar one, which has none, with it in the legend."""
    if not note:
        return figure
    if any(trace.get("type") == "scatterpolar" for trace in figure.data):
        said = {"type": "scatterpolar", "mode": "lines", "name": note, "theta": [], "r": [], "line": {"color": "#ffffff"}}
        return replace(figure, data=[*figure.data, said], layout=figure.layout | {"showlegend": True})
    axis = figure.layout.get("xaxis", {})
    title = axis.get("title", "")
    words = title.get("text", "") if isinstance(title, dict) else title
    return replace(figure, layout=figure.layout | {"xaxis": axis | {"title": {"text": f"{words}\n{note}".strip()}}})
