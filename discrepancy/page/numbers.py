"""Single numbers over the factors of their conditions, with error bars."""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from discrepancy.page import amounts, panels
from discrepancy.page.runs import Run, slug
from discrepancy.problem import SAMPLE
from fmu_src.arrays import Floats
from pages.content import Choice, Choosable
from pages.look import Figure, short

CONDITION = "condition"
GONE = " Grey rings are repetitions that are left out of fit, noise and errors."


def figure(
    prefix: str,
    signal: str,
    runs: Sequence[Run],
    words: tuple[str, str, str] = panels.WORDS,
    caption: str = "",
    gone: Sequence[Run] = (),
) -> Figure:
    """All numbers of one signal; the selector chooses what they are drawn over; ``gone``: repetitions that are left out."""
    unit = runs[0].record.unit
    names = [*varying(runs), CONDITION]
    choices = []
    for name in names:
        axis = panels.x_axis(CONDITION, type="category") if name == CONDITION else panels.x_axis(amounts.axis_title(name, runs[0].speed), type="linear")
        choices.append(
            Choice("each condition" if name == CONDITION else name.replace("_", " "), updates(runs, name, unit) + away(gone, name, unit), {"xaxis": axis})
        )
    layout = panels.layout(amounts.signal_axis(signal, unit), "difference", xaxis=choices[0].layout["xaxis"])
    traces = [t | u for t, u in zip(template(words) + [ringed()] * bool(gone), choices[0].traces)]
    text = caption or f"Dots: {words[0]}; bars are two standard deviations of the noise. Below, {words[2]}."
    text += GONE if gone else ""
    return Choosable(
        f"{prefix}_{slug(signal)}", amounts.signal_title(signal).capitalize(), text, traces, layout, 6, 360, asks="over", choices=choices
    )


def varying(runs: Sequence[Run]) -> list[str]:
    """Factors, and axes of short rows, that are given everywhere and differ."""
    names = dict.fromkeys(n for run in runs for n in (*run.record.factors, *run.record.axes) if n != SAMPLE)
    found = []
    for name in names:
        values = [v for run in runs if (v := places(run, name)) is not None]
        if len(values) == len(runs) and all(np.all(np.isfinite(v)) for v in values):
            every = np.concatenate(values)
            if np.ptp(every) > 1e-9 * np.max(np.abs(every)):
                found.append(name)
    return found


def places(run: Run, name: str) -> Floats | None:
    """The factor's value at each number of a run."""
    if name in run.record.axes and np.size(run.record.axes[name]) == run.kept.size:
        return np.asarray(run.record.axes[name], np.float64)[run.kept]
    if name in run.record.factors:
        return np.full(run.measured.size, float(run.record.factors[name]))
    return None


def placed(run: Run, name: str) -> Floats:
    """``places`` of a name that ``varying`` found."""
    values = places(run, name)
    if values is None:
        raise KeyError(f"{run.record.name} has no {name}")
    return values


def template(words: tuple[str, str, str]) -> list[dict[str, Any]]:
    """Measured (fitted, held out), predicted, differences (fitted, held out)."""
    traces = []
    for label, colour, symbol in (("fitted runs", panels.MEASURED, "circle"), ("held-out runs", panels.HELD, "diamond")):
        for axis, word in (("y", words[0]), ("y2", words[2])):
            traces.append(
                {
                    "type": "scatter",
                    "mode": "markers",
                    "yaxis": axis,
                    "name": label,
                    "showlegend": axis == "y",
                    "marker": {"color": colour, "symbol": symbol, "size": 7, "opacity": 0.85},
                    "hovertemplate": f"%{{text}}, {label}<br>{word}: %{{y}}<extra></extra>",
                }
            )
    return [
        *traces,
        {
            "type": "scatter",
            "mode": "markers",
            "name": words[1],
            "marker": {"color": panels.PREDICTED, "symbol": "line-ew-open", "size": 15, "line": {"width": 2.4}},
            "hovertemplate": f"{words[1]}: %{{y}}<extra></extra>",
        },
    ]


def updates(runs: Sequence[Run], name: str, unit: str) -> list[dict[str, Any]]:
    factor, _ = amounts.scale(unit, runs[0].record.quantity)
    found = []
    for held in (False, True):
        members = [r for r in runs if r.record.held_out == held]
        x = where(members, name)
        bars = {
            "type": "data",
            "array": short(2.0 * factor * joined(members, lambda r: r.noise), 3),
            "thickness": 1,
            "width": 3,
            "visible": True,
        }
        texts = [r.record.name for r in members for _ in r.measured]
        both = {"x": x, "error_y": bars, "text": texts}
        found.append(both | {"y": short(factor * joined(members, lambda r: r.measured), 5)})
        found.append(both | {"y": short(factor * joined(members, lambda r: r.measured - r.predicted), 3)})
    # Replicates have the same prediction: drawn once.
    marks = dict.fromkeys(zip(where(runs, name), short(factor * joined(runs, lambda r: r.predicted), 5)))
    return [*found, {"x": [a for a, _ in marks], "y": [b for _, b in marks]}]


def ringed() -> dict[str, Any]:
    """The trace of repetitions that are left out."""
    return {"type": "scatter", "mode": "markers", "name": panels.LEFT_OUT, "marker": {"color": panels.FAINT, "symbol": "circle-open-dot", "size": 9},
            "hovertemplate": "%{text}, left out: %{y}<extra></extra>"}  # fmt: skip


def away(gone: Sequence[Run], name: str, unit: str) -> list[dict[str, Any]]:
    """What ``ringed`` shows over one name, of runs that have it; nothing where there is no such trace."""
    if not gone:
        return []
    members = [r for r in gone if name == CONDITION or places(r, name) is not None]
    factor, _ = amounts.scale(unit, gone[0].record.quantity)
    return [{"x": where(members, name), "y": short(factor * joined(members, lambda r: r.measured), 5),
             "text": [r.record.name for r in members for _ in r.measured]}]  # fmt: skip


def where(runs: Sequence[Run], name: str) -> list[Any]:
    if name == CONDITION:
        return [r.record.condition for r in runs for _ in r.measured]
    if not runs:
        return []
    found: list[float | None] = short(amounts.axis_values(name, joined(runs, lambda r: placed(r, name)), runs[0].speed), 5)
    return found


def joined(runs: Sequence[Run], take: Callable[[Run], Floats]) -> Floats:
    return np.concatenate([take(r) for r in runs]) if runs else np.zeros(0)
