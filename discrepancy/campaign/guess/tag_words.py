"""What a word means that is given for a tag: one of its words, or the same in another language of the bench."""

import re

from discrepancy.campaign.guess.column_words import surface_named
from discrepancy.campaign.guess.locked_words import angle_named
from discrepancy.campaign.guess.said import Guess
from discrepancy.campaign.guess.state_words import SHAFTS, locked_side, plainly
from discrepancy.campaign.quantities import TAGS
from discrepancy.held_names import LOCKED_AT
from discrepancy.problem import MEAN
from fmu_src.faults import InputFault, nearest

# Chinese and Japanese part no words.
EAST_ASIAN = {"input": "输入|輸入|入力", "output": "输出|輸出|出力"}
SIDE = {side: re.compile(rf"\b(?:{words}|{EAST_ASIAN[side]})", re.IGNORECASE) for side, words in SHAFTS.items()}
SHORT = {"in": "input", "out": "output"}


def meant_by(tag: str, word: str) -> Guess[str]:
    """The word of the tag; InputFault for one that is not understood, which names those that are."""
    choices = TAGS[tag].choices
    if not choices:
        return Guess(word, "given")
    if word.strip().lower() in choices:
        return Guess(word.strip().lower(), "given")
    found = {"locked": side_meant, "surface": surface_named}[tag](word)
    if found is None:
        raise InputFault(f"--tag {tag}={word}: {word!r} is not understood; {TAGS[tag].description} is one of {', '.join(choices)}{hint(tag, word)}")
    return Guess(found, f"given: {word!r} is taken for {found}{hint(tag, word)}")


def side_meant(word: str) -> str | None:
    """What was done to a side counts more than that it is named: "Ausgang gesperrt, der Eingang frei"."""
    plain = plainly(word)
    said = [side for side, fits in SIDE.items() if fits.search(plain)]
    return locked_side(word) or (said[0] if len(said) == 1 else SHORT.get(plain))


def hint(tag: str, word: str) -> str:
    """Where a position is said that stands in the word of a side, else the word that may be meant."""
    at = angle_named(word) or (MEAN if MEAN in plainly(word).split() else None) if tag == "locked" else None
    if at:
        return f"; where it was held is said of the condition: --condition '{LOCKED_AT}={at}'"
    return nearest(word, TAGS[tag].choices)


def words_for(tag: str) -> str:
    """What may be given for a tag."""
    choices = TAGS[tag].choices
    return f"which is {', '.join(choices[:-1])} or {choices[-1]}" if choices else TAGS[tag].description
