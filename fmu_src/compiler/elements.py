"""Parts of what stands in memory: fields of records, elements and rows of arrays, items of tuples."""

import ast
import types as python_types

from fmu_src.arrays import field_of
from fmu_src.compiler import arithmetic, names
from fmu_src.compiler.function import Function
from fmu_src.compiler.types import (
    ELEMENTS,
    FLOAT,
    INTEGER,
    TRUTH,
    Array,
    Group,
    Layout,
    Number,
    Record,
    Records,
    Value,
    items_of,
    together,
)  # fmt: skip
from fmu_src.faults import nearest


def attribute(e: Function, node: ast.Attribute) -> Value:
    if isinstance(node.value, ast.Name) and node.value.id not in e.variables:
        owner = names.outer(e, node.value.id)
        if isinstance(owner, python_types.ModuleType):
            return names.constant(e, names.in_module(e, owner, node.value.id, node.attr), ast.unparse(node))
    value = e.expression(node.value)
    if node.attr == "shape" and isinstance(value.type, (Array, Records)):
        return extents(e, value)
    place, kind, shape = field_place(e, value, node.attr)
    if isinstance(kind, Layout):
        return Value(Records(kind) if isinstance(value.type, Records) else Record(kind), (place, *value.parts[1:]))
    if shape:
        return Value(Array(kind, len(shape)), (place, *map(str, shape)))
    return Value(kind, (e.give(f"load {kind.llvm}, ptr {place}, align 8"),))


def field_place(e: Function, value: Value, name: str) -> tuple[str, Number | Layout, tuple[int, ...]]:
    """Address of a record's field, what it holds, and its shape."""
    if not isinstance(value.type, (Record, Records)):
        raise e.fault(f"{value.type} has no .{name}")
    layout = value.type.layout
    known = layout.dtype.names or ()
    if name not in known:
        raise e.fault(f"the record has no {name}{nearest(name, known)}")
    dtype, offset = field_of(layout.dtype, name)
    base, shape = dtype.subdtype or (dtype, ())
    place = value.parts[0] if offset == 0 else e.give(
        f"getelementptr inbounds i8, ptr {value.parts[0]}, i64 {offset}", f"{name}.at"
    )
    if base.names:
        return place, e.module.layout(base), shape
    if isinstance(value.type, Records):
        raise e.fault(f"{name} of all records at once: take one of them first, records[0].{name}")
    if base.str[1:] not in ELEMENTS:
        raise e.fault(f"{name} holds {base}; kernels know 64-bit numbers and integers only")
    return place, ELEMENTS[base.str[1:]], shape


def extents(e: Function, value: Value) -> Value:
    if not isinstance(value.type, (Array, Records)):
        raise e.fault(f"{value.type} has no extents")
    return together([Value(INTEGER, (part,), int(part) if part.isdigit() else None, True) for part in value.parts[1:]])


def subscript(e: Function, node: ast.Subscript) -> Value:
    value = e.expression(node.value)
    if isinstance(value.type, Group):
        return of_group(e, value, node.slice)
    if isinstance(value.type, Records):
        index = from_front(e, e.expression(node.slice), value.parts[1])
        step = value.type.layout.dtype.itemsize
        offset = e.give(f"mul i64 {index}, {step}")
        return Value(Record(value.type.layout), (e.give(f"getelementptr inbounds i8, ptr {value.parts[0]}, i64 {offset}"),))
    part, kind = element_of(e, value, node.slice)
    if isinstance(kind, Array):
        return part
    return Value(kind, (e.give(f"load {kind.llvm}, ptr {part.parts[0]}, align 8"),))


