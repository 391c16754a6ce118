"""Orders of a misfit and of the effect that is to explain it."""

from collections.abc import Sequence

import numpy as np

from discrepancy.page import amounts
from discrepancy.page.runs import Run, slug
from discrepancy.page.series import by_condition
from fmu_src.arrays import Floats
from pages import look
from pages.content import Choice, Choosable
from pages.look import Figure, short

MOST_ORDERS = 200
SHOWN = 24
# Gaps are bridged if no more than the rest is missing.
LEAST_KEPT = 0.95


def turns(run: Run) -> int:
    """Whole turns of the output that the run covers evenly; 0: none."""
    angle = run.record.axes.get("angle")
    if angle is None or run.kept.mean() < LEAST_KEPT or np.size(angle) != run.kept.size or np.size(angle) < 32:
        return 0
    steps = np.abs(np.diff(angle))
    if np.ptp(steps) > 0.01 * np.median(steps):
        return 0
    whole = (np.ptp(angle) + np.median(steps)) / (2.0 * np.pi)
    return round(whole) if whole > 0.5 and abs(whole - round(whole)) < 1e-3 else 0


def bridged(run: Run, values: Floats) -> Floats:
    """Values of the kept samples at all samples, without those that stand far off."""
    return np.interp(np.arange(run.kept.size), np.flatnonzero(run.kept)[~run.outlying], values[~run.outlying])


def amplitudes(values: Floats, whole: int) -> Floats:
    """Amplitude at orders 0, 1, 2 ..."""
    found = 2.0 * np.abs(np.fft.rfft(values)) / values.size
    return found[::whole][: MOST_ORDERS + 1]


def figure(prefix: str, signal: str, runs: Sequence[Run], words: tuple[str, str]) -> Figure | None:
    """Orders at which the mean of the replicates, or the response, is largest; None without whole turns."""
    cells = {label: members for label, members in by_condition(runs).items() if turns(members[0])} if runs else {}
    if not cells:
        return None
    unit = runs[0].record.unit
    factor, _ = amounts.scale(unit, signal)
    spectra = {}
    for label, members in cells.items():
        alike = [r for r in members if turns(r) == turns(members[0]) and r.kept.size == members[0].kept.size]
        mean = np.mean([bridged(r, r.measured) for r in alike], axis=0)
        spectra[label] = (
            factor * amplitudes(mean, turns(alike[0])),
            factor * amplitudes(bridged(alike[0], alike[0].predicted), turns(alike[0])),
        )
    size = min(len(a) for pair in spectra.values() for a in pair)
    most = np.max([np.maximum(a[:size], b[:size]) for a, b in spectra.values()], axis=0)
    most[0] = 0.0
    orders = sorted(int(o) for o in np.argsort(most)[::-1][:SHOWN] if o > 0)
    names = [str(o) for o in orders]
    choices = [Choice(label, [{"y": short(a[orders], 4)}, {"y": short(b[orders], 4)}]) for label, (a, b) in spectra.items()]
    data = [
        {
            "type": "bar",
            "name": word,
            "x": names,
            "marker": {"color": colour},
            "hovertemplate": f"order %{{x}}, {word}: %{{y}}<extra></extra>",
        }
        for word, colour in zip(words, (look.START, look.NOW))
    ]
    legend = {"orientation": "h", "x": 0, "y": 1.02, "yanchor": "bottom", "font": {"size": 11.5}}
    layout = look.layout(
        barmode="group",
        showlegend=True,
        legend=legend,
        xaxis=look.axis("order of the output's turn", type="category", tickangle=0),
        yaxis=look.axis(amounts.signal_axis(signal, unit), rangemode="tozero"),
        margin={"l": 64, "r": 16, "t": 30, "b": 46},
    )
    first = [t | u for t, u in zip(data, choices[0].traces)]
    caption = f"Amplitudes of the mean of the replicates, at the {len(orders)} largest of the orders 1 to {size - 1}."
    return Choosable(
        f"{prefix}_{slug(signal)}",
        f"{amounts.signal_title(signal).capitalize()}: orders",
        caption,
        first,
        layout,
        12,
        260,
        asks="condition",
        choices=choices,
    )
