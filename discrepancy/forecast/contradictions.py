"""Readings that no growth explains: what falls, and what lies further from the best law than its noise lets it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from scipy.special import chdtrc

from discrepancy.forecast.forecast import Forecast, Reading

# Readings as far off as this, or further, come once in so many campaigns that grow as assumed.
RARE = 0.01
# A single reading, or the difference of two, that is off by more than so many of its standard deviations.
FAR = 3.0


@dataclass(frozen=True)
class Contradiction:
    """A sentence in the unit of the readings."""

    text: str


def contradictions(readings: Sequence[Reading], found: Forecast, unit: str) -> list[Contradiction]:
    """Of the ``readings`` that a forecast rests on; empty where they fit.

    The chi-square of the readings about the law that the posterior holds for the best, over their noise, has as many degrees of freedom as there are
    readings at the most: what is doubted by it is doubted with good reason.
    """
    ordered = sorted(readings, key=lambda r: r.hours)
    said = [Contradiction(text) for text in falls(ordered, unit)]
    if chdtrc(len(ordered), found.chi_square) < RARE:
        off = [(r, m) for r, m in zip(ordered, found.misfits) if abs(m) > FAR] or [max(zip(ordered, found.misfits), key=lambda pair: abs(pair[1]))]
        which = ", ".join(f"{r.value:.4g} {unit} at {r.hours:g} h ({abs(m):.1f} times its noise too {'low' if m > 0.0 else 'high'})" for r, m in off)
        text = f"the readings do not fit the best growth (chi-square {found.chi_square:.0f} on {len(ordered)} readings): {which}"
        said.append(Contradiction(f"{text}; a reading is wrong, its noise larger than stated, or the wear of another kind than assumed"))
    return said


def falls(ordered: Sequence[Reading], unit: str) -> list[str]:
    """A sentence for each reading that lies below an earlier one by more than the noise of both lets it."""
    said = []
    for k, later in enumerate(ordered):
        before = [r for r in ordered[:k] if r.hours < later.hours]
        if not before:
            continue
        worst = max(before, key=lambda r: (r.value - later.value) / math.hypot(r.noise, later.noise))
        size = (worst.value - later.value) / math.hypot(worst.noise, later.noise)
        if size > FAR:
            said.append(
                f"the reading falls from {worst.value:.4g} {unit} at {worst.hours:g} h to {later.value:.4g} {unit} at {later.hours:g} h, by {size:.1f} times"
                " the noise of both: what wears can only grow"
            )
    return said
