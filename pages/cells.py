"""Cells of a picture for a paper: what was measured where, in colours and numbers, with names that keep their room."""

import math
from textwrap import fill
from typing import Any

import numpy as np

from pages.fonts import room_of
from pages.look import Trace
from pages.marks import SIGN_WIDTH, colour_of, numbers, spelled

# Of the width at least for names of rows (all that few columns leave), what a column has then, and about what a colour scale takes with its words [mm].
SHARE_OF_NAMES, WIDE_COLUMN, SCALE = 0.36, 9.0, 19.0
# How low a colour scale can be for its words [mm].
LOWEST_SCALE = 19.0
# A line of 7 points [mm], what a row has above and below its lines, and what is left free around all.
LINE, BETWEEN, FREE = 2.95, 1.2, 8.0
# Names of columns that have no room beside each other lie so [degrees]; upright where they would cover each other even then.
SLANTED, UPRIGHT = 40.0, 90.0
# Size of numbers in cells, and the smallest that can be read [points]; signs of 7 points are ``SIGN_WIDTH`` wide.
NUMBER, SMALLEST = 6.5, 4.5
INK = "#1d2733"


def is_worded(trace: Trace) -> bool:
    """Whether its rows or columns have names instead of places on an axis."""
    return any(isinstance(v, str) for v in (*(trace.get("x") or ()), *(trace.get("y") or ())))


def row_names(trace: Trace, width: float) -> list[str]:
    """Folded to their share of the picture's width [mm]."""
    signs = max(12, int(max(SHARE_OF_NAMES * width, width - SCALE - WIDE_COLUMN * len(trace["x"])) / SIGN_WIDTH))
    return [fill(spelled(name), signs) for name in trace["y"]]


def room_of_column(trace: Trace, width: float) -> float:
    """How wide about a column is [mm] in a picture of this width."""
    names = max(len(line) for name in row_names(trace, width) for line in name.split("\n")) * SIGN_WIDTH
    scale = SCALE if trace.get("showscale", True) else 0.0
    return max(width - names - scale - 0.5 * FREE, 0.2 * width) / len(trace["x"])


def column_names(trace: Trace, width: float) -> tuple[list[str], float]:
    """The names, and how they lie [degrees]: level where they have room beside each other."""
    names = [spelled(name) for name in trace["x"]]
    room = room_of_column(trace, width)
    if max(room_of(line) for name in names for line in name.split("\n")) < room:
        return names, 0.0
    lying = SLANTED if room * math.sin(math.radians(SLANTED)) >= 0.9 * LINE else UPRIGHT
    return [name.replace("\n", " ") for name in names], lying


def least_height(trace: Trace, width: float) -> float:
    """The height [mm] in which every row holds its name and every column's name is whole."""
    lines = max(name.count("\n") + 1 for name in row_names(trace, width))
    names, lying = column_names(trace, width)
    longest = max(map(room_of, names))
    below = longest * math.sin(math.radians(lying)) if lying else LINE * max(name.count("\n") + 1 for name in names)
    scale = LOWEST_SCALE if trace.get("showscale", True) else 0.0
    return max(len(trace["y"]) * (LINE * lines + BETWEEN), scale) + below + FREE


def heat(picture: Any, axes: Any, trace: Trace, width: float) -> None:
    """Cells with their colours, texts and scale in a picture ``width`` mm wide; what was not measured stays white."""
    from matplotlib.colors import LinearSegmentedColormap

    z = np.array([numbers(row) for row in trace["z"]], float)
    scale = trace.get("colorscale")
    shades = LinearSegmentedColormap.from_list("page", [(float(at), colour_of(c)) for at, c in scale]) if isinstance(scale, list) else "Blues"
    look: dict[str, Any] = {"cmap": shades, "vmin": trace.get("zmin"), "vmax": trace.get("zmax")}
    if is_worded(trace):
        found = axes.pcolormesh(z, **look, edgecolor="white", linewidth=1.0)
        names, lying = column_names(trace, width)
        axes.set_xticks(np.arange(z.shape[1]) + 0.5, names, **({"rotation": lying, "ha": "right", "rotation_mode": "anchor"} if lying else {}))
        if lying == UPRIGHT:
            for label in axes.get_xticklabels():
                label.set_va("center")
        axes.set_yticks(np.arange(z.shape[0]) + 0.5, row_names(trace, width))
        axes.invert_yaxis()
        write_numbers(axes, trace, z, found.get_clim(), width)
    else:
        x, y = trace.get("x") or range(z.shape[1]), trace.get("y") or range(z.shape[0])
        found = axes.pcolormesh(np.array(x, float), np.array(y, float), z, **look, shading="nearest")
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    if trace.get("showscale", True):
        add_scale(picture, axes, found, trace.get("colorbar", {}))


def write_numbers(axes: Any, trace: Trace, z: Any, ends: tuple[float, float], width: float) -> None:
    """The texts of the cells, as large as the columns let them be."""
    texts = [[spelled(text or "") for text in row] for row in trace.get("text") or ()]
    longest = max((len(text) for row in texts for text in row), default=0)
    if not longest:
        return
    size = min(NUMBER, max(SMALLEST, 7.0 * room_of_column(trace, width) / (SIGN_WIDTH * longest)))
    low, high = ends
    for i, row in enumerate(texts):
        for k, text in enumerate(row):
            dark = np.isfinite(z[i, k]) and z[i, k] > low + 0.55 * (high - low)
            axes.text(k + 0.5, i + 0.5, text, ha="center", va="center", fontsize=size, color="white" if dark else INK)


def add_scale(picture: Any, axes: Any, cells: Any, bar: dict[str, Any]) -> None:
    """The colours' scale at the right, with its words."""
    shown = picture.colorbar(cells, ax=axes, pad=0.01, aspect=12)
    shown.outline.set_visible(False)
    if bar.get("tickvals"):
        shown.set_ticks(bar["tickvals"], labels=[spelled(text) for text in bar.get("ticktext", bar["tickvals"])])
    title = bar.get("title", "")
    shown.set_label(spelled(title.get("text", "") if isinstance(title, dict) else title))
