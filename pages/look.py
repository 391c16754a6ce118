"""How figures look: colours, axes, and a figure as plain data for plotly.js."""

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

INK, QUIET, GRID, STEEL, PAPER = "#1d2733", "#5d6975", "#e4e9ee", "#eceff2", "#ffffff"
START, NOW = "#98a3af", "#0b4f94"
# One sequential scale each, light to dark, so that they also read in grey: hours, depth, force.
HOURS = ("#a8cbe8", "#74abd9", "#4488c2", "#22669f", "#114877", "#062a4e")
DEPTH = ("#fde3b0", "#fdbe6f", "#f5923e", "#db6420", "#ad3f12", "#6e2108")
FORCE = ("#ffffff", "#dcd8ee", "#b6abd9", "#8a76bd", "#61449b", "#34156b")
# The four kinds of surface: colour-blind safe, each with its own line.
SURFACES = {
    "disc_flank_um": ("disc flank", "#0072b2", "solid"),
    "inner_raceway_um": ("inner raceway", "#d55e00", "dash"),
    "outer_raceway_um": ("outer raceway", "#e0a000", "dashdot"),
    "pin_um": ("pin", "#6b7785", "dot"),
}
FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Liberation Sans", sans-serif'

# As plotly.js takes them, ready for JSON: a trace or changes to one, a layout or a part of one.
Trace = dict[str, Any]
Layout = dict[str, Any]


@dataclass(frozen=True)
class Figure:
    """One plot: ``data`` and ``layout`` for plotly.js, and what the page says about it.

    ``columns`` of twelve is its width on a wide screen.  ``states[disc][hour]`` holds, for
    figures that follow the page's selectors, one update per trace (None: unchanged; a
    number: what that trace has at the first hour); with a single entry for ``disc`` the
    figure is the same for all discs.  ``rows_of`` names a heat map whose rows are the
    heights of this figure's first traces.
    """

    name: str
    title: str
    caption: str
    data: list[Trace]
    layout: Layout
    columns: int = 6
    height: int = 300
    aspect: str = ""
    keys: list[tuple[str, str, str]] = field(default_factory=list)
    states: list[list[list[Trace | int | None]]] = field(default_factory=list)
    rows_of: str = ""
    rows: int = 1


def blend(scale: tuple[str, ...], part: float) -> str:
    """Colour at ``part`` (0 to 1) of a scale."""
    place = min(max(part, 0.0), 1.0) * (len(scale) - 1)
    i = min(int(place), len(scale) - 2)
    low, high = (np.array([int(c[k : k + 2], 16) for k in (1, 3, 5)]) for c in (scale[i], scale[i + 1]))
    mixed = low + (place - i) * (high - low)
    return "#" + "".join(f"{round(v):02x}" for v in mixed)


def hour_colours(count: int) -> list[str]:
    """Colours of the shown hours, first light, last dark."""
    return [blend(HOURS, i / max(count - 1, 1)) if count > 1 else HOURS[-1] for i in range(count)]


def colour_scale(scale: tuple[str, ...]) -> list[list[float | str]]:
    return [[i / (len(scale) - 1), colour] for i, colour in enumerate(scale)]


def short(values: npt.ArrayLike, digits: int = 4) -> Any:
    """Nested lists with as many decimals as ``digits`` of the largest value need; NaN becomes None."""
    array = np.asarray(values, float)
    finite = np.abs(array[np.isfinite(array)])
    largest = float(finite.max(initial=0.0))
    decimals = digits - 1 - (math.floor(math.log10(largest)) if largest > 0.0 else 0)
    rounded = np.round(array, decimals)
    return plain(rounded.tolist())


def significant(values: npt.ArrayLike, digits: int = 4) -> Any:
    """Nested lists with ``digits`` digits of each value, for logarithmic axes; NaN becomes None."""
    array = np.asarray(values, float)
    return plain(np.array([float(f"{value:.{digits}g}") for value in array.flat]).reshape(array.shape).tolist())


def plain(value: Any) -> Any:
    if isinstance(value, list):
        return [plain(v) for v in value]
    if value is None or not math.isfinite(value):
        return None
    return int(value) if value == int(value) else value


def axis(title: str, **more: Any) -> Layout:
    """An axis with its title; quiet lines."""
    return {
        "title": {"text": title, "font": {"size": 12, "color": QUIET}, "standoff": 8},
        "gridcolor": GRID, "linecolor": GRID, "zeroline": False, "ticks": "outside", "ticklen": 3,
        "tickcolor": GRID, "tickfont": {"size": 11, "color": QUIET}, "exponentformat": "power", "automargin": True, "fixedrange": False,
    } | more  # fmt: skip


def hour_axis(hours: npt.NDArray[np.float64]) -> Layout:
    """Operating time from zero to a little beyond the last recorded hour."""
    last = float(hours[-1]) or 1.0
    return axis("operating time [h]", range=[-0.03 * last, 1.04 * last], tickformat=",~r", nticks=6, automargin=False)


