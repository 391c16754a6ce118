"""What is doubtful about what is given of a reducer, or stands in its file: where it is completed, and where the file is checked."""

import math

from fmu_src.display import read_text
from reducers.completion.dials import RING_SHARE
from reducers.completion.given import SUN, Given

# Pin circle radius [mm] over the cube root of the torque [N mm] that is usual (cycloid handbooks).
TORQUE_SHARE = (0.85, 1.3)
# Teeth below which a hob cuts into the roots of a gear without profile shift: 2 h_a / sin^2 alpha of the standard basic rack (ISO 53: addendum of a
# module, 20 degrees).
NO_UNDERCUT = 2.0 / math.sin(math.radians(20.0)) ** 2
# Profile shift [modules] that suns of few teeth have at most (assumed): from ten teeth on less does.
LARGEST_SHIFT = 0.5
RING = "pin.circle_radius"
# The number that is free where a catalogue states the stiffness.
FREE = "crank.support_compliance"


def doubts_of(given: Given, ring: float, sun: float) -> list[str]:
    """All that needs no more than what is given, the radius of the ring of pins [mm] and the sun's teeth."""
    return [*pins_doubt(given), *rounded_ratio(given), *ring_doubt(ring, given.rated, diameter_of(given)), *sun_doubt(sun)]


def rounded_ratio(given: Given) -> list[str]:
    """That whole teeth make another ratio than the one that is given, if they do."""
    planet, sun = given.teeth
    made = 1.0 + given.pins * planet / sun
    if abs(made - given.ratio) < 1e-6 * given.ratio:
        return []
    teeth = f"planets of {planet} and a sun of {sun} teeth with {given.pins} pins"
    return [f"--ratio {given.ratio:g} is taken for a rounded one: {teeth} make {made:.6g}, which the file has"]


def pins_doubt(given: Given) -> list[str]:
    """That nobody counted the pins, if so."""
    if given.pins_counted:
        return []
    return [
        f"{given.pins} pins are assumed, as many as reducers of this kind have: count them, or read them off a transmission error, in which the"
        f" cranks leave as many waves a turn of the output as there are pins ({given.pins}?) and the ring twice as many as a disc has lobes, and give --pins"
    ]  # fmt: skip


def diameter_of(given: Given) -> float | None:
    """The outer diameter [mm] of which the ring of pins was made, where it was."""
    return None if RING in given.known else given.diameter


def ring_doubt(radius: float, torque: float, diameter: float | None = None) -> list[str]:
    """That a ring of this radius [mm] is unusual for this torque [N m], if it is; ``diameter``: of the housing [mm], where the ring was made of it."""
    low, high = (share * math.cbrt(1e3 * torque) for share in TORQUE_SHARE)
    if not torque or low <= radius <= high:
        return []
    share = radius / math.cbrt(1e3 * torque)
    made, advice = "", ": look at both, and at their units"
    if diameter is not None:
        made = f", made as {radius / diameter:.3g} times the outer diameter of {diameter:g} mm,"
        advice = ": look at --rated and --diameter, and at their units"
        if RING_SHARE[0] * diameter <= high and low <= RING_SHARE[1] * diameter:
            usual = f"from {low:.4g} mm on" if radius < low else f"up to {high:.4g} mm"
            advice = f", here {usual}: measure the radius and give --known {RING}=..., or look at --rated and --diameter"
    return [
        f"{RING} = {radius:.4g} mm{made} is {share:.3g} times the cube root of the torque (rated, output.load_torque) of {torque:.6g} N m in N mm,"
        f" where {TORQUE_SHARE[0]} to {TORQUE_SHARE[1]} is usual (cycloid handbooks){advice}"
    ]  # fmt: skip


def sun_doubt(teeth: float) -> list[str]:
    """That a sun has so few teeth that no usual profile shift keeps them from being undercut, if so."""
    shift = 1.0 - teeth / NO_UNDERCUT
    if shift <= LARGEST_SHIFT:
        return []
    return [
        f"{SUN} = {teeth:g}: below {math.floor(NO_UNDERCUT)} teeth of 20 degrees are undercut without profile shift (2 / sin^2 20 deg = {NO_UNDERCUT:.1f},"
        f" standard basic rack of ISO 53); so few need {shift:.2f} modules, and come to a point from about {LARGEST_SHIFT:g} on (assumed): count its teeth"
    ]  # fmt: skip


def stiffness_doubt(stiffness: str, found: float, low: float, high: float, unit: str, diameter: float | None) -> list[str]:
    """That the catalogue's torsional stiffness, in words, asks for supports that no rule makes, if so; all other springs follow the ring's size."""
    if low <= found <= high:
        return []
    advice = "give --diameter if the catalogue has it, or look at the unit" if diameter is None else "look at its unit, and at what else was given"
    asked, least, most = (read_text(value, unit, 3) for value in (found, low, high))
    return [f"a torsional stiffness of {stiffness} asks for {FREE} = {asked}, where rules give {least} to {most}: {advice}"]
