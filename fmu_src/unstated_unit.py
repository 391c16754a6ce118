"""Numbers that a user gave without a unit, which are SI: where such a number cannot be meant, it is said which unit was."""

from fmu_src.display import display_unit
from fmu_src.limits import DOUBTFUL
from fmu_src.units import conversion
from fmu_src.variables import ValueFault, Variable


def check_given(variable: Variable, value: float, has_unit: bool, element: str | None = None) -> None:
    """``Variable.check`` of what a user gave, converted; without a unit also that a reducer can have it, with the usual unit where that makes it one."""
    if has_unit:
        variable.check(value, element)
        return
    name = element or variable.path
    fault, usual = fault_of(variable, value, name), display_unit(variable)
    if not fault:
        return
    if usual:
        factor, offset = conversion(usual, variable.unit)
        if not fault_of(variable, factor * value + offset, name):
            fault = (
                f"{name} = {value:g} is {value:g} {variable.unit}, since no unit was given; did you mean {value:g} {usual}?"
                f" write {name}={value:g}{usual}, in files and in Python {name} = \"{value:g} {usual}\" ({fault.partition(': ')[2]})"
            )
    raise ValueFault(fault)


def fault_of(variable: Variable, value: float, name: str) -> str:
    """Why the variable cannot have such a value, or is hardly meant to; empty if nothing speaks against it."""
    try:
        variable.check(value, name)
    except ValueFault as fault:
        return str(fault)
    most = DOUBTFUL.get(variable.unit)
    if most is None or variable.is_integer or abs(value) < most:
        return ""
    unit = variable.unit
    return f"{name} = {value:g} {unit} is more than any reducer has: if {value:g} {unit} are meant, write {name}={value:g}{unit}"
