"""Numbers in print, and words at the beginning of a sentence."""

import math
import re
from typing import Any

from fmu_src.unit_words import unit_on_screen


def hour_text(hours: float) -> str:
    """``10,000 h``"""
    return f"{hours:,.4g} h" if hours < 1000.0 else f"{hours:,.0f} h"


def number(value: float | None, digits: int = 3) -> str:
    """Rounded to significant digits, thousands marked, no exponent between 1e-3 and 1e6."""
    if value is None or not math.isfinite(value):
        return "–"
    if value == 0.0:
        return "0"
    size = math.floor(math.log10(abs(value)))
    if not -5 < size < 7:
        return f"{value:.{digits - 1}e}"
    text = f"{round(value, digits - 1 - size):,.{max(0, digits - 1 - size)}f}"
    return text.replace("-", "−")


def units_in_print(text: str) -> str:
    """A text of a command as a page has it: with the sign of a micrometre, alone or in a unit (``um/kN``), and torques in N m as on the screen."""
    return re.sub(r"(?<![\w.])um(?![\w.])", "µm", unit_on_screen(text))


def in_print(value: Any) -> Any:
    """The same of all texts in lists and tables."""
    if isinstance(value, dict):
        return {key: in_print(part) for key, part in value.items()}
    if isinstance(value, list):
        return [in_print(part) for part in value]
    # Markup, which templates make, stays as it is.
    return units_in_print(value) if type(value) is str else value


def capital(text: str) -> str:
    """The first letter large, all others as they are: names keep theirs."""
    return text[:1].upper() + text[1:]


def counted(count: int, noun: str) -> str:
    """``1 run``, ``2 runs``"""
    return f"{count} {noun}" + ("" if count == 1 else "s")


def ordinal(n: int) -> str:
    """``2nd``, ``11th``"""
    ending = "th" if 10 <= n % 100 <= 20 else {1: "st", 2: "nd", 3: "rd"}.get(n % 10, "th")
    return f"{n}{ending}"
