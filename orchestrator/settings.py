"""Settings ``name=value`` that a user gives for a run, with or without a unit.

``output.load_torque=200``, ``bearing.clearance=10um``, ``errors.pin.radius[3]=2um``,
``contact.law=palmgren``: any parameter or input of plant or wear unit.
"""

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy.typing as npt

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault, nearest
from fmu_src.names import found_by_name, settable_names
from fmu_src.reading import quoted
from fmu_src.source_hash import own_effects_hint
from fmu_src.table import Table
from fmu_src.units import UnitError, conversion
from fmu_src.unstated_unit import check_given
from fmu_src.variables import SETTABLE, ValueFault, Variable
from orchestrator.component import Component, InProcess, Signal

# Signs of a setting (assumed: names and units have a fraction of it).
LONGEST = 500
NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[+-]?inf|nan)\s*(.*?)\s*$", re.IGNORECASE)
# A decimal comma, or a thousands sign.
COMMA = re.compile(r"\s*([+-]?\d+),(\d+)(.*?)\s*$")


@dataclass(frozen=True)
class Setting:
    """One checked setting; ``name`` is what kernels call the variable, ``value`` is in its own unit."""

    name: str
    value: float | int


@dataclass(frozen=True)
class ArraySetting:
    """A value for each element of an array, in its shape."""

    name: str
    value: Floats


def parse_setting(text: str, tables: list[Table]) -> Setting:
    """Read ``name=value``; InputFault names what is wrong."""
    name, equals, value = text.partition("=")
    name = name.strip()
    if len(text) > LONGEST:
        raise InputFault(f"setting {quoted(text)}: longer than {LONGEST} signs; write name=value, for instance load_torque=200")
    if not equals:
        raise InputFault(f"setting {text!r}: write name=value, for instance output.load_torque=200")
    owners = found_by_name(tables, name, "setting", SETTABLE)
    if not owners:
        names, old = settable_names(tables)
        own = own_effects_hint() if name.startswith("effects.") else ""
        raise InputFault(f"setting {text!r}: there is no parameter or input {name!r}{nearest(name, names, old=old)}{own}")
    _, bracket, rest = name.partition("[")
    for owner, variable in owners:
        element = variable.path + bracket + rest
        if bracket:
            try:
                owner.cell_index(element)
            except KeyError as problem:
                raise InputFault(f"setting {text!r}: {problem.args[0]}") from None
        try:
            number = parse_value(value.strip(), variable)
            check_given(variable, number, has_unit(value), element)
        except (UnitError, ValueFault, InputFault) as problem:
            raise InputFault(f"setting {text!r}: {problem}") from None
    return Setting(owners[0][1].name + bracket + rest, number)


def parse_value(text: str, variable: Variable | Signal) -> float | int:
    """A number with an optional unit, or a choice's name, in the variable's unit."""
    if variable.choices:
        if text not in variable.choices:
            raise InputFault(f"{variable_name(variable)} takes one of: {', '.join(variable.choices)}")
        return variable.choices.index(text)
    require_point(text)
    match = NUMBER.match(text)
    if not match:
        raise InputFault(f"{text!r} is not a number with a unit; {variable_name(variable)} is in {variable.unit}")
    number, unit = float(match[1]), match[2]
    if unit:
        factor, offset = conversion(unit, variable.unit)
        number = factor * number + offset
    if variable.is_integer:
        if number != int(number):
            raise InputFault(f"{variable_name(variable)} = {text} must be a whole number")
        return int(number)
    return number


def has_unit(text: str) -> bool:
    """Whether something stands behind the number."""
    match = NUMBER.match(text)
    return bool(match and match[2])


def require_point(text: str) -> None:
    """InputFault for a number with a comma in it, with what is to be written."""
    if found := COMMA.match(text):
        whole, rest, unit = found.groups()
        meant = f"{whole}.{rest}{unit}" if len(rest) != 3 else f"{whole}{rest}{unit}, or {whole}.{rest}{unit}"
        raise InputFault(f"{text.strip()!r} has a comma in its number; write {meant}")


def set_given(component: Component, name: str, value: npt.ArrayLike) -> None:
    """Set what a file or a caller says: a number is in the variable's unit, a text carries its own."""
    signal = component.signal(name)
    number = parse_value(value, signal) if isinstance(value, str) else value
    # Of FMUs nothing says in which unit people read a variable.
    if isinstance(component, InProcess) and isinstance(number, int | float):
        variable = component.table.element_at(signal.references[0])[0]
        try:
            check_given(variable, number, isinstance(value, str) and has_unit(value), name)
        except ValueFault as fault:
            raise InputFault(f"{component.name}: {fault}") from None
    component.set(name, number)


def variable_name(variable: Variable | Signal) -> str:
    return variable.path if isinstance(variable, Variable) else variable.name


def apply(settings: Iterable[Setting | ArraySetting], components: Mapping[str, Component]) -> None:
    """Set each on every component that has it."""
    for setting in settings:
        for component in components.values():
            if component.has(setting.name) and component.signal(setting.name).causality in SETTABLE:
                component.set(setting.name, setting.value)
