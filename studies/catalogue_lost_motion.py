"""What the stiffness test reads of a completed reducer, and the gap of the flanks that would make its lost motion the catalogue's."""

from dataclasses import dataclass, replace
from enum import Enum

from fmu_src.faults import InputFault, RunFault
from orchestrator.settings import parse_setting
from reducers.completion.complete import Completion, complete
from reducers.completion.file import reducer_at
from reducers.completion.given import GAP, Given
from reducers.reducer import Reducer
from studies.catalogue_stiffness import as_stiff_as
from studies.hysteresis import Hysteresis, hysteresis
from studies.secants import size_for

# As near as a catalogue's figure is to be met, as a share of it, and steps until then: lost motion grows evenly with the gap.
NEAR, MOST_STEPS = 2e-3, 6
# Of the gap, between which its slope is taken [um].
FIRST = 1.0


@dataclass(frozen=True)
class Tested:
    """Lost motion [arcmin] and torsional stiffness [N m/arcmin] of a completed reducer; ``gap`` [um] makes the former the catalogue's,
    None: no gap does, with none it is ``least`` [arcmin]."""

    lost_motion: float
    stiffness: float
    gap: float | None
    least: float


class Meets(Enum):
    """Whether the gap of the flanks is to make the catalogue's lost motion; ``IF_IT_CAN``: where none does it stays the rule's."""

    NOT, IF_IT_CAN, SURELY = range(3)


def as_in_catalogue(given: Given, stiffness: float | None, meets: Meets, typed: str = "") -> Completion:
    """Completed as stiff as the catalogue says [N m/arcmin], if it does, ``typed`` with its unit, and with its lost motion as far as ``meets`` asks."""
    completion = complete(given) if stiffness is None else as_stiff_as(given, stiffness, typed)
    gap = gap_for(completion, meets)
    return completion if gap is None else as_in_catalogue(replace(given, flank_gap=gap), stiffness, Meets.NOT, typed)


def gap_for(completion: Completion, meets: Meets) -> float | None:
    """Gap of the flanks [um] that makes the lost motion the catalogue's; None where none is asked for or does, InputFault where one surely has to."""
    given = completion.given
    if GAP in given.known and meets is Meets.SURELY:
        raise InputFault(f"--meet-lost-motion and --known {GAP}: each says the gap of the flanks; keep one")
    if GAP in given.known or meets is Meets.NOT:
        return None
    try:
        found = tested(reducer_at(completion, {}), completion.numbers[GAP].value, given.lost_motion)
    except RunFault:
        if meets is Meets.SURELY:
            raise
        # Its check says what is wrong with it.
        return None
    if found.gap is None and meets is Meets.SURELY:
        raise InputFault(
            f"--meet-lost-motion: no gap of the flanks makes a lost motion of {given.lost_motion:g} arcmin, without one it is {found.least:.3g} arcmin;"
            " look at --lost-motion, or give --known bearing.clearance=... or first_stage.backlash=..., which make the rest"
        )
    return found.gap


def tested(reducer: Reducer, gap: float, lost_motion: float) -> Tested:
    """The test of a reducer whose flanks have the ``gap`` [um], held against the catalogue's ``lost_motion`` [arcmin]; RunFault where it fails."""
    as_it_is, without = test(reducer, gap), test(reducer, 0.0)
    found = as_it_is.lost_motion_arcmin, as_it_is.stiffness_Nm_per_arcmin
    least = without.lost_motion_arcmin
    if least > lost_motion:
        return Tested(*found, None, least)
    wider = (gap, found[0]) if gap > 0.0 else (FIRST, test(reducer, FIRST).lost_motion_arcmin)
    met = size_for(lost_motion, lambda size: test(reducer, size).lost_motion_arcmin, (0.0, least), wider, NEAR, MOST_STEPS)
    return Tested(*found, met.size if met.near else None, least)


def test(reducer: Reducer, gap: float) -> Hysteresis:
    return hysteresis(reducer, [parse_setting(f"{GAP}={gap!r}um", [reducer.plant, reducer.wear])])
