"""Charts of the claims: curves with a legend, in the look of the reports."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from pages import look
from pages.look import Figure, Layout, Trace

# Colour-blind safe, in the order of use.
COLOURS = ("#0b4f94", "#d55e00", "#009e73", "#98a3af", "#cc79a7", "#e0a000")


Row = npt.NDArray[np.floating | np.integer]


@dataclass(frozen=True)
class Curve:
    """One line (or scatter, with ``mode`` "markers")."""

    label: str
    x: Row
    y: Row
    colour: str = ""
    dash: str = "solid"
    mode: str = "lines"
    width: float = 1.8


def chart(
    name: str, title: str, caption: str, curves: Sequence[Curve], x_title: str, y_title: str, columns: int = 6, height: int = 300,
    marks: Sequence[tuple[float, str]] = (), x_axis: Layout | None = None, y_axis: Layout | None = None,
) -> Figure:  # fmt: skip
    """A figure of curves; ``marks`` are (x, text) of vertical dotted lines."""
    traces = []
    for i, curve in enumerate(curves):
        colour = curve.colour or COLOURS[i % len(COLOURS)]
        trace: Trace = {
            "type": "scatter", "mode": curve.mode, "name": curve.label, "x": rounded(curve.x, 5, x_axis),
            "y": rounded(curve.y, 4, y_axis), "hovertemplate": f"{curve.label}: %{{y}} at %{{x}}<extra></extra>",
        }  # fmt: skip
        if "lines" in curve.mode:
            trace["line"] = {"color": colour, "width": curve.width, "dash": curve.dash}
        if "markers" in curve.mode:
            trace["marker"] = {"color": colour, "size": 4 if curve.mode == "markers" else 6, "opacity": 0.8}
        traces.append(trace)
    lines = [look.upright(x, text) for x, text in marks]
    legend = {"orientation": "h", "x": 0, "y": -0.24, "yanchor": "top", "font": {"size": 11.5}}
    picture = look.layout(
        xaxis=look.axis(x_title, **(x_axis or {})), yaxis=look.axis(y_title, **(y_axis or {})), showlegend=True,
        legend=legend, margin={"l": 60, "r": 20, "t": 24 if marks else 10, "b": 46},
        shapes=[shape for shape, _ in lines], annotations=[label for _, label in lines],
    )  # fmt: skip
    return Figure(name, title, caption, traces, picture, columns, height)


def rounded(values: Row, digits: int, axis: Layout | None) -> list[float | None]:
    """As its axis needs them: a logarithmic one shows small values as well as large ones."""
    found: list[float | None] = look.significant(values, digits) if (axis or {}).get("type") == "log" else look.short(values, digits)
    return found


def degrees_axis(last: float = 180.0) -> Layout:
    """Phase on the tooth, 0 root to 180 tip (and 360 the next root)."""
    return {"range": [0.0, last], "dtick": 30.0 if last <= 180.0 else 60.0, "tick0": 0.0}


PHASE = "phase on the tooth [°]: 0 root, 180 tip"


def picture(name: str, title: str, caption: str, curves: Sequence[Curve], columns: int = 6, height: int = 340) -> Figure:
    """Curves to scale, without axes."""
    traces = []
    for i, curve in enumerate(curves):
        colour = curve.colour or COLOURS[i % len(COLOURS)]
        trace = look.line(look.short(curve.x, 5), look.short(curve.y, 5), colour, curve.width, curve.dash)
        traces.append(trace | {"name": curve.label, "hoverinfo": "name"})
    x = np.concatenate([c.x for c in curves])
    y = np.concatenate([c.y for c in curves])
    plain = look.drawing(look.padded(x), look.padded(y))
    plain |= {"showlegend": True, "legend": {"orientation": "h", "x": 0, "y": -0.02, "yanchor": "top"}}
    return Figure(name, title, caption, traces, plain | {"margin": {"l": 4, "r": 4, "t": 4, "b": 30}}, columns,
                  height)


def polar(name: str, title: str, caption: str, curves: Sequence[Curve], columns: int = 6, height: int = 360) -> Figure:
    """Closed rows over the angle [deg]: radius is the value."""
    traces = []
    for i, curve in enumerate(curves):
        colour = curve.colour or COLOURS[i % len(COLOURS)]
        traces.append({
            "type": "scatterpolar", "mode": "lines", "name": curve.label, "theta": look.short(curve.x, 5),
            "r": look.short(curve.y, 4), "line": {"color": colour, "width": curve.width, "dash": curve.dash},
            "hovertemplate": f"{curve.label}: %{{r}} at %{{theta}}°<extra></extra>",
        })  # fmt: skip
    quiet = {"gridcolor": look.GRID, "linecolor": look.GRID, "tickfont": {"size": 11, "color": look.QUIET}}
    around = {"radialaxis": quiet | {"angle": 45}, "angularaxis": quiet | {"dtick": 30}, "bgcolor": "rgba(0,0,0,0)"}
    layout = look.layout(polar=around, showlegend=True, margin={"l": 40, "r": 40, "t": 30, "b": 40})
    layout |= {"legend": {"orientation": "h", "x": 0, "y": -0.1, "yanchor": "top", "font": {"size": 11.5}}}
    return Figure(name, title, caption, traces, layout, columns, height)
