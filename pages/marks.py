"""What is drawn into the axes of a picture: plotly's traces by matplotlib's means."""

import re
from collections.abc import Sequence
from html import unescape
from typing import Any

import numpy as np

from pages.look import Trace
from pages.words import units_in_print

# A pixel of the screen's strokes and signs, in points of print.
STROKE, SIGN = 0.6, 0.55
# What a sign of a label takes [mm].
SIGN_WIDTH = 1.3
INCH = 25.4
DASHES = {"solid": "-", "dash": "--", "dot": ":", "dashdot": "-.", "longdash": (0, (8, 3))}
SYMBOLS = {
    "circle": "o", "diamond": "D", "square": "s", "x": "x", "cross": "+", "triangle-up": "^", "line-ew-open": "_", "line-ns-open": "|", "circle-open": "o",
}  # fmt: skip
COLOUR = re.compile(r"rgba?\(([^)]*)\)")


def spelled(text: Any) -> str:
    """A text of the page without its marks."""
    plain = re.sub(r"<br\s*/?>", "\n", str(text))
    # A dollar sign would begin mathematics.
    return units_in_print(unescape(re.sub(r"<[^>]+>", "", plain))).replace("$", r"\$")


def colour_of(text: Any) -> Any:
    """A colour as matplotlib takes it."""
    if isinstance(text, str) and (match := COLOUR.fullmatch(text.strip())):
        parts = [float(part) for part in match[1].split(",")]
        return (*(value / 255.0 for value in parts[:3]), parts[3] if len(parts) > 3 else 1.0)
    return text


def numbers(values: Any) -> Any:
    """Values with gaps as NaN; words stay as they are."""
    if values is None:
        return None
    return values if any(isinstance(v, str) for v in values) else np.array([np.nan if v is None else v for v in values], float)


def name_of(trace: Trace) -> str:
    """What the legend calls it; matplotlib leaves out names that begin with an underscore."""
    return spelled(trace["name"]) if trace.get("name") and trace.get("showlegend", True) else "_"


def line_of(axes: Any, trace: Trace) -> None:
    """Lines, markers, bands and texts of a scatter trace."""
    y = numbers(trace["y"])
    x = trace.get("x0", 0.0) + trace.get("dx", 1.0) * np.arange(len(y)) if trace.get("x") is None else numbers(trace["x"])
    mode, stroke, sign = str(trace.get("mode", "lines")), trace.get("line", {}), trace.get("marker", {})
    opacity = trace.get("opacity", 1.0)
    if trace.get("fill") == "toself":
        axes.fill(x, y, facecolor=colour_of(trace.get("fillcolor", "#98a3af")), edgecolor="none", label=name_of(trace), zorder=1.2)
        if stroke.get("width"):
            axes.plot(x, y, color=colour_of(stroke.get("color", "#0b4f94")), linewidth=STROKE * float(stroke["width"]))
        return
    if trace.get("fill") == "tozeroy":
        axes.fill_between(x, 0.0, y, facecolor=colour_of(trace.get("fillcolor", "#98a3af")), edgecolor="none", zorder=1.2)
    symbol = str(sign.get("symbol", "circle")) if isinstance(sign.get("symbol", "circle"), str) else "circle"
    own = sign.get("color", "#0b4f94")
    colour = colour_of(stroke.get("color") or (own[0] if isinstance(own, list) else own))
    if "lines" in mode or "markers" in mode:
        style = {
            "color": colour, "linestyle": DASHES.get(stroke.get("dash", "solid"), "-") if "lines" in mode else "none",
            "linewidth": STROKE * float(stroke.get("width", 2.0)), "alpha": opacity, "label": name_of(trace),
            "drawstyle": "steps-mid" if stroke.get("shape") == "hvh" else "default",
        }  # fmt: skip
        if "markers" in mode:
            size = sign.get("size", 6)
            style |= {"marker": SYMBOLS.get(symbol, "o"), "markersize": SIGN * float(np.mean(size)), "markerfacecolor": "none" if "open" in symbol else None}
            style["markeredgewidth"] = STROKE * float(sign.get("line", {}).get("width", 0.8))
            style = {key: value for key, value in style.items() if value is not None}
        if "markers" in mode and isinstance(own, list):
            axes.scatter(x, y, s=(SIGN * float(np.mean(sign.get("size", 6)))) ** 2, c=[colour_of(c) for c in own], zorder=3)
        else:
            axes.plot(x, y, **style)
    if (bar := trace.get("error_y")) and bar.get("visible", True) and bar.get("array") is not None:
        axes.errorbar(x, y, numbers(bar["array"]), fmt="none", ecolor=colour, elinewidth=STROKE, capsize=1.5, alpha=opacity)
    if "text" in mode and isinstance(trace.get("text"), list):
        for place in zip(x, y, trace["text"]):
            axes.annotate(spelled(place[2]), place[:2], fontsize=6.5, xytext=(2, 2), textcoords="offset points")


