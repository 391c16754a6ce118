"""Units behind the numbers in names of files: 1478 in-lbf, 77F, 15_U_min."""

import re
from collections.abc import Iterator

from fmu_src import unit_words as u
from fmu_src.unit_words import unit_of

NUMBER = r"[+-]?\d+(?:[.,p]\d+)?"
# Signs that part the words of a name; a unit has three words at most: in lbf, 1 min, deg F.
WORD = r"[^\s_\-{}()]+"
BEHIND = re.compile(rf"([_\s]?)({WORD}(?:[-_\s]{WORD}){{0,2}})")
FIELDS = {u.TORQUE: "load", u.SPEED: "speed", u.TEMPERATURE: "temperature"}
# Signs of a unit that speaks for itself behind letters or a gap: Last50Nm, 100_Nm; "Probe2h" and "2_C" may count anything.
LEAST_UNIT = 2
# Letters that are degrees behind a gap, too, where the number has as many digits: 77 F.
DEGREES = {"C": 2, "F": 2, "K": 3}
# From so many turns on, by a word of so many signs, a name says turns a minute: 750 giri, 1500 tours; "15U" may be anything.
SPEED_IN_TURNS, LEAST_TURNS = 100.0, 4
NUMBERED = re.compile(rf"[^\W\d_]*({NUMBER})([^\W\d_]*)")


def spelled(text: str) -> tuple[str, str] | None:
    """(unit, kind) of words as names write them, which have no strokes and often no blanks: in_lbf, U_min."""
    return unit_of(text.replace("_", " ")) or (unit_of(re.sub(r"[_\s-]", "/", text)) if re.search(r"[_\s-]", text) else None)


def figure(text: str) -> float:
    """The number of ``NUMBER``: 1,5 and 1p5 are 1.5."""
    return float(text.replace(",", ".").replace("p", "."))


def is_turns(text: str) -> bool:
    """Whether words are turns, which behind a speed stand for turns a minute: 15U."""
    known = spelled(text)
    return known is not None and known[0] == "turn"


def is_speed_in_turns(number: str, words: str) -> bool:
    """Whether a number with words behind it is a speed of which the minute is left out: 750 giri."""
    return len(words) >= LEAST_TURNS and is_turns(words) and figure(number) >= SPEED_IN_TURNS


def units_behind(text: str) -> Iterator[tuple[str, str, str, str]]:
    """(unit, kind, gap, words) that the text behind a number may begin with, the longest first."""
    if found := BEHIND.match(text):
        words = found[2]
        while words:
            if known := spelled(words):
                yield *known, found[1], words
            words = re.sub(rf"(?:^|[-_\s]){WORD}$", "", words)


def plain_field(words: str) -> tuple[str, str] | None:
    """(field, unit) of words that are a unit of a condition and hardly anything else."""
    known = spelled(words) if len(words) >= LEAST_UNIT else None
    return (FIELDS[known[1]], known[0]) if known and known[1] in FIELDS else None


def with_units(parts: list[str]) -> list[str]:
    """Parts of a name, which stand at even places, those of a number and of its unit as one: 100_Nm, 1478 in-lbf."""
    found: list[str] = []
    while parts:
        taken = of_unit(parts)
        found.append("".join(parts[: 1 + taken]))
        parts = parts[1 + taken :]
        found += parts[:1]
        parts = parts[1:]
    return found


def of_unit(parts: list[str]) -> int:
    """How many parts behind the first, a number, are its unit."""
    numbered = NUMBERED.fullmatch(parts[0])
    if not numbered:
        return 0
    number, begun = numbered.groups()
    for taken in (4, 2):
        behind = parts[1 : 1 + taken]
        if len(behind) < taken or not all(re.fullmatch(r"[_\s-]", gap) for gap in behind[::2]) or (not begun and behind[0] == "-"):
            continue
        words = begun + "".join(behind if begun else behind[1:])
        degrees = words in DEGREES and len(re.sub(r"\D", "", number)) >= DEGREES[words]
        if degrees or plain_field(words) or is_speed_in_turns(number, words):
            return taken
    return 0
