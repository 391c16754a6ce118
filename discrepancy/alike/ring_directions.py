"""From where directions and pins round the ring count: what somebody with the reducer in hand looks for."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from discrepancy.alike.opposite_sign import OTHER_WAY
from discrepancy.counted_from import ZERO, mounting_of
from discrepancy.model_file import ModelFile
from discrepancy.prediction.candidates import PIN_NUMBERS
from discrepancy.words.as_told import tables_of, told_name
from rv_plant.topology import Topology

# Directions of effects that are fixed to the ring, and numbers of a pin.
OF_RING = "pin_ring_"
# Why it stays open at which of two places an error is.
BY_SYMMETRY = (
    "no run of the reducer as a whole tells which of the two it is, for turned by half a turn it looks as it does; measure the ring itself at these places"
)
THESE_RUNS = "the runs that were fitted do not tell which of the two it is"


def seen_from_crank(effects: Sequence[Mapping[str, Any]], values: Mapping[str, float], file: ModelFile) -> list[dict[str, Any]]:
    """The effects, each direction with all places where it may be: ``alike`` is one that shows the same, and round the ring pin 1 may be any of its pins,
    so that what can be carried to the part counts from crank 1 at the encoder's zero."""

    def told(name: str, entry: Mapping[str, Any]) -> dict[str, Any]:
        places = places_text(name, entry, zeros_in(values), file)
        return {**entry, "meaning": "; ".join(filter(None, (entry.get("meaning"), places)))} if places else dict(entry)

    return [{**effect, "parameters": {name: told(name, entry) for name, entry in effect["parameters"].items()}} for effect in effects]


def places_text(name: str, entry: Mapping[str, Any], zeros: Mapping[str, float], file: ModelFile) -> str:
    """``it is in one of 2 places, which show the same: 10.61 or 70.61 deg from crank 1 where mounting 1 shows angle 0, the way the output turns; ...``; empty
    where the number alone says where it is, or is no direction."""
    if not entry.get("direction"):
        return ""
    places = [math.degrees(entry[key]) for key in ("value", "alike") if key in entry]
    start = f"it is in one of {len(places)} places, which show the same: " if len(places) > 1 else ""
    if zeros and name.startswith(OF_RING):
        seen = ", ".join(f"{angles_text(places, zero)} from crank 1 where mounting {mounting} shows angle 0" for mounting, zero in zeros.items())
        pins = file.reducer.topology.pins
        return f"{start}{seen}, the way the output turns; that is {angles_text(places)} from pin 1, and any of the {pins} pins may be pin 1"
    return f"{start}{angles_text(places)}" if start else ""


def angles_text(places: Sequence[float], zero: float = 0.0) -> str:
    """``10.61 or 70.61 deg``, counted from ``zero`` [deg]."""
    return f"{' or '.join(f'{place - zero:.2f}' for place in places)} deg"


def either_texts(effects: Sequence[Mapping[str, Any]], values: Mapping[str, float], file: ModelFile, more: bool) -> list[str]:
    """Of effects of which a value and another one, ``alike``, show the same: that it is open which, and whether any run can tell; ``more`` if others act
    beside them, which may tell."""
    texts = []
    for effect in effects:
        for name, entry in effect["parameters"].items():
            if "alike" not in entry or not entry.get("direction"):
                continue
            places = places_text(name, entry, zeros_in(values), file)
            why = BY_SYMMETRY if by_symmetry(name, file.reducer.topology, more) else THESE_RUNS
            texts.append(f"{told_name(name, tables_of(file))}: {places}; {why}")
        if any("alike" in entry and not entry.get("direction") for entry in effect["parameters"].values()):
            texts.append(f"{effect['candidates'][0]}: {OTHER_WAY}")
    return texts


def by_symmetry(name: str, t: Topology, more: bool) -> bool:
    """Whether half a turn on of an error of the ring is the same reducer, turned by half a turn."""
    return name.startswith(OF_RING) and t.ways % 2 == 0 and not more


def zeros_in(values: Mapping[str, float]) -> dict[str, float]:
    """By mounting where crank 1 stands at angle 0 [deg]."""
    return {mounting_of(name): math.degrees(value) for name, value in values.items() if name.startswith(ZERO)}


def ring_texts(effects: Sequence[Mapping[str, Any]], values: Mapping[str, float], file: ModelFile) -> list[str]:
    """Where pin 1 is, if an effect that is named is at a pin and a fit (``values``) has found where angles count from; which pins show the same."""
    numbers = [entry["value"] for effect in effects for name, entry in effect["parameters"].items() if name in PIN_NUMBERS]
    told = [alike_text(round(number), file.reducer.topology) for number in numbers]
    zeros = zeros_in(values)
    if zeros and numbers:
        stands = ", ".join(f"{zero:.1f} deg where mounting {mounting} shows angle 0" for mounting, zero in zeros.items())
        told.append(f"pins round the ring count from its pin 1, the way the output turns; crank 1 stands at {stands} (or whole pitches of the pins from there,"
                    " and the pin with it)")  # fmt: skip
    return [text for text in told if text]


def alike_text(pin: int, t: Topology) -> str:
    """The pins that show the same as this one: those onto which it comes as the reducer is turned onto itself."""
    others = sorted((pin - 1 + k * t.pins // t.ways) % t.pins + 1 for k in range(1, t.ways))
    first = (pin - 1) % t.pins + 1
    return f"pin {first} shows the same as pin {' and pin '.join(map(str, others))}: turned there, the reducer looks as it does" if others else ""
