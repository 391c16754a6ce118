"""The decorator of every kernel, and how Python calls one.

A kernel is a Python function in the subset that ``compiler`` turns into machine code:
scalars, loops, record fields, array elements.  Called from Python it is compiled for the
types of its arguments, once per user (``store``).  Set ``RVWEAR_PLAIN_PYTHON=1`` and the
same functions run as plain Python.
"""

import ast
import inspect
import os
import textwrap
from collections.abc import Callable
from functools import cached_property
from typing import Any

PLAIN = bool(os.environ.get("RVWEAR_PLAIN_PYTHON"))


class Kernel:
    """A function that compiles itself; ``is_entry`` gives it object code of its own, see ``entry_point``."""

    is_kernel = True

    def __init__(self, function: Callable, is_entry: bool = False):
        self.function = function
        self.is_entry = is_entry
        self.name = function.__name__
        self.module = function.__module__
        self.__doc__ = function.__doc__
        self.__name__ = function.__name__
        self.__module__ = function.__module__
        self.__wrapped__ = function
        self._callers: dict[tuple, Callable] = {}

    def __repr__(self) -> str:
        return f"<kernel {self.module}.{self.name}>"

    @property
    def origin(self) -> str:
        """Where in its module it stands; nested functions of one name may be several."""
        return f"{self.module}:{self.function.__qualname__}:{self.function.__code__.co_firstlineno}"

    @property
    def file(self) -> str:
        return self.function.__code__.co_filename

    @cached_property
    def tree(self) -> ast.FunctionDef:
        """The syntax tree of the function, with the file's line numbers."""
        lines, first = inspect.getsourcelines(self.function)
        tree = ast.parse(textwrap.dedent("".join(lines)))
        ast.increment_lineno(tree, first - 1)
        (function,) = tree.body
        assert isinstance(function, ast.FunctionDef)
        return function

    @property
    def local_names(self) -> tuple[str, ...]:
        return self.function.__code__.co_varnames

    def outer(self, name: str) -> Any:
        """What a name means outside of the function, or None."""
        code = self.function.__code__
        if name in code.co_freevars and self.function.__closure__:
            return self.function.__closure__[code.co_freevars.index(name)].cell_contents
        return self.function.__globals__.get(name)

    def __call__(self, *arguments: Any) -> Any:
        from fmu_src.compiler import calling

        return calling.call(self, arguments)


def kernel(function: Callable) -> Any:
    """Make a kernel of a function."""
    return function if PLAIN else Kernel(function)


def entry_point(function: Callable) -> Any:
    """A kernel with object code of its own: other kernels that run in this process call it and do not contain it.

    The entry points of one module (``initialise`` and ``step`` of a unit) are compiled together.
    """
    return function if PLAIN else Kernel(function, is_entry=True)
