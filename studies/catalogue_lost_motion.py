"""The gap of the flanks that makes the lost motion of a completed reducer the catalogue's, and what else is made smaller where no gap does."""

from collections.abc import Mapping
from dataclasses import replace
from enum import Enum
from typing import NamedTuple

from fmu_src.faults import InputFault, RunFault
from orchestrator.settings import parse_setting
from reducers.completion.complete import UNITS, Completion, complete
from reducers.completion.file import reducer_at
from reducers.completion.given import GAP, PLAY, Given
from reducers.completion.unusual import doubts_of_known
from reducers.reducer import Reducer
from studies.catalogue_stiffness import as_stiff_as
from studies.hysteresis import hysteresis
from studies.secants import size_for

# As near as a catalogue's figure is to be met, as a share of it, and steps until then: lost motion grows evenly with gap, clearance and play.
NEAR, MOST_STEPS = 2e-3, 6
# Of a size, between which its slope is taken [um].
FIRST = 1.0
# What is smaller than it ever is where even the least of all ranges leaves too much.
CLEARANCE = "bearing.clearance"


class Meets(Enum):
    """Whether gap, clearance and play are to make the catalogue's lost motion; ``AS_NEAR_AS_IT_GOES``: the least of their ranges where none do."""

    NOT, AS_NEAR_AS_IT_GOES, SURELY = range(3)


class Made(NamedTuple):
    """Sizes [um] of some of ``PLAY``, and the lost motion [arcmin] that is read of them."""

    sizes: dict[str, float]
    lost_motion: float


def as_in_catalogue(given: Given, stiffness: float | None, meets: Meets, typed: str = "") -> Completion:
    """Completed as stiff as the catalogue says [N m/arcmin], if it does, ``typed`` with its unit, and with its lost motion as far as ``meets`` asks."""
    completion = complete(given) if stiffness is None else as_stiff_as(given, stiffness, typed)
    if made := made_for(completion, meets):
        return as_in_catalogue(replace(given, made=made), stiffness, Meets.NOT, typed)
    return replace(completion, doubts=[*completion.doubts, *doubts_of_known(completion)])


def made_for(completion: Completion, meets: Meets) -> dict[str, float]:
    """Sizes [um] of some of ``PLAY`` that bring the lost motion to the catalogue's; none where none are asked for, InputFault where they surely have to."""
    given = completion.given
    if GAP in given.known and meets is Meets.SURELY:
        raise InputFault(f"--meet-lost-motion and --known {GAP}: each says the gap of the flanks; keep one")
    if GAP in given.known or meets is Meets.NOT:
        return {}
    try:
        found = narrowed(completion)
    except RunFault:
        if meets is Meets.SURELY:
            raise
        # Its check says what is wrong with it.
        return {}
    if meets is Meets.SURELY and abs(found.lost_motion - given.lost_motion) > NEAR * given.lost_motion:
        least = ", ".join(f"{name} = {size:g} um" for name, size in found.sizes.items())
        raise InputFault(
            f"--meet-lost-motion: nothing within the ranges makes a lost motion of {given.lost_motion:g} arcmin, the least is {found.lost_motion:.3g} arcmin"
            f" with {least}; look at --lost-motion, or give --known {CLEARANCE}=... of bearings that fit closer"
        )
    return found.sizes


def narrowed(completion: Completion) -> Made:
    """The gap of the flanks that makes the lost motion the catalogue's; where even none leaves too much, the next of ``PLAY`` within its range likewise."""
    reducer, wanted, figure = reducer_at(completion, {}), completion.given.lost_motion, 0.0
    made: dict[str, float] = {}
    for name in (name for name in PLAY if name not in completion.given.known):
        least = 0.0 if name == GAP else next(dial.low for dial in completion.dials if dial.name == name)
        figure = lost_motion(reducer, made | {name: least})
        if figure <= (1.0 + NEAR) * wanted:
            return met(reducer, made, name, (least, figure), max(completion.numbers[name].value, least + FIRST), wanted)
        made[name] = least
    return Made(made, figure)


def clearance_for(completion: Completion) -> float | None:
    """Clearance of the bearings [um] below its range that would make the lost motion the catalogue's with what is made; None where even none does."""
    reducer, made, wanted = reducer_at(completion, {}), dict(completion.given.made), completion.given.lost_motion
    without = lost_motion(reducer, made | {CLEARANCE: 0.0})
    return None if without > wanted else met(reducer, made, CLEARANCE, (0.0, without), made[CLEARANCE], wanted).sizes[CLEARANCE]


def met(reducer: Reducer, made: Mapping[str, float], name: str, here: tuple[float, float], there: float, wanted: float) -> Made:
    """The size of ``name`` with which the lost motion is as ``wanted``, from (size, figure) at ``here`` and a larger size on."""
    def figure(size: float) -> float:
        return lost_motion(reducer, {**made, name: size})

    found = size_for(wanted, figure, here, (there, figure(there)), NEAR, MOST_STEPS)
    return Made({**made, name: found.size}, found.figure)


def lost_motion(reducer: Reducer, sizes: Mapping[str, float]) -> float:
    """As the stiffness test reads it [arcmin], with ``sizes`` [um] in place of the file's."""
    tables = [reducer.plant, reducer.wear]
    return hysteresis(reducer, [parse_setting(f"{name}={size!r}{UNITS[name]}", tables) for name, size in sizes.items()]).lost_motion_arcmin
