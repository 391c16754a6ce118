"""Doubts that several files give rise to, told once."""

import re
from collections.abc import Sequence
from dataclasses import replace

from discrepancy.campaign.guess.said import Doubt

# How a doubt begins by which a speed was taken for that of a shaft because of its size alone.
BY_SIZE = re.compile(r"(?P<number>\S+) (?P<unit>.+) is taken for the (?P<key>\w+): \S+ rpm is (?P<reason>.+)")


def merged(doubts: Sequence[Doubt]) -> list[Doubt]:
    """Equal doubts of several files once."""
    places: dict[tuple[str, str], list[str]] = {}
    for doubt in with_speeds_together(doubts):
        places.setdefault((doubt.text, re.sub(r"'[^'=]*=QUANTITY'", "'FILES=QUANTITY'", doubt.remedy)), []).append(doubt.place)
    return [Doubt(files[0] + (f" and {len(files) - 1} more" if len(files) > 1 else ""), text, remedy) for (text, remedy), files in places.items()]


def with_speeds_together(doubts: Sequence[Doubt]) -> list[Doubt]:
    """Doubts of several speeds for one reason, each with all of them: ``600 and 1500 rpm are taken for the input_speed: each is faster than outputs turn``."""
    found = [BY_SIZE.fullmatch(doubt.text) for doubt in doubts]
    numbers: dict[tuple[str, ...], set[str]] = {}
    for match in filter(None, found):
        numbers.setdefault(match.group("unit", "key", "reason"), set()).add(match["number"])
    texts = [doubt.text if match is None else speeds_text(match, numbers[match.group("unit", "key", "reason")]) for doubt, match in zip(doubts, found)]
    return [replace(doubt, text=text) for doubt, text in zip(doubts, texts)]


def speeds_text(match: re.Match[str], numbers: set[str]) -> str:
    """What is told of a speed where others were taken for the same."""
    if len(numbers) == 1:
        return match[0]
    *others, last = sorted(numbers, key=float)
    return f"{', '.join(others)} and {last} {match['unit']} are taken for the {match['key']}: each is {match['reason']}"
