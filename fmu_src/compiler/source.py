"""A kernel as the compiler sees it: the function's syntax tree and what its names mean."""

import ast
import linecache
from collections.abc import Callable
from functools import cached_property, lru_cache
from typing import Any


@lru_cache(1024)
def functions_in(text: str) -> dict[tuple[str, int], ast.FunctionDef]:
    """Functions of a file by name and first line, that of the first decorator: read once for all kernels in it."""
    found = (node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef))
    return {(node.name, min([node.lineno, *(d.lineno for d in node.decorator_list)])): node for node in found}


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
        linecache.checkcache(self.file)
        text = "".join(linecache.getlines(self.file, self.function.__globals__))
        return functions_in(text)[self.name, self.function.__code__.co_firstlineno]

    @property
    def local_names(self) -> tuple[str, ...]:
        return self.function.__code__.co_varnames

    def outer(self, name: str) -> Any:
        """What a name means outside of the function, or None."""
        code = self.function.__code__
        if name in code.co_freevars and self.function.__closure__:
            return self.function.__closure__[code.co_freevars.index(name)].cell_contents
        return self.function.__globals__.get(name)
