"""Numbers with units as a campaign file states them."""

from typing import TypeGuard

from fmu_src.faults import InputFault
from fmu_src.units import UnitError, conversion
from orchestrator.settings import NUMBER, require_point


def to_si(unit: str, target: str, place: str) -> tuple[float, float]:
    """(factor, offset) from the stated unit, as benches write it, to ``target``."""
    try:
        return conversion(unit.strip(), target)
    except UnitError as problem:
        raise InputFault(f"{place}: {problem}") from None


def split(given: object, target: str, place: str) -> tuple[float, str]:
    """Number and unit of ``"15 rpm"`` or ``{ value = 15, unit = "rpm" }``."""
    if isinstance(given, dict) and given.keys() == {"value", "unit"} and is_number(given["value"]):
        return float(given["value"]), str(given["unit"])
    if target == "1" and is_number(given):
        return float(given), "1"
    if isinstance(given, str):
        try:
            require_point(given)
        except InputFault as fault:
            raise InputFault(f"{place}: {fault}") from None
    match = NUMBER.match(given) if isinstance(given, str) else None
    if match and (match[2] or target == "1"):
        return float(match[1]), match[2] or "1"
    raise InputFault(
        f'{place} = {given!r} is not a number with a unit: write "15 {target}" or {{ value = 15, unit = "{target}" }},'
        f" in any unit of the kind of {target}"
    )


def is_number(value: object) -> TypeGuard[int | float]:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def amount(given: object, target: str, place: str) -> float:
    """The stated number in the unit ``target``; finite."""
    number, unit = split(given, target, place)
    factor, offset = to_si(unit, target, f"{place} = {number:g} {unit}")
    value = factor * number + offset
    if not abs(value) < float("inf"):
        raise InputFault(f"{place} = {given!r}: not a finite number in {target}; give one")
    return value


def readable(value: float, digits: int = 3) -> str:
    """So many digits that mean something, and no exponent for numbers that people write without one."""
    return f"{value:.0f}" if 10.0 ** (digits - 1) <= abs(value) < 1e7 else f"{value:.{digits}g}"
