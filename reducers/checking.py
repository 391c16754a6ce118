"""Whether the numbers of a reducer file fit each other, and what of them nobody stated."""

import math
import re
from dataclasses import dataclass, field

from fmu_src.display import display_unit
from fmu_src.faults import InputFault
from fmu_src.units import conversion
from reducers.completion.again import STIFF, command, doubts_again, given_again, in_units, outdated, sources_of
from reducers.completion.complete import COMPLETED
from reducers.completion.dials import ASSUMED
from reducers.completion.geometry import check_geometry
from reducers.completion.given import GAP, SHIFT, SUN, Given
from reducers.completion.supports import SUPPORT_ASSUMED, SUPPORT_DIALS
from reducers.completion.unusual import is_beyond, unusual_alone
from reducers.completion.unusual import unusual as unusual_in_rules
from reducers.reducer import Reducer, numbers_of
from reducers.usual import DERIVED, USUAL, stale
from rv_plant.gear_stage import total_ratio
from rv_plant.parts import NOWHERE, PartsFault, check_drive, largest_pin

MM = 1e3
# Options of the command that completes reducers, and what a file calls the same.
KEYS = {"--rated": "output.load_torque", "--pins": "topology.pins", "--rollers": "topology.rollers", "--cranks": "topology.cranks", "--ratio": "ratio"}
STATED = "stated"
# From this share of the largest pin on, the flank is nearly undercut (assumed).
NEARLY = 0.95

# One number over another in RV reducers, with margins that a wrong unit leaves (the range that is usual, and its source, in words).
SHARES = (
    ("mesh.width", "pin.circle_radius", 0.05, 0.4, "0.1 to 0.2 (cycloid handbooks)"),
    ("crank.circle_radius", "pin.circle_radius", 0.25, 0.85, "0.5 to 0.6 (RV-20E, RV-40E)"),
    ("roller.radius", "pin.circle_radius", 0.008, 0.1, "0.03 to 0.04 (RV-20E, RV-40E)"),
    ("roller.length", "mesh.width", 0.2, 1.2, "less than 1: rollers are no longer than the disc is wide"),
)
# Single numbers likewise, SI: lowest, highest, and what is usual.
SPANS = (
    ("material.elastic_modulus", 1e11, 3e11, "200 to 212 GPa for steel"),
    ("material.hardness", 2e9, 1.5e10, "6.5 to 7.5 GPa for hardened steel"),
    ("bearing.clearance", 0.0, 1e-4, "1 to 5 um"),
    ("wear.roughness", 2e-8, 1e-5, "0.2 to 0.8 um"),
    ("disc.equidistant_modification", -3e-4, 3e-4, "a few tens of um"),
    ("disc.shift_modification", -3e-4, 3e-4, "a few tens of um"),
)
# The fastest output that catalogues permit, with a margin.
FASTEST_RPM = 150.0


@dataclass(frozen=True)
class Stated:
    """A number of the reducer in the unit that people read; ``kind``: stated, derived or usual."""

    name: str
    value: float
    unit: str
    low: float | None
    high: float | None
    source: str
    kind: str


@dataclass(frozen=True)
class Check:
    """``faults``: what forbids such a reducer; ``doubts``: what is likely to be a mistake; ``figures``: what follows, by name, with units."""

    reducer: Reducer
    numbers: list[Stated]
    faults: list[str]
    doubts: list[str]
    figures: dict[str, float]
    # The command that completes what is rigid, does not rub or is outdated; empty where nothing is missing.
    completing: str = ""
    # Of the doubts those about numbers that were completed from others than the file has now.
    outdated: list[str] = field(default_factory=list)
    # Of the fault which parts it is about, as ``rv_plant.parts`` names them.
    place: str = NOWHERE

    @property
    def outcome(self) -> str:
        """In the words of screen and page."""
        if self.faults:
            return f"cannot be made: {self.faults[0]}"
        return "its parts fit each other" + (", but look at what is doubtful" if self.doubts else "")


