"""The parts of a reducer to scale, as they stand at crank angle 0: ring of pins, discs, cranks with rollers, first stage, contacts.

Parts that are out of place stand in a colour of their own beside the ideal ones, as far off as can be seen.
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from fmu_src.arrays import Floats, Points, Records
from fmu_src.effect_words import effect_words
from orchestrator.component import InProcess
from pages import look
from pages.look import Figure, Layout, Trace, path
from pages.words import number
from reducers.reducer import Reducer
from rv_plant.effects import EFFECTS
from rv_plant.geometry import lobe_point, shortening
from rv_plant.pin_numbers import PIN_NUMBERS, pin_of
from studies.report.shapes import MM, directions, joined, ring

# Points per lobe, and the length of the largest force in pin circle radii.
PER_LOBE, LONGEST_FORCE = 48, 0.22
EVENLY = np.linspace(-math.pi, math.pi, PER_LOBE, endpoint=False)
# So near to 1 the root of a profile is a cusp, which has no normal: it is drawn a little beyond.
CUSP = 1e-6
# Of a drawing's width, the longest that its scale may be.
SCALE_SHARE = 0.2
DISC_COLOURS = ("#0b4f94", "#d55e00", "#009e73")
# Forces of a picture are those of one place: another pin, or a proud one, has more at another.
OVER_A_TURN = "over a turn of the cranks it may be more: rvwear solve has the largest"
# Of parts out of place; the largest error is drawn at most so long, in pin circle radii; what is less is none [mm].
OFF, LONGEST_ERROR, NO_ERROR = "#a3195b", 0.04, 1e-9


@dataclass(frozen=True)
class PartsOff:
    """Parts of one kind that are out of place: their ideal contours, and how far each point of these is off [mm].

    ``disc`` counts from 0; ``shown``: the ideal contours stand in the drawing anyway.
    """

    what: str
    ideal: list[Points]
    by: list[Points]
    disc: int = 0
    shown: bool = False

    @property
    def largest(self) -> float:
        return max(float(np.abs(by).max()) for by in self.by)

    @property
    def words(self) -> str:
        return f"{self.what}, up to {number(1e3 * self.largest)} µm"


def eccentric(reducer: Reducer, d: int) -> complex:
    """Centre of disc ``d`` from that of the ring [mm], input and output at angle 0."""
    return complex(MM * reducer.starts["eccentricity"] * np.exp(2j * math.pi * d / reducer.topology.discs))


def outline(reducer: Reducer, d: int, phases: Floats = EVENLY) -> Points:
    """The unmodified flank of disc ``d`` [mm], closed, at the local ``phases`` [rad] of each lobe."""
    lobes = reducer.topology.lobes
    # The profile of disc d is cut turned against its holes, so that all discs mesh.
    turns = np.exp(2j * math.pi * (np.arange(lobes) - d / reducer.topology.discs) / lobes)
    return np.asarray(eccentric(reducer, d) + (turns[:, None] * lobe_flank(reducer, phases)).ravel())


def lobe_flank(reducer: Reducer, phases: Floats) -> Points:
    """The unmodified flank of one lobe [mm] from the middle of its disc, its root at angle 0, at local phases [rad]."""
    lobes, s = reducer.topology.lobes, reducer.starts
    k1 = shortening(s["eccentricity"], lobes, s["pin_circle_radius"])
    if abs(k1 - 1.0) < CUSP:
        k1 = 1.0 + CUSP
    rows = np.array([lobe_point(phi, lobes, s["pin_circle_radius"], s["pin_radius"], s["eccentricity"], k1)[:2] for phi in phases])
    return np.asarray(MM * (rows[:, 0] + 1j * rows[:, 1]))


def pin_places(reducer: Reducer) -> Points:
    """Centres of the pins [mm]."""
    count = reducer.topology.pins
    return np.asarray(MM * reducer.starts["pin_circle_radius"] * directions(360.0 * np.arange(count) / count))


def contact_points(reducer: Reducer, d: int) -> tuple[Points, Points]:
    """(where each pin touches disc ``d`` [mm], outward normal of the flank there)."""
    count, s = reducer.topology.pins, reducer.starts
    k1 = shortening(s["eccentricity"], reducer.topology.lobes, s["pin_circle_radius"])
    ways = directions(360.0 * np.arange(count) / count)
    towards = 1.0 - k1 * np.exp(2j * math.pi * d / reducer.topology.discs) / ways
    normals = ways * towards / np.abs(towards)
    return pin_places(reducer) - MM * s["pin_radius"] * normals, normals


def at_rest(reducer: Reducer) -> Records:
    """The plant at rated torque and crank angle 0."""
    plant = InProcess("plant", reducer.specification("rv_plant"))
    plant.set("input_speed", 0.0)
    plant.exit_initialisation()
    plant.step(0.0, 1.0)
    return plant.records


def pin_forces(reducer: Reducer) -> Floats:
    """Forces [N] of the plant at rated torque and crank angle 0, shape (discs, pins)."""
    return np.array(at_rest(reducer)["mesh_force"][0], float)


def assembly(reducer: Reducer, diameter: float | None) -> Figure:
    """All parts; ``diameter`` of the housing [mm] where it is known."""
    off = parts_off(reducer)
    times = enlarged(reducer, off)
    traces = [*contours(reducer, diameter), *forces(reducer), *(trace for parts in off for trace in off_traces(parts, times))]
    said = f" Forces of flanks on pins at rated torque stand on their contacts, as long as they are large.{off_words(reducer, off, times)}"
    return framed(reducer, diameter, traces, said)


def contours(reducer: Reducer, diameter: float | None, phases: Floats = EVENLY) -> list[Trace]:
    """The parts alone, whatever becomes of them under load."""
    s, t = reducer.starts, reducer.topology
    traces = [] if diameter is None else [path(ring(0.5 * diameter), look.QUIET, 1.5)]
    traces += [path(ring(MM * s["pin_circle_radius"]), look.GRID, 1.0, dash="dot")]
    for d in reversed(range(t.discs)):
        fill = {"fill": "toself", "fillcolor": look.STEEL} if d == 0 else {}
        traces.append(path(outline(reducer, d, phases), DISC_COLOURS[d], 1.2, close=True) | fill | {"name": f"disc {d + 1}", "showlegend": True})
    traces += cranks(reducer)
    traces.append(path(joined([ring(MM * s["pin_radius"], place, 32) for place in pin_places(reducer)]), look.INK, 0.9))
    return traces


def framed(reducer: Reducer, diameter: float | None, traces: list[Trace], said: str) -> Figure:
    """Traces of the whole with a scale; ``said`` of them beside what all drawings have."""
    # Without a housing as far as the longest force may stand out.
    reach = 1.02 * ((1.0 + 0.8 * LONGEST_FORCE) * MM * reducer.starts["pin_circle_radius"] if diameter is None else 0.5 * diameter)
    bar, length = scale_bar(0j, reach, -1.0 - 1.0j)
    traces = [{"showlegend": False} | trace for trace in [*traces, bar]]
    picture = look.drawing([-reach, reach], [-reach, reach]) | {"showlegend": True, "legend": {"orientation": "h", "x": 0, "y": 0, "yanchor": "top"}}
    picture["annotations"] = [length]
    picture["margin"] = {"l": 4, "r": 4, "t": 4, "b": 36}
    return Figure(
        "assembly", "The parts to scale", f"Crank angle 0, seen along the axis; disc 1 is filled, the first stage's pitch circles are dashed.{said}",
        traces, picture, 7, aspect="1 / 1.05",
    )  # fmt: skip


def zoom(whole: Figure, reducer: Reducer) -> Figure:
    """The teeth around the most loaded pin of disc 1."""
    force = pin_forces(reducer)[0]
    centre = pin_places(reducer)[int(force.argmax())]
    half = 3.2 * MM * reducer.starts["pin_circle_radius"] * math.sin(math.pi / reducer.topology.pins)
    touching = f"{int((force > 0.0).sum())} of {force.size} pins touch it"
    caption = f"At crank angle 0 the most loaded pin of disc 1 carries {force.max():,.0f} N and {touching}; {OVER_A_TURN}."
    if times := enlarged(reducer, parts_off(reducer)):
        caption += f" Errors are drawn {times:,.0f} times."
    return zoomed(whole, centre, half, "Teeth and pins", caption)


def zoomed(whole: Figure, centre: complex, half: float, title: str, caption: str) -> Figure:
    """``half`` [mm] of a drawing to each side of a place of it."""
    picture = look.drawing([centre.real - half, centre.real + half], [centre.imag - half, centre.imag + half])
    # Outside of the discs there is room.
    bar, length = scale_bar(centre, half, complex(math.copysign(1.0, centre.real), math.copysign(1.0, centre.imag)))
    picture["annotations"] = [length]
    return Figure("teeth", title, caption, [*whole.data, bar | {"showlegend": False}], picture, 5, aspect="1 / 1.05")


def scale_bar(centre: complex, half: float, corner: complex) -> tuple[Trace, Layout]:
    """A round length, at most a fifth of a drawing ``half`` [mm] to each side of its ``centre``, in one ``corner`` of it, with how long it is above."""
    length, tick = look.round_down(2.0 * SCALE_SHARE * half), 0.02j * half
    start = centre + complex(0.96 * half * corner.real - (length if corner.real > 0.0 else 0.0), (0.96 if corner.imag < 0.0 else 0.86) * half * corner.imag)
    bar = path(np.array([start + tick, start, start + length, start + length + tick]), look.INK, 1.5)
    return bar, look.note(start.real + 0.5 * length, start.imag, f"{length:g} mm", yanchor="bottom", yshift=1)


def cranks(reducer: Reducer) -> list[Trace]:
    """Holes, eccentrics and rollers of disc 1, and pitch circles of sun and planets."""
    s, t = reducer.starts, reducer.topology
    inner, outer, roller, axis = (MM * s[k] for k in ("inner_race_radius", "outer_race_radius", "roller_radius", "crank_circle_radius"))
    seats = axis * directions(360.0 * np.arange(t.cranks) / t.cranks)
    middles = seats + eccentric(reducer, 0)
    around = (inner + roller) * directions(360.0 * np.arange(t.rollers) / t.rollers)
    pitch = axis / (1.0 + s["first_stage_ratio"])
    planets = [ring(axis - pitch, seat) for seat in seats]
    return [
        path(joined([ring(outer, m) for m in middles]), look.QUIET, 1.0, fill="toself", fillcolor=look.PAPER),
        path(joined([ring(inner, m) for m in middles]), look.QUIET, 1.0, fill="toself", fillcolor=look.STEEL),
        path(joined([ring(roller, m + a, 24) for m in middles for a in around]), "#98a3af", 0.8),
        path(joined([ring(pitch), *planets]), "#009e73", 1.0, dash="dash"),
    ]


def forces(reducer: Reducer) -> list[Trace]:
    """A line for each loaded contact, outwards along its normal."""
    found = pin_forces(reducer)
    most = LONGEST_FORCE * MM * reducer.starts["pin_circle_radius"] / max(float(found.max()), 1e-9)
    traces = []
    for d, row in enumerate(found):
        points, normals = contact_points(reducer, d)
        lines = [np.array([p, p + most * f * n]) for p, n, f in zip(points, normals, row) if f > 0.0]
        traces.append(path(joined(lines), DISC_COLOURS[d], 2.2))
    return traces


def parts_off(reducer: Reducer) -> list[PartsOff]:
    """Parts out of place by effects, or by errors that the file states, kind by kind and disc by disc."""
    found, t, now = [], reducer.topology, at_rest(at_whole_pins(reducer))[0]
    inner, outer, axis = (MM * reducer.starts[k] for k in ("inner_race_radius", "outer_race_radius", "crank_circle_radius"))
    ways = directions(360.0 * np.arange(t.cranks) / t.cranks)
    for d in range(t.discs):
        middles, turn = axis * ways + eccentric(reducer, d), np.exp(2j * math.pi * d / t.discs)
        throw = now["eccentricity"] + now["crank_eccentricity_error"][d] + now["throw_added"][d]
        turned = now["crank_phase_error"][d] + now["lobe_turn_added"][d]
        hole = now["disc_hole_error_radial"][d] + now["hole_radial_added"][d] + 1j * (now["disc_hole_error_tangential"][d] + now["hole_tangential_added"][d])
        found += [
            flanks_off(reducer, now, d),
            circles_off(f"holes of disc {d + 1}", outer, middles, MM * ways * hole, d),
            circles_off(f"eccentrics of the cranks at disc {d + 1}", inner, middles, MM * turn * (throw * np.exp(1j * turned) - now["eccentricity"]), d),
        ]
    seat = now["carrier_hole_error_radial"] + now["seat_radial_added"] + 1j * (now["carrier_hole_error_tangential"] + now["seat_tangential_added"])
    # A seat's own radius is nobody's number: half of the race above it stands for it.
    found += [circles_off("seats of the cranks in the carrier", 0.5 * inner, axis * ways, MM * ways * seat), pins_off(reducer, now)]
    return [parts for parts in found if parts.ideal]


def at_whole_pins(reducer: Reducer) -> Reducer:
    """With an error that was fitted next to a pin at that pin, as its number is told: a few thousandths of it at the next one are no error there."""
    return replace(reducer, starts=reducer.starts | {name: pin_of(reducer.starts[name]) for name in PIN_NUMBERS & reducer.starts.keys()})


def circles_off(what: str, radius: float, middles: Points, by: Points, d: int = 0) -> PartsOff:
    """Those of equal circles that are displaced by more than nothing."""
    which = np.flatnonzero(np.abs(by) > NO_ERROR)
    return PartsOff(what, [ring(radius, middles[i]) for i in which], [np.full(121, by[i]) for i in which], d)


def flanks_off(reducer: Reducer, now: Records, d: int) -> PartsOff:
    """The profile of disc ``d``: material that is missing, drawn inwards, and lobes along the pitch."""
    ideal = outline(reducer, d)
    ways = ideal - eccentric(reducer, d)
    ways /= np.abs(ways)
    # A lobe of the outline goes from tip to tip, one of the plant from root to root.
    lobe = (np.arange(ideal.size) - PER_LOBE // 2) // PER_LOBE
    missing = (now["lobe_profile_error"] + now["lobe_gap_added"])[d, lobe]
    along = (now["lobe_pitch_error"] + now["lobe_pitch_added"])[d, lobe]
    by = MM * ways * (1j * along - missing)
    is_off = np.abs(by).max() > NO_ERROR
    return PartsOff(f"teeth of disc {d + 1}", [np.append(ideal, ideal[0])] if is_off else [], [np.append(by, by[0])] if is_off else [], d, True)


def pins_off(reducer: Reducer, now: Records) -> PartsOff:
    """Pins displaced, or thicker than the others."""
    places = pin_places(reducer)
    thicker = MM * (now["pin_radius_error"] + now["pin_radius_added"])
    by = [MM * (x + 1j * y) - place + ring(thick, 0.0, 32) for x, y, place, thick in zip(now["pin_x"], now["pin_y"], places, thicker)]
    which = [i for i, each in enumerate(by) if np.abs(each).max() > NO_ERROR]
    return PartsOff("pins", [ring(MM * reducer.starts["pin_radius"], places[i], 32) for i in which], [by[i] for i in which], shown=True)


def enlarged(reducer: Reducer, off: list[PartsOff]) -> float:
    """How many times errors are enlarged, one number for all; 0 where nothing is out of place."""
    return look.round_down(LONGEST_ERROR * MM * reducer.starts["pin_circle_radius"] / max(parts.largest for parts in off)) if off else 0.0


def off_traces(parts: PartsOff, times: float) -> list[Trace]:
    """Where the parts should be, dotted, and where they are, in a dash for each disc."""
    moved = joined([ideal + times * by for ideal, by in zip(parts.ideal, parts.by)])
    name = f"{parts.words} (drawn {times:,.0f} times)"
    ideal = [] if parts.shown else [path(joined(parts.ideal), OFF, 0.7, dash="dot")]
    return [*ideal, path(moved, OFF, 1.5, dash=("solid", "dash", "dashdot")[parts.disc], name=name, showlegend=True)]


def off_words(reducer: Reducer, off: list[PartsOff], times: float) -> str:
    """What is drawn out of place and how many times enlarged, and which effects' numbers the drawing does not have."""
    drawn = f" Errors are drawn {times:,.0f} times, in red beside the ideal part: {'; '.join(parts.words for parts in off)}." if off else ""
    left = undrawn(reducer, off)
    return drawn + (f" Not drawn: {', '.join(left)}." if left else "")


def undrawn(reducer: Reducer, off: list[PartsOff]) -> list[str]:
    """Numbers of effects that are on and move nothing of the drawing."""
    told = []
    for name, effect in EFFECTS.items():
        for variable in (p.variable for p in effect.amplitudes()):
            if reducer.starts.get(variable.name, variable.start) == variable.start:
                continue
            without = parts_off(replace(reducer, starts=reducer.starts | {variable.name: variable.start}))
            if same(without, off):
                told.append(f"{effect_words(name)} ({variable.path.rpartition('.')[2].replace('_', ' ')})")
    return told


def same(some: list[PartsOff], others: list[PartsOff]) -> bool:
    """Whether the same parts are off by the same."""
    return [p.what for p in some] == [p.what for p in others] and all(
        len(a.by) == len(b.by) and all(np.array_equal(x, y) for x, y in zip(a.by, b.by)) for a, b in zip(some, others)
    )
