"""Worn parts on their true shape: one disc with its pins and cranks."""

from typing import Any

import numpy as np

from fmu_src.arrays import Floats, Points
from pages import look
from pages.look import Figure, Trace, path, short
from pages.words import hour_text, number
from studies.report import shapes
from studies.report.result import MICRON, Result


class Colours:
    """What wear takes off closed contours, collected by colour steps of depth."""

    def __init__(self, result: Result):
        self.times = shapes.enlargement(result, 0.75)
        self.edges = shapes.levels(max(float(result[name][-1]) for name in look.SURFACES))
        self.strips: list[list[Points]] = [[] for _ in self.edges[1:]]
        count = len(self.strips)
        self.colours = [look.blend(look.DEPTH, i / max(count - 1, 1)) for i in range(count)]

    def take_off(self, contour: Points, into: Points, depth: Floats) -> None:
        """Add what ``depth`` [m] takes off a contour [mm] in the direction ``into`` the part."""
        worn = contour + self.times * shapes.MM * depth * into
        for strip, found in zip(self.strips, shapes.bands(contour, worn, MICRON * depth, self.edges)):
            strip.extend(found)

    def traces(self) -> list[Trace]:
        """The coloured strips and their colour bar; none if nothing is worn."""
        if not self.times:
            return []
        pairs = [(c, shapes.joined(p)) for c, p in zip(self.colours, self.strips) if p]
        areas = [filled(outline, colour, colour, 0.4) for colour, outline in pairs]
        return [*areas, depth_bar(self.edges, self.colours)]


def filled(points: Points, fill: str, border: str = look.QUIET, width: float = 1.0, **more: Any) -> Trace:
    """An area."""
    return path(points, border, width, fill="toself", fillcolor=fill, **more)


def disc(result: Result) -> Figure:
    """One disc in its ring of pins, eccentrics upwards, every worn surface coloured by depth."""
    plant, mm, up = result.plant, shapes.MM, 1j
    d, _ = result.deepest_tooth
    colours = Colours(result)
    times, centre = colours.times, mm * plant["eccentricity"] * up
    points, normals = shapes.flank(result, shapes.thin(result["flank_phase"], 60))
    lobes = result.topology.lobes
    turns = shapes.directions(360.0 * np.arange(lobes) / lobes)[:, None] * up
    contour = centre + (turns * points).ravel()
    depth = shapes.thin(result["disc_wear"][-1, d], 60).ravel()
    colours.take_off(contour, -(turns * normals).ravel(), depth)
    bearing_traces, names = bearings(result, d, centre, up, colours)
    traces = [filled(contour, look.STEEL, close=True), *bearing_traces, pins(result, d, up, colours)]
    traces += [*colours.traces(), lobe_names(result, d, contour, depth)]

    reach = mm * (plant["pin_circle_radius"] + plant["pin_radius"]) * 1.02
    bars, labels = look.scale_bars(reach * (-0.95 - 1.1j), 0.95 * reach, 0.2 * reach, times)
    picture = look.drawing([-reach, reach], [-1.16 * reach, reach], annotations=names + labels)
    picture["margin"] = {"l": 4, "r": 4, "t": 4, "b": 62 if times else 4}
    spread = MICRON * result["disc_wear"][-1].max(axis=2)
    caption = (
        f"Disc {d + 1} in the pin ring after {hour_text(result.hours[-1])}, cranks' eccentric direction upwards."
        f" {shapes.enlarged_text(times)}"
    )
    if times:
        caption += (
            f" All surfaces share magnification and colours. The {spread.size} lobes of all discs are worn"
            f" {number(spread.min())} to {number(spread.max())} µm at their deepest."
        )
    aspect = "1 / 1.14" if times else "1 / 1.08"
    return Figure("disc", "The whole disc", caption, traces + bars, picture, 7, aspect=aspect, rows=2)


