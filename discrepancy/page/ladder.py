"""The ladder as a figure: the misfit in the patterns, attempt by attempt."""

from collections.abc import Sequence
from typing import Any

from discrepancy.ladder_step import Change, Step
from discrepancy.page.bars import noise_line
from discrepancy.words.sample_errors import OF_PATTERNS, PATTERNS
from pages import look
from pages.look import Figure, short
from pages.words import capital

# From this ratio of the largest to the smallest error on the axis is logarithmic.
WIDE = 8.0
KINDS = (("training", "fitted runs", look.START, 2.0), ("held_out", "unused runs", look.NOW, 3.0))


def stairs(steps: Sequence[Step], kind: str) -> tuple[list[float | None], list[float | None]]:
    """Corners of the line through the kept steps: step k falls at x = k."""
    x: list[float | None] = []
    y: list[float | None] = []
    for k, step in enumerate(steps, start=1):
        change = step.change(kind)
        if change is None:
            x.append(None)
            y.append(None)
            continue
        x += [k - 1 if k > 1 else 0.5, k]
        y += [change.before, change.before]
        if step.kept:
            x.append(k)
            y.append(change.after)
    if y and y[-1] is not None:
        x.append(len(steps) + 0.5)
        y.append(y[-1])
    return x, y


def attempts(steps: Sequence[Step], kind: str) -> list[tuple[int, Change, Step]]:
    """(place, errors, step) of the steps that were not kept."""
    return [(k, change, step) for k, step in enumerate(steps, start=1) if not step.kept and (change := step.change(kind)) is not None]


def figure(steps: Sequence[Step], name: str = "ladder") -> Figure:
    traces, values = [], []
    for kind, title, colour, width in KINDS:
        x, y = stairs(steps, kind)
        values += [v for v in y if v is not None]
        if any(v is not None for v in y):
            traces.append(look.line(x, clean(y), colour, width) | {"name": title})
            start = next(v for v in y if v is not None)
            traces.append(marks([x[y.index(start)]], [start], colour, "circle", [f"{title}, before: {start:.2f}"], kind == "held_out"))
        kept = [(k, change, s) for k, s in enumerate(steps, start=1) if s.kept and (change := s.change(kind)) is not None]
        if kept:
            traces.append(
                marks(
                    [k for k, _, _ in kept],
                    [change.after for _, change, _ in kept],
                    colour,
                    "circle",
                    [f"{s.label}, {title}: {change.before:.2f} → {change.after:.2f}" for _, change, s in kept],
                    kind == "held_out",
                )
            )
        for k, change, step in attempts(steps, kind):
            before, after = change.before, change.after
            values.append(after)
            traces.append(look.line([k, k], clean([before, after]), colour, 1.2, "dot") | {"showlegend": False})
            traces.append(
                marks(
                    [k],
                    [after],
                    colour,
                    "x",
                    [f"{step.label}, not kept, {title}: {before:.2f} → {after:.2f}"],
                    kind == "held_out",
                    "top right" if after > before else "bottom right",
                )
            )
    shape, text = noise_line()
    wide = bool(values) and min(values) > 0.0 and max(values) / min(values) > WIDE
    ticks = {
        "tickvals": list(range(1, len(steps) + 1)),
        "range": [0.4, len(steps) + 0.6],
        "showgrid": False,
        "ticktext": [f"{s.label}<br><i>{s.verdict}{'' if s.kept else ', not kept'}</i>" for s in steps],
    }
    limits = {"type": "log", "dtick": "D2"} if wide else {"rangemode": "tozero"}
    legend = {"orientation": "h", "x": 0, "y": 1.02, "yanchor": "bottom", "font": {"size": 11.5}}
    if wide:
        text["y"] = 0.0
    layout = look.layout(
        xaxis=look.axis("", **ticks),
        yaxis=look.axis(f"{PATTERNS}, over noise", **limits),
        showlegend=True,
        legend=legend,
        shapes=[shape],
        annotations=[text],
        margin={"l": 60, "r": 24, "t": 34, "b": 60},
    )
    caption = (
        f"Over all signals; {OF_PATTERNS}. A dotted line with a cross is an attempt "
        "that did not help: the model stayed as it was."
    )
    return Figure(name, f"{capital(PATTERNS)}, step by step", caption, traces, layout, 12, 380)


def clean(values: Sequence[float | None]) -> list[float | None]:
    shown: list[float | None] = short([float("nan") if v is None else v for v in values], 4)
    return shown


def marks(
    x: Sequence[float | None], y: Sequence[float], colour: str, symbol: str, texts: list[str], labelled: bool, where: str = "top right"
) -> dict[str, Any]:
    return {
        "type": "scatter",
        "mode": "markers+text" if labelled else "markers",
        "x": x,
        "y": clean(y),
        "showlegend": False,
        "customdata": texts,
        "marker": {"color": colour, "symbol": symbol, "size": 9},
        "hovertemplate": "%{customdata}<extra></extra>",
        "cliponaxis": False,
        "text": [f"{v:.2f}" for v in y],
        "textposition": where,
        "textfont": {"size": 12, "color": colour},
    }
