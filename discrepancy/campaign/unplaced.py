"""Loops of which nobody says where the input was locked: asked, at once and without a model; whether it shows ``discrepancy.doubts.locked_doubts`` computes."""

from collections.abc import Iterable

from discrepancy.campaign.findings import WARNING, Finding
from discrepancy.campaign.model import Campaign
from discrepancy.held_names import LOCKED_AT
from discrepancy.problem import MEAN, Record, is_unplaced

CODE = "position of loops"
QUESTION = "nobody says where the input was locked"
REMEDY = (
    f'state {LOCKED_AT} = "90 deg", the angle of the input, in the condition;'
    f' or measure at positions over a turn of the cranks and state {LOCKED_AT} = "{MEAN}"'
)


def unplaced_in(records: Iterable[Record]) -> list[str]:
    """Conditions of such loops."""
    return list(dict.fromkeys(record.condition for record in records if is_unplaced(record)))


def unplaced(campaign: Campaign) -> list[Finding]:
    """One finding for all conditions of such loops."""
    names = unplaced_in(campaign.records)
    if not names:
        return []
    text = f"loops in {', '.join(names)}: {QUESTION}; they are predicted as the mean over a turn of the cranks"
    return [Finding(WARNING, CODE, text, REMEDY)]
