"""Worn circles: a pin, the crank's raceway and the disc's raceway, as shapes and unrolled."""

import numpy as np

from orchestrator.report import look, shapes
from orchestrator.report.look import Figure, path, short
from orchestrator.report.parts import pin_depths, scale_bars
from orchestrator.report.result import MICRON, Result, hour_text, number

ROOM = 0.25  # largest drawn depth over the circle's radius


def figures(result: Result) -> list[Figure]:
    """Pin, inner and outer raceway, then both raceways unrolled."""
    times = shapes.magnification(
        1e-3 * max(result["inner_raceway_um"][-1], result["outer_raceway_um"][-1]),
        ROOM * shapes.MM * result.plant["inner_race_radius"],
    )
    unrolled_range = [0.0, 1.08 * MICRON * float(max(result[f"{s}_race_wear"][-1].max() for s in ("inner", "outer")))]
    if unrolled_range[1] == 0.0:
        unrolled_range[1] = 1.0
    return [
        pin(result), raceway(result, "inner", times), raceway(result, "outer", times),
        unrolled(result, "inner", unrolled_range), unrolled(result, "outer", unrolled_range),
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
    bars, labels = scale_bars(radius * (-1.3 - 1.4j), -0.16j * radius, 0.5 * radius, times)
    picture = look.drawing([-1.4 * radius, 1.4 * radius], [-1.66 * radius, 1.14 * radius], annotations=texts + labels)
    how = "It turns in its groove and wears evenly all round" if result.pins_turn else (
        "It stands in its groove and wears where the disc touches it"
    )
    caption = f"Pin {j + 1} at disc {d + 1}. {how}."
    if times:
        caption += f" Wear {times:,.0f} times too large."
    return Figure("pin", "Pin", caption, traces + bars, picture, 4, aspect="1 / 1.02")


def deepest_bearing(result: Result, side: str) -> tuple[int, int]:
    """(disc, crank) of the deepest worn raceway of a side, inner or outer."""
    worn = result[f"{side}_race_wear"][-1].max(axis=2)
    return tuple(int(i) for i in np.unravel_index(worn.argmax(), worn.shape))


def raceway(result: Result, side: str, times: float) -> Figure:
    """One raceway as a circle, its reference direction upwards, the turning of the cranks marked."""
    d, c = deepest_bearing(result, side)
    radius = shapes.MM * result.plant[f"{side}_race_radius"]
    # A crank loses at its outside, a hole grows.
    sign = -1.0 if side == "inner" else 1.0
    ways = 1j * shapes.directions(shapes.thin(result["race_phase"], 180))
    reach = 1.42 * radius
    traces = []
    if side == "inner":
        traces.append(path(shapes.ring(radius), look.STEEL, 0.0, fill="toself", fillcolor=look.STEEL))
    else:
        traces.append(path(shapes.ring(1.22 * radius), look.STEEL, 0.0, fill="toself", fillcolor=look.STEEL))
        traces.append(path(shapes.ring(radius), look.PAPER, 0.0, fill="toself", fillcolor=look.PAPER))
    for i, colour in zip(result.shown, look.hour_colours(len(result.shown))) if times else ():
        depth = shapes.thin(result[f"{side}_race_wear"][i, d, c], 180)
        traces.append(path((radius + sign * times * shapes.MM * depth) * ways, colour, 1.4, close=True))
    traces.append(path(shapes.ring(radius), look.INK, 1.6))
    traces.append(arrow(0.0, 0.62j * radius, look.QUIET))
    texts = [look.note(0.0, 0.70 * radius, "eccentric direction" if side == "inner" else "outwards from the axis",
                       bgcolor=look.STEEL if side == "inner" else look.PAPER)]
    traces += turning_arrow(result.sense, 0.34 * radius)
    texts.append(look.note(0.0, -0.46 * radius, "cranks turn"))
    peak = result.peak_place(f"{side}_peak_deg")
    if times:
        way = 1j * complex(shapes.directions(np.array(result.sense * peak)))
        at = (radius + sign * times * 1e-3 * float(result[f"{side}_raceway_um"][-1])) * way
        traces.append(path(np.array([0.0, at]), look.QUIET, 1.0, dash="dot"))
        traces.append({
            "type": "scatter", "mode": "markers", "x": short([at.real]), "y": short([at.imag]), "hoverinfo": "skip",
            "marker": {"size": 8, "color": look.HOURS[-1], "line": {"color": look.PAPER, "width": 1.5}},
        })  # fmt: skip
        depth_text = f"deepest<br><b>{number(result[f'{side}_raceway_um'][-1])} µm</b> at {number(peak)}°"
        texts.append(look.note(0.97 * reach, -1.48 * radius, depth_text, xanchor="right", align="right",
                               font={"size": 12, "color": look.INK}))
    bars, labels = scale_bars(-0.94 * reach - 1.4j * radius, -0.16j * radius, 0.5 * radius, times)
    picture = look.drawing([-reach, reach], [-1.66 * radius, 1.24 * radius], annotations=texts + labels)
    what, start = ("Crank lobe", "the lobe's eccentric direction") if side == "inner" else (
        "Hole in the disc", "the hole's outward radial"
    )
    caption = f"{what}, crank {c + 1}, disc {d + 1}. Angles from {start}, counted the way the cranks turn."
    if times:
        caption += f" Wear {times:,.0f} times too large, as on the other raceway."
    title = "Inner raceway" if side == "inner" else "Outer raceway"
    return Figure(f"{side}_raceway", title, caption, traces + bars, picture, 4, aspect="1 / 1.02")


def unrolled(result: Result, side: str, depth_range: list[float]) -> Figure:
    """Depth over the angle counted the way the cranks turn, one line per shown hour."""
    d, c = deepest_bearing(result, side)
    angles = (result.sense * result["race_phase"] + 180.0) % 360.0 - 180.0
    order = shapes.thin(np.argsort(angles), 180)
    traces = [
        look.line(short(angles[order]), short(MICRON * result[f"{side}_race_wear"][i, d, c][order]), colour, 1.6,
                  hover=f"{hour_text(result.hours[i])}: %{{y:.2f}} µm at %{{x:.0f}}°")
        for i, colour in zip(result.shown, look.hour_colours(len(result.shown)))
    ]  # fmt: skip
    start = "eccentric direction" if side == "inner" else "outward radial"
    picture = look.layout(
        xaxis=look.angle_axis(f"angle from the {start} [°]", -180.0, 180.0, 60.0),
        yaxis=look.axis("wear depth [µm]", range=short(depth_range)),
    )
    caption = ""
    worn = [i for i in range(len(result.hours)) if result[f"{side}_raceway_um"][i] > 0.0]
    if worn:
        first, last = (result.peak_place(f"{side}_peak_deg", i) for i in (worn[0], worn[-1]))
        caption = f"Deepest at {number(first)}° first, at {number(last)}° in the end."
    title = f"{'Inner' if side == 'inner' else 'Outer'} raceway unrolled"
    return Figure(f"{side}_unrolled", title, caption, traces, picture, 6, 270)


def arrow(start: complex, end: complex, colour: str) -> dict:
    """A straight arrow."""
    start, end = complex(start), complex(end)
    back = 0.22 * (end - start)
    barbs = [end - back * np.exp(0.5j), end, end - back * np.exp(-0.5j)]
    return path(np.array([start, end, *barbs]), colour, 1.6)


def turning_arrow(sense: float, radius: float) -> list[dict]:
    """An arc with an arrow head, below the centre, that turns the way of ``sense``."""
    arc = radius * shapes.directions(np.linspace(-90.0 - 70.0 * sense, -90.0 + 70.0 * sense, 40))
    along = 1j * sense * arc[-1]
    barbs = [arc[-1] - 0.4 * along * np.exp(0.5j), arc[-1], arc[-1] - 0.4 * along * np.exp(-0.5j)]
    return [path(arc, look.QUIET, 1.6), path(np.array(barbs), look.QUIET, 1.6)]
