"""Two plots over one axis: values above, what is left of them below."""

from typing import Any

import numpy as np

from fmu_src.arrays import Floats
from pages import look

MEASURED, PREDICTED, HELD, BAND = "#7d8894", look.NOW, "#d55e00", "rgba(11,79,148,0.14)"
# A repetition that is left out: its name, its grey, and from how many times what the others span on it would press them flat, and shows when asked for.
LEFT_OUT, FAINT, PRESSING = "left out", "#a3acb5", 4.0
WORDS = ("measured", "predicted", "measured − predicted")
# A way back by less than this share of the whole axis is noise of the axis.
TURN = 0.02
UPPER, LOWER = [0.40, 1.0], [0.0, 0.30]


def layout(y_title: str, lower_title: str, **more: Any) -> dict[str, Any]:
    legend = {"orientation": "h", "x": 0, "y": 1.02, "yanchor": "bottom", "font": {"size": 11.5}}
    return look.layout(
        yaxis=look.axis(y_title, domain=UPPER, automargin=True),
        showlegend=True,
        legend=legend,
        yaxis2=look.axis(lower_title, domain=LOWER, zeroline=True, zerolinecolor="#aab4be"),
        margin={"l": 64, "r": 16, "t": 30, "b": 46},
        **more,
    )


def x_axis(title: str, **more: Any) -> dict[str, Any]:
    return look.axis(title, anchor="y2", **more)


def ways(x: Floats) -> list[slice]:
    """Stretches of an axis (n,) between the places where it turns back for good; each begins with the last point of the one before."""
    turns, sense, furthest = [0], 0.0, 0
    least = TURN * float(np.ptp(x)) if len(x) else 0.0
    for i in range(len(x)):
        off = float(x[i] - x[furthest])
        if off * sense > 0.0 or (sense == 0.0 and abs(off) > least):
            furthest, sense = i, sense or float(np.sign(off))
        elif abs(off) > least:
            turns.append(furthest)
            furthest, sense = i, -sense
    ends = [*turns[1:], len(x) - 1]
    return [slice(a, b + 1) for a, b in zip(turns, ends) if b > a]


def band(x: Floats, low: Floats, high: Floats, name: str, axis: str = "y") -> dict[str, Any]:
    """A closed area between two lines; of a loop one for each way, for an area that crosses itself is half empty.

    All are walked around in the same sense: where one lies on another of the opposite sense, browsers leave both empty.
    """
    xs: list[Floats] = []
    ys: list[Floats] = []
    for way in ways(x):
        back = x[way][0] > x[way][-1]
        upper, lower = (low, high) if back else (high, low)
        xs += [x[way], x[way][::-1], np.array([np.nan])]
        ys += [upper[way], lower[way][::-1], np.array([np.nan])]
    return {
        "type": "scatter",
        "mode": "lines",
        "x": look.short(np.concatenate(xs[:-1]), 5) if xs else [],
        "y": look.short(np.concatenate(ys[:-1]), 4) if ys else [],
        "fill": "toself",
        "fillcolor": BAND,
        "line": {"width": 0},
        "hoverinfo": "skip",
        "name": name,
        "yaxis": axis,
    }
