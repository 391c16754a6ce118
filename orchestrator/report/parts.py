"""Worn parts on their true shape: the whole disc with its pins and cranks, and one tooth."""

import numpy as np

from orchestrator.report import look, shapes
from orchestrator.report.look import Figure, path, short
from orchestrator.report.result import MICRON, Result, hour_text, number

# Phases drawn on either side of a tooth's roots [deg].
BEYOND = 35.0


def figures(result: Result) -> list[Figure]:
    """Disc, tooth and depth along the tooth, in the order of the page."""
    return [disc(result), tooth(result), tooth_depth(result)]


def enlargement(result: Result, share: float) -> float:
    """How many times wear is enlarged: at most to a share of the tooth's height and of its sharpest radius."""
    deepest = max(result[name][-1] for name in look.SURFACES)
    room = share * min(2.0 * shapes.MM * result.plant["eccentricity"], shapes.sharpest_radius(result))
    return shapes.magnification(1e-3 * deepest, room)


def enlarged_text(times: float) -> str:
    return f"Wear is drawn {times:,.0f} times too large." if times else "Nothing is worn."


def disc(result: Result) -> Figure:
    """One disc in its ring of pins, lobe's eccentric direction upwards, every worn surface coloured by depth."""
    t, plant = result.topology, result.plant
    d, _ = result.deepest_tooth
    mm, up = shapes.MM, 1j
    times = enlargement(result, 0.75)
    edges = shapes.levels(max(float(result[name][-1]) for name in look.SURFACES))
    centre = mm * plant["eccentricity"] * up
    strips: list[list[np.ndarray]] = [[] for _ in range(edges.size - 1)]

    def wear_off(nominal, into, depth):
        """Colour what ``depth`` [m] takes off a closed contour in the direction ``into`` the part."""
        for total, new in zip(strips, shapes.bands(nominal, nominal + times * mm * depth * into, MICRON * depth, edges)):
            total.extend(new)

    phases = shapes.thin(result["flank_phase"], 60)
    points, normals = shapes.flank(result, phases)
    turns = shapes.directions(360.0 * np.arange(t.lobes) / t.lobes)[:, None] * up
    contour = centre + (turns * points).ravel()
    depth = shapes.thin(result["disc_wear"][-1, d], 60).ravel()
    wear_off(contour, -(turns * normals).ravel(), depth)

    # Cranks in their holes; the eccentric direction is the same for all.
    offset = 360.0 * d / t.discs
    places = shapes.directions(offset / t.lobes + 360.0 * np.arange(t.cranks) / t.cranks) * up
    phases_race = shapes.thin(result["race_phase"], 120)
    traces = [path(contour, look.QUIET, 1.0, close=True, fill="toself", fillcolor=look.STEEL)]
    inner, outer = mm * plant["inner_race_radius"], mm * plant["outer_race_radius"]
    roller, pin_radius = mm * plant["roller_radius"], mm * plant["pin_radius"]
    holes, lobes, rollers = [], [], []
    for c, place in enumerate(places):
        middle = centre + mm * plant["crank_circle_radius"] * place
        holes.append(shapes.ring(outer, middle))
        lobes.append(shapes.ring(inner, middle))
        ways = shapes.directions(360.0 * np.arange(t.rollers) / t.rollers) * place
        rollers += [shapes.ring(roller, middle + (inner + roller) * way, 24) for way in ways]
        way = shapes.directions(phases_race)
        wear_off(middle + outer * way * place, way * place, shapes.thin(result["outer_race_wear"][-1, d, c], 120))
        wear_off(middle + inner * way * up, -way * up, shapes.thin(result["inner_race_wear"][-1, d, c], 120))
    pin_places = mm * plant["pin_circle_radius"] * shapes.directions(360.0 * np.arange(t.pins) / t.pins) * up
    pins = [shapes.ring(pin_radius, place, 32) for place in pin_places]
    traces += [
        path(shapes.joined(holes), look.QUIET, 1.0, fill="toself", fillcolor=look.PAPER),
        path(shapes.joined(lobes), look.QUIET, 1.0, fill="toself", fillcolor=look.STEEL),
        path(shapes.joined(rollers), "#aab4be", 0.8),
        path(shapes.joined(pins), "#aab4be", 0.8, fill="toself", fillcolor="#f7f9fa"),
    ]
    for place, depths in zip(pin_places, pin_depths(result, d, count=16 if result.pins_turn else 60)):
        way = shapes.directions(np.linspace(-180.0, 180.0, depths.size, endpoint=False))
        wear_off(place + pin_radius * way * -place / abs(place), way * place / abs(place), depths)

    colours = [look.blend(look.DEPTH, i / max(edges.size - 2, 1)) for i in range(edges.size - 1)]
    for colour, polygons in zip(colours, strips):
        if polygons and times:
            traces.append(path(shapes.joined(polygons), colour, 0.4, fill="toself", fillcolor=colour))
    traces.append(lobe_names(result, d, contour, depth))
    if times:
        traces.append(depth_bar(edges, colours))
    reach = mm * (plant["pin_circle_radius"] + plant["pin_radius"]) * 1.02
    names = [
        look.note(place.real, place.imag, f"crank {c + 1}", font={"size": 12, "color": look.INK})
        for c, place in enumerate(centre + mm * plant["crank_circle_radius"] * places)
    ]
    bars, labels = scale_bars(reach * (-0.95 - 1.1j), 0.95 * reach, 0.2 * reach, times)
    traces += bars
    picture = look.drawing([-reach, reach], [-1.16 * reach, reach], annotations=names + labels)
    picture["margin"] = {"l": 4, "r": 4, "t": 4, "b": 62 if times else 4}
    spread = MICRON * result["disc_wear"][-1].max(axis=2)
    caption = (
        f"Disc {d + 1} in the pin ring after {hour_text(result.hours[-1])}, cranks' eccentric direction upwards."
        f" {enlarged_text(times)}"
    )
    if times:
        caption += (
            f" All surfaces share magnification and colours. The {spread.size} lobes of all discs are worn"
            f" {number(spread.min())} to {number(spread.max())} µm at their deepest."
        )
    return Figure("disc", "The whole disc", caption, traces, picture, 7, aspect="1 / 1.14" if times else "1 / 1.08", rows=2)


