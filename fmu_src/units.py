"""Units: read from text, converted, decomposed for FMI.  All by pint."""

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from fmu_src.cache_folder import cache_folder

if TYPE_CHECKING:
    import pint

# FMI's base units and pint's names for them, in the order of the FMI schema.
FMI_BASE = {
    "kg": "kilogram", "m": "meter", "s": "second", "A": "ampere", "K": "kelvin",
    "mol": "mole", "cd": "candela", "rad": "radian",
}


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


@cache
def registry() -> "pint.UnitRegistry[float]":
    """pint's units; half a second of reading, for those only who need them."""
    import pint

    return pint.UnitRegistry(cache_folder=cache_folder("units"))


@cache
def parse(text: str) -> "pint.Unit":
    """A unit such as ``N.m``, ``1/Pa``, ``um``, ``rpm`` or ``1``."""
    try:
        unit = registry().parse_units("" if text == "1" else text.replace(".", "*").replace("1/", "1 / "))
    except Exception as problem:  # noqa: BLE001
        raise UnitError(f"unit {text!r} is not known ({problem}); write it like mm, N.m, 1/Pa, rad/s, or 1") from None
    return unit


@cache
def conversion(source: str, target: str) -> tuple[float, float]:
    """(factor, offset) with target value = factor * source value + offset."""
    from pint import DimensionalityError

    try:
        zero = registry().Quantity(0.0, parse(source)).to(parse(target)).magnitude
        one = registry().Quantity(1.0, parse(source)).to(parse(target)).magnitude
    except DimensionalityError:
        raise UnitError(f"unit {source!r} does not fit: a unit of the same kind as {target!r} is needed") from None
    return one - zero, zero


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