# Compliances that are zero unless somebody states them.
RIGID = ("crank.support_compliance", "carrier.bearing_compliance", "carrier.compliance", "housing.compliance", "first_stage.compliance")

# Friction and drag that are zero unless somebody states them, each with the dial of the completion: the number itself, or its share of the rated
# torque at the input.
RUBBING = {
    "mesh.friction": "mesh.friction", "roller.friction": "roller.friction", "input.seal_torque": "seal_share", "input.churning_torque": "churning_share",
}  # fmt: skip


def check(reducer: Reducer) -> Check:
    n, t = numbers_of(reducer), reducer.topology
    ring, pin, throw = (MM * n[name] for name in ("pin.circle_radius", "pin.radius", "crank.eccentricity"))
    stage = n.get("first_stage.ratio", 0.0)
    most = largest_pin(ring + MM * n[SHIFT], throw, t.pins) - MM * n[GAP]
    figures = {
        "ratio": abs(float(total_ratio(stage, t.pins, t.lobes))), "K1": throw * t.pins / ring, "K2": ring * math.sin(math.pi / t.pins) / pin,
        "largest_pin_mm": most, "room_for_pins_mm": ring * math.sin(math.pi / t.pins),
    }  # fmt: skip
    faults, place = faults_of(reducer, n, stage)
    doubts = [
        f"{name} = {shown(reducer, name, stated)} is stated, {words} make {shown(reducer, name, value)}: correct one of them, or leave {name} out"
        for name, stated, value, words in stale(n, t)
    ]
    if not faults and pin > NEARLY * most:
        doubts.append(f"pin.radius = {pin:.4g} mm is nearly the largest without undercut, {most:.4g} mm")
    if not 0.4 <= figures["K1"] <= 0.95:
        doubts.append(f"K1 = e z_p / R_p = {figures['K1']:.3g}, where 0.4 to 0.95 is usual: look at crank.eccentricity and pin.circle_radius")
    doubts += [*unusual(reducer, n, figures["ratio"]), *doubts_again(reducer)] if stage > 0.0 else []
    rigid = [name for name in RIGID if n.get(name, 0.0) == 0.0] if not faults else []
    if rigid:
        doubts.append(f"{', '.join(rigid)}: not stated, and so rigid: a real reducer is several times softer, and looser")
    smooth = [name for name in RUBBING if n.get(name, 0.0) == 0.0] if not faults else []
    if smooth:
        usual = ", ".join(usual_losses(name, abs(n["output.load_torque"]) / max(figures["ratio"], 1.0)) for name in smooth)
        names = ", ".join(smooth)
        doubts.append(f"{names}: not stated, and so without losses there: efficiency is too high, loops are too narrow; usual are {usual}")
    doubts += beyond_usual(reducer, stage, doubts)
    old = outdated(reducer)
    return Check(reducer, numbers(reducer), faults, doubts + old, figures, command(reducer) if rigid or smooth or old else "", old, place)


def usual_losses(name: str, at_input: float) -> str:
    """A number of ``RUBBING`` with its usual range; ``at_input`` is the rated torque at the input [N m]."""
    dial = next(d for d in (*SUPPORT_DIALS, *SUPPORT_ASSUMED) if d.name == RUBBING[name])
    of, unit = (1.0, "") if dial.name == name else (at_input, " N.m")
    return f"{name} {of * dial.low:.2g} to {of * dial.high:.2g}{unit}"


def unusual(reducer: Reducer, n: dict[str, float], ratio: float) -> list[str]:
    """Numbers that no RV reducer has: most likely in another unit than they are written in."""
    found = [
        f"{name} = {shown(reducer, name, n[name])} is {n[name] / n[of]:.3g} times {of}, where {usual} is usual: look at its unit"
        for name, of, low, high, usual in SHARES
        if n.get(name) and n.get(of) and not low <= n[name] / n[of] <= high
    ]
    found += [
        f"{name} = {shown(reducer, name, n[name])}, where {usual} is usual: look at its unit"
        for name, low, high, usual in SPANS if name in n and not low <= n[name] <= high
    ]  # fmt: skip
    speed = output_rpm(n, ratio)
    if speed > FASTEST_RPM:
        told = shown(reducer, "input.speed", n["input.speed"])
        found.append(f"input.speed = {told} turns the output at {speed:.4g} rpm, where 5 to 100 is usual: look at its unit")
    return found


