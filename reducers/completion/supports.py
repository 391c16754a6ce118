"""What yields and rubs beside the contacts of an RV reducer, from its geometry: compliances, play, friction, drag.

[Palmgren]  Grundlagen der Waelzlagertechnik, 1964: line contact of steel, approach 3.84e-5 Q^0.9/l^0.8 (N, mm); a roller has two of them.
[Stribeck]  the most loaded roller of a bearing without clearance carries 4.08 F/Z.
[ISO 6336]  mesh stiffness of steel spur gears about 20 N/(mm um) of face width, 14 of one pair of teeth.
[catalogue]  moment rigidity in the RV-E series: 372 N m/arcmin (RV-20E) to 7,448 (RV-450E), 9.1e9 N/m^2 times the cube of the pin circle
    radius within a fifth.  From memory and secondary pages.

A crank is a beam on two bearings: between them it bends under the discs' forces, which are taken as those at rated torque.  Palmgren's
compliance is that of rollers on rigid rings; what rings in their seats, crowned rollers, the walls of the discs' holes and the plates of the carrier
add is a multiple of it (``support_share``): the one number that is not computed but fitted, to the torsional stiffness in the catalogue.
"""

import math
from collections.abc import Mapping

from reducers.completion.dials import Dial, between

SHEAR_MODULUS, ELASTIC_MODULUS = 80e9, 207e9
# N/m per m of face width.
TEETH = 20e9
# Moment rigidity over the cube of the pin circle radius [N/m^2].
MOMENT_RIGIDITY = 9.1e9
# Amplitude of a mesh's stiffness over its mean: between one pair of teeth and two, [ISO 6336].
SWING = 0.2
PRESSURE_COSINE = math.cos(math.radians(20.0))
IN_PLACE = "fitted: torsional stiffness of RV-20E to RV-450E in the catalogue; 1 would be rigid rings in rigid seats"
PINS_GREASED = "greased steel on steel, mixed friction; range of the literature, 0.04 to 0.10"

SUPPORT_DIALS: tuple[Dial, ...] = (
    between("support_share", "compliance of a crank's bearing in place over that of its rollers", 3.0, 9.0, IN_PLACE, value=6.0),
    between("support_rollers", "length of the rollers of a crank's bearing over that of the needle rollers", 0.5, 1.0, "assumed"),
    between("journal", "radius of a crank between the lobes over the largest that passes both", 0.75, 0.95, "assumed"),
    between("bearing_spread", "distance of the main bearings' load centres over pin circle radius", 1.0, 2.0, "assumed"),
    between("carrier_twist", "compliance of the carrier's twist times shear modulus and cube of the pin circle radius", 0.5, 8.0,
            "assumed: two plates joined by three posts"),
    between("housing_twist", "compliance of the housing's twist, likewise", 0.2, 1.2, "assumed: a tube a seventh of its radius thick"),
    between("gear_width", "face width of the first stage over pin circle radius", 0.1, 0.2, "assumed"),
    between("seal_share", "drag of the seals over rated input torque", 0.02, 0.06, "no-load torque of RV reducers 0.1 to 0.6 N m at the input; split assumed"),
    between("churning_share", "drag of the grease at rated speed and 20 degC over rated input torque", 0.02, 0.06,
            "no-load torque of RV reducers 0.1 to 0.6 N m at the input; split assumed"),
)  # fmt: skip
# What is the same for all reducers of this kind: ``name`` is that of the number itself.
SUPPORT_ASSUMED: tuple[Dial, ...] = (
    Dial("first_stage.backlash", "play of the first stage, along the normal", "um", 20.0, 10.0, 80.0, "assumed: 30 to 80 um in spur stages, 10 if paired"),
    Dial("mesh.friction", "sliding friction of flank and pin", "1", 0.06, 0.04, 0.10, PINS_GREASED),
    Dial("mesh.friction_excess", "static friction of flank and pin above that", "1", 0.04, 0.0, 0.06, "boundary friction 0.10 to 0.13"),
    Dial("roller.friction", "friction of the needle bearings", "1", 0.003, 0.002, 0.005, "Palmgren: needle bearings 0.002 to 0.005"),
)
SUPPORT_UNITS = {
    "crank.support_compliance": "m/N", "carrier.bearing_compliance": "m/N", "carrier.compliance": "rad/(N.m)", "housing.compliance": "rad/(N.m)",
    "first_stage.compliance": "m/N", "first_stage.stiffness_variation": "1", "input.seal_torque": "N.m", "input.churning_torque": "N.m",
} | {dial.name: dial.unit for dial in SUPPORT_ASSUMED}  # fmt: skip
SUPPORT_RULES = {
    "crank.support_compliance": ("Palmgren's roller bearings in their seats, and bending of the crank", "support_share"),
    "carrier.bearing_compliance": ("from the catalogue's moment rigidity", "bearing_spread"),
    "carrier.compliance": ("twist of plates and posts", "carrier_twist"), "housing.compliance": ("twist of a tube", "housing_twist"),
    "first_stage.compliance": ("teeth by ISO 6336, and torsion of the crank", "gear_width"),
    "first_stage.stiffness_variation": ("one pair of teeth and two, beside the crank's torsion", ""),
    "input.seal_torque": ("share of the rated input torque", "seal_share"), "input.churning_torque": ("share of the rated input torque", "churning_share"),
}  # fmt: skip


