"""What a completed file would hold if it were completed anew from the counts and given numbers that it has now.

A completed file keeps its numbers when somebody changes teeth or a measure by hand: what hung on the former ones is outdated.
"""

import re
import shlex
from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import Protocol

from fmu_src.display import read_text
from fmu_src.faults import InputFault
from fmu_src.table import Table
from fmu_src.units import conversion
from reducers.completion.command import PINS_ASSUMED, described, usual_name, words_of
from reducers.completion.complete import AS_STIFF, COMPLETED, FOUND, GIVEN, LEAST, MEETS, RULES, UNITS, complete, dials_for, numbers_of
from reducers.completion.dials import dials_of
from reducers.completion.doubts import FREE, diameter_of, doubts_of, ring_doubt, stiffness_doubt, sun_doubt
from reducers.completion.given import GAP, PLAY, SHIFT, SUN, Given
from reducers.completion.known import FROM_OPTIONS
from reducers.usual import DERIVED, FAR, USUAL
from rv_plant.gear_stage import total_ratio
from rv_plant.topology import Topology

# What sources and description of a completed file say of options that no number of it is.
SPEED = re.compile(r"(?:speed of|N m at) ([\d.e+-]+) rpm")
GAP_RANGE = re.compile(r"gap by (?:equidistant|shift) modification 0 to ([\d.e+-]+) arcmin")
MET = re.compile(rf"(?:{MEETS}|{LEAST}), ([\d.e+-]+) arcmin")
# Files of former versions said that it was given.
STIFF = re.compile(rf"(?:{GIVEN}|{FOUND}){re.escape(AS_STIFF.removeprefix(FOUND))}, ([\d.e+-]+) N\.m/arcmin")
FIGURE = r"([0-9.e+]+)"
NAMED = re.compile(f"ratio-{FIGURE}-{FIGURE}Nm")
DESCRIBED = re.compile(f"(ratio {FIGURE}, rated {FIGURE} N m at {FIGURE} rpm).*, completed by design rules")
# Name and description have the ratio as it was given, which a catalogue rounds.
ROUNDED = 0.005


