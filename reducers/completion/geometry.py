"""Whether the parts of a reducer can be made and put together."""

import math
from collections.abc import Mapping

import numpy as np

from fmu_src.faults import InputFault
from reducers.completion.dials import ROLLERS_APART
from reducers.completion.given import GAP, SHIFT, Given
from rv_plant.geometry import centre_curve_curvature
from rv_plant.topology import Topology

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


def check_geometry(given: Given, values: Mapping[str, float]) -> None:
    """PartsFault names the number, its value in mm, why no reducer has it, and what would do; ``values`` in the units of a completion."""
    ring, pin, eccentricity = values["pin.circle_radius"], values["pin.radius"], values["crank.eccentricity"]
    axis, hole, inner, roller = (values[k] for k in ("crank.circle_radius", "outer_race.radius", "inner_race.radius", "roller.radius"))
    pins, cranks = given.pins, given.crank_count
    planet, sun = given.teeth
    if (sun + planet) * math.sin(math.pi / cranks) <= planet + 2:
        raise PartsFault(
            f"--ratio {given.ratio:g} with --pins {pins} and {cranks} cranks: planets of {planet} teeth around a sun of {sun} overlap;"
            f" give --cranks {cranks - 1}, or look at ratio and pins", PLANETS,
        )  # fmt: skip
    if given.diameter is not None and ring + pin >= 0.5 * given.diameter:
        raise PartsFault(
            f"--diameter {given.diameter:g} mm: a ring of pins of {2.0 * (ring + pin):.4g} mm does not fit inside; give the outer diameter of the housing"
        )
    equidistant, shift = (1e-3 * values[name] for name in (GAP, SHIFT))
    check_profile(pins, ring, pin, eccentricity, equidistant, shift)
    check_holes(ring - eccentricity - pin - equidistant, axis, hole, cranks)
    if abs(inner + 2.0 * roller - hole) > 1e-6 * hole:
        raise races_apart(inner, roller, hole)
    pitch = hole - roller
    if inner <= eccentricity or roller > pitch * (1.0 + 1e-9) * math.sin(math.pi / given.rollers - math.radians(0.5 * ROLLERS_APART)):
        raise PartsFault(
            f"roller.radius = {roller:.4g} mm: {given.rollers} rollers do not fit on a circle of {pitch:.4g} mm radius with {ROLLERS_APART:g} degree"
            " between them; give fewer --rollers or smaller ones", ROLLERS,
        )  # fmt: skip
    if values["roller.length"] > values["mesh.width"] * (1.0 + 1e-9):
        raise PartsFault(
            f"roller.length = {values['roller.length']:.4g} mm: longer than the disc is wide (mesh.width = {values['mesh.width']:.4g} mm); give a shorter one"
        )


def check_drive(t: Topology, mm: Mapping[str, float]) -> None:
    """The same of a drive that the rules of RV reducers are not for, as far as the plant needs it; lengths in mm."""
    ring, pin, eccentricity, equidistant, shift = (mm[name] for name in ("pin.circle_radius", "pin.radius", "crank.eccentricity", GAP, SHIFT))
    axis, hole, inner, roller = (mm[name] for name in ("crank.circle_radius", "outer_race.radius", "inner_race.radius", "roller.radius"))
    check_profile(t.pins, ring, pin, eccentricity, equidistant, shift)
    if abs(inner + 2.0 * roller - hole) >= MOST_PLAY:
        raise races_apart(inner, roller, hole)
    pitch = inner + roller
    if roller >= pitch * math.sin(math.pi / t.rollers):
        raise PartsFault(
            f"roller.radius = {roller:.4g} mm: {t.rollers} rollers on a circle of {pitch:.4g} mm radius overlap; give fewer --rollers, or a radius below"
            f" {pitch * math.sin(math.pi / t.rollers):.4g} mm", ROLLERS,
        )  # fmt: skip
    root = ring - eccentricity - pin - equidistant
    if t.output_pins:
        check_output_holes(t.output_pins, mm, hole + axis, root)
    check_holes(root, axis, hole, t.cranks)


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


def check_profile(pins: int, ring: float, pin: float, eccentricity: float, equidistant: float = 0.0, shift: float = 0.0) -> None:
    """Of any drive with pins; lengths in mm.  PartsFault for pins that overlap, loops and undercut."""
    room = ring * math.sin(math.pi / pins)
    if pin >= room:
        raise PartsFault(
            f"pin.radius = {pin:.4g} mm: {pins} pins on a circle of {ring:.4g} mm radius overlap; the pins' radius must be below {room:.4g} mm,"
            f" or pin.circle_radius above {ring * pin / room:.4g} mm, or --pins smaller", PINS,
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
