"""Orders of a misfit and of the effect that is to explain it."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from discrepancy.campaign.order_analysis import Complex, amplitudes, even_curve
from discrepancy.page import amounts
from discrepancy.page.runs import Run, axis_name, slug
from discrepancy.page.series import by_condition
from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from pages import look
from pages.content import Choice, Choosable
from pages.look import Figure, short
from pages.words import capital, counted

MOST_ORDERS = 200
SHOWN = 24
# Missing samples are bridged if no more than the rest of this share is missing; fewer than these show no orders.
LEAST_KEPT, FEWEST = 0.95, 32


@dataclass(frozen=True)
class Spectrum:
    """Complex amplitudes (SI) of the orders 0, 1, 2 ... of the output's turn, of the mean of ``repetitions`` over whole ``turns``.

    ``predicted`` is of the first of them; ``bridged``: how many of their samples were missing or stood far off.
    """

    turns: int
    repetitions: int
    bridged: int
    measured: Complex
    predicted: Complex
    residual: Complex


def over_angle(run: Run) -> bool:
    """Whether a run could have orders."""
    return axis_name(run.record) == "angle"


def spectrum(members: Sequence[Run]) -> Spectrum:
    """Of the repetitions that are alike; InputFault, which says why, where none of them has orders."""
    found: list[tuple[str, Spectrum]] = []
    faults: list[InputFault] = []
    for run in members:
        try:
            found.append((run.record.mounting, spectrum_of(run)))
        except InputFault as fault:
            faults.append(fault)
    if not found:
        raise faults[0]
    # Of another mounting angles count from elsewhere.
    (mounting, first), *_ = found
    alike = [s for where, s in found if (where, s.turns, s.measured.size) == (mounting, first.turns, first.measured.size)]
    mean = [np.mean([getattr(s, of) for s in alike], axis=0) for of in ("measured", "residual")]
    return Spectrum(first.turns, len(alike), sum(s.bridged for s in alike), mean[0], first.predicted, mean[1])


def spectrum_of(run: Run) -> Spectrum:
    """Of one run: what is missing, or stands far off, is bridged as in tables of orders that are made of curves."""
    name, there = run.record.name, ~run.outlying
    angle = np.asarray(run.record.axes["angle"], float)[run.kept][there]
    if angle.size < FEWEST:
        raise InputFault(f"{name}: {counted(angle.size, 'sample')}; orders need {FEWEST}")
    curves = [even_curve(angle, values[there], None, name) for values in (run.measured, run.predicted)]
    turns = curves[0].turns
    steps = np.abs(np.diff(angle))
    whole, step = 2.0 * np.pi * turns, float(np.median(steps[steps > 0.0]))
    size = round(whole / step)
    # Half a step less: where a turn ends the next one begins.
    bridged = max(size - int(np.count_nonzero(np.abs(angle - angle[0]) < whole - 0.5 * step)), 0)
    if bridged > (1.0 - LEAST_KEPT) * size:
        raise InputFault(f"{name}: {bridged:,} of {size:,} samples are missing; orders need {100 * LEAST_KEPT:g} % of them")
    orders = np.arange(min(size // turns // 2, MOST_ORDERS) + 1.0)
    measured, predicted = (amplitudes(curve, orders) for curve in curves)
    return Spectrum(turns, 1, bridged, measured, predicted, measured - predicted)


def sizes(found: Complex) -> Floats:
    """Amplitudes; that of order 0 counts for nothing."""
    return np.where(np.arange(found.size) > 0, np.abs(found), 0.0)


def bridged_text(count: int) -> str:
    """Empty where nothing was missing."""
    return f"{counted(count, 'sample')} missing or far off {'is' if count == 1 else 'are'} bridged." if count else ""


def spectra_of(cells: Mapping[str, Sequence[Run]]) -> tuple[dict[str, Spectrum], dict[str, str]]:
    """Of each of the ``cells`` of repetitions its orders, or why it has none; neither of runs that are not over the angle."""
    found, why = {}, {}
    for label, members in cells.items():
        if over := [run for run in members if over_angle(run)]:
            try:
                found[label] = spectrum(over)
            except InputFault as fault:
                why[label] = str(fault)
    return found, why


def none_text(why: Mapping[str, str]) -> str:
    """``no orders at 900rpm_50N.m and 2 other conditions (why)``; empty where all have some."""
    if not why:
        return ""
    label, reason = next(iter(why.items()))
    others = f" and {counted(len(why) - 1, 'other condition')}" if len(why) > 1 else ""
    return f"no orders at {label}{others} ({reason})."


def figure(prefix: str, signal: str, runs: Sequence[Run], words: tuple[str, str]) -> tuple[Figure | None, str]:
    """Orders at which the mean of the replicates, or the response, is largest; without orders nothing but why, empty where none are asked for."""
    found, why = spectra_of(by_condition(runs))
    if not found:
        return None, none_text(why)
    unit = runs[0].record.unit
    factor, _ = amounts.scale(unit, signal)
    spectra = {label: (factor * sizes(s.measured), factor * sizes(s.predicted)) for label, s in found.items()}
    size = min(len(a) for pair in spectra.values() for a in pair)
    most = np.max([np.maximum(a[:size], b[:size]) for a, b in spectra.values()], axis=0)
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
    caption = " ".join(filter(None, [
        f"Amplitudes of the mean of the replicates, at the {len(orders)} largest of the orders 1 to {size - 1}.",
        bridged_text(sum(s.bridged for s in found.values())), capital(none_text(why)),
    ]))  # fmt: skip
    drawn = Choosable(
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
    return drawn, ""
