"""One number of a reducer file: its value in the unit of the variable that it is for, and the range in which it is held to lie."""

import re

from pydantic import Field

from fmu_src.faults import InputFault, nearest
from fmu_src.names import found_by_name, settable_names
from fmu_src.strict_file import Strict
from fmu_src.table import Table
from fmu_src.units import UnitError, conversion
from fmu_src.variables import SETTABLE, ValueFault

# What an assumed number may be off by where its file gives no range, as a share of it (assumed).
USUAL_RANGE = 0.1


class Entry(Strict):
    """One number of a reducer file."""

    value: float | str
    unit: str
    source: str = Field(min_length=1)
    range: tuple[float, float] | None = None


def si_value(tables: tuple[Table, ...], section: str, key: str, entry: Entry, place: str) -> tuple[str, float]:
    """What kernels call the variable, and the entry in its unit, checked against the tables that have it."""
    path = f"{section}.{key}"
    # Up to version 0.2 keys alone were names, and sections only grouped them; some names belong to no group.
    found = found_by_name(tables, path, place, SETTABLE) or found_by_name(tables, key, place, SETTABLE)
    if not found:
        names, old = settable_names(tables)
        hint = nearest(path, names, 1) or nearest(key, names, 1, old) or "; see docs/variables.md for the names"
        raise InputFault(f"{place} is not a parameter of plant or wear unit{hint}")
    variable = found[0][1]
    if variable.choices:
        if entry.value not in variable.choices:
            raise InputFault(f"{place} = {entry.value!r}: choose one of {', '.join(variable.choices)}")
        return variable.name, variable.choices.index(entry.value)
    if isinstance(entry.value, str):
        number = entry.value.strip().replace(",", ".", 1)
        if "," in entry.value and re.fullmatch(r"[+-]?\d+\.\d+", number):
            raise InputFault(f"{place} = {entry.value!r}: write {number}, with a point and without quotes")
        raise InputFault(f"{place} = {entry.value!r} is not a number; write one without quotes, in {entry.unit}")
    try:
        factor, offset = conversion(entry.unit, variable.unit)
        value = factor * entry.value + offset
        for _, owned in found:
            owned.check(value)
    except UnitError as problem:
        raise InputFault(f"{place} = {entry.value:g} {entry.unit}: {problem}") from None
    except ValueFault as problem:
        raise InputFault(f"{place} = {entry.value:g} {entry.unit}: {problem}") from None
    return variable.name, value


def in_unit(entry: Entry, before: str = "") -> str:
    """The unit behind a number; none where it has none."""
    return "" if entry.unit == "1" else f"{before} {entry.unit}"


def range_of(tables: tuple[Table, ...], section: str, key: str, entry: Entry, place: str) -> tuple[float, float] | None:
    """(lowest, highest) that the number may be, SI; None where nothing says that it may be another."""
    if isinstance(entry.value, str):
        if entry.range is not None:
            raise InputFault(f"{place}: range = {list(entry.range)}: a choice has no range; leave it out")
        return None
    if entry.range is None:
        half = USUAL_RANGE * abs(entry.value) if entry.source.startswith("assumed") else 0.0
        limits = (entry.value - half, entry.value + half)
    else:
        limits = entry.range
    if not limits[0] <= entry.value <= limits[1]:
        told = f"value = {entry.value:g}{in_unit(entry)} lies outside; give [lowest, highest]{in_unit(entry, ' in')}"
        raise InputFault(f"{place}: range = {list(limits)}: {told}")
    if limits[0] == limits[1]:
        return None
    low, high = (si_value(tables, section, key, entry.model_copy(update={"value": limit}), f"{place}: range")[1] for limit in limits)
    return low, high
