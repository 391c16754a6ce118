"""How an interval is written: with the digits that its width asks for, so that its ends differ."""

import math
from collections.abc import Callable, Mapping
from typing import Any

from reducers.reducer import Reducer
from rv_plant.pin_numbers import PIN_NUMBERS, pin_of, pins_alike

# A number as text, with so many significant digits.
Writer = Callable[[float, int], str]
UNDETERMINED = "not determined"
ANY = "any"
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


def is_any(entry: Mapping[str, Any]) -> bool:
    """Whether an estimate is a direction that may be any: its interval [rad] is a turn, or more."""
    low, high = relied_on(entry)
    return bool(entry.get("direction")) and high - low >= math.tau


def both_texts(entry: Mapping[str, Any], number: Callable[[float], float], least: int, write: Writer) -> tuple[str, str]:
    """``estimate_text`` of an estimate, in the unit that ``number`` makes, and behind it that of the other value that shows the same."""
    if "pins" in entry:
        return pin_texts(entry, least, write)
    if is_any(entry):
        return ANY, UNDETERMINED
    texts = [estimate_text(number(value), (number(low), number(high)), least, write) for value, (low, high) in values_of(entry)]
    value, interval = (" or ".join(dict.fromkeys(told)) for told in zip(*texts))
    return value, interval


def pins_in(name: str, value: float, reducer: Reducer) -> dict[str, list[float]]:
    """``pins`` of an estimate that is the number of a pin: it, and those that show the same; nothing of any other."""
    return {"pins": pins_alike(value, reducer.topology)} if name in PIN_NUMBERS else {}


def pin_texts(entry: Mapping[str, Any], least: int, write: Writer) -> tuple[str, str]:
    """``19 or 39``, ``19 or 39`` of the number of a pin: whole, unless it lies between two pins; the interval has the pins that it may be."""
    value, (low, high) = entry["value"], relied_on(entry)
    told = [estimate_text(pin, (low + pin - value, high + pin - value), least, write) for pin in entry["pins"]]
    if all(pin == round(pin) for pin in entry["pins"]):
        # The interval is as wide about each of them; its ends count from the number that was fitted, not from the pin nearest to it.
        shifts = [pin - entry["pins"][0] for pin in entry["pins"]]
        told = [(f"{pin:.0f}", text if text == UNDETERMINED else pins_between(low + shift, high + shift))
                for pin, shift, (_, text) in zip(entry["pins"], shifts, told)]  # fmt: skip
    pins, intervals = (" or ".join(dict.fromkeys(texts)) for texts in zip(*told))
    return pins, intervals


def pins_between(low: float, high: float) -> str:
    """``19``, or ``18 to 20``: a whole pin beyond an end that lies between two."""
    first, last = (near if (near := pin_of(end)) == round(near) else outer(end) for end, outer in ((low, math.floor), (high, math.ceil)))
    return f"{first:.0f} to {last:.0f}" if first < last else f"{first:.0f}"
