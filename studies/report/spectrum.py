"""Transmission error over an output turn, its orders, and what may cause them."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from pages import look
from pages.look import Figure, short
from pages.words import hour_text, number
from studies.report.result import Result

# Orders that far below the largest are not drawn.
DEPTH = 2e3
# A cause is named for an order this close to it.
NEAR = 0.6
LARGEST = 12
# Of a letter along a mark that stands upright [px].
LETTER = 6.4


@dataclass(frozen=True)
class Cause:
    """An order per output turn and what makes it."""

    order: float
    text: str


def causes(result: Result) -> list[Cause]:
    """Known orders of this reducer per output turn, from its counts and radii."""
    t, plant = result.topology, result.plant
    inner, outer = plant["inner_race_radius"], plant["outer_race_radius"]
    passing = t.rollers * t.pins / (inner + outer)
    known = [
        Cause(t.lobes, "crank in the housing"),
        Cause(t.pins, "crank against the carrier"),
        Cause(2 * t.lobes, "2 × crank in the housing (pin positions)"),
        Cause(2 * t.pins, "2 × crank against the carrier (needle clearance)"),
        Cause(t.lobes * t.pins, "pin meshing"),
        Cause(t.pins * inner / (inner + outer), "roller cages in the discs"),
        Cause(passing * outer, "rollers passing the inner raceway"),
        Cause(passing * inner, "rollers passing the outer raceway"),
    ]
    if plant["first_stage_ratio"] > 0.0:
        times = plant["first_stage_ratio"]
        ratio = 1.0 + times * t.pins
        # A whole first stage puts the sun's turns on a harmonic of the cranks', which holes of a disc make, too.
        also = f", and {round(times)} × crank against the carrier" if times > 1.5 and abs(times - round(times)) < 1e-9 else ""
        known += [Cause(ratio, "sun in the housing"), Cause(ratio - 1.0, "sun against the carrier" + also)]
    return sorted(known, key=lambda cause: cause.order)


def explanation(result: Result, order: int) -> str:
    """What an order may come from: a known one, a multiple, or one beside it; '' if nothing fits."""
    t = result.topology
    step = t.discs * t.pins
    known = causes(result)
    found = [c.text for c in known if abs(c.order - order) < NEAR]
    multiple = round(order / step)
    if not found and multiple > 1 and abs(order - multiple * step) < NEAR:
        found.append(f"{multiple * step // t.pins} × crank against the carrier")
    sources = [c for c in known if c.text.startswith(("rollers", "pin meshing"))]
    beside = []
    for cause in sources:
        for k in range(1, 7):
            for sign, symbol in ((1, "+"), (-1, "−")):
                if abs(abs(cause.order + sign * k * step) - order) < NEAR:
                    beside.append((k, f"{cause.text} {symbol} {k * step:g}"))
    found += [text for _, text in sorted(beside)[: max(0, 2 - len(found))]]
    return "; or ".join(found[:2])


def ends(result: Result) -> list[int]:
    """Entries of ``spectrum_hour`` to compare."""
    count = result.dataset.sizes.get("spectrum_hour", 0)
    return [0, count - 1] if count > 1 else [0] * count


def figures(result: Result) -> list[Figure]:
    """Spectrum, whole output turn, and a stretch of it; none if no spectrum was recorded."""
    if not ends(result):
        return []
    return [stems(result), turn(result, False), turn(result, True)]


def keys(result: Result) -> list[tuple[str, str, str]]:
    hours = result["spectrum_hour"]
    colours = (look.START, look.NOW) if len(ends(result)) > 1 else (look.NOW,)
    return [(hour_text(hours[i]), colour, "solid") for i, colour in zip(ends(result), colours)]


def stems(result: Result) -> Figure:
    """Amplitude over order, both logarithmic."""
    orders = result["order"]
    entries = ends(result)
    amplitude = result["order_amplitude"]
    top = float(amplitude[entries].max()) or 1.0
    floor = 10.0 ** round(math.log10(top / DEPTH))
    traces = []
    for i, (text, colour, _) in zip(entries, keys(result)):
        kept = amplitude[i] > floor
        x, y = orders[kept], amplitude[i][kept]
        width = 1.4 if i == entries[-1] else 3.2
        sticks = np.stack((np.full_like(y, floor), y, np.full_like(y, np.nan)), axis=1)
        traces.append(look.line(short(np.repeat(x, 3), 5), short(sticks.ravel(), 6), colour, width))
        traces.append({
            "type": "scatter", "mode": "markers", "x": x.tolist(), "y": short(y, 6), "text": named(result, x, y, top),
            "marker": {"size": 4 if i == entries[-1] else 5, "color": colour},
            "hovertemplate": f"order %{{x}}, {text}: %{{y:.3~g}} arcsec %{{text}}<extra></extra>",
        })  # fmt: skip
    marks, shapes, before, high = [], [], 0.0, False
    for place, text in grouped(causes(result)):
        # Close neighbours at two heights, for narrow screens.
        high = place < 1.5 * before and not high
        shape, label = look.upright(round(place, 3), text)
        # plotly.js takes annotations of a logarithmic axis as exponents, shapes as values.
        marks.append(label | {"x": round(math.log10(place), 5), "textangle": -90, "yshift": 40 if high else 4})
        shapes.append(shape)
        before = place
    above = max((mark["yshift"] + LETTER * len(mark["text"]) for mark in marks), default=0.0)
    picture = look.layout(
        xaxis=look.axis("order per output turn", type="log", range=[-0.05, round(math.log10(orders[-1] * 1.08), 4)],
                        tickvals=[1, 3, 10, 30, 100, 300, 1000, 3000], tickangle=0),
        yaxis=look.axis("amplitude [arcsec]", type="log", dtick=1, exponentformat="none",
                        range=[math.log10(floor), round(math.log10(top) + 0.15, 4)]),
        shapes=shapes, annotations=marks, margin={"l": 62, "r": 20, "t": max(84, round(above)), "b": 46},
    )  # fmt: skip
    return Figure("orders", "Orders of the transmission error at the input",
                  "Dotted: orders known from the counts and radii of the parts, named in the table; those of rollers"
                  " are not whole and spread over their neighbours.",
                  traces, picture, 12, 400, keys=keys(result))


def named(result: Result, orders: np.ndarray, amplitudes: np.ndarray, top: float) -> list[str]:
    """Explanations of the orders, where one is found and the order is not lost in the noise."""
    texts = [explanation(result, int(o)) if a > 1e-3 * top else "" for o, a in zip(orders, amplitudes)]
    return [f"({text})" if text else "" for text in texts]


def grouped(known: list[Cause]) -> list[tuple[float, str]]:
    """Orders that would stand on each other share a label: (place, text)."""
    groups: list[list[float]] = []
    for order in sorted({c.order for c in known}):
        if groups and order < 1.12 * groups[-1][0]:
            groups[-1].append(order)
        else:
            groups.append([order])
    return [(math.sqrt(g[0] * g[-1]), " · ".join(order_text(o) for o in g)) for g in groups]


def order_text(order: float) -> str:
    """Whole orders plain, others with one decimal."""
    return f"{order:.0f}" if abs(order - round(order)) < 0.02 else f"{order:.1f}"


def turn(result: Result, whole: bool) -> Figure:
    """Transmission error less its mean over the output angle: the whole turn, or three crank turns."""
    t = result.topology
    angle = result["output_phase"]
    last = 360.0 if whole else 3 * 360.0 / t.pins
    kept, step = angle <= last, round(float(angle[0]), 9)
    error = result["transmission_error_over_turn"]
    error = error - error.mean(axis=1, keepdims=True)
    traces = [
        look.line(None, short(error[i][kept], 4), colour, 1.0 if whole else 1.8,
                  hover=f"{text}, %{{x:.2f}}°: %{{y:.2f}} arcsec", x0=step, dx=step)
        for i, (text, colour, _) in zip(ends(result), keys(result))
    ]  # fmt: skip
    title = "Over one output turn" if whole else "Three turns of the cranks"
    spread = [round(v, 5) for v in look.padded(error[ends(result)], 0.01, 0.1)]
    picture = look.layout(
        xaxis=look.angle_axis("output angle [°]", 0.0, last, 60.0 if whole else 5.0),
        yaxis=look.axis("transmission error [arcsec]", range=spread, nticks=6, automargin=False),
    )
    caption = (
        "Less its mean; drag over the plot to look closer, double-click to return." if whole
        else "The beginning of the same record."
    )
    return Figure("error_turn" if whole else "error_stretch", title, caption, traces, picture, 8 if whole else 4, 280,
                  keys=keys(result))


def tables(result: Result) -> list[dict[str, Any]]:
    """Known orders, and the largest ones found: heading, column names, rows of text."""
    if not ends(result):
        return []
    entries, amplitude, orders = ends(result), result["order_amplitude"], result["order"]
    hours = [f"{hour_text(result['spectrum_hour'][i])} [arcsec]" for i in entries]
    known = [
        [order_text(c.order), c.text, *(number(near(orders, amplitude[i], c.order)) for i in entries)]
        for c in causes(result)
    ]
    ranking = np.argsort(-amplitude[entries[-1]], kind="stable")[:LARGEST]
    largest = [
        [str(int(orders[k])), explanation(result, int(orders[k])), *(number(amplitude[i][k]) for i in entries)]
        for k in ranking
    ]
    return [
        {"title": "Known orders", "head": ["order", "from", *hours], "rows": known},
        {"title": f"Largest orders at {hour_text(result['spectrum_hour'][entries[-1]])}",
         "head": ["order", "perhaps from", *hours], "rows": largest},
    ]  # fmt: skip


def near(orders: np.ndarray, amplitude: np.ndarray, order: float) -> float:
    """Amplitude at an order; between two whole ones (which share it), the larger."""
    close = np.abs(orders - order) < NEAR
    return float(amplitude[close].max(initial=0.0))
