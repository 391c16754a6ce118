"""Units in header cells: where they stand, and what is left of the cell without them."""

import re

from fmu_src.unit_words import unit_of

IN_BRACKETS = re.compile(r"\s*[\[(（【{<]([^\[\](){}（）【】<>]*)[\])）】}>]\s*")
# The whole last word where it has parts: "Drehzahl U/min" is in no minutes, "T_N.m" in no metres.
LAST_WORD = re.compile(r"^(.+?)(?:[\s_:：,]|/(?=\s))+(?:in\s+)?([^\s_:：,]*[^\s_:：,/][/.][^\s_:：,]+)$")
AFTER_WORD = re.compile(r"^(.*\S)\s*(?:/|\bin\b|,|:|：)\s*(\S+)$")
AFTER_LINE = re.compile(r"^(.+)[_ .-]([^_ ]+)$")
ENDINGS = (LAST_WORD, AFTER_WORD, AFTER_LINE)


def ending(cell: str) -> tuple[str, str, str, str] | None:
    """(unit, kind, the word that says it, what stands before it) of a cell without brackets that ends with a unit.

    A bare F is one behind a temperature alone: elsewhere it names a force, or a channel.
    """
    for pattern in ENDINGS:
        match = pattern.match(cell)
        if match and (known := unit_of(match[2])) and known[0] != "1" and (match[2] != "F" or re.search("temp", match[1], re.IGNORECASE)):
            return *known, match[2], match[1]
    return None


def unit_in(header: str) -> tuple[str, str, str] | None:
    """(unit, kind, where it stands) of a header cell: in brackets, after a stroke, or as its last part."""
    for written in IN_BRACKETS.findall(header):
        if known := unit_of(written):
            return *known, f"[{written}] in its header"
    # Half of what stands in brackets is no unit: "N furlong" is none, and no furlong.
    outside = IN_BRACKETS.sub(" ", header).strip()
    if found := ending(outside):
        return found[0], found[1], f"its header ends with {found[2]}"
    return None


def unknown_in(header: str) -> str:
    """What stands in a header's brackets where a unit does, and is none that is known; empty if there is nothing of that kind."""
    return "" if unit_in(header) else next((found.strip() for found in reversed(IN_BRACKETS.findall(header)) if found.strip()), "")


def name_of(header: str) -> str:
    """A header cell without its unit."""
    name = IN_BRACKETS.sub(" ", header).strip()
    found = ending(name)
    return found[3].strip(" :：") if found else name
