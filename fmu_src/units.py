"""Units: read from text, converted, decomposed for FMI.  All by pint."""

import base64
import json
import math
import tempfile
import threading
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fmu_src import checked_file
from fmu_src.cache_folder import cache_folder
from fmu_src.faults import nearest
from fmu_src.unit_words import KNOWN, plain

if TYPE_CHECKING:
    import pint

# FMI's base units and pint's names for them, in the order of the FMI schema.
FMI_BASE = {
    "kg": "kilogram", "m": "meter", "s": "second", "A": "ampere", "K": "kelvin",
    "mol": "mole", "cd": "candela", "rad": "radian",
}

# What people write for a torque (kgf.m) is the model's own unit of an unbalance.
OWN = ("kg.m",)

# What pint made of its definitions: the files of its own cache in one that is checked.
MARK = b"rvwear units 1\n"

# Held while the registry is read, once in a process.
READING = threading.Lock()


class UnitError(ValueError):
    """A unit that cannot be read or does not fit."""


@dataclass(frozen=True)
class BaseUnit:
    """FMI's and SSP's definition of a unit: SI value = factor * value + offset."""

    exponents: tuple[int, ...]
    factor: float = 1.0
    offset: float = 0.0

    def conversion(self, target: "BaseUnit") -> tuple[float, float] | None:
        """(factor, offset) to another unit; None if that is of another kind."""
        if self.exponents != target.exponents:
            return None
        return self.factor / target.factor, (self.offset - target.offset) / target.factor


def registry() -> "pint.UnitRegistry[float]":
    """pint's units; half a second of reading, for those only who need them.

    One for all threads: units of two registries cannot be held against each other.
    """
    with READING:
        return read_registry()


@cache
def read_registry() -> "pint.UnitRegistry[float]":
    """pint loads whatever lies in its cache: it is given a folder of its own, with what an earlier run kept there and is whole."""
    import pint

    place = cache_folder("units") / pint.__version__
    kept: dict[str, str] = json.loads(checked_file.read(place, MARK) or "{}")
    with tempfile.TemporaryDirectory(prefix="rvwear-units-") as name:
        folder = Path(name)
        for file, content in kept.items():
            (folder / file).write_bytes(base64.b64decode(content))
        made: pint.UnitRegistry[Any] = pint.UnitRegistry(cache_folder=folder)
        files = {path.name: path for path in folder.iterdir()}
        if files.keys() != kept.keys():
            text = json.dumps({file: base64.b64encode(path.read_bytes()).decode() for file, path in sorted(files.items())})
            checked_file.write(place, MARK, text.encode())
    return made


@cache
def parse(text: str) -> "pint.Unit":
    """A unit such as ``N.m``, ``1/Pa``, ``um``, ``rpm`` or ``1``, or as people write it: ``in-lbf``, ``U/min``."""
    try:
        return by_pint(text if text in OWN else written(text))
    except UnitError:
        return by_pint(text)


def written(text: str) -> str:
    """What people write, in the words of pint; parts of a quotient each for itself."""
    if known := KNOWN.get(plain(text)):
        return known[0]
    above, stroke, below = text.partition("/")
    if not stroke:
        return text
    over, under = (part_known[0] if (part_known := KNOWN.get(plain(part))) else part for part in (above, below))
    # A product below the stroke is below as a whole: um/Nm.
    return f"{over}/({under})" if under != below and "." in under else f"{over}/{under}"


def all_below(text: str) -> str:
    """A quotient with a product behind its stroke in brackets: um/N.m as um/(N.m); other texts as they are."""
    above, stroke, below = plain(text).partition("/")
    return f"{above}/({below})" if stroke and "." in below and "/" not in below and "(" not in below else text


@cache
def by_pint(text: str) -> "pint.Unit":
    """UnitError without pint's own words, which speak of its inside."""
    try:
        return registry().parse_units("" if text == "1" else text.replace(".", "*").replace("1/", "1 / "))
    except Exception:  # noqa: BLE001
        raise UnitError(f"unit {text!r} is not known; write it like mm, N.m, in-lbf, 1/Pa, rad/s, or 1{nearest(text, KNOWN)}") from None


@cache
def conversion(source: str, target: str) -> tuple[float, float]:
    """(factor, offset) with target value = factor * source value + offset.

    What people write for several units is the one of the target's kind: C is a temperature, but for an electric charge.
    Of um/N.m all behind the stroke is below it where that fits alone.
    A frequency counts turns: 25 Hz of a shaft are 1500 rpm (to pint, which has radians as numbers, 25 rad/s).
    """
    from pint import DimensionalityError

    aim = parse(target)
    ways = [parse(source)]
    for text in (source, written(source), all_below(source)):
        with suppress(UnitError):
            ways.append(by_pint(text))
    for unit in ways:
        try:
            zero = registry().Quantity(0.0, unit).to(aim).magnitude
            one = registry().Quantity(1.0, unit).to(aim).magnitude
        except DimensionalityError:
            continue
        turns = 2.0 * math.pi if is_speed(aim) and is_frequency(unit) else 0.5 / math.pi if is_speed(unit) and is_frequency(aim) else 1.0
        return turns * (one - zero), zero
    raise UnitError(f"unit {source!r} does not fit: a unit of the same kind as {target!r} is needed")


def is_frequency(unit: "pint.Unit") -> bool:
    """Hz, kHz; not 1/s, which people write of both."""
    return [name.endswith("hertz") for name, _ in registry().Quantity(1.0, unit).unit_items()] == [True]


def is_speed(unit: "pint.Unit") -> bool:
    """Angle over time: rad/s, rpm, deg/s, turn/s."""
    return bool(registry().Quantity(1.0, unit).to_base_units().units == registry().parse_units("rad/s"))


@cache
def fmi_base_unit(text: str) -> dict[str, float]:
    """Exponents, factor and offset of FMI's ``BaseUnit`` element, defaults left out."""
    base = registry().Quantity(1.0, parse(text)).to_base_units()
    offset = float(registry().Quantity(0.0, parse(text)).to_base_units().magnitude)
    # Whole numbers, which pint's types do not say.
    exponents: dict[str, Any] = dict(base.unit_items())
    attributes: dict[str, float] = {
        fmi_name: int(exponents[pint_name]) for fmi_name, pint_name in FMI_BASE.items() if pint_name in exponents
    }
    factor = float(base.magnitude) - offset
    if factor != 1.0:
        attributes["factor"] = factor
    if offset != 0.0:
        attributes["offset"] = offset
    return attributes
