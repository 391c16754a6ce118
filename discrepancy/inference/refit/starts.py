"""Where a fit starts: the score test's estimate first, then other sizes, other quadrants, and along the valley that it ended in.

An estimate from the slope at the base model leads into the nearest optimum.  Effects that begin with a threshold, act on one side
only, or whose parameters do nearly the same have others.
"""

from collections.abc import Callable, Mapping, Sequence
from itertools import product

import numpy as np

from discrepancy.problem import Parameter
from fmu_src.arrays import Floats

# Sizes of a start over the score test's estimate, and over a parameter's typical size.
FACTORS, SIZES = (0.25, 4.0), (0.5, 2.0)
# More amplitudes than these have too many quadrants; they are harmonics of one pattern.
MOST_AMPLITUDES = 3
# A harmonic's phases [rad]; with the sign turned it shows as much.
PHASES = (0.0, 0.25 * np.pi, 0.5 * np.pi, 0.75 * np.pi)
# So often a start that is worse than no effect is halved.
HALVINGS = 6
# Steps along the valley in its own standard deviations.
ALONG = (-12.0, -4.0, 4.0, 12.0)


def other_starts(amplitudes: Sequence[Parameter], start: Mapping[str, float]) -> list[dict[str, float]]:
    """Starts of other sizes and, for two or three amplitudes, of all quadrants; shapes stay as in ``start``."""
    found = [_scaled(amplitudes, start, factor) for factor in FACTORS]
    if len(amplitudes) > MOST_AMPLITUDES:
        return found
    for size in SIZES:
        for signs in product((1.0, -1.0), repeat=len(amplitudes)):
            if all(p.sign in (0, sign) for p, sign in zip(amplitudes, signs)):
                moved = {p.name: _inside(p, p.off + sign * size * p.scale) for p, sign in zip(amplitudes, signs)}
                found.append({**start, **moved})
    return found


def alone(amplitudes: Sequence[Parameter], start: Mapping[str, float]) -> list[list[dict[str, float]]]:
    """By each two of many amplitudes that follow each other (a harmonic's cosine and sine) starts at which they stand alone, at some phases.

    What shows alike with either sign has an optimum by each harmonic that may be taken for another.
    """
    off = {**start, **{p.name: p.off for p in amplitudes}}
    found = []
    for first, second in zip(amplitudes[::2], amplitudes[1::2]):
        waves = [(size * np.cos(phase), size * np.sin(phase)) for size in SIZES for phase in PHASES]
        places = [(_inside(first, first.off + a * first.scale), _inside(second, second.off + b * second.scale)) for a, b in waves]
        found.append([{**off, first.name: a, second.name: b} for a, b in places])
    return found


def along_valley(parameters: Sequence[Parameter], values: Mapping[str, float], information: Floats) -> list[dict[str, float]]:
    """Points far along the direction that the data determine least; ``information`` (p, p) by parameters in units of their scale."""
    eigenvalues, vectors = np.linalg.eigh(information)
    direction = vectors[:, 0] / np.sqrt(max(float(eigenvalues[0]), 1e-12 * max(float(eigenvalues[-1]), 1e-300)))
    # A valley has a bottom: along a direction that says nothing, no further than some typical sizes.
    direction *= min(1.0, 1.0 / float(np.abs(direction).max()))
    moved = [{p.name: _inside(p, values[p.name] + step * d * p.scale) for p, d in zip(parameters, direction)} for step in ALONG]
    return [{**values, **m} for m in moved]


def halved(amplitudes: Sequence[Parameter], start: Mapping[str, float], cost: Callable[[Mapping[str, float]], float], least: float) -> list[dict[str, float]]:
    """The first of the starts with half the size, a quarter, ... that costs less than ``least``; none if none of them does."""
    for k in range(1, HALVINGS + 1):
        nearer = _scaled(amplitudes, start, 0.5**k)
        if cost(nearer) < least:
            return [nearer]
    return []


def _scaled(amplitudes: Sequence[Parameter], start: Mapping[str, float], factor: float) -> dict[str, float]:
    return {**start, **{p.name: _inside(p, p.off + factor * (start.get(p.name, p.off) - p.off)) for p in amplitudes}}


def _inside(p: Parameter, value: float) -> float:
    return float(np.clip(value, p.lower, p.upper))
