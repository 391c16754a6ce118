"""Whether the parts of a drive can be made and put together, in words: which number, its value in mm, why no drive has it, and what would do."""

import math
from collections.abc import Mapping

import numpy as np

from fmu_src.arrays import Records
from fmu_src.faults import InputFault
from fmu_src.table import Table
from rv_plant.faults import OF_PARTS
from rv_plant.geometry import centre_curve_curvature
from rv_plant.topology import Topology

MM = 1e3
# Races and rollers of any drive may miss each other by less than this [mm]: the plant takes it for clearance.
MOST_PLAY = 0.1

# Which parts do not go with each other, for a drawing to mark them.
PINS, LOOPS, UNDERCUT, ROOTS, HOLES, ROLLERS, PLANETS, OUTPUT_HOLES, NOWHERE = (
    "pins that overlap", "loops of the profile", "undercut flank", "hole and roots", "holes that overlap", "rollers and races", "planets that overlap",
    "holes of the output pins", "",
)  # fmt: skip


class PartsFault(InputFault):
    """Parts that cannot be made or put together, and which of them: one of the names above, ``NOWHERE`` if it is not seen along the axis."""

    def __init__(self, text: str, place: str = NOWHERE):
        super().__init__(text)
        self.place = place


def largest_pin(ring: float, eccentricity: float, pins: int) -> float:
    """Largest radius of a pin, in the unit of ``ring``, whose flank is not undercut: least radius of curvature of the convex centre curve.

    Infinite where the centre curve is nowhere convex.
    """
    k1 = eccentricity * pins / ring
    phases = np.linspace(0.0, math.pi, 2001)
    sharpest = max(float(centre_curve_curvature(phi, pins - 1, ring, k1)) for phi in phases)
    return 1.0 / sharpest if sharpest > 0.0 else math.inf


def largest_eccentricity(ring: float, pin: float, pins: int) -> float:
    """Largest eccentricity, in the unit of ``ring``, with which flanks for pins of this radius are not undercut."""
    low, high = 0.0, ring / pins
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if largest_pin(ring, middle, pins) > pin else (low, middle)
    return low


def cannot_be_made(code: int, records: Records, table: Table, topology: Topology, name: str) -> str:
    """Of the reducer of a ``name`` what a status code of the plant means in mm, with the limit; empty for one that is not about its parts."""
    if code not in OF_PARTS:
        return ""
    try:
        check_drive(topology, {v.path: MM * float(records[v.name][0]) for v in table.variables if not v.shape})
    except PartsFault as fault:
        return f"{name} cannot be made: {fault}"
    # On the limit itself: what the plant says of it.
    return ""


def check_drive(t: Topology, mm: Mapping[str, float]) -> None:
    """PartsFault for what the plant refuses, of any drive; lengths in mm."""
    ring, pin, eccentricity, equidistant, shift = (
        mm[name] for name in ("pin.circle_radius", "pin.radius", "crank.eccentricity", "disc.equidistant_modification", "disc.shift_modification")
    )
    axis, hole, inner, roller = (mm[name] for name in ("crank.circle_radius", "outer_race.radius", "inner_race.radius", "roller.radius"))
    check_profile(t.pins, ring, pin, eccentricity, equidistant, shift)
    root = ring - eccentricity - pin - equidistant
    if t.output_pins:
        check_output_holes(t.output_pins, mm, hole + axis, root)
    check_holes(root, axis, hole, t.cranks)
    if abs(inner + 2.0 * roller - hole) >= MOST_PLAY:
        raise races_apart(inner, roller, hole)
    pitch = inner + roller
    if roller >= pitch * math.sin(math.pi / t.rollers):
        raise PartsFault(
            f"roller.radius = {roller:.4g} mm: {t.rollers} rollers on a circle of {pitch:.4g} mm radius overlap; give fewer topology.rollers, or a radius below"
            f" {pitch * math.sin(math.pi / t.rollers):.4g} mm", ROLLERS,
        )  # fmt: skip


