"""What a form of the page gives: texts that become numbers, and a model whose settings go into commands."""

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from discrepancy.campaign.amount import amount
from discrepancy.campaign.guess.name_units import is_turns
from fmu_src.faults import InputFault
from orchestrator.settings import NUMBER

if TYPE_CHECKING:
    from discrepancy.model_file import ModelFile
    from fmu_src.table import Table

# In which speeds are typed.
SPEED = "rpm"


def number(value: Any, what: str) -> float:
    """With a point or a comma; InputFault for ``what`` that is none, or is not finite."""
    try:
        found = float(str(value).strip().replace(",", "."))
    except ValueError:
        raise InputFault(f"{what}: {value!r} is no number") from None
    if not math.isfinite(found):
        raise InputFault(f"{what}: a finite number is needed")
    return found


def in_unit(value: Any, unit: str, what: str) -> float:
    """A number in ``unit``, alone or with a unit of its own as options of commands take it: 784, 0.784kNm."""
    text = str(value).strip().replace(",", ".")
    text = with_minute(text) if unit == SPEED else text
    found = NUMBER.match(text)
    return amount(text, unit or "1", what) if found and found[2] else number(value, what)


def with_minute(text: str) -> str:
    """What stands in the field of a speed, turns as those a minute: 750 giri, as names of files say it."""
    found = NUMBER.match(text.strip())
    return f"{found[1]} {SPEED}" if found and found[2] and is_turns(found[2]) else text


def whole(value: Any, what: str) -> int:
    found = number(value, what)
    if found != int(found):
        raise InputFault(f"{what}: {value!r} is no whole number")
    return int(found)


def factor(value: Any, what: str) -> float:
    """What a column is multiplied by: a number, or a fraction such as 1/3437.75."""
    above, _, below = str(value).partition("/")
    divisor = number(below, what) if below else 1.0
    if divisor == 0.0:
        raise InputFault(f"{what}: {value!r} divides by nothing")
    found = number(above, what) / divisor
    if found == 0.0:
        raise InputFault(f"{what}: a number other than 0 is needed")
    return found


def exactly(value: float) -> str:
    """As a command takes it, with all its digits."""
    return f"{value:.15g}"


def settings_of(file: "ModelFile") -> list[str]:
    """Settings and effects of a model as ``name=value``; those of the measuring chain, which no life has, are left out."""
    tables = [file.reducer.plant, file.reducer.wear]
    return [f"{name}={value!r}" for kernel_name, value in file.values().items() if (name := written(tables, kernel_name))]


def written(tables: "Sequence[Table]", name: str) -> str:
    """What a setting calls the variable (or its element); empty for one of the measuring chain."""
    base, bracket, rest = name.partition("[")
    variable = next((t.by_name[base] for t in tables if base in t.by_name), None)
    return variable.path + bracket + rest if variable else ""
