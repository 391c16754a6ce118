"""Parameter values (SSV) and their mapping to names of the system (SSM)."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from lxml import etree

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from fmu_src.units import BaseUnit, UnitError, conversion
from orchestrator.component import Component, Signal
from orchestrator.ssp.xml import child, children, file_at, local, number, parse, units_of


@dataclass(frozen=True)
class Parameter:
    """One value; ``kind`` is Real, Integer, Boolean, Enumeration or String."""

    name: str
    kind: str
    text: str
    unit: str | None = None
    base_unit: BaseUnit | None = None
    factor: float = 1.0
    offset: float = 0.0


def read_bindings(element: etree._Element, folder: Path) -> list[Parameter]:
    """All values bound at a component or system, with prefix and mapping applied."""
    return [p for binding in children(element, "ParameterBindings", "ParameterBinding") for p in read_binding(binding, folder)]


def read_binding(binding: etree._Element, folder: Path) -> list[Parameter]:
    source = binding.get("source")
    root = parse(file_at(folder, source, "ParameterBinding")) if source else child(binding, "ParameterValues", "ParameterSet")
    if root is None:
        raise InputFault("ParameterBinding: neither a source nor values")
    found = values_in(root, binding.get("prefix", ""))
    mapping = child(binding, "ParameterMapping")
    return found if mapping is None else mapped(found, mapping, folder)


def values_in(root: etree._Element, prefix: str = "") -> list[Parameter]:
    """The values of a parameter set (SSV)."""
    units = units_of(root)
    found = []
    for element in children(root, "Parameters", "Parameter"):
        value, name = next((e for e in element if local(e)), None), element.get("name", "")
        if not name:
            raise InputFault("a parameter without a name")
        text = None if value is None else value.get("value")
        if value is not None and not text and local(value) == "Enumeration":
            text = value.get("name")
        if value is None or text is None:
            raise InputFault(f"parameter {name}: no value")
        # Some tools write units in brackets.
        unit = value.get("unit", "").strip("[]") or None
        found.append(Parameter(
            prefix + name, local(value), text, unit, units.get(value.get("unit", "")),
        ))  # fmt: skip
    return found


def mapped(parameters: list[Parameter], mapping: etree._Element, folder: Path) -> list[Parameter]:
    """Those that the mapping names, under their new names."""
    source = mapping.get("source")
    root = parse(file_at(folder, source, "ParameterMapping")) if source else child(mapping, "ParameterMapping")
    by_name = {p.name: p for p in parameters}
    result = []
    for entry in children(root, "MappingEntry"):
        parameter, target = by_name.get(entry.get("source", "")), entry.get("target")
        if parameter is None:
            # Tools write mappings of all that could be set, whether there is a value or not.
            continue
        if not target:
            raise InputFault(f"parameter mapping: {parameter.name!r} has no target")
        linear = child(entry, "LinearTransformation")
        if linear is not None:
            parameter = replace(parameter, factor=number(linear, "factor", 1.0), offset=number(linear, "offset", 0.0))
        result.append(replace(parameter, name=target))
    return result


def apply(parameter: Parameter, component: Component, variable: str) -> None:
    """Set the variable, in its own unit."""
    if parameter.kind == "String":
        component.set_text(variable, parameter.text)
        return
    signal = component.as_written(variable)
    try:
        component.set(variable, value_of(parameter, signal))
    except (ValueError, UnitError) as problem:
        raise InputFault(f"parameter {component.name}.{variable} = {parameter.text!r}: {problem}") from None


def value_of(parameter: Parameter, signal: Signal) -> float | int | bool | Floats:
    text = parameter.text.strip()
    if signal.shape:
        # Row by row; one value is for all elements.
        texts = text.split()
        if len(texts) not in (1, len(signal.references)):
            raise ValueError(f"{len(texts)} values, but {signal.name} has {len(signal.references)}")
        single = replace(signal, shape=())
        values = np.array([value_of(replace(parameter, text=one), single) for one in texts])
        return np.broadcast_to(values, len(signal.references)).reshape(signal.shape)
    if parameter.kind == "Boolean":
        return text in ("true", "1")
    if parameter.kind == "Enumeration" and text in signal.choices:
        return signal.choices.index(text)
    if signal.is_integer:
        return int(text)
    factor, offset = unit_conversion(parameter, signal)
    return parameter.factor * (factor * float(text) + offset) + parameter.offset


def unit_conversion(parameter: Parameter, signal: Signal) -> tuple[float, float]:
    if parameter.unit is None or parameter.unit == signal.unit or not signal.unit_given:
        return 1.0, 0.0
    if parameter.base_unit is not None and signal.base_unit is not None:
        found = parameter.base_unit.conversion(signal.base_unit)
        if found is None:
            raise UnitError(f"unit {parameter.unit!r} does not fit {signal.unit!r}")
        return found
    return conversion(parameter.unit, signal.unit)
