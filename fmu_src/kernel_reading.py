"""What a kernel does to its record, read from its source: the compiler is not asked.

A kernel is followed from its arguments: into fields of the record, through local names that stand for an array
or a part of one, and into the kernels that it calls, in its own file or imported.  What is found does not depend
on the order of the statements: a name stands for everything that it is given anywhere.
"""

import ast
import builtins
import importlib.util
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from fmu_src.faults import nearest

# Neither machine code without allocation nor native FMUs have these.
FOREIGN = {
    ast.Try: "try", ast.With: "with", ast.Raise: "raise", ast.Assert: "assert", ast.Lambda: "lambda", ast.ListComp: "a list",
    ast.List: "a list", ast.Dict: "a dictionary", ast.DictComp: "a dictionary", ast.Set: "a set", ast.SetComp: "a set",
    ast.GeneratorExp: "a generator", ast.Yield: "yield", ast.YieldFrom: "yield", ast.Await: "await", ast.JoinedStr: "a text",
    ast.Global: "global", ast.Nonlocal: "nonlocal", ast.Import: "import", ast.ImportFrom: "import", ast.ClassDef: "a class",
    ast.Delete: "del", ast.Match: "match", ast.FunctionDef: "a function inside",
}  # fmt: skip
# Attributes of an array that say nothing about its values.
OF_ARRAYS = ("shape", "size", "ndim")
# What a kernel may call beside kernels, and what many write for it.
CALLED = "kernels call kernels, the functions of math, and abs, min, max, int, float, bool and len"
OF_NUMPY = ("np", "numpy")
OPERATORS = {ast.Add: "+=", ast.Sub: "-=", ast.Mult: "*=", ast.Div: "/="}


@dataclass(frozen=True)
class Part:
    """What a name may stand for: the record (no name), or a field of it after so many indices."""

    name: str = ""
    indices: int = 0


Parts = frozenset[Part]
# What has a line of its own in a file.
Place = ast.expr | ast.stmt
NOTHING: Parts = frozenset()
RECORD: Parts = frozenset({Part()})


@dataclass(frozen=True)
class Use:
    """One place where a field's value is read (action "read") or changed ("=", "+=", "-=", "*=", "/=", "other=")."""

    name: str
    action: str
    file: Path
    line: int


@dataclass(frozen=True)
class Trouble:
    """One place that cannot work, and why."""

    file: Path
    line: int
    text: str


@dataclass(frozen=True)
class Source:
    """A module as far as kernels go."""

    file: Path
    functions: Mapping[str, ast.FunctionDef]
    # Name here: (module, name there), the latter empty for a module itself.
    imports: Mapping[str, tuple[str, str]]
    names: frozenset[str]

    def kernels(self) -> dict[str, ast.FunctionDef]:
        return {name: f for name, f in self.functions.items() if is_kernel(f)}


def is_kernel(function: ast.FunctionDef) -> bool:
    return any(isinstance(d, ast.Name) and d.id == "kernel" for d in function.decorator_list)


def source_of(file: Path, tree: ast.Module) -> Source:
    imports: dict[str, tuple[str, str]] = {}
    names = set()
    for node in tree.body:
        if isinstance(node, ast.ImportFrom):
            imports |= {a.asname or a.name: (node.module or "", a.name) for a in node.names}
        elif isinstance(node, ast.Import):
            imports |= {a.asname or a.name.partition(".")[0]: (a.name if a.asname else a.name.partition(".")[0], "") for a in node.names}
        elif isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        else:
            names |= set(stored_names(node))
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    return Source(file, functions, imports, frozenset(names | imports.keys()))


def stored_names(node: ast.AST) -> Iterator[str]:
    return (n.id for n in ast.walk(node) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store))


@cache
def imported_source(module: str) -> Source | None:
    """The source of an importable module; None for what has none or cannot be found."""
    try:
        found = importlib.util.find_spec(module)
    except (ImportError, ValueError):
        return None
    if found is None or found.origin is None or not found.origin.endswith(".py"):
        return None
    file = Path(found.origin)
    return source_of(file, ast.parse(file.read_text(encoding="utf-8")))


@dataclass
class Reading:
    """Everything that following one or several kernels of ``source`` has shown; ``dimensions`` counts each field's indices.

    ``counts`` says of names of counts, which no record has (``discs``), what has them: ``roller_gap_now.shape[0]``.
    """

    source: Source
    dimensions: Mapping[str, int]
    counts: Mapping[str, str] = field(default_factory=dict)
    uses: set[Use] = field(default_factory=set)
    troubles: set[Trouble] = field(default_factory=set)
    # Names of kernels in ``source`` that were met.
    met: set[str] = field(default_factory=set)
    results: dict[tuple[Path, str, tuple[Parts, ...]], Parts] = field(default_factory=dict)

    def follow(self, source: Source, name: str, arguments: tuple[Parts, ...]) -> Parts:
        """Follow one call; returns what the kernel may give back."""
        key = (source.file, name, arguments)
        if key not in self.results:
            self.results[key] = NOTHING
            if source.file == self.source.file:
                self.met.add(name)
            self.results[key] = Call(self, source, source.functions[name], arguments).result()
        return self.results[key]


