"""What an answer says of loops of which nobody says where the input was locked."""

import math
from collections.abc import Mapping

from discrepancy.campaign.unplaced import QUESTION, REMEDY, unplaced_in
from discrepancy.held_names import LOCKED_AT, LOCKED_POSITION
from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.verdict import Diagnosis
from discrepancy.prediction.by_effects import Effects
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import effect_of, is_unplaced


def without_place(model: PhysicalModel, found: Diagnosis) -> list[str]:
    """Conditions of such loops that no place was found for beside what is named; none where that is a position itself."""
    conditions = unplaced_in(model.records)
    if not conditions or (found.fits.members and LOCKED_POSITION in (effect_of(c.name) for c in found.fits.members[0].candidates)):
        return []
    places = model.unstated_places.taken(*named_by(found))
    return [condition for condition in conditions if condition not in places]


def named_by(found: Diagnosis) -> tuple[Effects, Mapping[str, float]]:
    """Effects as places are found by them, and values: of what is named, else of the model as it is."""
    member = found.fits.members[0] if found.fits.members else None
    return (frozenset(), found.nuisances) if member is None else (named_amplitudes(member), member.fit.values)


def named_amplitudes(member: Refit) -> Effects:
    """Effects of a fit as places are found by them."""
    return frozenset(p.name for c in member.candidates for p in c.amplitudes)


def unstated_texts(model: PhysicalModel, found: Diagnosis) -> list[str]:
    """Where they are as measured beside what is named, with the line that states it; else that what is named may be the position."""
    if not unplaced_in(model.records):
        return []
    told = place_texts(model, *named_by(found))
    left = without_place(model, found)
    if left and found.fits.members:
        told.append(
            f"loops in {', '.join(left)}: {QUESTION}; they are predicted as the mean over a turn of the cranks: what is named or left in loops may be the"
            f" position; {REMEDY}"
        )
    return told


def place_texts(model: PhysicalModel, effects: Effects, values: Mapping[str, float]) -> list[str]:
    """Where such loops are as measured beside the ``effects`` of ``values``, or of the model file itself, with the line that states it."""
    period, told = model.unstated_places.period, []
    beside = "what is named" if effects else "the model's effects" if model.without_own else "the base model"
    for condition, place in model.unstated_places.taken(effects, values).items():
        # From where angles count by this fit, as a stated position does.
        place -= model.locked_places.zero_moved(next(r for r in model.records if r.condition == condition and is_unplaced(r)), values)
        # Half a turn of the cranks on discs have changed places: where nothing is off about one of them that is as good.
        angle, other = (round(math.degrees(math.remainder(place + further, period))) for further in (0.0, 0.5 * period))
        turn = math.degrees(period)
        told.append(
            f"loops in {condition}: {QUESTION}; beside {beside} they are as measured at about {angle} deg of the input (or {other} deg, if nothing is off about"
            f" one disc alone), not as the mean over a turn of the cranks ({turn:.0f} deg, after which they are much alike); if that is where it was state"
            f' {LOCKED_AT} = "{angle} deg" in the condition'
        )
    return told
