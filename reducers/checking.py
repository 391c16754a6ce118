"""Whether the numbers of a reducer file fit each other, and what of them nobody stated."""

import math
import re
import shlex
from dataclasses import dataclass

from fmu_src.display import display_unit
from fmu_src.faults import InputFault
from fmu_src.units import conversion
from reducers.completion.complete import UNITS
from reducers.completion.geometry import check_geometry, check_profile, largest_pin
from reducers.completion.given import Given
from reducers.reducer import Reducer, numbers_of
from reducers.usual import DERIVED, USUAL, stale
from rv_plant.gear_stage import total_ratio

MM = 1e3
# Options of the command that completes reducers, and what a file calls the same.
KEYS = {"--pins": "topology.pins", "--rollers": "topology.rollers", "--cranks": "topology.cranks", "--ratio": "ratio"}
STATED = "stated"
# From this share of the largest pin on, the flank is nearly undercut (assumed).
NEARLY = 0.95


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
    # The command that completes what is rigid; empty where nothing is.
    completing: str = ""


# Compliances that are zero unless somebody states them.
RIGID = ("crank.support_compliance", "carrier.bearing_compliance", "carrier.compliance", "housing.compliance", "first_stage.compliance")


def check(reducer: Reducer) -> Check:
    n, t = numbers_of(reducer), reducer.topology
    ring, pin, throw = (MM * n[name] for name in ("pin.circle_radius", "pin.radius", "crank.eccentricity"))
    stage = n.get("first_stage.ratio", 0.0)
    most = largest_pin(ring, throw, t.pins)
    figures = {
        "ratio": abs(float(total_ratio(stage, t.pins, t.lobes))), "K1": throw * t.pins / ring, "K2": ring * math.sin(math.pi / t.pins) / pin,
        "largest_pin_mm": most, "room_for_pins_mm": ring * math.sin(math.pi / t.pins),
    }  # fmt: skip
    faults = faults_of(reducer, n, ring, pin, throw, stage)
    doubts = [
        f"{name} = {shown(reducer, name, stated)} is stated, {words} make {shown(reducer, name, value)}: correct one of them, or leave {name} out"
        for name, stated, value, words in stale(n, t)
    ]
    if not faults and pin > NEARLY * most:
        doubts.append(f"pin.radius = {pin:.4g} mm is nearly the largest without undercut, {most:.4g} mm")
    if not 0.4 <= figures["K1"] <= 0.95:
        doubts.append(f"K1 = e z_p / R_p = {figures['K1']:.3g}, where 0.4 to 0.95 is usual: look at crank.eccentricity and pin.circle_radius")
    rigid = [name for name in RIGID if n.get(name, 0.0) == 0.0] if not faults else []
    if rigid:
        doubts.append(f"{', '.join(rigid)}: not stated, and so rigid: a real reducer is several times softer, and looser")
    return Check(reducer, numbers(reducer), faults, doubts, figures, completing(reducer, n, figures["ratio"]) if rigid else "")


def completing(reducer: Reducer, n: dict[str, float], ratio: float) -> str:
    """The command that completes the file, with all that it states itself; none for drives that the rules are not for."""
    t = reducer.topology
    if t.output_pins or n.get("first_stage.ratio", 0.0) <= 0.0 or t.discs != 2:
        return ""
    words = ["rvwear", "reducer", "new", "--ratio", f"{ratio:.6g}", "--pins", str(t.pins), "--rated", f"{abs(n['output.load_torque']):.6g}"]
    words += ["--speed", f"{abs(n['input.speed']) / ratio * 30.0 / math.pi:.6g}", "--cranks", str(t.cranks), "--rollers", str(t.rollers)]
    for one in numbers(reducer):
        if one.kind == STATED and one.name in UNITS and one.name not in FOLLOW:
            factor, offset = conversion(one.unit or "1", UNITS[one.name])
            words += ["--known", f"{one.name}={factor * one.value + offset:.8g}{'' if UNITS[one.name] == '1' else UNITS[one.name]}"]
    return shlex.join([*words, "--name", reducer.name, "--output", f"{reducer.name}_completed.toml"])


# What the command has as options of its own, or reckons from them.
FOLLOW = ("output.load_torque", "input.speed", "first_stage.ratio", "first_stage.sun_teeth", "wear.run_in_crank_speed")


def faults_of(reducer: Reducer, n: dict[str, float], ring: float, pin: float, throw: float, stage: float) -> list[str]:
    """The first thing that forbids it, in the words of the file."""
    t = reducer.topology
    try:
        if t.output_pins or stage <= 0.0 or t.cranks < 2:
            check_profile(t.pins, ring, pin, throw)
        else:
            given = Given(float(total_ratio(stage, t.pins, t.lobes)), t.pins, max(1.0, abs(n["output.load_torque"])), cranks=t.cranks, rollers=t.rollers)
            check_geometry(given, {name: MM * value for name, value in n.items()})
    except InputFault as fault:
        return [re.sub("|".join(KEYS), lambda found: KEYS[found[0]], str(fault))]
    return []


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