class Call:
    """One kernel with what its arguments stand for."""

    def __init__(self, reading: Reading, source: Source, function: ast.FunctionDef, arguments: tuple[Parts, ...]):
        self.reading, self.source, self.function = reading, source, function
        parameters = [a.arg for a in function.args.args]
        self.stands_for = dict(zip(parameters, arguments))
        self.known = {*parameters, *stored_names(function), *source.names, *dir(builtins)}
        self.given = NOTHING
        # Troubles in the kernels that a file imports are not the file's.
        self.own = source.file == reading.source.file

    def result(self) -> Parts:
        before = None
        while before != (self.stands_for, self.given):
            before = dict(self.stands_for), self.given
            for statement in self.function.body:
                self.run(statement)
        return self.given

    def note(self, name: str, action: str, node: Place) -> None:
        self.reading.uses.add(Use(name, action, self.source.file, node.lineno))

    def trouble(self, node: Place, text: str) -> None:
        if self.own:
            self.reading.troubles.add(Trouble(self.source.file, node.lineno, text))

    # Statements

    def run(self, node: ast.stmt) -> None:
        if type(node) in FOREIGN:
            self.trouble(node, f"a kernel has numbers, loops and fields of the record, not {FOREIGN[type(node)]}")
        elif isinstance(node, ast.Assign):
            self.assign_all(node.targets, node.value)
        elif isinstance(node, ast.AnnAssign):
            if node.value is not None:
                self.assign_all([node.target], node.value)
        elif isinstance(node, ast.AugAssign):
            self.value(node.value)
            self.change(node.target, OPERATORS.get(type(node.op), "other="))
        elif isinstance(node, ast.For):
            self.assign(node.target, self.inside(self.value(node.iter), 1, node))
        elif isinstance(node, ast.Return):
            self.given |= self.value(node.value) if node.value is not None else NOTHING
        else:
            for expression in ast.iter_child_nodes(node):
                if isinstance(expression, ast.expr):
                    self.value(expression)
        for block in ("body", "orelse"):
            for statement in getattr(node, block, []) if isinstance(node, (ast.For, ast.While, ast.If)) else []:
                self.run(statement)

    def assign_all(self, targets: list[ast.expr], value: ast.expr) -> None:
        for target in targets:
            if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple) and len(target.elts) == len(value.elts):
                for one, of_it in zip(target.elts, value.elts):
                    self.assign(one, self.value(of_it))
            else:
                self.assign(target, self.value(value))

    def assign(self, target: ast.expr, parts: Parts) -> None:
        if isinstance(target, ast.Name):
            self.stands_for[target.id] = self.stands_for.get(target.id, NOTHING) | parts
        elif isinstance(target, ast.Tuple):
            for one in target.elts:
                self.assign(one, self.inside(parts, 1, target))
        else:
            self.change(target, "=")

    def change(self, target: ast.expr, action: str) -> None:
        """A target other than a plain name, or one that is changed in place."""
        if isinstance(target, ast.Name):
            # An array changes in place, a number does not.
            for part in self.stands_for.get(target.id, NOTHING):
                if part.name and part.indices < self.reading.dimensions[part.name]:
                    self.note(part.name, action, target)
        elif isinstance(target, ast.Attribute):
            if Part() in self.value(target.value) and self.has_field(target):
                self.note(target.attr, action, target)
        elif isinstance(target, ast.Subscript):
            self.value(target.slice)
            for part in self.value(target.value):
                if part.name:
                    self.note(part.name, action, target)

    # Expressions

    def value(self, node: ast.expr) -> Parts:
        """What an expression stands for, reads noted on the way."""
        if type(node) in FOREIGN:
            self.trouble(node, f"a kernel has numbers, loops and fields of the record, not {FOREIGN[type(node)]}")
            return NOTHING
        if isinstance(node, ast.Name):
            if node.id not in self.known:
                self.trouble(node, f"{node.id} is not defined" + self.meant(node.id, self.known - set(dir(builtins))))
            return self.stands_for.get(node.id, NOTHING)
        if isinstance(node, ast.Attribute):
            return self.attribute(node)
        if isinstance(node, ast.Subscript):
            self.value(node.slice)
            taken = node.slice.elts if isinstance(node.slice, ast.Tuple) else [node.slice]
            return self.inside(self.value(node.value), sum(not isinstance(i, ast.Slice) for i in taken), node)
        if isinstance(node, ast.Call):
            return self.call(node)
        if isinstance(node, ast.IfExp):
            self.value(node.test)
            return self.value(node.body) | self.value(node.orelse)
        if isinstance(node, ast.Tuple):
            return frozenset().union(*(self.value(one) for one in node.elts))
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.expr):
                self.read_all(self.value(child), node)
        return NOTHING

    def has_field(self, node: ast.Attribute) -> bool:
        if node.attr in self.reading.dimensions:
            return True
        self.trouble(node, f"the record has no field {node.attr}" + self.meant(node.attr, self.reading.dimensions))
        return False

    def meant(self, name: str, known: Iterable[str]) -> str:
        """What was perhaps meant by a name that is not there, as the end of a message."""
        if name in self.reading.counts:
            return f"; how many there are is the length of a field: r.{self.reading.counts[name]}"
        if name == "math":
            return ": write import math at the head of the file"
        if name in OF_NUMPY:
            return f": kernels have no numpy; write import math at the head of the file and math.exp and the like, for {CALLED}"
        if hasattr(math, name) and not name.startswith("_"):
            return f": write import math at the head of the file, and math.{name} here"
        return nearest(name, known, 1)

    def attribute(self, node: ast.Attribute) -> Parts:
        parts = self.value(node.value)
        if Part() in parts:
            return self.inside(frozenset({Part(node.attr)}), 0, node) if self.has_field(node) else NOTHING
        if node.attr not in OF_ARRAYS:
            self.read_all(parts, node)
        if isinstance(node.value, ast.Name) and self.source.imports.get(node.value.id) == ("math", "") and not hasattr(math, node.attr):
            self.trouble(node, f"math has no {node.attr}" + nearest(node.attr, dir(math), 1))
        return NOTHING

    def inside(self, parts: Parts, indices: int, node: Place) -> Parts:
        """What is left of arrays after more indices; a number is read."""
        deeper = {Part(p.name, p.indices + indices) for p in parts if p.name}
        for part in deeper:
            if part.indices >= self.reading.dimensions[part.name]:
                self.note(part.name, "read", node)
        return frozenset(p for p in deeper if p.indices < self.reading.dimensions[p.name])

    def read_all(self, parts: Parts, node: Place) -> None:
        for part in parts:
            if part.name:
                self.note(part.name, "read", node)

    def call(self, node: ast.Call) -> Parts:
        arguments = [self.value(a) for a in node.args]
        named = {k.arg: self.value(k.value) for k in node.keywords}
        source, name = self.called(node.func)
        if source is None:
            if isinstance(node.func, ast.Name) and node.func.id == "len":
                return NOTHING
            self.look_at_module(node)
            for parts in [*arguments, *named.values()]:
                self.read_all(parts, node)
                if Part() in parts:
                    self.trouble(node, f"{ast.unparse(node.func)} gets the whole record and cannot be looked into")
            return NOTHING
        if not is_kernel(source.functions[name]):
            self.trouble(node, f"{name} is no kernel: write @kernel above it")
        parameters = [a.arg for a in source.functions[name].args.args]
        if len(arguments) + len(named) != len(parameters):
            self.trouble(node, f"{name} takes {len(parameters)} arguments ({', '.join(parameters)}), not {len(arguments) + len(named)}")
        rest = parameters[len(arguments) :]
        return self.reading.follow(source, name, (*arguments, *(named.get(p, NOTHING) for p in rest)))

    def look_at_module(self, node: ast.Call) -> None:
        """A call of an imported function that the compiler cannot follow."""
        first = node.func.value if isinstance(node.func, ast.Attribute) else node.func
        module = self.source.imports.get(first.id, ("math", ""))[0] if isinstance(first, ast.Name) else "math"
        if module != "math":
            self.trouble(node, f"{ast.unparse(node.func)} is no kernel, of {module}: {CALLED}")

    def called(self, function: ast.expr) -> tuple[Source | None, str]:
        """Where a called kernel stands; None for what is no kernel of ours."""
        source, name = None, ""
        if isinstance(function, ast.Name):
            self.value(function)
            source, name = self.source, function.id
            if name in source.imports:
                module, name = source.imports[name]
                source = imported_source(module)
        elif isinstance(function, ast.Attribute) and isinstance(function.value, ast.Name):
            self.value(function)
            module, attribute = self.source.imports.get(function.value.id, ("", "-"))
            source, name = imported_source(module) if module and not attribute else None, function.attr
        return (source, name) if source is not None and name in source.functions else (None, name)
