"""What a line above a table says of a number that the file's name says, too: the name sets it, the line may have measured it."""

from pathlib import Path

from discrepancy.campaign.guess.said import Doubt
from discrepancy.campaign.guess.same_number import ANY_REDUCER, figure_of
from discrepancy.campaign.guess.set_steps import MEASURED, spans_no_step
from discrepancy.campaign.quantities import FACTOR_KEYS


def is_measured(key: str, named: str, above: str) -> bool:
    """Whether the number ``above`` is what was measured of the ``named`` one: another, and by less than anyone sets."""
    if key not in MEASURED or "%" in named + above or figure_of(key, named) == figure_of(key, above):
        return False
    return spans_no_step([ANY_REDUCER.number(FACTOR_KEYS[key], text, key) for text in (named, above)], key, FACTOR_KEYS[key].unit)


def contradiction(path: Path, key: str, named: str, above: str) -> Doubt | None:
    """A number above the table that is another one than the file's name says; None where both say the same, or only the reducer can tell."""
    if "%" in named + above or figure_of(key, named) == figure_of(key, above) or is_measured(key, named, above):
        return None
    text = f"its name says {key} = {named}, which is taken, and a line above its table {above}"
    return Doubt(path.name, text, f"--condition 'NAME:{key}={above}' for the condition of that name if the line is right")
