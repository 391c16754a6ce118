"""One tooth, enlarged: its contour and its depth at the recorded hours."""

import numpy as np

from pages import look
from pages.look import Figure, path, short
from pages.words import hour_text
from studies.report import shapes
from studies.report.result import MICRON, Result

# Phases drawn on either side of a tooth's roots [deg].
BEYOND = 35.0


def shape(result: Result) -> Figure:
    """The deepest worn tooth, tip upwards, with its contour at every shown hour."""
    t, plant, mm = result.topology, result.plant, shapes.MM
    d, lobe = result.deepest_tooth
    times = shapes.enlargement(result, 0.5)
    # The tip, half a lobe from the root, goes upwards; x = 0 at the tip.
    turn = complex(1j * shapes.directions(np.array(-180.0 / t.lobes)))
    phases = np.arange(-BEYOND, 360.0 + BEYOND + 1.0, 2.0)
    points, normals = shapes.flank(result, phases)
    points, normals = turn * points, turn * normals
    top = points.imag.max() + 1.3 * mm * plant["pin_radius"]
    bottom = points.imag.min() - 2.2 * mm * plant["eccentricity"]
    corners = points[[0, -1]].real + 1j * bottom
    body = np.concatenate((corners[:1], points, corners[1:]))
    traces = [path(body, look.STEEL, 0.0, fill="toself", fillcolor=look.STEEL)]
    if times:
        traces.append(contact_pin(result, turn))
        bins = result["disc_wear"].shape[-1]
        neighbours = result["disc_wear"][:, d, (lobe + np.array([-1, 0, 1])) % t.lobes].reshape(len(result.hours), -1)
        places = (phases / 360.0 + 1.0) * bins - 0.5
        for i, colour in zip(result.shown, look.hour_colours(len(result.shown))):
            wear = np.interp(places, np.arange(3 * bins), neighbours[i])
            traces.append(path(points - times * mm * wear * normals, colour, 1.3))
    traces.append(path(points, look.INK, 1.6))
    marks = np.arange(0.0, 361.0, 30.0)
    at, out = (turn * z for z in shapes.flank(result, marks))
    traces.append({
        "type": "scatter", "mode": "markers", "x": short(at.real, 5), "y": short(at.imag, 5), "hoverinfo": "skip",
        "marker": {"size": 5, "color": look.PAPER, "line": {"color": look.INK, "width": 1.2}},
    })  # fmt: skip
    names = {0.0: "root ", 180.0: "tip ", 360.0: "root "}
    texts = [
        look.note(place.real, place.imag, f"{names.get(phase, '')}{phase:.0f}°")
        for phase, place in zip(marks[::2], (at + 0.22 * mm * plant["pin_radius"] * out)[::2])
    ]
    reach = 1.02 * points.real.max()
    gap = 0.06 * (top - bottom)
    bars, labels = look.scale_bars(-0.94 * reach + 1j * (bottom + 1.7 * gap), -1j * gap, 0.3 * reach, times)
    picture = look.drawing([-reach, reach], [bottom, top], annotations=texts + labels)
    caption = f"Lobe {lobe + 1} of disc {d + 1}. Nothing is worn."
    if times:
        caption = (
            f"Lobe {lobe + 1} of disc {d + 1}, the deepest worn. Black: as made; blue: the worn contour at the recorded"
            f" hours. {shapes.enlarged_text(times)}"
        )
    aspect = f"{2 * reach:.2f} / {top - bottom:.2f}"
    return Figure("tooth", "One tooth, enlarged", caption, traces + bars, picture, 5, aspect=aspect)


def contact_pin(result: Result, turn: complex) -> look.Trace:
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


def depth(result: Result) -> Figure:
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
        caption = (
            f"The same tooth unrolled; dotted: the deepest place, at {first:.0f}° first and {last:.0f}° in the end."
        )
    step = 30.0 if high - low < 200.0 else 60.0
    picture = look.layout(
        xaxis=look.angle_axis("phase on the tooth [°]: 0 root, 180 tip", low, high, step),
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
