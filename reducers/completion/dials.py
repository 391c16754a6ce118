"""What is free in the design of an RV reducer once its task is given: one dial each, with its published or assumed range.

Numbers of a reducer hang together: a larger ring has larger pins and eccentrics.  What is free are shares and
coefficients, and only they have ranges of their own; the range of a number follows from all of them (``complete.completed``).

[handbook]  Rules of the Chinese handbooks for cycloid reducers, as quoted in public design programs: pin circle radius 0.85 to 1.3 times
    the cube root of the torque in N mm (mm), K1 and K2 by tooth number, width 0.1 to 0.2 pin circle radii.  Read in quotations, not in
    the handbooks.
[Wang 2016]  Wang et al., Multi-objective optimal design of cycloid speed reducer, Mech. Mach. Theory 102: K1 0.65 to 0.9 at 43 lobes; quoted there.
[RV programs]  Constraints of public programs for the optimal design of RV reducers: K2 1.15 to 2; sun and two planets together 0.8 to 1.1
    outer pin diameters; rollers at least a degree apart; rollers no longer than the disc is wide.
"""

import math
from dataclasses import dataclass, replace

HANDBOOK = "cycloid handbooks, as quoted in public design programs"
PROGRAMS = "constraint of public programs for the optimal design of RV reducers"
# One line contact of steel: F = 8.06e4 L^(8/9) d^(10/9), N and mm (Palmgren); two of them in series are as stiff as this share of one.
IN_SERIES = 2.0 ** (-10.0 / 9.0)

BULK = "assumed: around what was reckoned from drawings of an RV-20E and an RV-40E"
# Rollers stand at least so far apart [deg], see [RV programs].
ROLLERS_APART = 1.0
# Range of the pin circle radius over the outer diameter of the housing.
RING_SHARE = (0.33, 0.40)


@dataclass(frozen=True)
class Dial:
    """One free number of the design, with a range [low, high] and where both come from."""

    name: str
    meaning: str
    unit: str
    value: float
    low: float
    high: float
    source: str


def between(name: str, meaning: str, low: float, high: float, source: str, unit: str = "1", value: float | None = None) -> Dial:
    """A dial that stands in the (geometric) middle of its range where nothing says more."""
    return Dial(name, meaning, unit, math.sqrt(low * high) if value is None else value, low, high, source)


def short_width(lobes: int) -> tuple[float, float]:
    """Usual range of K1 = e z_p / R_p by the number of lobes [handbook]."""
    for most, span in ((12, (0.42, 0.55)), (24, (0.48, 0.74)), (60, (0.65, 0.90))):
        if lobes <= most:
            return span
    return 0.75, 0.90


def pin_room(pins: int) -> tuple[float, float]:
    """Usual range of K2 = R_p sin(pi/z_p) / r_rp by the number of pins [handbook]; from 36 on as in RV reducers [RV programs]."""
    for most, span in ((12, (2.85, 3.85)), (24, (2.0, 2.8)), (35, (1.25, 2.0))):
        if pins <= most:
            return span
    return 1.15, 2.0


