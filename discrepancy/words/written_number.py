"""Numbers as a model file has them: in the unit that the field uses, with the digits that they are known to.

Read again they are the same to a thousandth of their uncertainty, and to twelve digits where none is known.
"""

import math
from typing import Any

from discrepancy.scales import Scale, largest, of_variable
from fmu_src.units import UnitError, conversion
from fmu_src.variables import Variable

# Digits of a number whose uncertainty nobody states: what is beyond comes from conversions of units.
DIGITS = 12
# Of errors and what else a step tells of the past; nothing is computed from them.
TOLD = 6
# What rounding may take, over half of an interval; a value has four digits at least.
SHARE, LEAST = 1e-3, 4


def rounded(value: float, digits: int = DIGITS) -> float:
    return float(f"{value:.{digits}g}")


def digits_of(value: float, half: float) -> int:
    """As many digits of ``value`` as leave it right to a small part of ``half`` of its interval."""
    if not 0.0 < half < math.inf or not value:
        return DIGITS
    return min(DIGITS, max(LEAST, 1 + math.floor(math.log10(abs(value))) - math.floor(math.log10(SHARE * half))))


def scale_of(size: float, variable: Variable) -> Scale:
    """The field's unit, where a file can be read with it; else the variable's own."""
    unit, scale = variable.unit, of_variable(variable, size)
    try:
        factor, _ = conversion(scale.unit, unit)
    except UnitError:
        return Scale(1.0, unit)
    return scale if math.isclose(factor * scale.factor, 1.0, rel_tol=1e-9) else Scale(1.0, unit)


def written_entry(variable: Variable, entry: dict[str, Any]) -> dict[str, Any]:
    """Value, interval and the other value of an effect's parameter [its SI unit], which stays within its bounds as it is read."""
    numbers: dict[str, float] = {key: float(entry[key]) for key in ("value", "low", "high", "alike") if key in entry}
    half = 0.5 * abs(numbers.get("high", math.nan) - numbers.get("low", math.nan))
    for scale in (scale_of(largest(*numbers.values()), variable), Scale(1.0, variable.unit)):
        back, offset = conversion(scale.unit, variable.unit)
        told = {key: rounded(scale.number(v), digits_of(scale.number(v), abs(scale.factor) * half)) for key, v in numbers.items()}
        if variable.minimum <= back * told["value"] + offset <= variable.maximum:
            return {"value": told.pop("value"), "unit": scale.unit, **told}
    # At a bound that has more digits than it is known to.
    return {**entry, "unit": variable.unit}


def written_setting(variable: Variable, value: float) -> str | float:
    """A number of the reducer: ``"3 um"``."""
    scale = scale_of(abs(value), variable)
    number = rounded(scale.number(value))
    return number if scale.unit == "1" else f"{number:.{DIGITS}g} {scale.unit}"


def told_of(step: Any) -> Any:
    """A step of the ladder, or what it holds, without digits that nobody reads."""
    if isinstance(step, dict):
        return {key: told_of(value) for key, value in step.items() if value is not None}
    if isinstance(step, list | tuple):
        return [told_of(value) for value in step]
    return rounded(step, TOLD) if isinstance(step, float) else step
