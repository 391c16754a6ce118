"""The decorator of every kernel, and how Python calls one.

A kernel is a Python function in the subset that ``compiler`` turns into machine code:
scalars, loops, record fields, array elements.  Called from Python it is compiled for the
types of its arguments, once per user.  Set ``RVWEAR_PLAIN_PYTHON=1`` and the same
functions run as plain Python.
"""

import os
import threading
from collections.abc import Callable
from typing import Any

from fmu_src.compiler.source import Source

# Kernels that several threads call for the first time are compiled by one.
compiling = threading.RLock()
PLAIN = bool(os.environ.get("RVWEAR_PLAIN_PYTHON"))


class Kernel(Source):
    """A kernel that Python can call; ``callers`` by the sorts of arguments seen so far."""

    def __init__(self, function: Callable[..., Any], is_entry: bool = False):
        super().__init__(function, is_entry)
        self.__doc__ = function.__doc__
        self.__name__ = self.name
        self.__module__ = self.module
        self.__wrapped__ = function
        self.callers: dict[tuple[Any, ...], Callable[..., Any]] = {}

    def __repr__(self) -> str:
        return f"<kernel {self.module}.{self.name}>"

    def __call__(self, *arguments: Any) -> Any:
        # Here, so that who only declares kernels does not load the compiler.
        from fmu_src.compiler.calling import sorts_of

        sorts = sorts_of(self, arguments)
        caller = self.callers.get(sorts)
        if caller is None:
            from fmu_src.compiler.calling import make_caller

            with compiling:
                caller = self.callers.get(sorts) or make_caller(self, arguments)
                self.callers[sorts] = caller
        return caller(*arguments)


def kernel(function: Callable[..., Any]) -> Any:
    """Make a kernel of a function."""
    return function if PLAIN else Kernel(function)


def entry_point(function: Callable[..., Any]) -> Any:
    """A kernel with object code of its own: other kernels that run in this process call it and do not contain it.

    The entry points of one module (``initialise`` and ``step`` of a unit) are compiled together.
    """
    return function if PLAIN else Kernel(function, is_entry=True)


def plain(kernel: Any) -> Callable[..., Any]:
    """A kernel's Python function: of a few numbers it is done before compiled code is called."""
    function: Callable[..., Any] = getattr(kernel, "__wrapped__", kernel)
    return function
