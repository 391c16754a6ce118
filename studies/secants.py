"""Which size of one number makes a figure of the stiffness test the catalogue's: by secants, for such figures hang nearly straight on it."""

from collections.abc import Callable
from typing import NamedTuple

# As sizes found are written.
DIGITS = 4


class Met(NamedTuple):
    """The last ``size`` tried, the ``figure`` there, and whether that is near enough; units as given."""

    size: float
    figure: float
    near: bool


def size_for(wanted: float, figure: Callable[[float], float], here: tuple[float, float], there: tuple[float, float], near: float, most_steps: int) -> Met:
    """The size, 0 or more, whose ``figure`` is ``wanted`` to the share ``near`` of it, from two (size, figure) on; a figure must grow with the size."""
    for _ in range(most_steps):
        slope = (there[1] - here[1]) / (there[0] - here[0])
        if abs(there[1] - wanted) <= near * wanted or slope <= 0.0:
            break
        size = max(float(f"{there[0] + (wanted - there[1]) / slope:.{DIGITS}g}"), 0.0)
        here, there = there, (size, figure(size))
    return Met(*there, abs(there[1] - wanted) <= near * wanted)