def pin_depths(result: Result, d: int, entry: int = -1, count: int = 60) -> np.ndarray:
    """Depth [pin, angle] over a pin's whole circumference, from -180 degrees of its inward radial, at disc ``d``."""
    even = result["pin_even_wear"][entry, d][:, None] * np.ones(2 * count)
    contact_side = shapes.thin(result["pin_wear"][entry, d], count)
    angles = np.linspace(-180.0, 180.0, 2 * count, endpoint=False)
    phases = shapes.thin(result["pin_phase"], count)
    return even + np.array([np.interp(angles, phases, row, left=0.0, right=0.0) for row in contact_side])


def lobe_names(result: Result, d: int, contour: np.ndarray, depth: np.ndarray) -> dict:
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


def depth_bar(edges: np.ndarray, colours: list[str]) -> dict:
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


def tooth(result: Result) -> Figure:
    """The deepest worn tooth, tip upwards, with its contour at every shown hour."""
    t, plant, mm = result.topology, result.plant, shapes.MM
    d, lobe = result.deepest_tooth
    times = enlargement(result, 0.5)
    # The tip, half a lobe from the root, goes upwards; x = 0 at the tip.
    turn = 1j * shapes.directions(np.array(-180.0 / t.lobes))
    phases = np.arange(-BEYOND, 360.0 + BEYOND + 1.0, 2.0)
    points, normals = shapes.flank(result, phases)
    points, normals = turn * points, turn * normals
    top = points.imag.max() + 1.3 * mm * plant["pin_radius"]
    bottom = points.imag.min() - 2.2 * mm * plant["eccentricity"]
    traces = [path(np.concatenate(([points[0].real + 1j * bottom], points, [points[-1].real + 1j * bottom])),
                   look.STEEL, 0.0, fill="toself", fillcolor=look.STEEL)]
    if times:
        traces.append(contact_pin(result, turn))
        bins = result["disc_wear"].shape[-1]
        neighbours = result["disc_wear"][:, d, (lobe + np.array([-1, 0, 1])) % t.lobes].reshape(len(result.hours), -1)
        places = (phases / 360.0 + 1.0) * bins - 0.5
        for i, colour in zip(result.shown, look.hour_colours(len(result.shown))):
            depth = np.interp(places, np.arange(3 * bins), neighbours[i])
            traces.append(path(points - times * mm * depth * normals, colour, 1.3))
    traces.append(path(points, look.INK, 1.6))
    marks = np.arange(0.0, 361.0, 30.0)
    at, out = (turn * z for z in shapes.flank(result, marks))
    traces.append({
        "type": "scatter", "mode": "markers", "x": short(at.real, 5), "y": short(at.imag, 5), "hoverinfo": "skip",
        "marker": {"size": 5, "color": look.PAPER, "line": {"color": look.INK, "width": 1.2}},
    })  # fmt: skip
    names = {0.0: "root 0°", 60.0: "60°", 120.0: "120°", 180.0: "tip 180°", 240.0: "240°", 300.0: "300°", 360.0: "root 360°"}
    texts = [
        look.note(place.real, place.imag, names[phase])
        for phase, place in zip(marks, at + 0.22 * mm * plant["pin_radius"] * out) if phase in names
    ]
    reach = 1.02 * points.real.max()
    gap = 0.06 * (top - bottom)
    bars, labels = scale_bars(-0.94 * reach + 1j * (bottom + 1.7 * gap), -1j * gap, 0.3 * reach, times)
    picture = look.drawing([-reach, reach], [bottom, top], annotations=texts + labels)
    caption = f"Lobe {lobe + 1} of disc {d + 1}. Nothing is worn."
    if times:
        caption = (
            f"Lobe {lobe + 1} of disc {d + 1}, the deepest worn. Black: as made; blue: the worn contour at the recorded"
            f" hours. {enlarged_text(times)}"
        )
    aspect = f"{2 * reach:.2f} / {top - bottom:.2f}"
    return Figure("tooth", "One tooth, enlarged", caption, traces + bars, picture, 5, aspect=aspect)


