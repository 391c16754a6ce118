"""Directions of effects half a turn on, which many signals show alike."""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from discrepancy.problem import Candidate, Parameter

# What places on a grid, written with four decimals, may be off even steps of a turn, of a period.
EVEN = 0.01


def half_a_turn_on(candidates: Sequence[Candidate], values: Mapping[str, float]) -> Iterator[tuple[Parameter, float]]:
    """Directions [rad] of effects half a turn from where ``values`` have them, where that is another one: an oval is not."""
    for candidate in candidates:
        for p in candidate.shapes:
            if p.is_direction and (again := period(candidate, p)) and abs(further := math.remainder(math.pi, again)) > EVEN * again:
                yield p, math.remainder(values[p.name] + abs(further), 2.0 * math.pi)


def period(candidate: Candidate, shape: Parameter) -> float | None:
    """The angle [rad] after which a direction is the same again, which is looked through in even steps: a turn, half of it for an oval; None of an angle
    that is no such direction (a width, a phase of several waves)."""
    places = sorted({grid[shape.name] for grid in candidate.shape_grid})
    steps = [high - low for low, high in pairwise(places)]
    if not steps or max(steps) - min(steps) > EVEN * max(steps):
        return None
    again = len(places) * steps[0]
    waves = round(2.0 * math.pi / again)
    return 2.0 * math.pi / waves if abs(waves * again - 2.0 * math.pi) < EVEN * again else None