def supports_of(values: Mapping[str, float], dial: Mapping[str, float], pins: int, cranks: int, rollers: int, discs: int = 2) -> dict[str, float]:
    """The numbers of ``SUPPORT_RULES`` from dimensions [mm], torque [N m] and ratio of ``values``, by name, in their units."""
    ring, axis, width = (1e-3 * values[name] for name in ("pin.circle_radius", "crank.circle_radius", "mesh.width"))
    journal = dial["journal"] * 1e-3 * (values["inner_race.radius"] - values["crank.eccentricity"])
    torque = abs(values["output.load_torque"])
    stage = values["first_stage.ratio"]
    seat = dial["support_share"] * roller_bearing(torque / (2.0 * cranks * axis), dial["support_rollers"] * values["roller.length"], rollers)
    cube = SHEAR_MODULUS * ring**3
    lever = axis * stage / (1.0 + stage) * PRESSURE_COSINE
    teeth = 1.0 / (TEETH * dial["gear_width"] * ring)
    # From the planet through a bearing as wide as a disc to the middle of the first eccentric.
    twist = 1.5 * width / (SHEAR_MODULUS * 0.5 * math.pi * journal**4) * lever**2
    at_input = torque / (1.0 + stage * pins)
    return {
        "crank.support_compliance": 0.5 * seat + bending(journal, width, discs),
        "carrier.bearing_compliance": dial["bearing_spread"] ** 2 / (4.0 * MOMENT_RIGIDITY * ring),
        "carrier.compliance": dial["carrier_twist"] / cube,
        "housing.compliance": dial["housing_twist"] / cube,
        "first_stage.compliance": teeth + twist,
        "first_stage.stiffness_variation": SWING * teeth / (teeth + twist),
        "input.seal_torque": dial["seal_share"] * at_input,
        "input.churning_torque": dial["churning_share"] * at_input,
    }


def roller_bearing(force: float, length: float, rollers: int) -> float:
    """Radial compliance [m/N] of a bearing of rollers ``length`` [mm] long on rigid rings under a ``force`` [N] [Palmgren, Stribeck]."""
    most = 4.08 * force / rollers
    approach: float = 2.0 * 3.84e-5 * most**0.9 / length**0.8
    return 1e-3 * 0.9 * approach / force


def bending(radius: float, width: float, discs: int) -> float:
    """Shift of the eccentrics [m/N] of a shaft of ``radius`` [m] on two bearings as wide as a disc beside ``discs`` discs, loaded alike: bending and shear."""
    inertia, area = 0.25 * math.pi * radius**4, math.pi * radius**2
    span = (discs + 1.0) * width
    reach = width if discs > 1 else 0.5 * span
    bent = reach**2 * (3.0 * span - 4.0 * reach) / (12.0 * ELASTIC_MODULUS * inertia)
    return bent + reach / (2.0 * 0.9 * SHEAR_MODULUS * area)
