"""Whether the parts of a reducer can be made and put together."""

import math
from collections.abc import Mapping

import numpy as np

from fmu_src.faults import InputFault
from reducers.completion.dials import ROLLERS_APART
from reducers.completion.given import Given
from rv_plant.geometry import centre_curve_curvature


def largest_pin(ring: float, eccentricity: float, pins: int) -> float:
    """Largest radius of a pin, in the unit of ``ring``, whose flank is not undercut: least radius of curvature of the convex centre curve.

    Infinite where the centre curve is nowhere convex.
    """
    k1 = eccentricity * pins / ring
    phases = np.linspace(0.0, math.pi, 2001)
    sharpest = max(float(centre_curve_curvature(phi, pins - 1, ring, k1)) for phi in phases)
    return 1.0 / sharpest if sharpest > 0.0 else math.inf


def check_geometry(given: Given, values: Mapping[str, float]) -> None:
    """InputFault names the number, its value in mm, why no reducer has it, and what would do."""
    ring, pin, eccentricity = values["pin.circle_radius"], values["pin.radius"], values["crank.eccentricity"]
    axis, hole, inner, roller = (values[k] for k in ("crank.circle_radius", "outer_race.radius", "inner_race.radius", "roller.radius"))
    pins, cranks = given.pins, given.crank_count
    planet, sun = given.teeth
    if (sun + planet) * math.sin(math.pi / cranks) <= planet + 2:
        raise InputFault(
            f"--ratio {given.ratio:g} with --pins {pins} and {cranks} cranks: planets of {planet} teeth around a sun of {sun} overlap;"
            f" give --cranks {cranks - 1}, or look at ratio and pins"
        )
    if given.diameter is not None and ring + pin >= 0.5 * given.diameter:
        raise InputFault(
            f"--diameter {given.diameter:g} mm: a ring of pins of {2.0 * (ring + pin):.4g} mm does not fit inside; give the outer diameter of the housing"
        )
    check_profile(pins, ring, pin, eccentricity)
    rim = ring - eccentricity - pin - axis
    if hole >= rim:
        raise InputFault(
            f"outer_race.radius = {hole:.4g} mm: {rim:.4g} mm lie between the hole's centre (crank.circle_radius = {axis:.4g} mm) and the disc's roots;"
            f" give a smaller hole, or crank.circle_radius below {ring - eccentricity - pin - hole:.4g} mm"
        )
    if hole >= axis * math.sin(math.pi / cranks):
        raise InputFault(
            f"outer_race.radius = {hole:.4g} mm: the holes of {cranks} cranks at crank.circle_radius = {axis:.4g} mm overlap;"
            " give a smaller hole or a larger circle"
        )
    if abs(inner + 2.0 * roller - hole) > 1e-6 * hole:
        raise InputFault(
            f"inner_race.radius = {inner:.4g} mm, roller.radius = {roller:.4g} mm, outer_race.radius = {hole:.4g} mm do not fit each other:"
            f" inner race and a roller's diameter make {inner + 2.0 * roller:.4g} mm; give two of the three, clearance is bearing.clearance"
        )
    pitch = hole - roller
    if inner <= eccentricity or roller > pitch * (1.0 + 1e-9) * math.sin(math.pi / given.rollers - math.radians(0.5 * ROLLERS_APART)):
        raise InputFault(
            f"roller.radius = {roller:.4g} mm: {given.rollers} rollers do not fit on a circle of {pitch:.4g} mm radius with {ROLLERS_APART:g} degree"
            " between them; give fewer --rollers or smaller ones"
        )
    if values["roller.length"] > values["mesh.width"] * (1.0 + 1e-9):
        raise InputFault(
            f"roller.length = {values['roller.length']:.4g} mm: longer than the disc is wide (mesh.width = {values['mesh.width']:.4g} mm); give a shorter one"
        )


def check_profile(pins: int, ring: float, pin: float, eccentricity: float) -> None:
    """Of any drive with pins; lengths in mm.  InputFault for pins that overlap, loops and undercut."""
    room = ring * math.sin(math.pi / pins)
    if pin >= room:
        raise InputFault(
            f"pin.radius = {pin:.4g} mm: {pins} pins on a circle of {ring:.4g} mm radius overlap; the pins' radius must be below {room:.4g} mm,"
            f" or pin.circle_radius above {ring * pin / room:.4g} mm, or --pins smaller"
        )
    if eccentricity * pins >= ring:
        raise InputFault(
            f"crank.eccentricity = {eccentricity:.4g} mm: K1 = e z_p / R_p = {eccentricity * pins / ring:.3g} makes loops of the profile; it must be"
            f" below 1: an eccentricity below {ring / pins:.4g} mm, or pin.circle_radius above {eccentricity * pins:.4g} mm"
        )
    most = largest_pin(ring, eccentricity, pins)
    if pin >= most:
        raise InputFault(
            f"pin.radius = {pin:.4g} mm: the flank is undercut; with crank.eccentricity = {eccentricity:.4g} mm and pin.circle_radius = {ring:.4g} mm the"
            f" pins' radius must be below {most:.4g} mm; give a smaller pin or a smaller eccentricity"
        )
