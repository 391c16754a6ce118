"""What an answer says of loops of which nobody says where the input was locked."""

import math

from discrepancy.campaign.unplaced import QUESTION, REMEDY
from discrepancy.held_names import LOCKED_AT
from discrepancy.hidden_by_position import POSITION
from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.separable import effect_of
from discrepancy.inference.verdict import Diagnosis
from discrepancy.prediction.by_effects import Effects
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import is_unplaced


def without_place(model: PhysicalModel, found: Diagnosis) -> list[str]:
    """Conditions of such loops that no place was found for beside what is named; none where that is a position itself."""
    conditions = dict.fromkeys(record.condition for record in model.records if is_unplaced(record))
    member = found.fits.members[0] if found.fits.members else None
    if not conditions or member is None:
        return list(conditions)
    if POSITION in map(effect_of, member.candidates):
        return []
    places = model.unstated_places.taken(named_amplitudes(member), member.fit.values)
    return [condition for condition in conditions if condition not in places]


def named_amplitudes(member: Refit) -> Effects:
    """Effects of a fit as places are found by them."""
    return frozenset(p.name for c in member.candidates for p in c.amplitudes)


def unstated_texts(model: PhysicalModel, found: Diagnosis) -> list[str]:
    """Where they are as measured beside what is named, with the line that states it; else that what is named may be the position."""
    conditions = dict.fromkeys(record.condition for record in model.records if is_unplaced(record))
    member = found.fits.members[0] if found.fits.members else None
    if not conditions or member is None:
        return []
    places = model.unstated_places.taken(named_amplitudes(member), member.fit.values)
    period = model.unstated_places.period
    told = []
    for condition, place in places.items():
        # From where angles count by this fit, as a stated position does.
        place -= model.locked_places.zero_moved(next(r for r in model.records if r.condition == condition and is_unplaced(r)), member.fit.values)
        angle, turn = math.degrees(math.remainder(place, period)), math.degrees(period)
        told.append(
            f"loops in {condition}: {QUESTION}; beside what is named they are as measured at about {angle:.0f} deg of the input, not as"
            f" the mean over a turn of the cranks ({turn:.0f} deg, after which they are much alike); state {LOCKED_AT} in the condition if you know it"
        )
    left = without_place(model, found)
    if left:
        told.append(
            f"loops in {', '.join(left)}: {QUESTION}; they are predicted as the mean over a turn of the cranks: what is named or left in loops may be the"
            f" position; {REMEDY}"
        )
    return told
