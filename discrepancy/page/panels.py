"""Two plots over one axis: values above, what is left of them below."""

from typing import Any

import numpy as np

from fmu_src.arrays import Floats
from pages import look

MEASURED, PREDICTED, HELD, BAND = "#7d8894", look.NOW, "#d55e00", "rgba(11,79,148,0.14)"
WORDS = ("measured", "predicted", "measured − predicted")
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


def band(x: Floats, low: Floats, high: Floats, name: str, axis: str = "y") -> dict[str, Any]:
    """A closed area between two lines."""
    return {
        "type": "scatter",
        "mode": "lines",
        "x": look.short(np.concatenate([x, x[::-1]]), 5),
        "y": look.short(np.concatenate([high, low[::-1]]), 4),
        "fill": "toself",
        "fillcolor": BAND,
        "line": {"width": 0},
        "hoverinfo": "skip",
        "name": name,
        "yaxis": axis,
    }
