"""With how many digits a key figure is told: down to the second of its noise, the same on screen, pages and workbench."""

import math
from collections.abc import Callable

from discrepancy.figures.key_figures import KeyFigure
from discrepancy.scales import of_signal

# More fit no telephone.
MOST_DIGITS = 6
POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def figure_texts(f: KeyFigure, *others: float, text: "Callable[[float, int], str] | None" = None) -> tuple[str, list[str]]:
    """(unit, texts of what was measured, of its noise, and of ``others`` [SI]); as on a page, or as ``text`` writes a number with so many decimals."""
    scale = of_signal(f.told_as, f.unit)
    decimals = decimals_of(scale.factor * f.noise)
    return scale.unit, [(text or text_of)(scale.factor * value, decimals) for value in (f.measured, f.noise, *others)]


def decimals_of(noise: float) -> int:
    """Decimals down to the second digit of the noise, before the point where negative: what is smaller says nothing."""
    return 1 - math.floor(math.log10(noise)) if noise > 0.0 and math.isfinite(noise) else 4


def text_of(value: float, decimals: int) -> str:
    """Of MOST_DIGITS digits at most; with a power of ten as the page writes it where there are too many zeros."""
    mantissa, _, power = plain_text(value, decimals, ",").partition("e")
    return f"{mantissa}·10{str(int(power)).translate(POWERS)}".replace("-", "−") if power else mantissa.replace("-", "−")


def plain_text(value: float, decimals: int, thousands: str = "") -> str:
    """The same for a screen."""
    if not math.isfinite(value):
        return "–"
    value = round(value, decimals) or 0.0
    size = math.floor(math.log10(abs(value))) if value else 0
    if -5 < size < MOST_DIGITS:
        return f"{value:{thousands}.{max(0, min(decimals, MOST_DIGITS - 1 - size))}f}"
    return f"{value:.{max(0, min(size + decimals, MOST_DIGITS - 1))}e}"
