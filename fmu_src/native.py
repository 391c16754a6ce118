"""A unit as machine code without Python: object code for this machine or any other, and its loading.

The object code of a unit offers two C functions

    int64 initialise(void *cells)
    int64 step(void *cells, double time, double duration)

and needs nothing but libm.  ``link`` makes shared libraries of it; where Python runs it
is loaded in a few milliseconds.
"""

import ctypes
from collections.abc import Callable
from typing import Any

from fmu_src.compiler import loading
from fmu_src.compiler.module import host_triple
from fmu_src.compiler.types import Layout
from fmu_src.faults import RunFault
from fmu_src.unit import Specification, make_unit

__all__ = ["NativeFault", "host_triple", "load_object", "object_code", "object_codes"]


class NativeFault(RunFault):
    """A library that could not be made or would not run without Python."""


def object_codes(specification: Specification, triples: tuple[str, ...]) -> dict[str, bytes]:
    """Object code of a unit for several targets (LLVM triples): sources and array sizes decide it, start values do not."""
    unit = make_unit(specification)
    if unit.kernels is None:
        raise NativeFault("kernels run as plain Python here and are not compiled; unset RVWEAR_PLAIN_PYTHON")
    return loading.unit_code(*unit.kernels, Layout(unit.table.dtype), triples)


def object_code(specification: Specification, triple: str | None = None) -> bytes:
    """Object code of a unit for one target (default this machine), plain instructions only."""
    triple = triple or host_triple()
    return object_codes(specification, (triple,))[triple]


def load_object(code: bytes) -> dict[str, Callable[..., Any]]:
    """The entry points of an object, callable as ``f(address of the record, ...)``.

    The loaded code lives as long as the process; loading the same bytes twice gives the
    same functions.
    """
    if code not in _loaded:
        addresses = loading.load_object(code, tuple(loading.ENTRY_POINTS))
        _loaded[code] = {
            name: loading.c_function(address, [ctypes.c_void_p, *[ctypes.c_double] * len(numbers)], ctypes.c_int64)
            for (name, numbers), address in zip(loading.ENTRY_POINTS.items(), addresses)
        }
    return _loaded[code]


_loaded: dict[bytes, dict[str, Callable[..., Any]]] = {}
