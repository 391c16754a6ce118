"""A function of LLVM while it is written: its lines, blocks and variables.

Every local variable has one type, that of all its values together (a variable that gets
0 and later 0.5 holds numbers).  A walk that finds a variable wider than it had assumed is
done again; two walks do.  Variables stand in memory and LLVM makes registers of them.
"""

import ast
from abc import ABC, abstractmethod
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from fmu_src.compiler import arithmetic
from fmu_src.compiler.source import Source
from fmu_src.compiler.types import Group, KernelFault, Layout, Number, Type, Value, items_of, joined


@dataclass(eq=False)
class Instance:
    """A kernel for argument types; ``result`` is known once it is written.

    One that is separate stands in other object code, with a C function's arguments: of
    records the address alone.
    """

    kernel: Source
    arguments: tuple[Type, ...]
    symbol: str
    result: Type | None = None
    is_separate: bool = False


class Surroundings(Protocol):
    """What a function is written into."""

    def instance(self, kernel: Source, arguments: tuple[Type, ...], is_called: bool = False) -> Instance:
        """The kernel for these types, written if it is new."""

    def declare(self, declaration: str, symbol: str) -> str:
        """Gives back the symbol of what is declared."""

    def note_constant(self, kernel: Source, name: str, value: Any) -> None: ...

    def layout(self, dtype: np.dtype) -> Layout: ...


class Wider(Exception):
    """A variable or result holds more than was assumed: walk again."""


@dataclass
class Loop:
    """Where ``continue`` and ``break`` go."""

    onward: str
    end: str


@dataclass
class Function(ABC):
    """One instance; ``variables`` and ``result`` are kept from walk to walk, all else begins anew."""

    module: Surroundings
    instance: Instance
    variables: dict[str, Type] = field(default_factory=dict)
    result: Type | None = None
    # Variables that get a whole number below zero somewhere, or may.
    sometimes_negative: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        kernel = self.instance.kernel
        self.tree: ast.FunctionDef = kernel.tree
        self.node: ast.AST = self.tree
        self.begin()

    def begin(self) -> None:
        """An empty body."""
        self.lines: list[str] = []
        self.slots: list[str] = []
        self.places: dict[str, tuple[str, ...]] = {}
        self.count = 0
        self.block = "entry"
        self.loops: list[Loop] = []
        self.never_negative: set[str] = set()
        self.ended = False

    @abstractmethod
    def expression(self, node: ast.expr) -> Value:
        """Writes an expression; its value."""

    @abstractmethod
    def statements(self, body: list[ast.stmt]) -> None:
        """Writes statements, up to one that leaves the block."""

    def fault(self, text: str) -> KernelFault:
        line = getattr(self.node, "lineno", self.tree.lineno)
        return KernelFault(f"{self.instance.kernel.file}:{line}: {text}")

    # What is written.

    def write(self, line: str) -> None:
        if not self.ended:
            self.lines.append("  " + line)

    def give(self, instruction: str, hint: str = "t") -> str:
        """Writes an instruction; the name of its result, which begins with the hint."""
        self.count += 1
        name = f"%{hint}{self.count}"
        self.write(f"{name} = {instruction}")
        return name

    def new_block(self, hint: str) -> str:
        self.count += 1
        return f"{hint}{self.count}"

    def start(self, block: str) -> None:
        self.lines.append(f"{block}:")
        self.block, self.ended = block, False

    def go(self, block: str) -> None:
        self.write(f"br label %{block}")
        self.ended = True

    def branch(self, test: str, yes: str, no: str) -> None:
        self.write(f"br i1 {test}, label %{yes}, label %{no}")
        self.ended = True

    def slot(self, kind: str, variable: str) -> str:
        """A place in memory, named after the variable that it is for."""
        self.count += 1
        name = f"%{variable if variable.isascii() else 'variable'}.s{self.count}"
        self.slots.append(f"  {name} = alloca {kind}")
        return name

    def intrinsic(self, name: str, arguments: int) -> str:
        return self.module.declare(f"double @{name}({', '.join(['double'] * arguments)})", f"@{name}")

    def library(self, name: str, arguments: int) -> str:
        return self.module.declare(f"double @{name}({', '.join(['double'] * arguments)}) #1", f"@{name}")

    # Variables.

    def store_name(self, name: str, value: Value) -> None:
        known = self.variables.get(name)
        if known is None:
            self.variables[name] = known = value.type
        else:
            wider = joined(known, value.type)
            if wider is None:
                raise self.fault(f"{name} is {known} here and {value.type} there; use two names")
            if wider != known:
                self.variables[name] = wider
                raise Wider
        if name not in self.places:
            self.places[name] = tuple(self.slot(part, name) for part in known.parts)
        if not value.not_negative:
            self.sometimes_negative.add(name)
        elif name not in self.sometimes_negative:
            self.never_negative.add(name)
        value = self.cast(value, known)
        for place, kind, part in zip(self.places[name], known.parts, value.parts):
            self.write(f"store {kind} {part}, ptr {place}")

    def load_name(self, name: str) -> Value:
        if name not in self.places:
            raise self.fault(f"{name} is used before it has a value")
        kind = self.variables[name]
        parts = tuple(self.give(f"load {part}, ptr {place}") for part, place in zip(kind.parts, self.places[name]))
        return Value(kind, parts, not_negative=name in self.never_negative)

    def cast(self, value: Value, wanted: Type) -> Value:
        """The value as a type that ``joined`` found."""
        if value.type == wanted:
            return value
        if isinstance(wanted, Number):
            return arithmetic.converted(self, value, wanted)
        assert isinstance(wanted, Group)
        parts = [p for item, kind in zip(items_of(value), wanted.items) for p in self.cast(item, kind).parts]
        return Value(wanted, tuple(parts))

    def number(self, value: Value) -> Value:
        if not isinstance(value.type, Number):
            raise self.fault(f"{value.type} stands where a number is needed")
        return value