def bearings(result: Result, d: int, centre: complex, up: complex, colours: Colours) -> tuple[list[Trace], list[look.Layout]]:
    """Holes of a disc with cranks and rollers: (traces, names of the cranks)."""
    t, plant, mm = result.topology, result.plant, shapes.MM
    inner, outer, roller = (mm * plant[f"{name}_radius"] for name in ("inner_race", "outer_race", "roller"))
    # The disc stands where its eccentric direction points upwards.
    offset = 360.0 * d / t.discs / t.lobes
    places = shapes.directions(offset + 360.0 * np.arange(t.cranks) / t.cranks) * up
    ways = shapes.directions(shapes.thin(result["race_phase"], 120))
    holes, lobes, rollers, names = [], [], [], []
    for c, place in enumerate(places):
        middle = centre + mm * plant["crank_circle_radius"] * place
        names.append(look.note(middle.real, middle.imag, f"crank {c + 1}", font={"size": 12, "color": look.INK}))
        holes.append(shapes.ring(outer, middle))
        lobes.append(shapes.ring(inner, middle))
        seats = (inner + roller) * place * shapes.directions(360.0 * np.arange(t.rollers) / t.rollers)
        rollers += [shapes.ring(roller, middle + seat, 24) for seat in seats]
        # Raceway angles count from the hole's outward radial and from the eccentric's direction.
        way = ways * place
        colours.take_off(middle + outer * way, way, shapes.thin(result["outer_race_wear"][-1, d, c], 120))
        way = ways * up
        colours.take_off(middle + inner * way, -way, shapes.thin(result["inner_race_wear"][-1, d, c], 120))
    traces = [filled(shapes.joined(holes), look.PAPER), filled(shapes.joined(lobes), look.STEEL)]
    return [*traces, path(shapes.joined(rollers), "#aab4be", 0.8)], names


def pins(result: Result, d: int, up: complex, colours: Colours) -> Trace:
    """The ring of pins."""
    count, radius = result.topology.pins, shapes.MM * result.plant["pin_radius"]
    ways = shapes.directions(360.0 * np.arange(count) / count) * up
    places = shapes.MM * result.plant["pin_circle_radius"] * ways
    for place, outwards, depth in zip(places, ways, pin_depths(result, d, count=16 if result.pins_turn else 60)):
        # Counted from the inward radial.
        way = -outwards * shapes.directions(np.linspace(-180.0, 180.0, depth.size, endpoint=False))
        colours.take_off(place + radius * way, -way, depth)
    return filled(shapes.joined([shapes.ring(radius, place, 32) for place in places]), "#f7f9fa", "#aab4be", 0.8)


def pin_depths(result: Result, d: int, entry: int = -1, count: int = 60) -> Floats:
    """Depth [pin, angle] over a pin's whole circumference, from -180 degrees of its inward radial, at disc ``d``."""
    even: Floats = result["pin_even_wear"][entry, d][:, None] * np.ones(2 * count)
    contact_side = shapes.thin(result["pin_wear"][entry, d], count)
    angles = np.linspace(-180.0, 180.0, 2 * count, endpoint=False)
    phases = shapes.thin(result["pin_phase"], count)
    worn: Floats = np.array([np.interp(angles, phases, row, left=0.0, right=0.0) for row in contact_side])
    return even + worn


def lobe_names(result: Result, d: int, contour: Points, depth: Floats) -> Trace:
    """Invisible markers that name each lobe and its deepest wear under the pointer."""
    bins = depth.size // result.topology.lobes
    rows = depth.reshape(-1, bins)
    places = contour[np.arange(rows.shape[0]) * bins + rows.argmax(axis=1)]
    deepest = MICRON * result["disc_wear"][-1, d].max(axis=1)
    texts = [f"lobe {k + 1}: {number(value)} µm" for k, value in enumerate(deepest)]
    return {
        "type": "scatter", "mode": "markers", "x": short(places.real), "y": short(places.imag), "text": texts,
        "hovertemplate": "%{text}<extra></extra>", "marker": {"size": 14, "opacity": 0, "color": look.INK},
    }  # fmt: skip


def depth_bar(edges: Floats, colours: list[str]) -> Trace:
    """A trace that only carries the colour bar of the depth steps."""
    count = len(colours)
    steps = [[place / count, colour] for i, colour in enumerate(colours) for place in (i, i + 1)]
    return {
        "type": "scatter", "mode": "markers", "x": [None], "y": [None], "hoverinfo": "skip",
        "marker": {
            "color": [0], "cmin": 0, "cmax": float(edges[-1]), "colorscale": steps, "showscale": True,
            "colorbar": {
                "orientation": "h", "y": -0.005, "yanchor": "top", "thickness": 10, "len": 0.7, "outlinewidth": 0,
                "tickvals": short(edges), "tickfont": {"size": 11, "color": look.QUIET},
                "title": {"text": "wear depth [µm]", "side": "bottom", "font": {"size": 12, "color": look.QUIET}},
            },
        },
    }  # fmt: skip
