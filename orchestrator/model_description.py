"""What an FMU's model description says, as the master needs it: signals, units, feedthrough.

FMI 2 has scalars only: ``force[1,1]`` ... ``force[2,40]`` are joined to one array where
the set is complete and in order.  FMI 3 has arrays; each element gets a number of its own
(``Cells``), because a value reference there names the whole array.
"""

import math
import re
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from fmu_src.arrays import Integers
from fmu_src.faults import InputFault
from fmu_src.reading import shown
from fmu_src.units import BaseUnit
from orchestrator.component import Element, Signal

if TYPE_CHECKING:
    from fmpy.model_description import ModelDescription, ModelVariable

EXPONENTS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")
REALS = ("Real", "Float64", "Float32")
INTEGERS = ("Integer", "Enumeration", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64")
KINDS = (*REALS, *INTEGERS, "Boolean")
INDEXED = re.compile(r"(.+)\[(\d+(?:,\d+)*)\]")
# Enumerations may count from any number; a list longer than this is no list of choices.
MOST_CHOICES = 1000
# Of an array (assumed: the largest surface takes a hundredth).
MOST_ELEMENTS, MOST_DIMENSIONS = 10_000_000, 16


@dataclass(frozen=True)
class Cells:
    """Place of every FMI 3 variable among the elements of all: first cell, size, reference, type."""

    first: Integers
    size: Integers
    value_reference: npt.NDArray[np.uint32]
    kind: tuple[str, ...]

    def variable_of(self, cells: Integers) -> Integers:
        """Index of the variable that each cell belongs to."""
        return np.searchsorted(self.first, cells, side="right") - 1


class Described:
    """A model description, read once."""

    def __init__(self, description: "ModelDescription"):
        self.description = description
        self.is_fmi3 = description.fmiVersion.startswith("3")
        self.variables = [
            v for v in description.modelVariables
            if v.type in KINDS and v.causality not in ("independent", "structuralParameter")
        ]  # fmt: skip
        self.texts = {v.name: v.valueReference for v in description.modelVariables if v.type == "String"}
        self.base_units = {
            u.name: BaseUnit(tuple(getattr(u.baseUnit, k) for k in EXPONENTS), u.baseUnit.factor, u.baseUnit.offset)
            for u in description.unitDefinitions if u.baseUnit is not None
        }  # fmt: skip

    @cached_property
    def cells(self) -> Cells:
        sizes = np.array([int(np.prod(shape_of(v), dtype=int)) for v in self.variables], int)
        first = np.concatenate([[0], np.cumsum(sizes)[:-1]]) if self.variables else sizes
        references = np.array([v.valueReference for v in self.variables], np.uint32)
        return Cells(first, sizes, references, tuple(v.type for v in self.variables))

    @cached_property
    def references(self) -> dict[str, tuple[int, ...]]:
        """Variable name -> the numbers under which its elements are read and written."""
        if self.is_fmi3:
            spans = zip(self.variables, self.cells.first.tolist(), self.cells.size.tolist())
            return {v.name: tuple(range(first, first + size)) for v, first, size in spans}
        return {v.name: (v.valueReference,) for v in self.variables}

    def signals(self) -> dict[str, Signal]:
        if self.is_fmi3:
            return {v.name: self.signal(v.name, [v], shape_of(v)) for v in self.variables}
        signals: dict[str, Signal] = {}
        for base, members in grouped(self.variables).items():
            shape = array_shape(members)
            if shape is None:
                signals |= {v.name: self.signal(v.name, [v], ()) for v in members}
            else:
                signals[base] = self.signal(base, members, shape)
        return signals

    def signal(self, name: str, members: list["ModelVariable"], shape: tuple[int, ...]) -> Signal:
        v = members[0]
        unit = v.unit or (v.declaredType.unit if v.declaredType is not None else None)
        return Signal(
            name, v.causality, unit or "1", tuple(r for m in members for r in self.references[m.name]), shape,
            v.type in INTEGERS, v.variability == "tunable", choices_of(v), v.type == "Boolean", unit is not None,
            self.base_units.get(unit), float(v.nominal) if v.nominal and v.type in REALS else None,
        )  # fmt: skip

    def feedthrough(self) -> dict[Element, tuple[Element, ...]]:
        """Output element -> input elements; an output without a declaration depends on every input."""
        inputs = [v for v in self.variables if v.causality == "input"]
        depends: dict[Element, tuple[Element, ...]] = {}
        for unknown in self.description.outputs:
            if unknown.variable.name not in self.references:
                continue
            named = inputs if unknown.dependencies is None else [v for v in unknown.dependencies if v in inputs]
            causes = tuple(cause for v in named for cause in self.elements(v))
            if causes:
                depends |= dict.fromkeys(self.elements(unknown.variable), causes)
        return depends

    def elements(self, variable: "ModelVariable") -> list[Element]:
        kind = "?" if variable.type == "Boolean" else "i8" if variable.type in INTEGERS else "f8"
        return [(kind, r) for r in self.references[variable.name]]


def shape_of(variable: "ModelVariable") -> tuple[int, ...]:
    """An FMI 3 variable's shape; a dimension is a number or a structural parameter's start."""
    shape = tuple(int(d.start if d.start is not None else d.variable.start) for d in variable.dimensions or [])
    if min(shape, default=1) < 0 or math.prod(shape) > MOST_ELEMENTS or len(shape) > MOST_DIMENSIONS:
        raise InputFault(f"variable {shown(variable.name)}: the shape {shape} is none that can be handled, of up to {MOST_ELEMENTS} elements")
    return shape


def grouped(variables: list["ModelVariable"]) -> dict[str, list["ModelVariable"]]:
    """Scalars by the name before their indices."""
    groups: dict[str, list[ModelVariable]] = {}
    for v in variables:
        match = INDEXED.fullmatch(v.name)
        groups.setdefault(match[1] if match else v.name, []).append(v)
    return groups


def array_shape(members: list["ModelVariable"]) -> tuple[int, ...] | None:
    """Shape of the array that the scalars make up, row by row from 1; None if they make none."""
    indices = []
    for v in members:
        match = INDEXED.fullmatch(v.name)
        if not match:
            return None
        indices.append(tuple(int(i) for i in match[2].split(",")))
    shape = indices[-1]
    # What is too large, or too deep, to be the array that they make up.
    if len(shape) > MOST_DIMENSIONS or math.prod(shape) != len(members):
        return None
    alike = len({(v.causality, v.type, v.unit) for v in members}) == 1 and len({len(i) for i in indices}) == 1
    if not alike or indices != [tuple(i + 1 for i in index) for index in np.ndindex(shape)]:
        return None
    return shape


def choices_of(variable: "ModelVariable") -> tuple[str, ...]:
    """Names of an enumeration's values, by value; those of a Boolean are false and true."""
    if variable.type == "Boolean":
        return ("false", "true")
    items = variable.declaredType.items if variable.type == "Enumeration" and variable.declaredType else []
    values = [int(item.value) for item in items]
    if not values or min(values) < 0 or max(values) > MOST_CHOICES:
        return ()
    names = [""] * (max(values) + 1)
    for value, item in zip(values, items):
        names[value] = item.name
    return tuple(names)
