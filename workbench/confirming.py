"""A guess that is right is stated by one click: what its question offers as the answer, and the corrections that state it."""

from typing import Any

from discrepancy.campaign.guess.propose import Proposal
from discrepancy.campaign.guess.said import AngleAssumed, Doubt, SpeedBySize, Unplaced
from discrepancy.campaign.guess.wishes import INPUT
from discrepancy.held_names import LOCKED_AT


def answer_of(doubt: Doubt, proposal: Proposal) -> dict[str, Any]:
    """``yes``: what the button says, ``stated``: what is added to the corrections then, ``guess``: what is taken for true until then; nothing where
    no guess was made that could be right."""
    if isinstance(doubt, Unplaced) and doubt.angles:
        angles = ", ".join(dict.fromkeys(angle for _, angle in doubt.angles))
        return told(f"locked at {angles}, as their names say", "", {"conditions": {f"{name}:{LOCKED_AT}": angle for name, angle in doubt.angles}})
    if isinstance(doubt, AngleAssumed) and proposal.angle_of:
        whose = "the input's, over the ratio" if proposal.angle_of.value == INPUT else "an encoder's on the output"
        return told(f"it is {whose}", f"the angle is {whose}", {"angle_of": proposal.angle_of.value})
    if isinstance(doubt, SpeedBySize):
        guesses = [(run.condition, run.guessed.factors[doubt.key]) for run in proposal.runs if doubt.key in run.guessed.factors]
        stated = {f"{condition}:{doubt.key}": guess.value for condition, guess in guesses if not guess.sure}
        side = doubt.key.removesuffix("_speed")
        return told(f"of the {side}", f"speeds are those of the {side}", {"conditions": stated}) if stated else {}
    return {}


def told(text: str, guess: str, stated: dict[str, Any]) -> dict[str, Any]:
    return {"yes": f"Yes: {text}", "guess": guess, "stated": stated}
