"""From where directions round the ring of pins count: what somebody with the reducer in hand looks for."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from discrepancy.counted_from import ZERO, mounting_of

# Directions of effects that are fixed to the ring.
OF_RING = "pin_ring_"


def ring_texts(effects: Sequence[Mapping[str, Any]], values: Mapping[str, float]) -> list[str]:
    """Where direction 0 is, if an effect that is named has one round the ring and a fit (``values``) has found where angles count from."""
    directed = any(name.startswith(OF_RING) and entry.get("direction") for effect in effects for name, entry in effect["parameters"].items())
    zeros = {mounting_of(name): math.degrees(value) for name, value in values.items() if name.startswith(ZERO)}
    if not (directed and zeros):
        return []
    stands = ", ".join(f"{zero:.1f} deg where mounting {mounting} shows angle 0" for mounting, zero in zeros.items())
    return [f"directions round the ring count from its pin 1, the way the output turns; crank 1 stands at {stands} (or whole pitches of the pins from there,"
            " and the direction with it)"]  # fmt: skip