def check_output_holes(count: int, mm: Mapping[str, float], bearing: float, root: float) -> None:
    """Holes for output pins between what the bearings take, from the middle, and the disc's roots [mm]."""
    pin, circle = mm["output_pin.radius"], mm["output_pin.circle_radius"]
    more = mm["crank.eccentricity"] + mm["output_pin.clearance"]
    hole = pin + more
    neighbour, inside, outside = circle * math.sin(math.pi / count), circle - bearing, root - circle
    most = min(neighbour, inside, outside)
    if hole < most:
        return
    why = (
        f"the holes of {count} output pins on a circle of {circle:.4g} mm radius overlap" if most == neighbour else
        f"the hole of an output pin cuts that of the bearing, {inside:.4g} mm from its centre" if most == inside else
        f"the hole of an output pin cuts the roots of the disc, {outside:.4g} mm from its centre"
    )  # fmt: skip
    remedy = f"the pins' radius must be below {most - more:.4g} mm" if most > more else "give another output_pin.circle_radius"
    raise PartsFault(f"output_pin.radius = {pin:.4g} mm: {why}; with eccentricity and clearance a hole has {hole:.4g} mm: {remedy}", OUTPUT_HOLES)


def check_holes(root: float, axis: float, hole: float, cranks: int) -> None:
    """Holes for the cranks' bearings, in a disc whose roots are at ``root`` from its middle [mm]."""
    rim = root - axis
    if hole >= rim:
        nearer = f", or crank.circle_radius below {root - hole:.4g} mm" if axis > 0.0 else ""
        raise PartsFault(
            f"outer_race.radius = {hole:.4g} mm: {rim:.4g} mm lie between the hole's centre (crank.circle_radius = {axis:.4g} mm) and the disc's roots;"
            f" give a smaller hole{nearer}", ROOTS,
        )  # fmt: skip
    if cranks > 1 and hole >= axis * math.sin(math.pi / cranks):
        raise PartsFault(
            f"outer_race.radius = {hole:.4g} mm: the holes of {cranks} cranks at crank.circle_radius = {axis:.4g} mm overlap;"
            " give a smaller hole or a larger circle", HOLES,
        )  # fmt: skip


def races_apart(inner: float, roller: float, hole: float) -> PartsFault:
    return PartsFault(
        f"inner_race.radius = {inner:.4g} mm, roller.radius = {roller:.4g} mm, outer_race.radius = {hole:.4g} mm do not fit each other:"
        f" inner race and a roller's diameter make {inner + 2.0 * roller:.4g} mm; give two of the three, clearance is bearing.clearance", ROLLERS,
    )  # fmt: skip


def check_profile(pins: int, ring: float, pin: float, eccentricity: float, equidistant: float = 0.0, shift: float = 0.0,
                  count: str = "topology.pins") -> None:  # fmt: skip
    """Of any drive with pins; lengths in mm.  PartsFault for pins that overlap, loops and undercut; ``count`` is what the user calls their number."""
    room = ring * math.sin(math.pi / pins)
    if pin >= room:
        raise PartsFault(
            f"pin.radius = {pin:.4g} mm: {pins} pins on a circle of {ring:.4g} mm radius overlap; the pins' radius must be below {room:.4g} mm,"
            f" or pin.circle_radius above {ring * pin / room:.4g} mm, or {count} smaller", PINS,
        )  # fmt: skip
    circle = ring + shift
    if eccentricity * pins >= circle:
        raise PartsFault(
            f"crank.eccentricity = {eccentricity:.4g} mm: K1 = e z_p / R_p = {eccentricity * pins / circle:.3g} makes loops of the profile; it must be"
            f" below 1: an eccentricity below {circle / pins:.4g} mm, or pin.circle_radius above {eccentricity * pins - shift:.4g} mm", LOOPS,
        )  # fmt: skip
    most = largest_pin(circle, eccentricity, pins) - equidistant
    if pin >= most:
        modified = f" and disc.equidistant_modification = {1e3 * equidistant:.4g} um" if equidistant else ""
        raise PartsFault(
            f"pin.radius = {pin:.4g} mm: the flank is undercut; with crank.eccentricity = {eccentricity:.4g} mm and pin.circle_radius = {ring:.4g} mm{modified}"
            f" the pins' radius must be below {most:.4g} mm; give a smaller pin, or an eccentricity below"
            f" {largest_eccentricity(circle, pin + equidistant, pins):.4g} mm", UNDERCUT,
        )  # fmt: skip