def bars(axes: Any, trace: Trace, alike: Sequence[Trace]) -> None:
    """Bars beside those of the other traces, with their texts at the end."""
    place = next(k for k, other in enumerate(alike) if other is trace)
    lying = trace.get("orientation") == "h"
    words, lengths = (trace["y"], trace["x"]) if lying else (trace["x"], trace["y"])
    thick = 0.7 / len(alike)
    worded = any(isinstance(word, str) for word in words)
    at = np.arange(len(words)) if worded else np.array(words, float)
    spacing = 1.0 if worded or len(at) < 2 else float(np.min(np.diff(np.sort(at)))) or 1.0
    at = at + spacing * thick * (place - 0.5 * (len(alike) - 1))
    colour = trace.get("marker", {}).get("color", "#0b4f94")
    colours = [colour_of(c) for c in colour] if isinstance(colour, list) else colour_of(colour)
    values = np.nan_to_num(np.array(numbers(lengths), float))
    base = trace.get("base", 0.0) or 0.0
    drawn = (axes.barh if lying else axes.bar)(at, values, spacing * thick, base, color=colours, label=name_of(trace), zorder=2)
    if isinstance(trace.get("text"), list):
        axes.bar_label(drawn, [spelled(text) for text in trace["text"]], padding=2, fontsize=6.5)
    names = [spelled(word) for word in words]
    if worded and lying:
        axes.set_yticks(np.arange(len(words)), names)
    elif worded:
        named = standing_apart(axes, names, [max(abs(float(v or 0.0)) for v in tall) for tall in zip(*(other["y"] for other in alike))])
        axes.set_xticks(named, [names[k] for k in named])


def standing_apart(axes: Any, names: Sequence[str], tall: Sequence[float]) -> list[int]:
    """Places of upright bars whose names do not run together below the axis, as the page has them: the tallest keep theirs first."""
    cell = INCH * axes.figure.get_figwidth() * axes.get_position().width / len(names)
    wide = [SIGN_WIDTH * max(len(line) for line in name.split("\n")) for name in names]
    kept: list[int] = []
    for k in sorted(range(len(names)), key=lambda k: -tall[k]):
        if all(abs(k - other) * cell > 0.5 * (wide[k] + wide[other]) + SIGN_WIDTH for other in kept):
            kept.append(k)
    return sorted(kept)


def polar_curve(axes: Any, trace: Trace) -> None:
    """A closed row over the angle."""
    stroke = trace.get("line", {})
    axes.plot(np.radians(numbers(trace["theta"])), numbers(trace["r"]), color=colour_of(stroke.get("color", "#0b4f94")), label=name_of(trace),
              linewidth=STROKE * float(stroke.get("width", 2.0)), linestyle=DASHES.get(stroke.get("dash", "solid"), "-"))  # fmt: skip
