"""From where directions and pins round the ring count: what somebody with the reducer in hand looks for."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from discrepancy.counted_from import ZERO, mounting_of
from discrepancy.model_file import ModelFile
from discrepancy.prediction.candidates import PIN_NUMBERS
from rv_plant.topology import Topology

# Directions of effects that are fixed to the ring, and numbers of a pin.
OF_RING = "pin_ring_"


def ring_texts(effects: Sequence[Mapping[str, Any]], values: Mapping[str, float], file: ModelFile) -> list[str]:
    """Where direction 0 and pin 1 are, if an effect that is named has one round the ring and a fit (``values``) has found where angles count from; which
    pins show the same."""
    parameters = {name: entry for effect in effects for name, entry in effect["parameters"].items()}
    directed = any(name.startswith(OF_RING) and entry.get("direction") for name, entry in parameters.items())
    numbers = [entry["value"] for name, entry in parameters.items() if name in PIN_NUMBERS]
    told = [alike_text(round(number), file.reducer.topology) for number in numbers]
    zeros = {mounting_of(name): math.degrees(value) for name, value in values.items() if name.startswith(ZERO)}
    if zeros and (directed or numbers):
        what = " and ".join(word for word, there in (("directions", directed), ("pins", numbers)) if there)
        stands = ", ".join(f"{zero:.1f} deg where mounting {mounting} shows angle 0" for mounting, zero in zeros.items())
        told.append(f"{what} round the ring count from its pin 1, the way the output turns; crank 1 stands at {stands} (or whole pitches of the pins from"
                    f" there, and {'the direction' if directed else 'the pin'} with it)")  # fmt: skip
    return [text for text in told if text]


def alike_text(pin: int, t: Topology) -> str:
    """The pins that show the same as this one: those onto which it comes as the reducer is turned onto itself."""
    others = sorted((pin - 1 + k * t.pins // t.ways) % t.pins + 1 for k in range(1, t.ways))
    first = (pin - 1) % t.pins + 1
    return f"pin {first} shows the same as pin {' and pin '.join(map(str, others))}: turned there, the reducer looks as it does" if others else ""