def of_group(e: Function, value: Value, index: ast.expr) -> Value:
    items = items_of(value)

    def known(node: ast.expr | None) -> int | None:
        if node is None:
            return None
        constant = e.expression(node).constant
        if not isinstance(constant, int):
            raise e.fault("an item of a tuple is taken by a number, not by a variable")
        return constant

    if isinstance(index, ast.Slice):
        return together(items[known(index.lower) : known(index.upper) : known(index.step)])
    chosen = e.expression(index)
    if chosen.constant is None:
        return item_by_number(e, items, chosen)
    place = known(index)
    assert place is not None
    if not -len(items) <= place < len(items):
        raise e.fault(f"the tuple has {len(items)} items, there is no {place}")
    return items[place]


def item_by_number(e: Function, items: list[Value], chosen: Value) -> Value:
    """An item of a short table of numbers."""
    index = from_front(e, chosen, str(len(items)))
    kind = FLOAT if any(item.type == FLOAT for item in items) else INTEGER
    numbers = [arithmetic.converted(e, e.number(item), kind).parts[0] for item in items]
    found = numbers[0]
    for i, number in enumerate(numbers[1:], 1):
        found = e.give(f"select i1 {e.give(f'icmp eq i64 {index}, {i}')}, {kind.llvm} {number}, {kind.llvm} {found}")
    return Value(kind, (found,), not_negative=all(item.not_negative for item in items))


def element_of(e: Function, value: Value, index: ast.expr) -> tuple[Value, Number | Array]:
    """(address or row, what it is) of an element or row of an array."""
    if not isinstance(value.type, Array):
        raise e.fault(f"{value.type} has no elements")
    nodes = index.elts if isinstance(index, ast.Tuple) else [index]
    if any(isinstance(node, ast.Slice) for node in nodes):
        raise e.fault("kernels take elements and rows of arrays, no slices; write a loop")
    sizes = value.parts[1:]
    if len(nodes) > len(sizes):
        raise e.fault(f"{value.type} takes {len(sizes)} indices, not {len(nodes)}")
    indices = [from_front(e, e.expression(node), extent) for node, extent in zip(nodes, sizes)]
    place = indices[0]
    for i in range(1, len(sizes)):
        place = times(e, place, sizes[i])
        if i < len(indices):
            place = e.give(f"add nsw i64 {place}, {indices[i]}")
    address = e.give(f"getelementptr inbounds {value.type.element.llvm}, ptr {value.parts[0]}, i64 {place}")
    if len(indices) == len(sizes):
        return Value(value.type.element, (address,)), value.type.element
    row = Array(value.type.element, len(sizes) - len(indices))
    return Value(row, (address, *sizes[len(indices) :])), row


def times(e: Function, place: str, extent: str) -> str:
    if place.isdigit() and extent.isdigit():
        return str(int(place) * int(extent))
    return e.give(f"mul nsw i64 {place}, {extent}")


def from_front(e: Function, value: Value, extent: str) -> str:
    """The index counted from the front: a negative one counts from the end."""
    if value.type not in (INTEGER, TRUTH):
        raise e.fault(f"an index must be a whole number, not {value.type}; say int(...)")
    (part,) = arithmetic.converted(e, value, INTEGER).parts
    if value.constant is not None and value.constant < 0:
        return e.give(f"add i64 {extent}, {part}")
    if value.not_negative:
        return part
    is_negative = e.give(f"icmp slt i64 {part}, 0")
    return e.give(f"select i1 {is_negative}, i64 {e.give(f'add i64 {part}, {extent}')}, i64 {part}")


def place_of(e: Function, target: ast.expr) -> tuple[str, Number]:
    """Address of a field or element that is assigned to, and what it holds."""
    match target:
        case ast.Attribute(value=owner, attr=name):
            place, kind, shape = field_place(e, e.expression(owner), name)
            if shape or isinstance(kind, Layout):
                raise e.fault(f"{name} is an array; assign its elements in a loop")
            return place, kind
        case ast.Subscript(value=owner, slice=index):
            part, element = element_of(e, e.expression(owner), index)
            if isinstance(element, Array):
                raise e.fault("a row cannot be assigned; assign its elements in a loop")
            return part.parts[0], element
    raise e.fault(f"{ast.unparse(target)} cannot be assigned in a kernel")