def contact_pin(result: Result, turn: complex) -> dict:
    """A pin where it touches the tooth at the deepest wear."""
    phase = np.array([result.peak_place("disc_peak_deg")])
    d, lobe = result.deepest_tooth
    profile = result["disc_wear"][-1, d, lobe]
    if result["flank_phase"][profile.argmax()] > 180.0:
        phase = 360.0 - phase
    point, normal = shapes.flank(result, phase)
    radius = shapes.MM * result.plant["pin_radius"]
    circle = shapes.ring(radius, turn * (point[0] + radius * normal[0]), 90)
    return path(circle, "#c3cbd3", 1.0, fill="toself", fillcolor="rgba(236,239,242,0.55)")


def scale_bars(start: complex, step: complex, room: float, times: float) -> tuple[list[dict], list[dict]]:
    """Bars, at most ``room`` long and ``step`` apart, for the part [mm] and its wear [um]: (traces, labels)."""
    bars = [(shapes.round_down(room), "{:g} mm of the part", look.QUIET)]
    if times:
        micron = shapes.round_down(room * 1e3 / times)
        bars.insert(0, (micron * times * 1e-3, f"{micron:g} µm of wear", look.NOW))
    traces, labels = [], []
    for k, (length, text, colour) in enumerate(bars):
        ends = start + k * step + np.array([0.0, length])
        traces.append(path(ends, colour, 4))
        labels.append(look.note(ends[1].real, ends[1].imag, " " + text.format(length), xanchor="left"))
    return traces, labels


def tooth_depth(result: Result) -> Figure:
    """Depth along the same tooth, one line per shown hour, and the way of the deepest place."""
    d, lobe = result.deepest_tooth
    profiles = MICRON * result["disc_wear"][:, d, lobe]
    low, high = loaded_side(result, profiles[-1])
    phases = result["flank_phase"]
    inside = (phases > low) & (phases < high)
    traces = [
        look.line(short(phases[inside]), short(profiles[i][inside]), colour, 1.6,
                  hover=f"{hour_text(result.hours[i])}: %{{y:.2f}} µm at %{{x:.0f}}°")
        for i, colour in zip(result.shown, look.hour_colours(len(result.shown)))
    ]  # fmt: skip
    worn = [i for i in range(len(result.hours)) if profiles[i].max() > 0.0]
    caption = "The same tooth unrolled."
    if worn:
        places = np.array([phases[profiles[i].argmax()] for i in worn])
        depths = profiles[worn, profiles[worn].argmax(axis=1)]
        traces.append(look.line(short(places), short(depths), look.INK, 1.0, "dot"))
        first, last = result.peak_place("disc_peak_deg", worn[0]), result.peak_place("disc_peak_deg")
        caption = f"The same tooth unrolled; dotted: the deepest place, at {first:.0f}° first and {last:.0f}° in the end."
    picture = look.layout(
        xaxis=look.angle_axis("phase on the tooth, root 0°, tip 180°", low, high, 30.0 if high - low < 200.0 else 60.0),
        yaxis=look.axis("wear depth [µm]", rangemode="tozero"),
    )
    return Figure("tooth_depth", "Depth along the tooth", caption, traces, picture, 5, 300)


def loaded_side(result: Result, *profiles: np.ndarray) -> tuple[float, float]:
    """Range of phases [deg] worth showing: one flank if the other is bare, else the whole tooth."""
    half = result["flank_phase"].size // 2
    first = sum(float(p[:half].sum()) for p in profiles)
    second = sum(float(p[half:].sum()) for p in profiles)
    if first == second == 0.0:
        return 0.0, 360.0
    if second < 0.05 * first:
        return 0.0, 180.0
    return (180.0, 360.0) if first < 0.05 * second else (0.0, 360.0)
