"""From where directions and pins round the ring count: what somebody with the reducer in hand looks for."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from discrepancy.alike.opposite_sign import OTHER_WAY
from discrepancy.counted_from import ZERO, mounting_of
from discrepancy.model_file import ModelFile
from discrepancy.words.as_told import tables_of, told_name
from discrepancy.words.intervals import pins_in
from rv_plant.topology import Topology

# Directions of effects that are fixed to the ring.
OF_RING = "pin_ring_"
# Why it stays open at which of two places an error is.
BY_SYMMETRY = (
    "no run of the reducer as a whole tells which of the two it is, for turned by half a turn it looks as it does; measure the ring itself at these places"
)
# The same of pins, as many as there are ways.
PINS_BY_SYMMETRY = "no run of the reducer as a whole tells which of them it is, for turned from one to the other it looks as it does; measure these pins"
PINS_BY_RUNS = "the runs that were fitted do not tell which of them it is"
THESE_RUNS = "the runs that were fitted do not tell which of the two it is"


def seen_from_crank(effects: Sequence[Mapping[str, Any]], values: Mapping[str, float], file: ModelFile) -> list[dict[str, Any]]:
    """The effects, each direction and each pin with all places where it may be: ``alike`` is one that shows the same, and round the ring pin 1 may be any
    of its pins, so that what can be carried to the part counts from crank 1 at the encoder's zero."""

    def told(name: str, entry: Mapping[str, Any]) -> dict[str, Any]:
        if pins := pins_in(name, entry["value"], file.reducer):
            # Where it is comes first: by what the number means nobody finds the pin.
            where = pins_text(pins["pins"], zeros_in(values), file)
            return {**entry, **pins, "meaning": "; ".join(filter(None, (where, entry.get("meaning"))))}
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


def pins_text(found: Sequence[float], zeros: Mapping[str, float], file: ModelFile) -> str:
    """``it is one of 2 pins, which show the same: 156.3 or 336.3 deg from crank 1 where mounting 1 shows angle 0, the way the output turns; ...``"""
    pins = file.reducer.topology.pins
    places = [360.0 * (pin - 1.0) / pins for pin in found]
    start = f"it is one of {len(found)} pins, which show the same: " if len(found) > 1 else ""
    if not zeros:
        return f"{start}{round_text(places)} from pin 1, the way the output turns"
    seen = ", ".join(f"{round_text(places, zero)} from crank 1 where mounting {mounting} shows angle 0" for mounting, zero in zeros.items())
    return f"{start}{seen}, the way the output turns; the number counts from pin 1, and any of the {pins} pins may be pin 1"


def round_text(places: Sequence[float], zero: float = 0.0) -> str:
    """``156.3 or 336.3 deg``, counted from ``zero`` [deg] on round the ring."""
    return f"{' or '.join(f'{round(place - zero, 1) % 360.0:.1f}' for place in places)} deg"


def angles_text(places: Sequence[float], zero: float = 0.0) -> str:
    """``10.61 or 70.61 deg``, counted from ``zero`` [deg]."""
    return f"{' or '.join(f'{place - zero:.2f}' for place in places)} deg"


def either_texts(effects: Sequence[Mapping[str, Any]], values: Mapping[str, float], file: ModelFile, more: bool) -> list[str]:
    """Of effects of which a value and another one, ``alike``, show the same: that it is open which, and whether any run can tell; ``more`` if others act
    beside them, which may tell."""
    texts = []
    for effect in effects:
        for name, entry in effect["parameters"].items():
            if len(found := pins_in(name, entry["value"], file.reducer).get("pins", ())) > 1:
                where = pins_text(found, zeros_in(values), file)
                texts.append(f"{told_name(name, tables_of(file))}: {where}; {PINS_BY_SYMMETRY if not more else PINS_BY_RUNS}")
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
