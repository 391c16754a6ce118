"""Worn circles: a pin, the crank's raceway and the disc's raceway, as shapes and unrolled."""

from dataclasses import dataclass

import numpy as np

from pages import look
from pages.look import Figure, Trace, path, short
from pages.words import hour_text, number
from studies.report import shapes
from studies.report.parts import pin_depths
from studies.report.result import MICRON, Result, deepest

ROOM = 0.25  # largest drawn depth over the circle's radius


@dataclass(frozen=True)
class Side:
    """One of the two raceways of a bearing; ``sign`` +1 where wear enlarges the circle."""

    name: str
    title: str
    part: str
    reference: str
    pointer: str
    sign: float


INNER = Side("inner", "Inner raceway", "Crank eccentric", "the eccentric's direction", "eccentric direction", -1.0)
OUTER = Side("outer", "Outer raceway", "Hole in the disc", "the hole's outward radial", "outwards from the axis", 1.0)


def figures(result: Result) -> list[Figure]:
    """Pin, inner and outer raceway, then both raceways unrolled; the raceways share their scales."""
    deepest = max(float(result[f"{side.name}_race_wear"][-1].max()) for side in (INNER, OUTER))
    times = shapes.magnification(shapes.MM * deepest, ROOM * shapes.MM * result.plant["inner_race_radius"])
    depth_range = [0.0, 1.08 * MICRON * deepest or 1.0]
    return [
        pin(result), *(raceway(result, side, times) for side in (INNER, OUTER)),
        *(unrolled(result, side, depth_range) for side in (INNER, OUTER)),
    ]  # fmt: skip


def pin(result: Result) -> Figure:
    """Cross-section of the deepest worn pin."""
    total = result["pin_even_wear"][-1] + result["pin_wear"][-1].max(axis=2)
    d, j = (int(i) for i in np.unravel_index(total.argmax(), total.shape))
    radius = shapes.MM * result.plant["pin_radius"]
    times = shapes.magnification(1e-3 * float(result["pin_um"][-1]), ROOM * radius)
    angles = np.linspace(-180.0, 180.0, 180, endpoint=False)
    inward = -1j
    ways = inward * shapes.directions(angles)
    traces = [path(shapes.ring(radius), look.STEEL, 0.0, fill="toself", fillcolor=look.STEEL)]
    for i, colour in zip(result.shown, look.hour_colours(len(result.shown))) if times else ():
        depth = pin_depths(result, d, i, 90)[j]
        traces.append(path((radius - times * shapes.MM * depth) * ways, colour, 1.4, close=True))
    traces.append(path(shapes.ring(radius), look.INK, 1.6))
    texts = [look.note(0.0, -1.16 * radius, "towards the disc")]
    traces.append(arrow(0.3 * radius * inward, 0.62 * radius * inward, look.QUIET))
    if times:
        texts.append(look.note(0.0, 0.0, f"{number(result['pin_um'][-1])} µm", font={"size": 14, "color": look.INK}))
    bars, labels = look.scale_bars(radius * (-1.3 - 1.4j), -0.16j * radius, 0.5 * radius, times)
    picture = look.drawing([-1.4 * radius, 1.4 * radius], [-1.66 * radius, 1.14 * radius], annotations=texts + labels)
    how = "It turns in its groove and wears evenly all round" if result.pins_turn else (
        "It stands in its groove and wears where the disc touches it"
    )
    caption = f"Pin {j + 1} at disc {d + 1}. {how}."
    if times:
        caption += f" Wear {times:,.0f} times too large."
    return Figure("pin", "Pin", caption, traces + bars, picture, 4, aspect="1 / 1.02")


def deepest_bearing(result: Result, side: Side) -> tuple[int, int]:
    """(disc, crank) of the deepest worn raceway of a side."""
    disc, crank = deepest(result[f"{side.name}_race_wear"][-1])
    return disc, crank


