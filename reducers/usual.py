"""What a reducer file need not say: numbers that follow from others, and those that are usual, each with where it is from.

A number that the file states itself always wins.  What follows is reckoned anew at each reading, so that it cannot be stale.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from fmu_src.units import conversion
from reducers.completion.dials import ASSUMED, IN_SERIES
from rv_plant.gear_stage import total_ratio
from rv_plant.topology import Topology

# Force [N] of a line contact of steel at 1 mm of approach, for 1 mm of length (Palmgren).
PALMGREN = 8.06e4
DERIVED, USUAL = "derived", "usual"
MM, UM = 1e-3, 1e-6
# Numbers by structured name, SI.
Numbers = Mapping[str, float]


@dataclass(frozen=True)
class Filled:
    """A number that nobody stated, SI; ``range`` where it may lie, if it is not what follows."""

    path: str
    value: float
    source: str
    range: tuple[float, float] | None = None


@dataclass(frozen=True)
class Rule:
    """A number that follows from the numbers ``needs``."""

    path: str
    needs: tuple[str, ...]
    reckon: Callable[[Numbers, Topology], float]
    words: str
    # Lowest and highest over the value.
    spread: tuple[float, float] | None = None


def line_contact(length: float) -> float:
    """Force [N] at 1 mm of approach of line contacts of a length [m], in the middle between one contact and two in series."""
    return math.sqrt(IN_SERIES) * PALMGREN * math.pow(length / MM, 8.0 / 9.0)


def pin_force(n: Numbers, t: Topology) -> float:
    """Largest force of a pin [N]: sum of sin^2 over the loaded half of the pins."""
    return 4.0 * resultant(n, t) / t.pins


def resultant(n: Numbers, t: Topology) -> float:
    """Force [N] of all pins on one disc at the file's torque."""
    return abs(n["output.load_torque"]) / (t.discs * n["crank.eccentricity"] * t.lobes)


def roller_force(n: Numbers, t: Topology) -> float:
    """Largest force of a roller [N]: Stribeck's 4 for line contacts without clearance."""
    axis = n["crank.circle_radius"]
    couple = abs(n["output.load_torque"]) / (t.discs * axis) if axis > 0.0 else 0.0
    return 4.0 / t.rollers * (resultant(n, t) + couple) / t.cranks


def lankarani(force: float, stiffness: float) -> float:
    """Force [N] at 1 mm with the exponent 1.5 that gives the approach of the line contact at this force."""
    return force / math.pow(force / stiffness, 0.9 * 1.5)


def crank_speed(n: Numbers, t: Topology) -> float:
    """Of the cranks against the carrier's frame [rad/s], as the input turns."""
    return float(abs(n["input.speed"] / total_ratio(n["first_stage.ratio"], t.pins, t.lobes)) * t.lobes)


TORQUE = ("output.load_torque", "crank.eccentricity")
CONTACT = (math.sqrt(IN_SERIES), 1.0 / math.sqrt(IN_SERIES))
RULES = (
    Rule("roller.radius", ("inner_race.radius", "outer_race.radius"), lambda n, t: 0.5 * (n["outer_race.radius"] - n["inner_race.radius"]),
         "half of hole less eccentric"),
    Rule("inner_race.radius", ("outer_race.radius", "roller.radius"), lambda n, t: n["outer_race.radius"] - 2.0 * n["roller.radius"], "inside the rollers"),
    Rule("outer_race.radius", ("inner_race.radius", "roller.radius"), lambda n, t: n["inner_race.radius"] + 2.0 * n["roller.radius"], "around the rollers"),
    Rule("wear.run_in_crank_speed", ("input.speed", "first_stage.ratio"), crank_speed, "input.speed times lobes over the ratio"),
    Rule("mesh.stiffness", ("mesh.width",), lambda n, t: line_contact(n["mesh.width"]),
         "line contacts of steel on mesh.width, one or two in series (Palmgren)", CONTACT),
    Rule("roller.stiffness", ("roller.length",), lambda n, t: line_contact(n["roller.length"]),
         "line contacts of steel on roller.length, one or two in series (Palmgren)", CONTACT),
    Rule("mesh.stiffness_lankarani", (*TORQUE, "mesh.stiffness"), lambda n, t: lankarani(pin_force(n, t), n["mesh.stiffness"]),
         "same penetration as the line contact at the largest pin force"),
    Rule("roller.stiffness_lankarani", (*TORQUE, "crank.circle_radius", "roller.stiffness"), lambda n, t: lankarani(roller_force(n, t), n["roller.stiffness"]),
         "same approach as the line contact at the largest roller force"),
)  # fmt: skip
# The ideal profile.
ZERO = ("disc.equidistant_modification", "disc.shift_modification")


def usual() -> dict[str, Filled]:
    """Numbers that are much the same in all reducers of this kind, by name."""
    found = {path: Filled(path, 0.0, f"{USUAL}: ideal profile") for path in ZERO}
    for dial in ASSUMED:
        factor, offset = conversion(dial.unit, SI.get(dial.unit, dial.unit))
        value, low, high = (factor * number + offset for number in (dial.value, dial.low, dial.high))
        found[dial.name] = Filled(dial.name, value, f"{USUAL}: {dial.source}", (low, high))
    return found


SI = {"um": "m", "GPa": "Pa", "h": "s"}
# All that a file may leave out, of what it must state otherwise.
FILLED = frozenset((*(rule.path for rule in RULES), *ZERO, *(dial.name for dial in ASSUMED)))


def derived(rule: Rule, have: Numbers, topology: Topology) -> float | None:
    """What a rule makes of the numbers that there are; None where one is missing, or makes no sense."""
    if any(name not in have for name in rule.needs):
        return None
    try:
        value = rule.reckon(have, topology)
    except (ZeroDivisionError, OverflowError, ValueError):
        return None
    return value if math.isfinite(value) and value > 0.0 else None


def filled(have: Numbers, topology: Topology) -> list[Filled]:
    """All that can be filled in beside the numbers ``have`` (by structured name, SI), in an order in which each has what it needs."""
    numbers, found = dict(have), []
    for one in usual().values():
        if one.path not in numbers:
            numbers[one.path] = one.value
            found.append(one)
    for rule in RULES:
        value = derived(rule, numbers, topology) if rule.path not in numbers else None
        if value is not None:
            numbers[rule.path] = value
            low, high = rule.spread or (1.0, 1.0)
            found.append(Filled(rule.path, value, f"{DERIVED}: {rule.words}", (low * value, high * value) if rule.spread else None))
    return found


# A stated number that is so far from what follows from the others is told (assumed).
FAR = 0.02
# Of these a file may state another one with good reason, and yet it is often forgotten when teeth or speed change.
TOLD = ("wear.run_in_crank_speed", "roller.radius", "inner_race.radius", "outer_race.radius")


def stale(have: Numbers, topology: Topology) -> list[tuple[str, float, float, str]]:
    """(name, stated, what follows from the others, by which rule) of stated numbers that do not fit the others."""
    found = []
    for rule in RULES:
        if rule.path in TOLD and rule.path in have and (value := derived(rule, have, topology)) is not None and abs(have[rule.path] - value) > FAR * value:
            found.append((rule.path, have[rule.path], value, rule.words))
    return found
