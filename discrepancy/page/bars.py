"""Bars of errors over the noise, before and after."""

from collections.abc import Sequence
from typing import Any

from discrepancy.model_file import SignalEntry
from discrepancy.page.amounts import signal_title
from discrepancy.words.sample_errors import SAMPLES
from pages import look
from pages.look import Figure, short

BEFORE, AFTER = look.START, look.NOW


def noise_line(horizontal: bool = True) -> tuple[dict[str, Any], dict[str, Any]]:
    """The line at 1, where an error is the noise: (shape, label).  It proves nothing: no green."""
    line: dict[str, Any] = {"type": "line", "line": {"color": look.QUIET, "width": 1.2, "dash": "dot"}, "layer": "above"}
    if horizontal:
        line |= {"xref": "paper", "x0": 0, "x1": 1, "y0": 1, "y1": 1}
        label = look.note(1.0, 1.0, "noise", xref="paper", xanchor="right", yanchor="bottom", font={"size": 11, "color": look.QUIET})
    else:
        line |= {"yref": "paper", "y0": 0, "y1": 1, "x0": 1, "x1": 1}
        label = look.note(1.0, 1.0, "noise", yref="paper", yanchor="bottom", font={"size": 11, "color": look.QUIET})
    return line, label


def pairs(
    name: str,
    title: str,
    caption: str,
    groups: Sequence[str],
    before: Sequence[float | None],
    after: Sequence[float | None],
    hover: tuple[Sequence[str], Sequence[str]],
    columns: int = 6,
    words: tuple[str, str] = ("before", "after"),
    axis: str = SAMPLES,
) -> Figure:
    """Two horizontal bars per group, in times the noise."""
    data = two_bars(groups, (before, after), [f"%{{y}}<br>{word}: %{{customdata}}<extra></extra>" for word in words], words)
    for trace, values, texts in zip(data, (before, after), hover):
        trace |= {"customdata": list(texts), "text": [f"{v:.2f}" if v is not None else "" for v in values]}
    shape, label = noise_line(horizontal=False)
    most = max([v for v in (*before, *after) if v is not None], default=1.0)
    layout = two_bars_layout(axis, [0.0, 1.12 * max(most, 1.1)]) | {"shapes": [shape], "annotations": [label]}
    return Figure(name, title, caption, data, layout, columns, 132 + 46 * max(len(groups), 2))


def shares(
    name: str, title: str, caption: str, groups: Sequence[str], alone: Sequence[float], beside: Sequence[float], texts: tuple[Sequence[str], ...]
) -> Figure:
    """Of each of several effects the share [%] that it has alone, and what it adds to the others."""
    words = ("alone", "added to the others")
    data = two_bars(groups, (alone, beside), [f"%{{y}}<br>{word}: %{{text}}<extra></extra>" for word in words], words)
    for trace, text in zip(data, texts):
        trace |= {"text": list(text)}
    return Figure(name, title, caption, data, two_bars_layout("share [%]", [0.0, 115.0]), 12, 132 + 46 * max(len(groups), 2))


def two_bars(groups: Sequence[str], values: Sequence[Sequence[float | None]], hover: Sequence[str], words: Sequence[str]) -> list[dict[str, Any]]:
    return [
        {
            "type": "bar",
            "orientation": "h",
            "name": word,
            "y": list(groups),
            "x": short([float("nan") if v is None else v for v in own], 4),
            "marker": {"color": colour},
            "hovertemplate": text,
            "textposition": "outside",
            "cliponaxis": False,
        }
        for word, own, colour, text in zip(words, values, (BEFORE, AFTER), hover)
    ]


def two_bars_layout(x_title: str, x_range: list[float]) -> dict[str, Any]:
    legend = {"orientation": "h", "x": 1, "xanchor": "right", "y": 1.0, "yref": "container", "yanchor": "top", "font": {"size": 11.5}}
    return look.layout(
        barmode="group",
        bargap=0.35,
        showlegend=True,
        legend=legend,
        xaxis=look.axis(x_title, range=x_range),
        yaxis=look.axis("", type="category", autorange="reversed", showgrid=False, ticks=""),
        margin={"l": 60, "r": 20, "t": 48, "b": 46},
    )


def single(
    name: str,
    title: str,
    caption: str,
    groups: Sequence[str],
    values: Sequence[float],
    x_title: str,
    colours: Sequence[str],
    texts: Sequence[str],
    columns: int = 6,
    **axis: Any,
) -> Figure:
    """One horizontal bar per group."""
    data = [
        {
            "type": "bar",
            "orientation": "h",
            "y": list(groups),
            "x": short(values, 4),
            "marker": {"color": list(colours)},
            "text": list(texts),
            "textposition": "outside",
            "cliponaxis": False,
            "hovertemplate": "%{y}: %{text}<extra></extra>",
        }
    ]
    most = max(values, default=1.0) or 1.0
    layout = look.layout(
        xaxis=look.axis(x_title, **({"range": [0.0, 1.25 * most]} | axis)),
        bargap=0.4,
        yaxis=look.axis("", type="category", autorange="reversed", showgrid=False, ticks=""),
        margin={"l": 60, "r": 24, "t": 10, "b": 46},
    )
    return Figure(name, title, caption, data, layout, columns, 80 + 30 * max(len(groups), 2))


def signal_rows(rows: Sequence[SignalEntry]) -> list[str]:
    """Names of signals, held-out ones marked."""
    return [signal_title(r.signal) + (", held out" if r.held_out else ", fitted") for r in rows]
