"""Directions of effects half a turn on, which many signals show alike."""

import math
from collections.abc import Iterator, Mapping, Sequence

from discrepancy.problem import Candidate, Parameter


def half_a_turn_on(candidates: Sequence[Candidate], values: Mapping[str, float]) -> Iterator[tuple[Parameter, float]]:
    """Directions [rad] of effects half a turn from where ``values`` have them, where that is another one: an oval is not."""
    for candidate in candidates:
        for p in candidate.shapes:
            if p.is_direction and (further := math.remainder(math.pi, period(candidate, p))):
                yield p, math.remainder(values[p.name] + abs(further), 2.0 * math.pi)


def period(candidate: Candidate, shape: Parameter) -> float:
    """The angle [rad] after which a direction is the same again, which is looked through in even steps: a turn, half of it for an oval."""
    places = sorted({grid[shape.name] for grid in candidate.shape_grid})
    whole = 2.0 * math.pi / len(places) / (places[1] - places[0]) if len(places) > 1 else 1.0
    return 2.0 * math.pi / round(whole)
