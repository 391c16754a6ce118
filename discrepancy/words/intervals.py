"""How an interval is written: with the digits that its width asks for, so that its ends differ."""

import math
from collections.abc import Callable, Mapping
from typing import Any

# A number as text, with so many significant digits.
Writer = Callable[[float, int], str]
UNDETERMINED = "not determined"
# Digits of the width that are told, and how many an end has at most unless the two would look the same.
OF_WIDTH, MOST = 2, 6
# Beyond them a float has none.
ALL = 15
# Over its ends: what is narrower has no width, for a fit moves nothing along directions that the data do not see.
NO_WIDTH = 1e-9


def general(value: float, digits: int) -> str:
    return f"{value:.{digits}g}"


def relied_on(entry: Mapping[str, Any]) -> tuple[float, float]:
    """Of an estimate the interval that one may rely on: with the base model's numbers free within their ranges where that is the wider."""
    low, high = entry.get("interval_with_base", entry["interval"])
    return low, high


def values_of(entry: Mapping[str, Any]) -> list[tuple[float, tuple[float, float]]]:
    """Value and interval of an estimate, and those of the other value that shows the same, ``alike``: as far on for a direction, the other way round for a
    size."""
    (low, high), value = relied_on(entry), entry["value"]
    if (other := entry.get("alike")) is None:
        return [(value, (low, high))]
    there = (low + other - value, high + other - value) if entry.get("direction") else (value + other - high, value + other - low)
    return [(value, (low, high)), (other, there)]


def digits_of(low: float, high: float, least: int = 3, write: Writer = general) -> int:
    """Significant digits with which ``write`` tells the ends apart; ``least`` of them where the interval is wide, or none."""
    width, size = high - low, max(abs(low), abs(high))
    if not 0.0 < width < math.inf:
        return least
    asked = OF_WIDTH + math.floor(math.log10(size)) - math.floor(math.log10(width))
    first = max(least, min(asked, MOST))
    return next((digits for digits in range(first, ALL) if write(low, digits) != write(high, digits)), ALL)


def interval_text(low: float, high: float, least: int = 3, write: Writer = general) -> str:
    """``3.9982 to 4.0013``"""
    digits = digits_of(low, high, least, write)
    return f"{write(low, digits)} to {write(high, digits)}"


def estimate_text(value: float, interval: tuple[float, float], least: int, write: Writer) -> tuple[str, str]:
    """(value, interval), both with the digits of the interval."""
    low, high = interval
    if high - low <= NO_WIDTH * max(abs(low), abs(high)):
        return write(value, least), UNDETERMINED
    return write(value, digits_of(low, high, least, write)), interval_text(low, high, least, write)


def both_texts(entry: Mapping[str, Any], number: Callable[[float], float], least: int, write: Writer) -> tuple[str, str]:
    """``estimate_text`` of an estimate, in the unit that ``number`` makes, and behind it that of the other value that shows the same."""
    texts = [estimate_text(number(value), (number(low), number(high)), least, write) for value, (low, high) in values_of(entry)]
    value, interval = (" or ".join(dict.fromkeys(told)) for told in zip(*texts))
    return value, interval