def dials_of(pins: int, rollers: int, diameter: bool, lost_motion: float) -> list[Dial]:
    """The dials of a reducer with so many pins, and rollers a bearing; ``diameter``: that of the housing is known; ``lost_motion`` as of
    the catalogue [arcmin].
    """
    closest = rollers / math.pi * math.sin(math.pi / rollers - math.radians(0.5 * ROLLERS_APART))
    ring = (
        between("ring_share", "pin circle radius over outer diameter", *RING_SHARE, "assumed: ring, seat, bearing and flange share the radius")
        if diameter else
        between("ring_torque", "pin circle radius over the cube root of the rated torque", 0.85, 1.3, HANDBOOK, "mm/(N.mm)^(1/3)")
    )  # fmt: skip
    return [
        ring,
        between("K1", "eccentricity times pins over pin circle radius", *short_width(pins - 1), HANDBOOK),
        between("K2", "half the distance of neighbouring pins over pin radius", *pin_room(pins), HANDBOOK if pins < 36 else PROGRAMS),
        between("width_share", "width of a disc over pin circle radius", 0.1, 0.2, HANDBOOK),
        between("first_stage_share", "sun and two planets over outer diameter of the ring of pins", 0.8, 1.1, PROGRAMS),
        between("hole_share", "crank hole over the room between its centre and the disc's roots", 0.55, 0.75, "assumed: the rest is the disc's rim"),
        between("fill", "rollers side by side over the circle on which they stand", 0.60, closest, f"{PROGRAMS}: a degree apart; lower end assumed"),
        between("roller_share", "length of a roller over width of the disc", 0.75, 1.0, f"{PROGRAMS}: not wider than the disc; lower end assumed"),
        between("mesh_contact", "stiffness of flank and pin over that of one line contact", IN_SERIES, 1.0,
                "Palmgren: pin on disc and seat in series, or on the disc alone"),
        between("roller_contact", "stiffness of a roller over that of one line contact", IN_SERIES, 1.0,
                "Palmgren: roller on both races in series, or on one alone"),
        between("gap", "flank gap by equidistant modification", 0.0, 0.5 * lost_motion, "assumed: at most the lost motion of the catalogue, both flanks",
                "arcmin", 0.25 * lost_motion),
        between("shift", "further gap by shift modification", 0.0, 0.5 * lost_motion, "assumed: at most the lost motion of the catalogue, both flanks",
                "arcmin", 0.0),
        between("disc_solid", "mass of a disc over that of a plate with the cranks' holes", 0.7, 0.95, BULK),
        between("crank_bulk", "mass of crank with planet over that of its two eccentrics", 2.0, 4.0, BULK),
        between("carrier_bulk", "mass of the carrier over that of a plate of the ring's size, as thick as the discs", 0.4, 0.9, BULK),
        between("sun_length", "length of sun and shaft over pin circle radius", 1.5, 3.5, BULK),
        *ASSUMED,
    ]  # fmt: skip


def dial_at(dial: Dial, value: float) -> Dial:
    """The dial moved to ``value``; its range reaches there."""
    return replace(dial, value=value, low=min(dial.low, value), high=max(dial.high, value))


# What is the same for all reducers of this kind: ``name`` is that of the number itself.
ASSUMED = (
    Dial("bearing.clearance", "radial clearance of the needle bearings", "um", 2.5, 1.5, 5.0, "assumed: matched grinding, 3 to 10 um diametral"),
    Dial("material.elastic_modulus", "elastic modulus", "GPa", 207.0, 203.0, 211.0, "assumed: bearing steel"),
    Dial("material.poisson_ratio", "Poisson's ratio", "1", 0.3, 0.28, 0.31, "assumed: steel"),
    Dial("material.hardness", "hardness", "GPa", 7.0, 6.5, 7.5, "assumed: 60 to 62 HRC"),
    Dial("wear.mesh_coefficient", "wear of flank and pin", "1", 5e-9, 1e-9, 2.5e-8, "assumed: some 5 um of flank wear in 10,000 h"),
    Dial("wear.race_coefficient", "wear of the races, in laws with a constant coefficient", "1", 3e-9, 6e-10, 1.5e-8,
         "assumed: what the Janakiraman law gives at 650 N"),
    Dial("wear.run_in_ratio", "wear at the start over later wear", "1", 5.0, 3.0, 10.0, "assumed: running-in wears 3 to 10 times faster"),
    Dial("wear.run_in_time", "duration of running-in", "h", 300.0, 50.0, 500.0, "assumed: 50 to 500 h at rated speed"),
    Dial("wear.load_exponent", "exponent of the line load in mesh wear", "1", 0.3, 0.0, 0.6, "assumed"),
    Dial("wear.reference_line_load", "line load at which the coefficient holds", "N/m", 5e4, 3e4, 8e4, "assumed: near the peak load"),
    Dial("wear.roughness", "composite roughness of roller and race", "um", 0.4, 0.25, 0.8, "assumed: ground raceways"),
    Dial("wear.inner_slip_ratio", "slip of rollers on the inner race", "1", 0.05, 0.02, 0.1, "assumed: as in an RV-20E of the literature"),
    Dial("wear.outer_slip_ratio", "slip of rollers on the outer race", "1", 0.05, 0.02, 0.1, "assumed: as in an RV-20E of the literature"),
    Dial("grease.pressure_viscosity", "pressure-viscosity coefficient", "1/Pa", 1.8e-8, 1.3e-8, 2.4e-8, "assumed: PAO 1.3e-8 to mineral oil 2.4e-8"),
)
