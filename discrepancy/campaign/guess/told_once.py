"""Doubts that several files give rise to, told once."""

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace

from discrepancy.campaign.guess.said import Doubt, SpeedBySize


def merged(doubts: Sequence[Doubt]) -> list[Doubt]:
    """Equal doubts of several files once."""
    alike: dict[tuple[str, str], list[Doubt]] = {}
    for doubt in with_speeds_together(doubts):
        alike.setdefault((doubt.text, re.sub(r"'[^'=]*=QUANTITY'", "'FILES=QUANTITY'", doubt.remedy)), []).append(doubt)
    # The first of them stays what it is: what answers it hangs on that.
    return [
        replace(same[0], place=same[0].place + (f" and {len(same) - 1} more" if len(same) > 1 else ""), remedy=remedy,
                so=" ".join(dict.fromkeys(doubt.so for doubt in same if doubt.so)))
        for (_, remedy), same in alike.items()
    ]  # fmt: skip


def with_speeds_together(doubts: Sequence[Doubt]) -> list[Doubt]:
    """Doubts of several speeds for one reason, each with all of them: ``600 and 1500 rpm are taken for the input_speed: each is faster than outputs turn``."""
    speeds: dict[tuple[str, str], dict[str, float]] = {}
    for doubt in doubts:
        if isinstance(doubt, SpeedBySize):
            number, unit = doubt.speed.split(" ", 1)
            speeds.setdefault((unit, doubt.key), {})[number] = float(number)
    return [replace(doubt, text=speeds_text(doubt, speeds)) if isinstance(doubt, SpeedBySize) else doubt for doubt in doubts]


def speeds_text(doubt: SpeedBySize, speeds: Mapping[tuple[str, str], Mapping[str, float]]) -> str:
    """What is told of a speed where others were taken for the same."""
    unit = doubt.speed.split(" ", 1)[1]
    alike = speeds[unit, doubt.key]
    if len(alike) == 1:
        return doubt.text
    *others, last = sorted(alike, key=lambda number: alike[number])
    return f"{', '.join(others)} and {last} {unit} are taken for the {doubt.key}: each is {doubt.size}"
