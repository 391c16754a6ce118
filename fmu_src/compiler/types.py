"""What a value of a kernel can be.

A value is a type and its parts, the LLVM operands that make it up: one for a number or a
record, one per item of a tuple, address and extents of an array.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fmu_src.arrays import field_of
from fmu_src.faults import InputFault


class KernelFault(InputFault):
    """A kernel outside the subset: says file, line and remedy."""


@dataclass(frozen=True)
class Number:
    """``llvm`` is its LLVM type, ``code`` its letter in a signature."""

    name: str
    llvm: str
    code: str

    @property
    def parts(self) -> tuple[str, ...]:
        return (self.llvm,)

    def __str__(self) -> str:
        return self.name


FLOAT = Number("a number", "double", "f")
INTEGER = Number("an integer", "i64", "i")
TRUTH = Number("true or false", "i1", "b")


@dataclass(frozen=True)
class Group:
    """A tuple."""

    items: "tuple[Type, ...]"

    @property
    def parts(self) -> tuple[str, ...]:
        return tuple(part for item in self.items for part in item.parts)

    @property
    def code(self) -> str:
        return f"({''.join(item.code for item in self.items)})"

    def __str__(self) -> str:
        return f"a tuple of {len(self.items)}"


@dataclass(frozen=True, eq=False)
class Layout:
    """A structured dtype, known by its digest: equal layouts are one type."""

    dtype: np.dtype

    @cached_property
    def digest(self) -> str:
        return layout_digest(self.dtype)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Layout) and (self.dtype is other.dtype or self.digest == other.digest)

    def __hash__(self) -> int:
        return hash(self.digest)


@dataclass(frozen=True)
class Record:
    """One record; its part is its address."""

    layout: Layout
    parts = ("ptr",)

    @property
    def code(self) -> str:
        return f"r{self.layout.digest}"

    def __str__(self) -> str:
        return "a record"


@dataclass(frozen=True)
class Records:
    """A row of records; parts are address and count."""

    layout: Layout
    parts = ("ptr", "i64")

    @property
    def code(self) -> str:
        return f"R{self.layout.digest}"

    def __str__(self) -> str:
        return "an array of records"


@dataclass(frozen=True)
class Array:
    """Numbers in C order without gaps; parts are address and extents."""

    element: Number
    dimensions: int

    @property
    def parts(self) -> tuple[str, ...]:
        return ("ptr",) + ("i64",) * self.dimensions

    @property
    def code(self) -> str:
        return f"a{self.dimensions}{self.element.code}"

    def __str__(self) -> str:
        return f"an array of {self.dimensions} dimension{'s' if self.dimensions > 1 else ''}"


Type = Number | Group | Record | Records | Array
NOTHING = Group(())

ELEMENTS = {"f8": FLOAT, "i8": INTEGER}


@dataclass(frozen=True)
class Value:
    """``constant`` is the number itself where it is known; ``not_negative`` spares an index a look at its sign."""

    type: Type
    parts: tuple[str, ...]
    constant: int | float | None = None
    not_negative: bool = False


def layout_digest(dtype: np.dtype) -> str:
    """Of names, kinds, shapes and places of all fields."""
    import hashlib

    return hashlib.sha256("\n".join(layout_lines(dtype)).encode()).hexdigest()[:24]


def layout_lines(dtype: np.dtype) -> list[str]:
    lines = [f"size {dtype.itemsize}"]
    for name in dtype.names or ():
        field, place = field_of(dtype, name)
        base, shape = field.subdtype or (field, ())
        inner = layout_digest(base) if base.names else base.str
        lines.append(f"{name} {place} {shape} {inner}")
    return lines


def joined(a: Type, b: Type) -> Type | None:
    """The type that holds values of both, or None."""
    if a == b:
        return a
    if isinstance(a, Number) and isinstance(b, Number):
        return FLOAT if FLOAT in (a, b) else INTEGER
    if isinstance(a, Group) and isinstance(b, Group) and len(a.items) == len(b.items):
        items = [item for x, y in zip(a.items, b.items) if (item := joined(x, y)) is not None]
        return Group(tuple(items)) if len(items) == len(a.items) else None
    return None


def items_of(value: Value) -> list[Value]:
    """The items of a tuple; what is known of whole numbers goes with them."""
    assert isinstance(value.type, Group)
    items, start = [], 0
    for kind in value.type.items:
        parts = value.parts[start : start + len(kind.parts)]
        start += len(parts)
        constant = None
        if kind == INTEGER and parts[0].lstrip("-").isdigit():
            constant = int(parts[0])
        items.append(Value(kind, parts, constant, constant is not None and constant >= 0))
    return items


def together(items: list[Value]) -> Value:
    return Value(Group(tuple(item.type for item in items)), tuple(part for item in items for part in item.parts))


def returned(kind: Type) -> str:
    """LLVM's type of a result."""
    if len(kind.parts) <= 1:
        return kind.parts[0] if kind.parts else "void"
    return "{ " + ", ".join(kind.parts) + " }"