def raceway(result: Result, side: Side, times: float) -> Figure:
    """One raceway as a circle, its reference direction upwards, the turning of the cranks marked."""
    d, c = deepest_bearing(result, side)
    radius = shapes.MM * result.plant[f"{side.name}_race_radius"]
    reach = 1.42 * radius
    # Material lies within the crank's eccentric and around the hole.
    areas = [(1.0, look.STEEL)] if side is INNER else [(1.22, look.STEEL), (1.0, look.PAPER)]
    traces = [path(shapes.ring(s * radius), fill, 0.0, fill="toself", fillcolor=fill) for s, fill in areas]
    ways = 1j * shapes.directions(shapes.thin(result["race_phase"], 180))
    for i, colour in zip(result.shown, look.hour_colours(len(result.shown))) if times else ():
        depth = shapes.thin(result[f"{side.name}_race_wear"][i, d, c], 180)
        traces.append(path((radius + side.sign * times * shapes.MM * depth) * ways, colour, 1.4, close=True))
    traces += [path(shapes.ring(radius), look.INK, 1.6), arrow(0.0, 0.62j * radius, look.QUIET)]
    traces += turning_arrow(result.sense, 0.34 * radius)
    texts = [
        look.note(0.0, 0.70 * radius, side.pointer, bgcolor=areas[-1][1]),
        look.note(0.0, -0.46 * radius, "cranks turn"),
    ]
    if times:
        marks, text = peak_mark(result, side, radius, times)
        traces += marks
        texts.append(look.note(0.97 * reach, -1.48 * radius, text, xanchor="right", align="right",
                               font={"size": 12, "color": look.INK}))  # fmt: skip
    bars, labels = look.scale_bars(-0.94 * reach - 1.4j * radius, -0.16j * radius, 0.5 * radius, times)
    picture = look.drawing([-reach, reach], [-1.66 * radius, 1.24 * radius], annotations=texts + labels)
    caption = f"{side.part}, crank {c + 1}, disc {d + 1}. Angles from {side.reference}, the way the cranks turn."
    if times:
        caption += f" Wear {times:,.0f} times too large, as on the other raceway."
    return Figure(f"{side.name}_raceway", side.title, caption, traces + bars, picture, 4, aspect="1 / 1.02")


def peak_mark(result: Result, side: Side, radius: float, times: float) -> tuple[list[Trace], str]:
    """A ray to the deepest place with a dot on the worn contour, and what to say about it."""
    peak, depth = result.peak_place(f"{side.name}_peak_deg"), float(result[f"{side.name}_raceway_um"][-1])
    way = 1j * complex(shapes.directions(np.array(result.sense * peak)))
    at = (radius + side.sign * times * 1e-3 * depth) * way
    dot = {
        "type": "scatter", "mode": "markers", "x": short([at.real]), "y": short([at.imag]), "hoverinfo": "skip",
        "marker": {"size": 8, "color": look.HOURS[-1], "line": {"color": look.PAPER, "width": 1.5}},
    }  # fmt: skip
    ray = path(np.array([0.0, at]), look.QUIET, 1.0, dash="dot")
    return [ray, dot], f"deepest<br><b>{number(depth)} µm</b> at {number(peak)}°"


def unrolled(result: Result, side: Side, depth_range: list[float]) -> Figure:
    """Depth over the angle counted the way the cranks turn, one line per shown hour."""
    d, c = deepest_bearing(result, side)
    angles = (result.sense * result["race_phase"] + 180.0) % 360.0 - 180.0
    order = shapes.thin(np.argsort(angles), 180)
    depth = MICRON * result[f"{side.name}_race_wear"][:, d, c]
    traces = [
        look.line(short(angles[order]), short(depth[i][order]), colour, 1.6,
                  hover=f"{hour_text(result.hours[i])}: %{{y:.2f}} µm at %{{x:.0f}}°")
        for i, colour in zip(result.shown, look.hour_colours(len(result.shown)))
    ]  # fmt: skip
    picture = look.layout(
        xaxis=look.angle_axis(f"angle from {side.reference} [°]", -180.0, 180.0, 60.0),
        yaxis=look.axis("wear depth [µm]", range=short(depth_range)),
    )
    caption = "Nothing is worn."
    worn = [i for i in range(len(result.hours)) if result[f"{side.name}_raceway_um"][i] > 0.0]
    if worn:
        first, last = (result.peak_place(f"{side.name}_peak_deg", i) for i in (worn[0], worn[-1]))
        caption = f"Deepest at {number(first)}° first, at {number(last)}° in the end."
    return Figure(f"{side.name}_unrolled", f"{side.title} unrolled", caption, traces, picture, 6, 270)


def arrow(start: complex, end: complex, colour: str) -> Trace:
    """A straight arrow."""
    start, end = complex(start), complex(end)
    back = 0.22 * (end - start)
    barbs = [end - back * np.exp(0.5j), end, end - back * np.exp(-0.5j)]
    return path(np.array([start, end, *barbs]), colour, 1.6)


def turning_arrow(sense: float, radius: float) -> list[Trace]:
    """An arc with an arrow head, below the centre, that turns the way of ``sense``."""
    arc = radius * shapes.directions(np.linspace(-90.0 - 70.0 * sense, -90.0 + 70.0 * sense, 40))
    along = 1j * sense * arc[-1]
    barbs = [arc[-1] - 0.4 * along * np.exp(0.5j), arc[-1], arc[-1] - 0.4 * along * np.exp(-0.5j)]
    return [path(arc, look.QUIET, 1.6), path(np.array(barbs), look.QUIET, 1.6)]
