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


def seen_from_crank(effects: Sequence[Mapping[str, Any]], values: Mapping[str, float]) -> list[dict[str, Any]]:
    """The effects, each direction round the ring told from crank 1 at the encoder's zero besides: pin 1 is known to whole pitches of the pins only, this is
    what can be carried to the part."""
    zeros = zeros_in(values)

    def told(name: str, entry: Mapping[str, Any]) -> dict[str, Any]:
        if not zeros or not name.startswith(OF_RING) or not entry.get("direction"):
            return dict(entry)
        at = math.degrees(entry["value"])
        seen = ", ".join(f"{at - zero:.2f} deg from crank 1 where mounting {mounting} shows angle 0" for mounting, zero in zeros.items())
        meaning = f"{entry['meaning']}, " if entry.get("meaning") else ""
        return {**entry, "meaning": f"{meaning}from pin 1, which whole pitches of the pins leave open; that is {seen}, which can be carried to the part"}

    return [{**effect, "parameters": {name: told(name, entry) for name, entry in effect["parameters"].items()}} for effect in effects]


def zeros_in(values: Mapping[str, float]) -> dict[str, float]:
    """By mounting where crank 1 stands at angle 0 [deg]."""
    return {mounting_of(name): math.degrees(value) for name, value in values.items() if name.startswith(ZERO)}


def ring_texts(effects: Sequence[Mapping[str, Any]], values: Mapping[str, float], file: ModelFile) -> list[str]:
    """Where direction 0 and pin 1 are, if an effect that is named has one round the ring and a fit (``values``) has found where angles count from; which
    pins show the same."""
    parameters = {name: entry for effect in effects for name, entry in effect["parameters"].items()}
    directed = any(name.startswith(OF_RING) and entry.get("direction") for name, entry in parameters.items())
    numbers = [entry["value"] for name, entry in parameters.items() if name in PIN_NUMBERS]
    told = [alike_text(round(number), file.reducer.topology) for number in numbers]
    zeros = zeros_in(values)
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
