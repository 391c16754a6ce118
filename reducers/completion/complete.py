"""From what is given to every number of a reducer file, by the design rules of the field; each with the range that the dials leave it."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from fmu_src.display import read_in
from reducers.completion.dials import ASSUMED, Dial, dial_at, dials_of
from reducers.completion.doubts import FREE, doubts_of
from reducers.completion.geometry import check_geometry
from reducers.completion.given import GAP, SUN, Given
from reducers.completion.supports import SUPPORT_ASSUMED, SUPPORT_DIALS, SUPPORT_RULES, SUPPORT_UNITS, supports_of

# In the order of the file; all that is computed here is in these units.
UNITS = {
    "pin.circle_radius": "mm", "pin.radius": "mm", "crank.eccentricity": "mm", "crank.circle_radius": "mm", "mesh.width": "mm",
    "mesh.stiffness": "N", "mesh.stiffness_lankarani": "N", "disc.equidistant_modification": "um", "disc.shift_modification": "um",
    "inner_race.radius": "mm", "outer_race.radius": "mm", "roller.radius": "mm", "roller.length": "mm", "roller.stiffness": "N",
    "roller.stiffness_lankarani": "N", "first_stage.ratio": "1", "first_stage.sun_teeth": "1", "input.speed": "rpm", "output.load_torque": "N.m",
    "wear.run_in_crank_speed": "rpm", "disc.mass": "kg", "disc.inertia": "kg.m^2", "crank.mass": "kg", "crank.inertia": "kg.m^2",
    "carrier.mass": "kg", "carrier.inertia": "kg.m^2", "sun.inertia": "kg.m^2",
} | SUPPORT_UNITS | {dial.name: dial.unit for dial in ASSUMED}  # fmt: skip
# By which rule a number comes, and the dial of its own that the rule has.
RULES = {
    "pin.radius": ("R_p sin(pi/z_p) / K2", "K2"), "crank.eccentricity": ("K1 R_p / z_p", "K1"),
    "crank.circle_radius": ("sun and planets fill the ring of pins", "first_stage_share"), "mesh.width": ("share of the pin circle radius", "width_share"),
    "mesh.stiffness": ("share of 8.06e4 N L^(8/9) at 1 mm", "mesh_contact"),
    "mesh.stiffness_lankarani": ("same penetration as the line contact at the largest pin force", ""),
    "disc.equidistant_modification": ("flank gap times e z_c", "gap"), "disc.shift_modification": ("further flank gap times e z_c", "shift"),
    "inner_race.radius": ("inside the rollers", ""), "outer_race.radius": ("share of the room from hole centre to roots", "hole_share"),
    "roller.radius": ("so many side by side", "fill"), "roller.length": ("share of the disc's width", "roller_share"),
    "roller.stiffness": ("share of 8.06e4 N L^(8/9) at 1 mm", "roller_contact"),
    "roller.stiffness_lankarani": ("same approach as the line contact at the largest roller force", ""),
    "input.speed": ("ratio times output speed", ""), "first_stage.ratio": ("ratio = 1 + pins z2/z1", ""),
    "first_stage.sun_teeth": ("fewest whole teeth from 10 on", ""), "wear.run_in_crank_speed": ("output speed times lobes", ""),
    "disc.mass": ("a steel plate with holes", "disc_solid"), "disc.inertia": ("radius of inertia 0.77 of the plate's", ""),
    "crank.mass": ("two steel eccentrics and what belongs to them", "crank_bulk"), "crank.inertia": ("radius of inertia 0.94 of the eccentric's", ""),
    "carrier.mass": ("a steel plate", "carrier_bulk"), "carrier.inertia": ("radius of inertia 0.63 of the pin circle's", ""),
    "sun.inertia": ("a steel shaft as thick as the sun", "sun_length"),
} | SUPPORT_RULES  # fmt: skip
# None of these may move alone: races and rollers fit each other, teeth are whole.
NOT_ALONE = ("inner_race.radius", "outer_race.radius", "roller.radius", "first_stage.sun_teeth")
COMPLETED, GIVEN, FOUND = "completed", "given", "found"
# Source of crank supports: how soft they are in place is what rules leave open, and what they were fitted for to catalogues.
AS_STIFF = f"{FOUND}: makes the torsional stiffness that of the catalogue"
# Sources of what the stiffness test asks for, of the gap of the flanks first: no numbers of the catalogue, and none that were measured.
MEETS = f"{COMPLETED}: makes the lost motion that of the catalogue"
LEAST = f"{COMPLETED}: the least of its range, for the lost motion of the catalogue"
SUPPORTS = (
    "How soft a crank's bearing is in place is fitted to the RV-E series: it makes four fifths of the compliance, and scatters by a third from size to size."
)
PALMGREN = 8.06e4
# kg/mm^3
STEEL = 7.85e-6
# By so many teeth a sun may have more than the fewest (assumed).
SUN_MORE = 10


@dataclass(frozen=True)
class Number:
    """One number of the file in its unit, with [low, high] and the dials that move it."""

    name: str
    unit: str
    value: float
    low: float
    high: float
    source: str
    dials: tuple[str, ...] = ()

    @property
    def is_given(self) -> bool:
        return self.source.startswith(GIVEN)

    @property
    def is_found(self) -> bool:
        """Whether it was looked for, so that a figure of the catalogue is met: nobody gave it."""
        return self.source.startswith((FOUND, MEETS, LEAST))

    @property
    def as_read(self) -> "Number":
        """In the unit that people read it in: compliances in um/kN and arcmin/(N.m)."""
        unit, (value, low, high) = read_in(self.unit, self.value, self.low, self.high)
        return replace(self, unit="" if unit == "1" else unit, value=value, low=low, high=high)


@dataclass(frozen=True)
class Completion:
    """All numbers by name, what was given, the dials, and what is doubtful about what was given."""

    given: Given
    dials: list[Dial]
    numbers: dict[str, Number]
    doubts: list[str]

    @property
    def left_open(self) -> list[str]:
        """What the rules leave open of any reducer, unless it was given: how soft its crank supports are."""
        return [] if self.numbers[FREE].is_given or self.numbers[FREE].is_found else [SUPPORTS]


def complete(given: Given) -> Completion:
    """Every number with its range; InputFault if what is given makes no reducer.

    A number's range adds what each dial, at either end of its own range, makes of it, see ``span``.
    """
    dials = dials_for(given)
    middle = {dial.name: dial.value for dial in dials}
    values = numbers_of(given, middle)
    check_geometry(given, values)
    ends = {dial.name: [numbers_of(given, middle | {dial.name: end}) for end in (dial.low, dial.high)] for dial in dials}
    numbers, by_name = {}, {dial.name: dial for dial in dials}
    for name, value in values.items():
        reached = {dial: [end[name] for end in both] for dial, both in ends.items() if any(end[name] != value for end in both)}
        low, high = span(value, list(reached.values()))
        if name == "first_stage.sun_teeth" and name not in given.known:
            low, high = value, value + SUN_MORE
        numbers[name] = Number(name, UNITS[name], value, low, high, source_of(given, name, by_name), tuple(reached))
    return Completion(given, dials, numbers, doubts_of(given, values["pin.circle_radius"], values[SUN]))


def dials_for(given: Given) -> list[Dial]:
    """All that is free in the design of such a reducer."""
    dials = [*dials_of(given.pins, given.rollers, given.diameter is not None, given.lost_motion), *SUPPORT_DIALS, *SUPPORT_ASSUMED]
    moved = dict(given.made)
    if GAP in moved:
        # An arcmin of gap is another length of every reducer.
        moved["gap"] = moved[GAP] / numbers_of(given, {dial.name: 1.0 if dial.name == "gap" else dial.value for dial in dials})[GAP]
    return [dial_at(dial, moved[dial.name]) if dial.name in moved else dial for dial in dials]


def span(value: float, reached: Sequence[Sequence[float]]) -> tuple[float, float]:
    """[low, high] of a number that dials, each for itself, take from ``value`` to the ends ``reached``.

    Changes add up as squares: of logarithms, as numbers are products, unless one of them is 0 or turns around.
    """
    products = min([value, *(end for ends in reached for end in ends)]) > 0.0
    there, back = (math.log, math.exp) if products else (float, float)
    changes = [[there(end) - there(value) for end in ends] for ends in reached]
    up, down = (math.sqrt(sum(max(0.0, *(sign * change for change in both)) ** 2 for both in changes)) for sign in (1.0, -1.0))
    low, high = back(there(value) - down), back(there(value) + up)
    if min([value, *(end for ends in reached for end in ends)]) >= 0.0:
        # What no dial turns around stays on its side.
        low = max(low, 0.0)
    return (low, high) if reached else (value, value)


def source_of(given: Given, name: str, dials: Mapping[str, Dial]) -> str:
    if name == FREE and given.stiffness is not None:
        return f"{AS_STIFF}, {given.stiffness:g} N.m/arcmin"
    if name in given.known:
        return f"{GIVEN}: measured"
    if name in given.made:
        return made_source(given, dials["gap" if name == GAP else name])
    if name == "output.load_torque":
        return f"{GIVEN}: rated torque"
    if name in dials:
        return f"{COMPLETED}: {dials[name].source}"
    if name == "pin.circle_radius":
        return f"{COMPLETED}: {own_dial(dials['ring_torque' if given.diameter is None else 'ring_share'])}"
    rule, own = RULES[name]
    if name == "input.speed":
        # The one place of a file that says the output's speed: teeth that change later change the ratio.
        rule += f" of {given.speed:.9g} rpm"
    return f"{COMPLETED}: {rule}" + (f", {own_dial(dials[own])}" if own else "")


def made_source(given: Given, dial: Dial) -> str:
    """Of a number of ``PLAY`` that the lost motion asks for."""
    return f"{LEAST if dial.value <= dial.low else MEETS}, {given.lost_motion:g} arcmin; {own_dial(dial) if dial.name == 'gap' else dial.source}"


def own_dial(dial: Dial) -> str:
    return f"{dial.meaning} {dial.low:.3g} to {dial.high:.3g}{'' if dial.unit == '1' else f' {dial.unit}'} ({dial.source})"


def numbers_of(given: Given, dial: Mapping[str, float]) -> dict[str, float]:
    """Every number in the units of ``UNITS`` at one setting of all dials; what is known stays as it is and carries on to what builds on it."""
    found: dict[str, float] = {}

    def take(name: str, value: float) -> float:
        found[name] = given.known.get(name, value)
        return found[name]

    pins, lobes, cranks = given.pins, given.pins - 1, given.crank_count
    planet, sun = given.teeth
    stage = take("first_stage.ratio", planet / sun)
    take("first_stage.sun_teeth", sun)
    torque = take("output.load_torque", given.rated)
    ring = take("pin.circle_radius", dial["ring_torque"] * math.cbrt(1e3 * torque) if given.diameter is None else dial["ring_share"] * given.diameter)
    pin = take("pin.radius", ring * math.sin(math.pi / pins) / dial["K2"])
    eccentricity = take("crank.eccentricity", dial["K1"] * ring / pins)
    # Pitch diameters of sun and two planets make first_stage_share of 2 (R_p + r_rp); the axes stand half of sun and planet apart.
    axis = take("crank.circle_radius", dial["first_stage_share"] * (ring + pin) * (1.0 + stage) / (1.0 + 2.0 * stage))
    width = take("mesh.width", dial["width_share"] * ring)
    # Arcmin at the flank: the normal's lever arm is e z_c where the flank is steepest.
    arc = math.radians(1.0 / 60.0) * eccentricity * lobes * 1e3
    take("disc.equidistant_modification", dial["gap"] * arc)
    take("disc.shift_modification", 0.0 - dial["shift"] * arc)
    hole, roller = races(given, dial, ring - eccentricity - pin - axis)
    take("outer_race.radius", hole)
    take("roller.radius", roller)
    take("inner_race.radius", hole - 2.0 * roller)
    length = take("roller.length", dial["roller_share"] * width)
    # Sum of sin^2 over the loaded half of the pins: z_p/4; Stribeck's 4 for line contacts without clearance.
    resultant = 0.5e3 * torque / (eccentricity * lobes)
    pin_force = 4.0 * resultant / pins
    roller_force = 4.0 / given.rollers * (resultant + 0.5e3 * torque / axis) / cranks
    for part, contact, reach, force in (("mesh", "mesh_contact", width, pin_force), ("roller", "roller_contact", length, roller_force)):
        stiffness = take(f"{part}.stiffness", dial[contact] * PALMGREN * reach ** (8.0 / 9.0))
        take(f"{part}.stiffness_lankarani", force / (force / stiffness) ** (0.9 * 1.5))
    take("input.speed", given.ratio * given.speed)
    take("wear.run_in_crank_speed", given.speed * lobes)
    masses(take, dial, ring, pin, axis, width, stage, hole, found["inner_race.radius"], cranks)
    for name, value in supports_of(found, dial, pins, cranks, given.rollers).items():
        take(name, value)
    for one in (*ASSUMED, *SUPPORT_ASSUMED):
        take(one.name, dial[one.name])
    return {name: found[name] for name in UNITS}


def masses(
    take: Callable[[str, float], float], dial: Mapping[str, float], ring: float, pin: float, axis: float, width: float, stage: float, hole: float, lobe: float,
    cranks: int,
) -> None:
    """Masses [kg] and inertias [kg m^2] of bodies from radii and width [mm]; radii of inertia as of an RV-20E (assumed)."""
    def cylinder(radius: float, length: float) -> float:
        return STEEL * math.pi * radius**2 * length

    plate = ring - pin
    disc = take("disc.mass", dial["disc_solid"] * (cylinder(plate, width) - cranks * cylinder(hole, width)))
    take("disc.inertia", disc * (0.77e-3 * plate) ** 2)
    crank = take("crank.mass", dial["crank_bulk"] * cylinder(lobe, 2.0 * width))
    take("crank.inertia", crank * (0.94e-3 * lobe) ** 2)
    carrier = take("carrier.mass", dial["carrier_bulk"] * cylinder(ring, 2.0 * width))
    take("carrier.inertia", carrier * (0.63e-3 * ring) ** 2)
    sun = axis / (1.0 + stage)
    take("sun.inertia", 0.5e-6 * cylinder(sun, dial["sun_length"] * ring) * sun**2)


def races(given: Given, dial: Mapping[str, float], room: float) -> tuple[float, float]:
    """Radii of hole and rollers [mm]: of two of races and rollers the third follows."""
    inner, hole, roller = (given.known.get(name) for name in ("inner_race.radius", "outer_race.radius", "roller.radius"))
    per_pitch = dial["fill"] * math.pi / given.rollers
    if hole is None:
        if inner is None:
            hole = dial["hole_share"] * room
        else:
            hole = inner + 2.0 * (inner * per_pitch / (1.0 - per_pitch) if roller is None else roller)
    if roller is None:
        roller = hole * per_pitch / (1.0 + per_pitch) if inner is None else 0.5 * (hole - inner)
    return hole, roller
