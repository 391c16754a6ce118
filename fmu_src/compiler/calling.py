"""Calls of kernels from Python: types of the arguments, and what goes to and fro."""

import ctypes
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from fmu_src import arrays
from fmu_src.compiler import loading
from fmu_src.compiler.source import Source
from fmu_src.compiler.types import ELEMENTS, FLOAT, INTEGER, TRUTH, Array, Group, Layout, Number, Record, Records, Type

# Layouts of record types seen, by the identity of the dtype, which is kept so that it stays one.
_layouts: dict[int, Layout] = {}


def layout_of(dtype: np.dtype) -> Layout:
    known = _layouts.get(id(dtype))
    if known is None:
        known = _layouts[id(dtype)] = Layout(dtype)
    return known


def sorts_of(kernel: Source, arguments: tuple[Any, ...]) -> tuple[Any, ...]:
    """What decides the types of the arguments of a call."""
    try:
        return tuple([sort_of(argument) for argument in arguments])
    except TypeError as problem:
        raise TypeError(f"{kernel.name}: {problem}") from None


def sort_of(argument: Any) -> Any:
    """What decides the type of an argument, cheaply."""
    kind = type(argument)
    if kind is float or kind is int or kind is bool:
        return kind
    if isinstance(argument, np.ndarray):
        return (argument.ndim, id(argument.dtype) if argument.dtype.names else argument.dtype.str)
    if isinstance(argument, np.void):
        return id(argument.dtype)
    if isinstance(argument, (float, np.floating)):
        return float
    if isinstance(argument, np.bool):
        return bool
    if isinstance(argument, (int, np.integer)):
        return int
    raise TypeError(f"{kind.__name__} is nothing that a kernel takes; give numbers, arrays of numbers or records")


def type_of(argument: Any) -> Type:
    sort = sort_of(argument)
    if sort in (float, int, bool):
        return {float: FLOAT, int: INTEGER, bool: TRUTH}[sort]
    if isinstance(argument, np.void):
        return Record(layout_of(argument.dtype))
    if argument.dtype.names:
        if argument.ndim != 1:
            raise TypeError(f"an array of records with {argument.ndim} dimensions; kernels take one")
        return Records(layout_of(argument.dtype))
    if argument.dtype.str not in ("<f8", "<i8") or argument.ndim == 0:
        raise TypeError(f"an array of {argument.dtype} with {argument.ndim} dimensions; kernels take f8 and i8 with one or more")
    return Array(ELEMENTS[argument.dtype.str[1:]], argument.ndim)


C_TYPES: dict[str, loading.CType] = {"double": ctypes.c_double, "i64": ctypes.c_int64, "i1": ctypes.c_int8, "ptr": ctypes.c_void_p}
# What goes to C of one argument.
Parts = tuple[int | float, ...]


def number_of(argument: float) -> Parts:
    return (argument,)


def address_of(record: np.void) -> tuple[int]:
    """A record's address, by way of a field that is an array: NumPy describes a whole record slowly."""
    name, place = array_field(record.dtype)
    if name is None:
        return (record.__array_interface__["data"][0],)
    return (record[name].ctypes.data - place,)


def array_field(dtype: np.dtype) -> tuple[str | None, int]:
    """(name, place) of a field that is an array."""
    known = _array_fields.get(id(dtype))
    if known is None:
        fields = [(name, *arrays.field_of(dtype, name)) for name in dtype.names or ()]
        known = _array_fields[id(dtype)] = next(((name, place) for name, kind, place in fields if kind.shape), (None, 0))
        # Kept, so that its identity stays its own.
        layout_of(dtype)
    return known


_array_fields: dict[int, tuple[str | None, int]] = {}


def row_of(argument: np.ndarray) -> tuple[int, ...]:
    """Address and extents of an array."""
    if not argument.flags.c_contiguous:
        raise TypeError("an array with gaps; give numpy.ascontiguousarray(...) of it")
    return (argument.ctypes.data, *argument.shape)


def make_caller(kernel: Source, arguments: tuple[Any, ...]) -> Callable[..., Any]:
    """A function of the same arguments that calls the compiled kernel."""
    types = tuple(type_of(argument) for argument in arguments)
    given: list[Callable[[Any], Parts]] = [
        number_of if isinstance(kind, Number) else address_of if isinstance(kind, Record) else row_of for kind in types
    ]
    if kernel.is_entry and types and isinstance(types[0], Records):
        return unit_caller(kernel, types[0].layout)
    address, code = loading.call_address(kernel, types)
    result = loading.result_type(code)
    c_arguments = [C_TYPES[part] for kind in types for part in kind.parts]
    if isinstance(result, Group):
        return tuple_caller(address, c_arguments, given, result)
    function = loading.c_function(address, c_arguments, ctypes.c_double if result == FLOAT else ctypes.c_int64)

    def call_for_number(*arguments: Any) -> Any:
        return function(*[part for take, argument in zip(given, arguments) for part in take(argument)])

    if result == TRUTH:
        return lambda *arguments: bool(call_for_number(*arguments))
    return call_for_number


def tuple_caller(
    address: int, c_arguments: Sequence[loading.CType], given: Sequence[Callable[[Any], Parts]], result: Group
) -> Callable[..., tuple[float | bool | int, ...] | None]:
    function = loading.c_function(address, [*c_arguments, ctypes.c_void_p], None)
    kinds = [item.parts[0] for item in result.items]

    def call_for_several(*arguments: Any) -> tuple[float | bool | int, ...] | None:
        cells = np.empty(max(1, len(kinds)))
        function(*[part for take, argument in zip(given, arguments) for part in take(argument)], cells.__array_interface__["data"][0])
        whole = cells.view("i8")
        values = (float(cells[i]) if kind == "double" else bool(whole[i]) if kind == "i1" else int(whole[i]) for i, kind in enumerate(kinds))
        return tuple(values) if kinds else None

    return call_for_several


def unit_caller(kernel: Source, layout: Layout) -> Callable[..., int]:
    """An entry point's caller: ``f(records, ...)``."""
    function = entry_function(loading.module_addresses(kernel, layout), kernel.name)
    return lambda records, *more: function(row_of(records)[0], *more)


def entry_function(addresses: dict[str, int], name: str) -> Callable[..., int]:
    numbers = [ctypes.c_double] * len(loading.ENTRY_POINTS[name])
    return loading.c_function(addresses[name], [ctypes.c_void_p, *numbers], ctypes.c_int64)


def bound_unit(initialise: Source, step: Source, records: arrays.Records) -> tuple[Callable[[], int], Callable[[float, float], int]]:
    """Both entry points for one record, without a look at the arguments of each call."""
    addresses, cells = loading.unit_addresses(initialise, step, layout_of(records.dtype)), ctypes.c_void_p(row_of(records)[0])
    first, following = entry_function(addresses, "initialise"), entry_function(addresses, "step")
    return lambda: first(cells), lambda time, duration: following(cells, time, duration)