def beyond_usual(reducer: Reducer, stage: float, told: list[str]) -> list[str]:
    """Stated numbers outside of what rules have for such a reducer, of which nothing is ``told`` yet; of other drives those that all drives of steel share."""
    have, given = in_units(reducer), given_again(reducer)
    stated = {name for name, source in sources_of(reducer).items()
              if not source.startswith((f"{DERIVED}: ", f"{USUAL}: ", COMPLETED)) and not STIFF.match(source)}  # fmt: skip
    # Of what is rigid or does not rub another doubt tells.
    stated -= {name for name in (*RIGID, *RUBBING) if have.get(name) == 0.0}
    if given is not None:
        found = unusual_in_rules(given, have, stated)
    else:
        steel = next(dial for dial in ASSUMED if dial.name == "material.elastic_modulus")
        found = unusual_alone(have, stated) if stage > 0.0 or not is_beyond(have[steel.name], steel.low, steel.high) else {}
    return [text for name, text in found.items() if not any(re.search(rf"\b{re.escape(name)}\b", other) for other in told)]


def output_rpm(n: dict[str, float], ratio: float) -> float:
    return abs(n["input.speed"]) / ratio * 30.0 / math.pi


def faults_of(reducer: Reducer, n: dict[str, float], stage: float) -> tuple[list[str], str]:
    """The first thing that forbids it, in the words of the file, and the parts that it is about."""
    t = reducer.topology
    try:
        if t.output_pins or stage <= 0.0 or t.cranks < 2:
            check_drive(t, {name: MM * value for name, value in n.items()})
        else:
            ratio, torque = float(total_ratio(stage, t.pins, t.lobes)), max(1.0, abs(n["output.load_torque"]))
            # What a file leaves out is usual, and none of its own teeth.
            sun = {SUN: n[SUN]} if SUN in n else {}
            check_geometry(Given(ratio, t.pins, torque, cranks=t.cranks, rollers=t.rollers, known=sun), in_units(reducer))
    except InputFault as fault:
        said = re.sub("|".join(KEYS), lambda found: KEYS[found[0]], str(fault))
        return [said], fault.place if isinstance(fault, PartsFault) else NOWHERE
    return [], NOWHERE


def numbers(reducer: Reducer) -> list[Stated]:
    """What the file states, what follows and what is usual, in the order of the tables."""
    variables = {v.path: v for table in (reducer.plant, reducer.wear, reducer.joint) for v in table.variables if v.name in reducer.starts}
    found = []
    for path, v in variables.items():
        unit = display_unit(v) or v.unit
        factor, offset = (1.0, 0.0) if v.choices else conversion(v.unit, unit)
        source = reducer.sources.get(v.name, "")
        if v.name == "rated_torque" and source == reducer.sources["load_torque"]:
            source = f"{DERIVED}: output.load_torque"
        kind = next((word for word in (DERIVED, USUAL) if source.startswith(f"{word}: ")), STATED)
        low, high = (factor * end + offset for end in reducer.ranges[v.name]) if v.name in reducer.ranges else (None, None)
        found.append(Stated(path, factor * reducer.starts[v.name] + offset, "" if unit == "1" else unit, low, high, source, kind))
    return found


def shown(reducer: Reducer, path: str, value: float) -> str:
    """In the unit that people read."""
    v = next(v for table in (reducer.plant, reducer.wear, reducer.joint) for v in table.variables if v.path == path)
    unit = display_unit(v) or v.unit
    factor, offset = conversion(v.unit, unit)
    return f"{factor * value + offset:.5g} {unit}"
