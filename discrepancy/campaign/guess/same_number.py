"""Numbers of conditions, compared in one unit however they were written: 25 degC, 25.0 degC and 77 degF."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from discrepancy.campaign.guess.conditions import State
from discrepancy.campaign.quantities import FACTOR_KEYS
from discrepancy.campaign.scales import Scales
from fmu_src.faults import InputFault

# Numbers of one key are compared, whatever their units.
ANY_REDUCER = Scales(None, 1.0, 1.0)
# Units differ in the last digits of what they are converted by.
DIGITS = 9


def figure_of(key: str, text: str) -> object:
    """What equals that of the same number; of what is no number (``mean``, a direction) the text itself."""
    if key not in FACTOR_KEYS:
        return text
    try:
        number = ANY_REDUCER.number(FACTOR_KEYS[key], text, key)
    except InputFault:
        # Who reads it says what is wrong with it.
        return text
    # A share of the rated torque is no torque before the reducer is known.
    return f"{number:.{DIGITS}g}", text.rstrip().endswith("%")


def in_figures(stated: Mapping[str, str]) -> dict[str, object]:
    """A whole condition, to be compared with others."""
    return {key: figure_of(key, text) for key, text in stated.items()}


def written_alike(states: Sequence[State]) -> list[State]:
    """Equal numbers as the first file has them: what differs in the unit alone is one condition."""
    first: dict[tuple[str, object], str] = {}
    return [
        replace(state, stated=tuple((key, first.setdefault((key, figure_of(key, text)), text)) for key, text in state.stated)) for state in states
    ]