def angle_axis(title: str, low: float, high: float, step: float, **more: Any) -> Layout:
    return axis(title, range=[low, high], dtick=step, tick0=low, automargin=False, **more)


def layout(**more: Any) -> Layout:
    """A figure's layout: transparent, small margins, no legend (keys stand in the page)."""
    return {
        "font": {"family": FONT, "size": 12, "color": INK}, "paper_bgcolor": "rgba(0,0,0,0)",
        "plot_bgcolor": "rgba(0,0,0,0)", "margin": {"l": 56, "r": 20, "t": 10, "b": 46}, "showlegend": False,
        "hovermode": "closest", "hoverlabel": {"font": {"family": FONT, "size": 12}}, "autosize": True,
        "dragmode": "zoom", "modebar": {"bgcolor": "rgba(255,255,255,0.7)", "color": "#aab4be", "activecolor": NOW},
    } | more  # fmt: skip


def drawing(x_range: list[float], y_range: list[float], **more: Any) -> Layout:
    """Layout of a picture to scale: equal units, no axes."""
    bare = {"visible": False, "fixedrange": False}
    return layout(
        margin={"l": 4, "r": 4, "t": 4, "b": 4},
        xaxis=bare | {"range": x_range, "constrain": "domain"},
        yaxis=bare | {"range": y_range, "scaleanchor": "x", "scaleratio": 1, "constrain": "domain"},
        **more,
    )


def line(x: Any, y: Any, colour: str, width: float = 1.8, dash: str = "solid", hover: str | None = None, **more: Any) -> Trace:
    """A line trace through ``short`` values; without ``hover`` text it does not react to the pointer."""
    trace: Trace = {"type": "scatter", "mode": "lines", "y": y, "line": {"color": colour, "width": width, "dash": dash}}
    trace |= {} if x is None else {"x": x}
    trace |= {"hovertemplate": hover + "<extra></extra>"} if hover else {"hoverinfo": "skip"}
    return trace | more


def path(
    points: npt.NDArray[np.complex128], colour: str, width: float = 1.2, close: bool = False, digits: int = 5, **more: Any
) -> Trace:
    """A line through complex points."""
    if close:
        points = np.append(points, points[0])
    return line(short(points.real, digits), short(points.imag, digits), colour, width, **more)


def note(x: float, y: float, text: str, **more: Any) -> Layout:
    """An annotation without arrow."""
    return {
        "x": round(float(x), 4), "y": round(float(y), 4), "text": text, "showarrow": False,
        "font": {"size": 11, "color": QUIET},
    } | more  # fmt: skip


def upright(x: float, text: str = "", colour: str = QUIET, reference: str = "paper") -> tuple[Layout, Layout]:
    """A vertical dotted line over the whole plot and its label on top: (shape, annotation)."""
    shape = {
        "type": "line", "xref": "x", "yref": reference, "x0": x, "x1": x, "y0": 0, "y1": 1, "layer": "below",
        "line": {"color": colour, "width": 1, "dash": "dot"},
    }  # fmt: skip
    label = note(x, 1.0, text, yref="paper", yanchor="bottom", font={"size": 11, "color": colour})
    return shape, label


def padded(values: npt.ArrayLike, floor: float = 0.0, share: float = 0.06) -> list[float]:
    """Range of all finite values with a margin; at least ``floor`` wide."""
    array = np.asarray(values, float)
    array = array[np.isfinite(array)]
    low, high = (float(array.min()), float(array.max())) if array.size else (0.0, 1.0)
    spare = max(share * (high - low), 0.5 * (floor - (high - low)), 1e-9 * max(abs(low), abs(high)), 1e-12)
    return [low - spare, high + spare]


def scale_bars(start: complex, step: complex, room: float, times: float) -> tuple[list[Trace], list[Layout]]:
    """Bars, at most ``room`` long and ``step`` apart, for the part [mm] and its wear [um]: (traces, labels)."""
    bars = [(round_down(room), "{:g} mm of the part", QUIET)]
    if times:
        micron = round_down(room * 1e3 / times)
        bars.insert(0, (micron * times * 1e-3, f"{micron:g} µm of wear", NOW))
    traces, labels = [], []
    for k, (length, text, colour) in enumerate(bars):
        ends = start + k * step + np.array([0.0, length])
        traces.append(path(ends, colour, 4))
        labels.append(note(ends[1].real, ends[1].imag, " " + text.format(length), xanchor="left"))
    return traces, labels


def round_down(value: float, steps: tuple[float, ...] = (1.0, 2.0, 5.0)) -> float:
    """The largest of ``steps`` times a power of ten that is not above ``value``."""
    power = 10.0 ** math.floor(math.log10(value) + 1e-9)
    return max(step * power for step in steps if step * power <= value * (1.0 + 1e-9))
