"""Loops of which no file says where the input was locked: asked, with the options that say it."""

from collections.abc import Iterable, Mapping

from discrepancy.campaign.guess.file_names import stem
from discrepancy.campaign.guess.locked_words import angle_named
from discrepancy.campaign.guess.run import GuessedRun
from discrepancy.campaign.guess.said import Unplaced
from discrepancy.campaign.guess.wishes import NAMED, OPEN
from discrepancy.campaign.unplaced import QUESTION
from discrepancy.held_names import LOCKED_AT


def is_held(run: GuessedRun) -> bool:
    """Whether it is a loop with its input locked."""
    return run.quantity.value == "hysteresis" and run.tags["locked"].value == "input"


def angle_for(run: GuessedRun, text: str) -> str | None:
    """What is given of all loops, for one: with ``NAMED`` the angle that its name holds."""
    if text != NAMED:
        return text
    return angle_named(stem(run.path)) if is_held(run) else None


def positions_asked(runs: Iterable[tuple[str, GuessedRun]], conditions: Mapping[str, Mapping[str, str]]) -> list[Unplaced]:
    """One doubt for all conditions; an angle that their names hold stands in the option, and where all do one option says so.  ``runs``: condition and run."""
    angles: dict[str, set[str | None]] = {}
    for condition, run in runs:
        if is_held(run) and LOCKED_AT not in conditions[condition] and LOCKED_AT not in run.columns:
            angles.setdefault(condition, set()).add(angle_named(stem(run.path)))
    if not angles:
        return []
    named = {condition: found.pop() if len(found) == 1 else None for condition, found in angles.items()}
    options = " ".join(f"--condition '{condition}:{LOCKED_AT}={angle or OPEN}'" for condition, angle in named.items())
    if all(named.values()):
        options = f"--condition {LOCKED_AT}={NAMED}"
    text = f"{QUESTION} ({LOCKED_AT} of the condition); these loops are predicted as the mean over a turn of the cranks"
    said = tuple((condition, angle) for condition, angle in named.items() if angle)
    if said:
        text += f"; their names say {', '.join(dict.fromkeys(angle for _, angle in said))}, which may be that angle"
    remedy = f"{options}; {LOCKED_AT}=mean where loops at positions over a turn were averaged; leave it where nobody knows"
    return [Unplaced(", ".join(angles), text, remedy, said)]
