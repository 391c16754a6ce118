"""The parts of a reducer to scale, as they stand at crank angle 0: ring of pins, discs, cranks with rollers, first stage, contacts."""

import math

import numpy as np

from fmu_src.arrays import Floats, Points
from orchestrator.component import InProcess
from pages import look
from pages.look import Figure, Trace, path
from reducers.reducer import Reducer
from rv_plant.geometry import lobe_point, shortening
from studies.report.shapes import MM, directions, joined, ring

# Points per lobe, and the length of the largest force in pin circle radii.
PER_LOBE, LONGEST_FORCE = 48, 0.22
DISC_COLOURS = ("#0b4f94", "#d55e00", "#009e73")


def eccentric(reducer: Reducer, d: int) -> complex:
    """Centre of disc ``d`` from that of the ring [mm], input and output at angle 0."""
    return complex(MM * reducer.starts["eccentricity"] * np.exp(2j * math.pi * d / reducer.topology.discs))


def outline(reducer: Reducer, d: int) -> Points:
    """The unmodified flank of disc ``d`` [mm], closed, shape (lobes * PER_LOBE,)."""
    lobes, s = reducer.topology.lobes, reducer.starts
    k1 = shortening(s["eccentricity"], lobes, s["pin_circle_radius"])
    phases = np.linspace(-math.pi, math.pi, PER_LOBE, endpoint=False)
    rows = np.array([lobe_point(phi, lobes, s["pin_circle_radius"], s["pin_radius"], s["eccentricity"], k1)[:2] for phi in phases])
    # The profile of disc d is cut turned against its holes, so that all discs mesh.
    turns = np.exp(2j * math.pi * (np.arange(lobes) - d / reducer.topology.discs) / lobes)
    return np.asarray(eccentric(reducer, d) + MM * (turns[:, None] * (rows[:, 0] + 1j * rows[:, 1])).ravel())


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


def pin_forces(reducer: Reducer) -> Floats:
    """Forces [N] of the plant at rated torque and crank angle 0, shape (discs, pins)."""
    plant = InProcess("plant", reducer.specification("rv_plant"))
    plant.set("input_speed", 0.0)
    plant.exit_initialisation()
    plant.step(0.0, 1.0)
    return np.array(plant.records["mesh_force"][0], float)


def assembly(reducer: Reducer, diameter: float | None) -> Figure:
    """All parts; ``diameter`` of the housing [mm] where it is known."""
    s, t = reducer.starts, reducer.topology
    # Without a housing as far as the longest force may stand out.
    reach = 1.02 * ((1.0 + 0.8 * LONGEST_FORCE) * MM * s["pin_circle_radius"] if diameter is None else 0.5 * diameter)
    traces = [] if diameter is None else [path(ring(0.5 * diameter), look.QUIET, 1.5)]
    traces += [path(ring(MM * s["pin_circle_radius"]), look.GRID, 1.0, dash="dot")]
    for d in reversed(range(t.discs)):
        fill = {"fill": "toself", "fillcolor": look.STEEL} if d == 0 else {}
        traces.append(path(outline(reducer, d), DISC_COLOURS[d], 1.2, close=True) | fill | {"name": f"disc {d + 1}", "showlegend": True})
    traces += cranks(reducer)
    traces.append(path(joined([ring(MM * s["pin_radius"], place, 32) for place in pin_places(reducer)]), look.INK, 0.9))
    traces += forces(reducer)
    traces = [{"showlegend": False} | trace for trace in traces]
    picture = look.drawing([-reach, reach], [-reach, reach]) | {"showlegend": True, "legend": {"orientation": "h", "x": 0, "y": 0, "yanchor": "top"}}
    picture["margin"] = {"l": 4, "r": 4, "t": 4, "b": 36}
    return Figure(
        "assembly", "The parts to scale",
        "Crank angle 0, seen along the axis; disc 1 is filled, the first stage's pitch circles are dashed."
        " Forces of flanks on pins at rated torque stand on their contacts, as long as they are large.",
        traces, picture, 7, aspect="1 / 1.05",
    )  # fmt: skip


def zoom(whole: Figure, reducer: Reducer) -> Figure:
    """The teeth around the most loaded pin of disc 1."""
    force = pin_forces(reducer)[0]
    centre = pin_places(reducer)[int(force.argmax())]
    half = 3.2 * MM * reducer.starts["pin_circle_radius"] * math.sin(math.pi / reducer.topology.pins)
    picture = look.drawing([centre.real - half, centre.real + half], [centre.imag - half, centre.imag + half])
    caption = f"The most loaded pin carries {force.max():,.0f} N; {int((force > 0.0).sum())} of {force.size} pins touch disc 1."
    return Figure("teeth", "Teeth and pins", caption, whole.data, picture, 5, aspect="1 / 1.05")


def cranks(reducer: Reducer) -> list[Trace]:
    """Holes, lobes and rollers of disc 1, and pitch circles of sun and planets."""
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
