"""C functions of a unit with their arguments held: what runs every step costs a third less than through ctypes' conversions.

Arguments stand ready as C values, so that nothing is converted at a call but what changes.
"""

import ctypes
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

# Statuses of FMI above "warning" are failures.
WARNING, ERROR = 1, 3
# A status that the unit refused with: to raise.
Refuse = Callable[[str, int], None]


class Step(Protocol):
    """From ``time`` on through ``duration`` [s]."""

    def __call__(self, time: float, duration: float) -> None: ...


def bound(library: ctypes.CDLL, function: str, instance: int, arguments: tuple[Any, ...], refuse: Refuse) -> Callable[[], None]:
    """The function with the instance and all arguments, which are C values, held."""
    call, held = function_of(library, function), (ctypes.c_void_p(instance), *arguments)

    def run() -> None:
        status = call(*held)
        if status > WARNING:
            refuse(function, status)

    return run


def bound_step(library: ctypes.CDLL, function: str, instance: int, arguments: tuple[Any, ...], refuse: Refuse) -> Step:
    """The same for a step, whose time and duration stand before the other arguments."""
    start, length = ctypes.c_double(), ctypes.c_double()
    call, held = function_of(library, function), (ctypes.c_void_p(instance), start, length, *arguments)

    def run(time: float, duration: float) -> None:
        start.value, length.value = time, duration
        status = call(*held)
        if status > WARNING:
            refuse(function, status)

    return run


def function_of(library: ctypes.CDLL, function: str) -> Any:
    # Of its own, so that it does not share fmpy's types of arguments.
    call = library[function]
    call.restype = ctypes.c_int
    return call


def address(buffer: np.ndarray) -> ctypes.c_void_p:
    """Of a buffer's values; it keeps the buffer alive, as a plain number would not."""
    return buffer.ctypes.data_as(ctypes.c_void_p)
