"""A kernel as the compiler sees it: the function's syntax tree and what its names mean."""

import ast
import inspect
import textwrap
from collections.abc import Callable
from functools import cached_property
from typing import Any


class Source:
    """``is_entry`` gives the kernel object code of its own, see ``fmu_src.kernel.entry_point``."""

    def __init__(self, function: Callable[..., Any], is_entry: bool = False):
        self.function = function
        self.is_entry = is_entry
        self.name: str = function.__name__
        self.module: str = function.__module__

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
