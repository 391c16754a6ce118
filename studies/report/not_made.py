"""The drawing of a reducer, also of one that cannot be made: its parts as they are stated, with the place where they do not go with each other in red.

Such a reducer carries nothing, so that no forces are drawn, and one for which no equilibrium is found has none either.
"""

import math
from dataclasses import dataclass, field

import numpy as np

from fmu_src.arrays import Points
from fmu_src.faults import InputFault, RunFault
from pages.look import Figure, Trace, path
from reducers.reducer import Reducer
from rv_plant.geometry import centre_curve_curvature, shortening
from rv_plant.parts import HOLES, LOOPS, OUTPUT_HOLES, PINS, PLANETS, ROLLERS, ROOTS, UNDERCUT
from studies.report.assembly import OFF, assembly, contours, eccentric, framed, lobe_flank, pin_places, zoom, zoomed
from studies.report.shapes import MM, directions, joined, ring

# Of what is filled in red.
TINT = "rgba(163,25,91,0.25)"
# Places on a lobe at which its flank is looked at.
FINE = 721
# And those at which it is drawn [rad], near each other at its root: where K1 is near 1 the flank turns there within a hundredth of a lobe.
DRAWN = math.pi * np.sinh(5.0 * np.linspace(-1.0, 1.0, 161)[:-1]) / math.sinh(5.0)


@dataclass(frozen=True)
class Marked:
    """Where parts do not go with each other [mm]: closed ``areas`` and ``lines`` to be drawn in red, and the middle and half width of a closer look."""

    centre: complex
    half: float
    areas: list[Points] = field(default_factory=list)
    lines: list[Points] = field(default_factory=list)


def drawings(reducer: Reducer, place: str | None, diameter: float | None = None) -> tuple[list[Figure], str]:
    """The whole and a closer look at it; ``place`` of ``rv_plant.parts`` where it cannot be made, None where it can.

    Also what keeps forces from being drawn where that is another reason, in words.
    """
    if place is None:
        try:
            whole = assembly(reducer, diameter)
            return [whole, zoom(whole, reducer)], ""
        except (InputFault, RunFault) as fault:
            return [framed(reducer, diameter, contours(reducer, diameter), " No forces are drawn.")], f"no forces are drawn: {fault}"
    marked = marks(reducer, place)
    if marked is None:
        return [framed(reducer, diameter, contours(reducer, diameter), " What does not fit is not seen along the axis.")], ""
    said = f" In red: {place}. No forces are drawn, for it cannot be made so."
    whole = framed(reducer, diameter, [*contours(reducer, diameter, DRAWN), *traces_of(marked, place)], said)
    return [whole, zoomed(whole, marked.centre, marked.half, "Where it cannot be made", f"In red: {place}.")], ""


def traces_of(marked: Marked, place: str) -> list[Trace]:
    areas = [path(joined(marked.areas), OFF, 1.2, fill="toself", fillcolor=TINT)] if marked.areas else []
    lines = [path(joined(marked.lines), OFF, 3.0)] if marked.lines else []
    first, *others = [*areas, *lines]
    return [first | {"name": place, "showlegend": True}, *others]


def marks(reducer: Reducer, place: str) -> Marked | None:
    """None for what is not seen along the axis."""
    s, t = reducer.starts, reducer.topology
    room = MM * s["pin_circle_radius"] * math.sin(math.pi / t.pins)
    hole, axis = MM * s["outer_race_radius"], MM * s["crank_circle_radius"]
    middles = axis * directions(360.0 * np.arange(t.cranks) / t.cranks) + eccentric(reducer, 0)
    match place:
        case _ if place == PINS:
            pins, radius = pin_places(reducer), MM * s["pin_radius"]
            return Marked(complex(0.5 * (pins[0] + pins[1])), 2.0 * max(1.6 * room, radius), [lens(*pair, radius) for pair in zip(pins, np.roll(pins, -1))])
        case _ if place == LOOPS:
            stretches = turned_back(reducer)
            return Marked(complex(np.mean(stretches[0])), 1.6 * room, lines=stretches)
        case _ if place == UNDERCUT:
            # A tenth of a mm and less: a ring about each is what one sees of it.
            stretches = turned_back(reducer)
            middles = np.array([np.mean(stretch) for stretch in stretches])
            return Marked(complex(middles[0]), 0.6 * room, [ring(0.15 * room, m, 24) for m in middles], stretches)
        case _ if place == ROOTS:
            return Marked(complex(middles[0]), 1.4 * hole, [ring(hole, m) for m in middles])
        case _ if place == HOLES:
            return Marked(complex(0.5 * (middles[0] + middles[1])), 1.4 * hole, [ring(hole, m) for m in middles])
        case _ if place == ROLLERS:
            radius, pitch = MM * s["roller_radius"], MM * (s["inner_race_radius"] + s["roller_radius"])
            around = pitch * directions(360.0 * np.arange(t.rollers) / t.rollers)
            return Marked(complex(middles[0]), 1.3 * max(hole, pitch + radius), [ring(radius, m + a, 24) for m in middles for a in around])
        case _ if place == PLANETS:
            pitch = axis / (1.0 + s["first_stage_ratio"])
            return Marked(0j, 1.1 * (2.0 * axis - pitch), [ring(axis - pitch, m - eccentric(reducer, 0)) for m in middles])
        case _ if place == OUTPUT_HOLES:
            radius = MM * (s["output_pin_radius"] + s["eccentricity"] + s["output_clearance"])
            holes = MM * s["output_circle_radius"] * directions(360.0 * np.arange(t.output_pins) / t.output_pins) + eccentric(reducer, 0)
            return Marked(complex(holes[0]), 2.2 * radius, [ring(radius, h) for h in holes])
    return None


def lens(one: complex, other: complex, radius: float) -> Points:
    """What two equal circles have in common; nothing where they do not meet."""
    apart = abs(other - one)
    if apart >= 2.0 * radius:
        return np.array([], complex)
    half = math.degrees(math.acos(0.5 * apart / radius))
    arc = radius * (other - one) / apart * directions(np.linspace(-half, half, 25))
    return np.concatenate((one + arc, other - arc, one + arc[:1]))


def turned_back(reducer: Reducer) -> list[Points]:
    """Where the flank of disc 1 runs backwards, lobe by lobe from that at angle 0 on: in loops of the profile, or where it is undercut."""
    s, lobes = reducer.starts, reducer.topology.lobes
    circle = s["pin_circle_radius"] + s["shift_modification"]
    pin, k1 = s["pin_radius"] + s["equidistant_modification"], shortening(s["eccentricity"], lobes, circle)
    phases = np.linspace(-math.pi, math.pi, FINE)
    if k1 >= 1.0:
        back = np.cos(phases) > 1.0 / k1
    else:
        back = np.array([pin * centre_curve_curvature(float(phi), lobes, circle, k1) >= 1.0 for phi in phases])
    # What is that much beyond a limit may be less than two of the places that are looked at.
    sharpest = 0.0 if k1 >= 1.0 else max(phases, key=lambda phi: float(centre_curve_curvature(float(phi), lobes, circle, k1)))
    back |= np.abs(np.abs(phases) - abs(sharpest)) < 2.5 * math.pi / FINE
    ends = np.flatnonzero(np.diff(back)) + 1
    runs = [lobe_flank(reducer, run) for run in np.split(phases, ends) if back[np.searchsorted(phases, run[0])]]
    return [eccentric(reducer, 0) + np.exp(2j * math.pi * k / lobes) * run for k in range(lobes) for run in runs]
