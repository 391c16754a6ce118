"""Measured and predicted series, one figure per signal, condition by condition."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from discrepancy.page import amounts, panels
from discrepancy.page.runs import Run, axis_of, slug
from fmu_src.arrays import Floats
from pages.content import Choice, Choosable
from pages.look import Figure, short
from pages.words import ordinal

# Samples drawn of one series: fewer where there are many conditions, so that the page stays small.
SAMPLES, FEWEST, MOST = 40_000, 800, 3_000
MOST_REPLICATES = 4
# Where runs were written at several heights.
FREE = " The zero of this quantity is free: every run is drawn at its fitted zero."
# Where a sample stands far off.
FAR = " A diamond is a sample that stands far off: it lies outside of the axis, its number shows where one points at it."
# Where a repetition was left out.
GONE = " Dashed in grey is a repetition that is left out of fit, noise and errors; where it would press the others flat it shows when its name is clicked."
EMPTY: dict[str, list[float]] = {"x": [], "y": []}


def figure(
    prefix: str,
    signal: str,
    runs: Sequence[Run],
    words: tuple[str, str, str] = panels.WORDS,
    caption: str = "",
    gone: Sequence[Run] = (),
) -> Figure:
    """Every condition of one signal behind a selector; ``words`` name measured, predicted and their difference; ``gone``: repetitions that are left out."""
    unit = runs[0].record.unit
    every = by_condition([*runs, *gone])
    cells = {label: [r for r in members if not r.record.left_out] for label, members in every.items()}
    apart = {label: [r for r in members if r.record.left_out] for label, members in every.items()}
    width = min(max(len(members) for members in cells.values()), MOST_REPLICATES)
    title = amounts.axis_title(axis_of(runs[0]))
    traces = template(words, width) + [dashed()] * bool(gone) + [mark(words[0])] * any(run.outlying.any() for run in runs)
    most = min(max(SAMPLES // len(cells), FEWEST), MOST)
    choices = [
        Choice(label, [*updates(members[:width], unit, width, most), *([away(apart[label], members, unit, most)] if gone else []),
                       *marks(members[:width], unit, traces)])
        for label, members in cells.items()
    ]  # fmt: skip
    step = max(stride(run, most) for run in runs)
    longest = max(len(members) for members in cells.values())
    text = caption or f"The band is two standard deviations of the noise of {whose_noise(runs)} around the blue line."
    text += FREE if any(run.zero for run in runs) else ""
    text += GONE if gone else ""
    text += FAR if any(run.outlying.any() for run in runs) else ""
    text += f" Every {ordinal(step)} sample is drawn." if step > 1 else ""
    text += f" {MOST_REPLICATES} of up to {longest} replicates are drawn." if longest > MOST_REPLICATES else ""
    layout = panels.layout(amounts.signal_axis(signal, unit), "difference", xaxis=panels.x_axis(title))
    first = [t | u for t, u in zip(traces, choices[0].traces)]
    return Choosable(
        f"{prefix}_{slug(signal)}",
        amounts.signal_title(signal).capitalize(),
        text,
        first,
        layout,
        12,
        380,
        asks="condition",
        choices=choices,
    )


def whose_noise(runs: Sequence[Run]) -> str:
    """Of what the band is: means of repetitions have a narrower one than a run."""
    counts = sorted({run.mean_of for run in runs})
    if counts == [1]:
        return "a single run"
    return f"a mean of {' or '.join(map(str, counts))} replicates{' (1: a single run)' if counts[0] == 1 else ''}"


def by_condition(runs: Sequence[Run]) -> dict[str, list[Run]]:
    """Runs that repeat each other, fitted conditions first; those of another mounting count angles from elsewhere."""
    mounted: dict[str, set[str]] = {}
    for run in runs:
        mounted.setdefault(run.record.condition, set()).add(run.record.mounting)
    cells: dict[str, list[Run]] = {}
    for run in sorted(runs, key=lambda r: r.record.held_out):
        record = run.record
        label = record.condition + (f", mounting {record.mounting}" if len(mounted[record.condition]) > 1 else "")
        cells.setdefault(label + (" (held out)" if record.held_out else ""), []).append(run)
    return cells


def template(words: tuple[str, str, str], width: int) -> list[dict[str, Any]]:
    """The traces without data: bands, measured, predicted, differences."""
    area: dict[str, Any] = {"type": "scatter", "mode": "lines", "fill": "toself", "fillcolor": panels.BAND, "line": {"width": 0}, "hoverinfo": "skip"}
    dots: dict[str, Any] = {"type": "scatter", "mode": "lines", "line": {"color": panels.MEASURED, "width": 1}}
    # A prediction lies on top, dashed, so that what was measured is seen under it where they agree.
    agreeing = words == panels.WORDS
    broad: dict[str, Any] = {"line": {"color": panels.MEASURED, "width": 2.4}} if agreeing else {}
    traces = [area | {"name": "noise, 2 σ"}, area | {"yaxis": "y2", "showlegend": False}]
    for k in range(width):
        look_of = {"opacity": 0.9 - 0.15 * k, "hovertemplate": f"{words[0]}, replicate {k + 1}: %{{y}} at %{{x}}<extra></extra>"}
        traces.append(dots | look_of | broad | {"name": words[0], "legendgroup": "measured", "showlegend": k == 0})
        traces.append(
            dots
            | look_of
            | {
                "name": words[2],
                "yaxis": "y2",
                "showlegend": False,
                "hovertemplate": f"{words[2]}, replicate {k + 1}: %{{y}} at %{{x}}<extra></extra>",
            }
        )
    traces.append(
        {
            "type": "scatter",
            "mode": "lines",
            "line": {"color": panels.PREDICTED, "width": 1.6, "dash": "dash" if agreeing else "solid"},
            "name": words[1],
            "hovertemplate": f"{words[1]}: %{{y}} at %{{x}}<extra></extra>",
        }
    )
    return traces


def updates(members: Sequence[Run], unit: str, width: int, most: int) -> list[dict[str, Any]]:
    """What the traces show at one condition."""
    factor, _ = amounts.scale(unit, members[0].record.quantity)
    first = thinned(members[0], most)
    x, predicted, noise = first[0], factor * first[2], 2.0 * factor * rms(members[0].noise)
    ends = np.array([x.min(), x.max()])
    found: list[dict[str, Any]] = [
        points(panels.band(x, predicted - noise, predicted + noise, "")),
        points(panels.band(ends, np.full(2, -noise), np.full(2, noise), "")),
    ]
    for k in range(width):
        if k < len(members):
            at, measured, own = thinned(members[k], most)
            found.append({"x": short(at, 5), "y": short(factor * measured, 4)})
            found.append({"x": short(at, 5), "y": short(factor * (measured - own), 3)})
        else:
            found += [EMPTY, EMPTY]
    found.append({"x": short(x, 5), "y": short(predicted, 4)})
    return found


def mark(word: str) -> dict[str, Any]:
    """The trace of samples that stand far off: at the edge of what is drawn, their numbers in words."""
    return {"type": "scatter", "mode": "markers", "showlegend": False, "marker": {"color": panels.MEASURED, "symbol": "diamond", "size": 9},
            "hovertemplate": f"{word}, far off: %{{text}} at %{{x}}<extra></extra>"}  # fmt: skip


def marks(members: Sequence[Run], unit: str, traces: Sequence[dict[str, Any]]) -> list[dict[str, Any]]:
    """What ``mark`` shows at one condition; nothing where ``traces`` have none."""
    if traces[-1].get("mode") != "markers":
        return []
    factor, _ = amounts.scale(unit, members[0].record.quantity)
    every = np.concatenate([run.inside for run in members])
    low, high = factor * np.nanmin(every), factor * np.nanmax(every)
    x = np.concatenate([axis_values(run)[run.outlying] for run in members])
    values = factor * np.concatenate([run.measured[run.outlying] for run in members])
    above = values > 0.5 * (low + high)
    return [{"x": short(x, 5), "y": short(np.where(above, high, low), 4), "text": [f"{v:.4g}" for v in values]}]


def dashed() -> dict[str, Any]:
    """The trace of repetitions that are left out."""
    return {"type": "scatter", "mode": "lines", "line": {"color": panels.FAINT, "width": 1.4, "dash": "dash"}, "name": panels.LEFT_OUT, "connectgaps": False,
            "hovertemplate": "%{text}, left out: %{y} at %{x}<extra></extra>"}  # fmt: skip


def away(gone: Sequence[Run], members: Sequence[Run], unit: str, most: int) -> dict[str, Any]:
    """What ``dashed`` shows at one condition, one after another with a gap between."""
    if not gone:
        return {**EMPTY, "text": [], "showlegend": False}
    factor, _ = amounts.scale(unit, gone[0].record.quantity)
    drawn = [(*thinned(run, most)[:2], run.record.name) for run in gone]
    gap = [np.nan]
    x, y = (np.concatenate([part for run in drawn for part in (run[k], gap)]) for k in (0, 1))
    return {"x": short(x, 5), "y": short(factor * y, 4), "text": [name for at, _, name in drawn for _ in (*at, *gap)], "showlegend": True,
            "visible": "legendonly" if reach(gone) > panels.PRESSING * reach(members) else True}  # fmt: skip


def reach(runs: Sequence[Run]) -> float:
    """What curves span together."""
    return float(np.ptp([bound for run in runs for bound in (np.nanmin(run.inside), np.nanmax(run.inside))]))


def points(trace: dict[str, Any]) -> dict[str, Any]:
    return {k: trace[k] for k in ("x", "y")}


def thinned(run: Run, most: int) -> tuple[Floats, Floats, Floats]:
    """(axis, measured, predicted) with at most ``most`` samples."""
    x, step = axis_values(run), stride(run, most)
    return x[::step], run.inside[::step], run.predicted[::step]


def axis_values(run: Run) -> Floats:
    name = axis_of(run)
    return amounts.axis_values(name, np.asarray(run.record.axes[name])[run.kept])


def stride(run: Run, most: int) -> int:
    return max(1, int(np.ceil(run.measured.size / most)))


def rms(values: npt.ArrayLike) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