class Reducer(Protocol):
    """What is looked at of one; ``reducers.reducer``, which says these commands where a file cannot be read, has the class."""

    @property
    def name(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def topology(self) -> Topology: ...
    @property
    def starts(self) -> Mapping[str, float]: ...
    @property
    def sources(self) -> Mapping[str, str]: ...
    @property
    def plant(self) -> Table: ...
    @property
    def wear(self) -> Table: ...
    @property
    def joint(self) -> Table: ...


def given_again(reducer: Reducer, measured: Collection[str] = ()) -> Given | None:
    """What is given of a reducer now, the numbers ``measured`` among it whatever their sources say; None of drives that the rules are not for."""
    t, numbers, sources = reducer.topology, in_units(reducer), sources_of(reducer)
    if t.output_pins or t.discs != 2 or numbers.get("first_stage.ratio", 0.0) <= 0.0:
        return None
    completed = completed_names(reducer) - set(measured)
    ratio = float(f"{float(total_ratio(numbers['first_stage.ratio'], t.pins, t.lobes)):.9g}")
    # What no number of the file is: an input speed that was completed tells the output's with the ratio of that time alone.
    told = SPEED.search(f"{sources['input.speed']} {reducer.description}") if "input.speed" in completed else None
    made = {name: numbers[name] for name in PLAY if name in completed and MET.match(sources[name])}
    stiff = STIFF.match(sources.get(FREE, "")) if FREE not in measured else None
    ring = next(dial for dial in dials_of(t.pins, t.rollers, True, Given.lost_motion) if dial.name == "ring_share")
    by_diameter = "pin.circle_radius" in completed and ring.meaning in sources["pin.circle_radius"]
    known = {
        name: value for name, value in numbers.items()
        if name not in completed and name not in FROM_OPTIONS and not sources[name].startswith((f"{DERIVED}: ", f"{USUAL}: "))
    }  # fmt: skip
    try:
        return Given(
            ratio, t.pins, abs(numbers["output.load_torque"]), numbers["pin.circle_radius"] / ring.value if by_diameter else None,
            float(told[1]) if told else abs(numbers["input.speed"]) / ratio, t.cranks, t.rollers,
            lost_motion_of(sources), known=known, made=made, stiffness=float(stiff[1]) if stiff else None,
        )  # fmt: skip
    except InputFault:
        return None


def lost_motion_of(sources: Mapping[str, str]) -> float:
    """That of the catalogue [arcmin], of which the sources of what makes it tell, or the range of a gap of the flanks."""
    met = next((met for name in PLAY if (met := MET.match(sources.get(name, "")))), None)
    if met:
        return float(met[1])
    gap = GAP_RANGE.search(sources.get(GAP, "")) or GAP_RANGE.search(sources.get(SHIFT, ""))
    return 2.0 * float(gap[1]) if gap else Given.lost_motion


def doubts_again(reducer: Reducer) -> list[str]:
    """What was said to be doubtful when the file was completed; of any other file what its own numbers say of the same."""
    given, numbers, sources = given_again(reducer), in_units(reducer), sources_of(reducer)
    ring, rated, sun = numbers["pin.circle_radius"], abs(numbers["output.load_torque"]), numbers.get(SUN)
    plain = ring_doubt(ring, rated, diameter_of(given) if given else None) + (sun_doubt(sun) if sun is not None else [])
    if given is None:
        return plain
    stiff = stiff_again(given, numbers, sources)
    if sun is None:
        return plain + stiff
    if (told := DESCRIBED.match(reducer.description)) and alike(told[2], given.ratio):
        # The description alone has the ratio as it was given, and says whether somebody counted the pins.
        given = replace(given, ratio=float(told[2]), pins_counted=PINS_ASSUMED not in reducer.description)
    try:
        return doubts_of(replace(given, known={**given.known, SUN: sun}), ring, sun) + stiff
    except InputFault:
        # Teeth that do not go with each other are told as a fault.
        return plain + stiff


def stiff_again(given: Given, numbers: Mapping[str, float], sources: Mapping[str, str]) -> list[str]:
    """Whether the supports that make a catalogue's stiffness are far from those by rules."""
    if not (told := STIFF.match(sources.get(FREE, ""))):
        return []
    try:
        by_rules = complete(replace(given, known={name: value for name, value in given.known.items() if name != FREE})).numbers[FREE]
    except InputFault:
        return []
    return stiffness_doubt(f"{told[1]} N.m/arcmin", numbers[FREE], by_rules.low, by_rules.high, by_rules.unit, given.diameter)


def command(reducer: Reducer, measured: Collection[str] = ()) -> str:
    """The command that completes the file with all that it states itself, and the numbers ``measured``; empty where none does."""
    given = given_again(reducer, measured)
    if given is None:
        return ""
    name = usual_name(given) if NAMED.fullmatch(reducer.name) else reducer.name
    return shlex.join([*words_of(given), "--name", name, "--output", f"{name}_completed.toml"])


def outdated(reducer: Reducer) -> list[str]:
    """Each number that was completed and that would be another now, what it is and would be; name and description likewise."""
    completed, given = completed_names(reducer), given_again(reducer)
    if not completed or given is None:
        return []
    have = in_units(reducer)
    try:
        anew = numbers_of(given, {dial.name: dial.value for dial in dials_for(given)})
    except (InputFault, ArithmeticError, ValueError):
        # No reducer follows from what is given now; what forbids it is told as a fault.
        return []
    found = []
    # Whether the teeth go with each other is told as a fault where they do not; nothing else hangs on those of the sun.
    for name in (name for name in anew if name in completed and name != SUN):
        if abs(have[name] - anew[name]) > FAR * max(abs(have[name]), abs(anew[name])):
            had, would = (read_text(numbers[name], UNITS[name], 5) for numbers in (have, anew))
            rule = f" ({RULES[name][0]})" if name in RULES else ""
            found.append(
                f"{name} = {had} was completed{rule} from other numbers than the file has now, of which it would be {would}"
            )
    if (named := NAMED.fullmatch(reducer.name)) and not all(map(alike, named.groups(), (given.ratio, given.rated))):
        found.append(f"reducer.name = {reducer.name} is made of other numbers than the file has now, of which it would be {usual_name(given)}")
    if (said := DESCRIBED.match(reducer.description)) and not all(map(alike, said.groups()[1:], (given.ratio, given.rated, given.speed))):
        found.append(f'reducer.description says "{said[1]}", and would be "{described(given)}"')
    return found


def alike(written: str, value: float) -> bool:
    return abs(float(written) - value) <= ROUNDED * value


def completed_names(reducer: Reducer) -> set[str]:
    """Numbers whose sources say that they were completed."""
    return {name for name, source in sources_of(reducer).items() if source.startswith(COMPLETED)}


def in_units(reducer: Reducer) -> dict[str, float]:
    """The numbers of the file that the rules know, in the units of ``UNITS``."""
    found = {}
    for table in (reducer.plant, reducer.wear, reducer.joint):
        for v in table.variables:
            if v.path in UNITS and v.name in reducer.starts:
                factor, offset = conversion(v.unit, UNITS[v.path])
                found[v.path] = factor * reducer.starts[v.name] + offset
    return found


def sources_of(reducer: Reducer) -> dict[str, str]:
    """Where these are from."""
    variables = [v for table in (reducer.plant, reducer.wear, reducer.joint) for v in table.variables]
    return {v.path: reducer.sources.get(v.name, "") for v in variables if v.path in UNITS and v.name in reducer.starts}
