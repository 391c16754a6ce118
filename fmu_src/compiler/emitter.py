"""One kernel for given argument types as LLVM code, in a single walk over its syntax tree.

Every local variable has one type, that of all its values together (a variable that gets
0 and later 0.5 holds numbers).  A walk that finds a variable wider than it had assumed is
done again; two walks do.  Variables stand in memory and LLVM makes registers of them.
"""

import ast
import builtins
import difflib
import types as python_types
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from fmu_src.arrays import field_of
from fmu_src.compiler import arithmetic
from fmu_src.compiler.source import Source
from fmu_src.compiler.types import (
    ELEMENTS,
    FLOAT,
    INTEGER,
    NOTHING,
    TRUTH,
    Array,
    Group,
    KernelFault,
    Layout,
    Number,
    Record,
    Records,
    Type,
    Value,
    joined,
)  # fmt: skip

BUILTINS = ("abs", "min", "max", "int", "float", "bool", "len")


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
class Emitter:
    """Walks one instance; ``variables`` and ``result`` are kept from walk to walk."""

    module: Surroundings
    instance: Instance
    variables: dict[str, Type] = field(default_factory=dict)
    result: Type | None = None
    # Counters that one of their loops starts below zero, or may.
    sometimes_negative: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        kernel = self.instance.kernel
        self.tree: ast.FunctionDef = kernel.tree
        self.file: str = kernel.file
        self.node: ast.AST = self.tree
        self.names = self.tree.args.args
        if len(self.names) != len(self.instance.arguments):
            raise self.fault(f"{kernel.name} takes {len(self.names)} arguments, not {len(self.instance.arguments)}")
        self.counters = only_counters(self.tree)

    def fault(self, text: str) -> KernelFault:
        line = getattr(self.node, "lineno", self.tree.lineno)
        return KernelFault(f"{self.file}:{line}: {text}")

    def define(self) -> str:
        """The definition of the function in LLVM's language."""
        for _ in range(8):
            try:
                return self.walk()
            except Wider:
                continue
        raise self.fault(f"the types of {self.instance.kernel.name} do not settle")

    def walk(self) -> str:
        self.lines: list[str] = []
        self.slots: list[str] = []
        self.places: dict[str, tuple[str, ...]] = {}
        self.count = 0
        self.block = "entry"
        self.loops: list[Loop] = []
        self.never_negative: set[str] = set()
        self.ended = False
        parameters = []
        for name, kind in zip(self.names, self.instance.arguments):
            operands = tuple(f"%{name.arg}.{i}" for i in range(len(kind.parts)))
            parameters += [f"{part} {operand}" for part, operand in zip(kind.parts, operands)]
            self.store_name(name.arg, Value(kind, operands))
        self.statements(self.tree.body)
        if not self.ended:
            self.give_back(Value(NOTHING, ()))
        if self.never_negative & self.sometimes_negative:
            raise Wider
        assert self.result is not None
        self.instance.result = self.result
        body = "\n".join(["entry:", *self.slots, *self.lines])
        return f"define internal {returned(self.result)} {self.instance.symbol}({', '.join(parameters)}) #0 {{\n{body}\n}}\n"

    # What is written.

    def write(self, line: str) -> None:
        if not self.ended:
            self.lines.append("  " + line)

    def give(self, instruction: str) -> str:
        """Writes an instruction; the name of its result."""
        self.count += 1
        name = f"%t{self.count}"
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

    def slot(self, kind: str) -> str:
        self.count += 1
        name = f"%s{self.count}"
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
            self.places[name] = tuple(self.slot(part) for part in known.parts)
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

    # Statements.

    def statements(self, body: list[ast.stmt]) -> None:
        for statement in body:
            if self.ended:
                # Behind return, break or continue; types are not looked for there.
                return
            self.statement(statement)

    def statement(self, node: ast.stmt) -> None:
        self.node = node
        match node:
            case ast.Expr(value=ast.Constant()) | ast.Pass():
                pass
            case ast.Expr(value=value):
                self.expression(value)
            case ast.Assign(targets=targets, value=value):
                given = self.expression(value)
                for target in targets:
                    self.assign(target, given)
            case ast.AnnAssign(target=target, value=value) if value is not None:
                self.assign(target, self.expression(value))
            case ast.AugAssign():
                self.add_to(node)
            case ast.Return(value=value):
                self.give_back(self.expression(value) if value is not None else Value(NOTHING, ()))
            case ast.If():
                self.choose(node)
            case ast.For():
                self.count_through(node)
            case ast.While():
                self.repeat(node)
            case ast.Break() | ast.Continue():
                self.go(self.loops[-1].end if isinstance(node, ast.Break) else self.loops[-1].onward)
            case _:
                raise self.fault(f"kernels have no {type(node).__name__.lower()}; they are made of assignments, if, for, while and return")

    def assign(self, target: ast.expr, value: Value) -> None:
        match target:
            case ast.Name(id=name):
                self.store_name(name, value)
            case ast.Tuple(elts=targets):
                if not isinstance(value.type, Group) or len(value.type.items) != len(targets):
                    raise self.fault(f"{value.type} cannot be laid into {len(targets)} names")
                for inner, item in zip(targets, items_of(value)):
                    self.assign(inner, item)
            case _:
                place, kind = self.place(target)
                self.store(place, kind, value)

    def store(self, place: str, kind: Number, value: Value) -> None:
        if not isinstance(value.type, Number):
            raise self.fault(f"{value.type} cannot be stored in a field or element that holds {kind}")
        if kind == INTEGER and value.type == FLOAT:
            raise self.fault("a number with a fraction cannot be stored in a whole-number field; say int(...)")
        (part,) = arithmetic.converted(self, value, kind).parts
        self.write(f"store {kind.llvm} {part}, ptr {place}, align 8")

    def add_to(self, node: ast.AugAssign) -> None:
        if isinstance(node.target, ast.Name):
            before = self.load_name(node.target.id)
            self.assign(node.target, self.number(arithmetic.binary(self, node.op, self.number(before), self.number(self.expression(node.value)))))
            return
        place, kind = self.place(node.target)
        before = Value(kind, (self.give(f"load {kind.llvm}, ptr {place}, align 8"),))
        self.store(place, kind, arithmetic.binary(self, node.op, before, self.number(self.expression(node.value))))

    def give_back(self, value: Value) -> None:
        if self.result is None:
            self.result = value.type
        else:
            wider = joined(self.result, value.type)
            if wider is None:
                raise self.fault(f"{self.instance.kernel.name} returns {value.type} here and {self.result} elsewhere")
            if wider != self.result:
                self.result = wider
                raise Wider
        value = self.cast(value, self.result)
        parts = self.result.parts
        if not parts:
            self.write("ret void")
        elif len(parts) == 1:
            self.write(f"ret {parts[0]} {value.parts[0]}")
        else:
            whole = "poison"
            for i, (kind, part) in enumerate(zip(parts, value.parts)):
                whole = self.give(f"insertvalue {returned(self.result)} {whole}, {kind} {part}, {i}")
            self.write(f"ret {returned(self.result)} {whole}")
        self.ended = True

    def choose(self, node: ast.If) -> None:
        test = self.test(node.test)
        if test.constant is not None:
            self.statements(node.body if test.constant else node.orelse)
            return
        yes, no, end = self.new_block("yes"), self.new_block("no"), self.new_block("end")
        self.branch(test.parts[0], yes, no if node.orelse else end)
        reached = not node.orelse
        for block, body in ((yes, node.body), (no, node.orelse)):
            if not body:
                continue
            self.start(block)
            self.statements(body)
            if not self.ended:
                self.go(end)
                reached = True
        if reached:
            self.start(end)

    def repeat(self, node: ast.While) -> None:
        head, body, other, end = (self.new_block(hint) for hint in ("while", "do", "else", "end"))
        self.go(head)
        self.start(head)
        self.branch(self.test(node.test).parts[0], body, other)
        self.start(body)
        self.inner(node, Loop(head, end))
        self.start(other)
        self.statements(node.orelse)
        self.leave(end)

    def inner(self, node: ast.For | ast.While, loop: Loop) -> None:
        self.loops.append(loop)
        self.statements(node.body)
        self.loops.pop()
        if not self.ended:
            self.go(loop.onward)

    def leave(self, end: str) -> None:
        if not self.ended:
            self.go(end)
        self.start(end)

    def count_through(self, node: ast.For) -> None:
        """``for`` over range(...) or over a tuple of numbers."""
        items: list[Value] = []
        match node:
            case ast.For(target=ast.Name(id=name), iter=ast.Call(func=ast.Name(id="range"), args=limits, keywords=[])) if 1 <= len(limits) <= 3:
                first, last, step = self.limits_of([self.number(self.expression(limit)) for limit in limits])
            case ast.For(target=ast.Name(id=name), iter=ast.Tuple() as items_node):
                items = items_of(self.expression(items_node))
                first, last, step = arithmetic.literal(0), arithmetic.literal(len(items)), 1
            case _:
                raise self.fault("kernels loop over range(...) or a tuple of numbers only")
        if items or step < 0 or not first.not_negative:
            self.sometimes_negative.add(name)
        elif name in self.counters and name not in self.sometimes_negative:
            self.never_negative.add(name)
        head, body, onward, other, end = (self.new_block(hint) for hint in ("for", "do", "next", "else", "end"))
        counter = self.slot("i64")
        self.write(f"store i64 {first.parts[0]}, ptr {counter}")
        self.go(head)
        self.start(head)
        now = self.give(f"load i64, ptr {counter}")
        self.branch(self.give(f"icmp {'slt' if step > 0 else 'sgt'} i64 {now}, {last.parts[0]}"), body, other)
        self.start(body)
        count = Value(INTEGER, (now,), not_negative=True)
        self.store_name(name, self.item_by_number(items, count) if items else count)
        self.inner(node, Loop(onward, end))
        self.start(onward)
        before = self.give(f"load i64, ptr {counter}")
        self.write(f"store i64 {self.give(f'add nsw i64 {before}, {step}')}, ptr {counter}")
        self.go(head)
        self.start(other)
        self.statements(node.orelse)
        self.leave(end)

    def limits_of(self, values: list[Value]) -> tuple[Value, Value, int]:
        """(first, last, step) of a range."""
        if any(value.type != INTEGER for value in values):
            raise self.fault("range takes whole numbers; say int(...)")
        if len(values) == 1:
            return arithmetic.literal(0), values[0], 1
        step = values[2].constant if len(values) == 3 else 1
        if not isinstance(step, int) or step == 0:
            raise self.fault("the step of range must be a number other than 0, not a variable")
        return values[0], values[1], step

    # Expressions.

    def number(self, value: Value) -> Value:
        if not isinstance(value.type, Number):
            raise self.fault(f"{value.type} stands where a number is needed")
        return value

    def test(self, node: ast.expr) -> Value:
        if isinstance(node, ast.BoolOp):
            return self.both_or_either(node, self.test)
        return arithmetic.truth(self, self.number(self.expression(node)))

    def expression(self, node: ast.expr) -> Value:
        match node:
            case ast.Constant(value=bool() | int() | float() as number):
                return arithmetic.literal(number)
            case ast.Name(id=name):
                return self.named(name)
            case ast.Tuple(elts=elements):
                return together([self.expression(element) for element in elements])
            case ast.BinOp(left=left, op=op, right=right):
                first = self.number(self.expression(left))
                return arithmetic.binary(self, op, first, self.number(self.expression(right)))
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return arithmetic.negative(self, self.number(self.expression(operand)))
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return self.number(self.expression(operand))
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                test = self.test(operand)
                if test.constant is not None:
                    return arithmetic.literal(not test.constant)
                return Value(TRUTH, (self.give(f"xor i1 {test.parts[0]}, true"),))
            case ast.Compare():
                return self.compare(node)
            case ast.BoolOp():
                return self.both_or_either(node, self.truth_alone)
            case ast.IfExp(test=test, body=body, orelse=orelse):
                return self.either(self.test(test), body, orelse)
            case ast.Call():
                return self.call(node)
            case ast.Attribute():
                return self.attribute(node)
            case ast.Subscript():
                return self.subscript(node)
        raise self.fault(f"kernels have no {type(node).__name__}: {ast.unparse(node)}")

    def named(self, name: str) -> Value:
        if name in self.variables:
            return self.load_name(name)
        if name in self.instance.kernel.local_names:
            raise self.fault(f"{name} is used before it has a value")
        return self.constant(self.outer(name), name)

    def outer(self, name: str) -> Any:
        """What a name means outside of the function."""
        found = self.instance.kernel.outer(name)
        if found is None and not hasattr(builtins, name):
            known = [*self.variables, *self.instance.kernel.function.__globals__]
            raise self.fault(f"there is no {name}{nearest(name, known)}")
        return found

    def constant(self, value: Any, text: str) -> Value:
        if isinstance(value, (bool, int, float, np.integer, np.floating)):
            number = value.item() if isinstance(value, np.generic) else value
            self.module.note_constant(self.instance.kernel, text, number)
            return arithmetic.literal(number)
        if isinstance(value, tuple):
            return together([self.constant(item, f"{text}[{i}]") for i, item in enumerate(value)])
        raise self.fault(f"{text} is {type(value).__name__}; kernels take numbers and tuples of numbers from outside")

    def compare(self, node: ast.Compare) -> Value:
        left = self.number(self.expression(node.left))
        right = self.number(self.expression(node.comparators[0]))
        result = arithmetic.comparison(self, node.ops[0], left, right)
        for op, comparator in zip(node.ops[1:], node.comparators[1:]):
            left, right = right, self.number(self.expression(comparator))
            following = arithmetic.comparison(self, op, left, right)
            result = Value(TRUTH, (self.give(f"and i1 {result.parts[0]}, {following.parts[0]}"),))
        return result

    def truth_alone(self, node: ast.expr) -> Value:
        value = self.number(self.expression(node))
        if value.type != TRUTH:
            raise self.fault("and, or of numbers would give one of the numbers in Python, and true or false in a kernel; write x != 0.0")
        return value

    def both_or_either(self, node: ast.BoolOp, look: Callable[[ast.expr], Value]) -> Value:
        """``and`` and ``or`` of what ``look`` sees as tests; what comes later is looked at only if it matters."""
        ends_with = "false" if isinstance(node.op, ast.And) else "true"
        end, arrivals = self.new_block("end"), []
        for i, part in enumerate(node.values):
            test = look(part).parts[0]
            if i == len(node.values) - 1:
                arrivals.append(f"[ {test}, %{self.block} ]")
                self.go(end)
                break
            onward = self.new_block("and" if ends_with == "false" else "or")
            arrivals.append(f"[ {ends_with}, %{self.block} ]")
            self.branch(test, *((onward, end) if ends_with == "false" else (end, onward)))
            self.start(onward)
        self.start(end)
        return Value(TRUTH, (self.give(f"phi i1 {', '.join(arrivals)}"),))

    def either(self, test: Value, body: ast.expr, orelse: ast.expr) -> Value:
        if test.constant is not None:
            return self.expression(body if test.constant else orelse)
        yes, no, end = self.new_block("yes"), self.new_block("no"), self.new_block("end")
        # What both give is known only after both are written: they end in blocks of their own.
        self.branch(test.parts[0], yes, no)
        given = []
        for block, node in ((yes, body), (no, orelse)):
            self.start(block)
            value = self.expression(node)
            given.append((value, self.block, len(self.lines)))
            self.ended = True
        kind = joined(given[0][0].type, given[1][0].type)
        if kind is None:
            raise self.fault(f"one side of the choice is {given[0][0].type}, the other {given[1][0].type}")
        tail = self.lines[given[0][2] :]
        del self.lines[given[0][2] :]
        arrivals = []
        for (value, block, _), rest in zip(given, (tail, [])):
            self.block, self.ended = block, False
            value = self.cast(value, kind)
            arrivals.append((value.parts, block))
            self.go(end)
            self.lines += rest
        self.start(end)
        parts = tuple(
            self.give(f"phi {part} {', '.join(f'[ {parts[i]}, %{block} ]' for parts, block in arrivals)}")
            for i, part in enumerate(kind.parts)
        )
        return Value(kind, parts, not_negative=all(value.not_negative for value, _, _ in given))

    def call(self, node: ast.Call) -> Value:
        if node.keywords:
            raise self.fault("kernels are called with plain arguments, without names")
        name = node.func.id if isinstance(node.func, ast.Name) else None
        function = self.callee(node.func)
        # A name of the module stands before a builtin one.
        if name in BUILTINS and function is getattr(builtins, name):
            return self.builtin(name, [self.expression(argument) for argument in node.args])
        if isinstance(function, python_types.BuiltinFunctionType) and function.__module__ == "math":
            return arithmetic.of_math(self, function.__name__, [self.number(self.expression(a)) for a in node.args])
        if not isinstance(function, Source):
            raise self.fault(f"{ast.unparse(node.func)} is no kernel; kernels call kernels, math, {', '.join(BUILTINS)}")
        return self.call_kernel(function, [self.expression(argument) for argument in node.args])

    def callee(self, node: ast.expr) -> Any:
        if isinstance(node, ast.Name):
            found = self.outer(node.id)
            return getattr(builtins, node.id, None) if found is None else found
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            owner = self.outer(node.value.id)
            if isinstance(owner, python_types.ModuleType) and hasattr(owner, node.attr):
                return getattr(owner, node.attr)
            if isinstance(owner, python_types.ModuleType):
                raise self.fault(f"{node.value.id} has no {node.attr}{nearest(node.attr, dir(owner))}")
        raise self.fault(f"{ast.unparse(node)} cannot be called in a kernel")

    def call_kernel(self, kernel: Source, values: list[Value]) -> Value:
        if kernel.is_entry:
            values = [arithmetic.converted(self, value, FLOAT) if isinstance(value.type, Number) else value for value in values]
        callee = self.module.instance(kernel, tuple(value.type for value in values), is_called=True)
        taken = 1 if callee.is_separate else None
        arguments = ", ".join(f"{kind} {part}" for value in values for kind, part in list(zip(value.type.parts, value.parts))[:taken])
        result = callee.result
        if result is None:
            raise self.fault(f"{kernel.name} calls itself")
        if not result.parts:
            self.write(f"call void {callee.symbol}({arguments})")
            return Value(result, ())
        whole = self.give(f"call {returned(result)} {callee.symbol}({arguments})")
        if len(result.parts) == 1:
            return Value(result, (whole,))
        return Value(result, tuple(self.give(f"extractvalue {returned(result)} {whole}, {i}") for i in range(len(result.parts))))

    def builtin(self, name: str, values: list[Value]) -> Value:
        if name == "len":
            (value,) = values
            if isinstance(value.type, Group):
                return arithmetic.literal(len(value.type.items))
            return items_of(self.extents(value))[0]
        numbers = [self.number(value) for value in values]
        if name in ("min", "max"):
            if len(numbers) < 2:
                raise self.fault(f"{name} takes two numbers or more")
            return arithmetic.extreme(self, numbers, name == "max")
        if len(numbers) != 1:
            raise self.fault(f"{name} takes one number")
        if name == "abs":
            return arithmetic.absolute(self, numbers[0])
        return arithmetic.converted(self, numbers[0], {"int": INTEGER, "float": FLOAT, "bool": TRUTH}[name])

    # Records and arrays.

    def attribute(self, node: ast.Attribute) -> Value:
        if isinstance(node.value, ast.Name) and node.value.id not in self.variables:
            owner = self.outer(node.value.id)
            if isinstance(owner, python_types.ModuleType):
                if not hasattr(owner, node.attr):
                    raise self.fault(f"{node.value.id} has no {node.attr}{nearest(node.attr, dir(owner))}")
                return self.constant(getattr(owner, node.attr), ast.unparse(node))
        value = self.expression(node.value)
        if node.attr == "shape" and isinstance(value.type, (Array, Records)):
            return self.extents(value)
        place, kind, shape = self.field(value, node.attr)
        if isinstance(kind, Layout):
            return Value(Records(kind) if isinstance(value.type, Records) else Record(kind), (place, *value.parts[1:]))
        if shape:
            return Value(Array(kind, len(shape)), (place, *map(str, shape)))
        return Value(kind, (self.give(f"load {kind.llvm}, ptr {place}, align 8"),))

    def field(self, value: Value, name: str) -> tuple[str, Number | Layout, tuple[int, ...]]:
        """Address of a record's field, what it holds, and its shape."""
        if not isinstance(value.type, (Record, Records)):
            raise self.fault(f"{value.type} has no .{name}")
        layout = value.type.layout
        names = layout.dtype.names or ()
        if name not in names:
            raise self.fault(f"the record has no {name}{nearest(name, list(names))}")
        dtype, offset = field_of(layout.dtype, name)
        base, shape = dtype.subdtype or (dtype, ())
        place = value.parts[0] if offset == 0 else self.give(f"getelementptr inbounds i8, ptr {value.parts[0]}, i64 {offset}")
        if base.names:
            return place, self.module.layout(base), shape
        if isinstance(value.type, Records):
            raise self.fault(f"{name} of all records at once: take one of them first, records[0].{name}")
        if base.str[1:] not in ELEMENTS:
            raise self.fault(f"{name} holds {base}; kernels know 64-bit numbers and integers only")
        return place, ELEMENTS[base.str[1:]], shape

    def extents(self, value: Value) -> Value:
        if not isinstance(value.type, (Array, Records)):
            raise self.fault(f"{value.type} has no extents")
        return together([Value(INTEGER, (part,), int(part) if part.isdigit() else None, True) for part in value.parts[1:]])

    def subscript(self, node: ast.Subscript) -> Value:
        value = self.expression(node.value)
        if isinstance(value.type, Group):
            return self.of_group(value, node.slice)
        if isinstance(value.type, Records):
            index = self.index(self.expression(node.slice), value.parts[1])
            step = value.type.layout.dtype.itemsize
            offset = self.give(f"mul i64 {index}, {step}")
            return Value(Record(value.type.layout), (self.give(f"getelementptr inbounds i8, ptr {value.parts[0]}, i64 {offset}"),))
        part, kind = self.element(value, node.slice)
        if isinstance(kind, Array):
            return part
        return Value(kind, (self.give(f"load {kind.llvm}, ptr {part.parts[0]}, align 8"),))

    def of_group(self, value: Value, index: ast.expr) -> Value:
        items = items_of(value)

        def known(node: ast.expr | None) -> int | None:
            if node is None:
                return None
            constant = self.expression(node).constant
            if not isinstance(constant, int):
                raise self.fault("an item of a tuple is taken by a number, not by a variable")
            return constant

        if isinstance(index, ast.Slice):
            return together(items[known(index.lower) : known(index.upper) : known(index.step)])
        chosen = self.expression(index)
        if chosen.constant is None:
            return self.item_by_number(items, chosen)
        place = known(index)
        assert place is not None
        if not -len(items) <= place < len(items):
            raise self.fault(f"the tuple has {len(items)} items, there is no {place}")
        return items[place]

    def item_by_number(self, items: list[Value], chosen: Value) -> Value:
        """An item of a short table of numbers."""
        index = self.index(chosen, str(len(items)))
        kind = FLOAT if any(item.type == FLOAT for item in items) else INTEGER
        numbers = [arithmetic.converted(self, self.number(item), kind).parts[0] for item in items]
        found = numbers[0]
        for i, number in enumerate(numbers[1:], 1):
            found = self.give(f"select i1 {self.give(f'icmp eq i64 {index}, {i}')}, {kind.llvm} {number}, {kind.llvm} {found}")
        return Value(kind, (found,), not_negative=all(item.not_negative for item in items))

    def element(self, value: Value, index: ast.expr) -> tuple[Value, Number | Array]:
        """(address or row, what it is) of an element or row of an array."""
        if not isinstance(value.type, Array):
            raise self.fault(f"{value.type} has no elements")
        nodes = index.elts if isinstance(index, ast.Tuple) else [index]
        if any(isinstance(node, ast.Slice) for node in nodes):
            raise self.fault("kernels take elements and rows of arrays, no slices; write a loop")
        extents = value.parts[1:]
        if len(nodes) > len(extents):
            raise self.fault(f"{value.type} takes {len(extents)} indices, not {len(nodes)}")
        indices = [self.index(self.expression(node), extent) for node, extent in zip(nodes, extents)]
        place = indices[0]
        for i in range(1, len(extents)):
            place = self.times(place, extents[i])
            if i < len(indices):
                place = self.give(f"add nsw i64 {place}, {indices[i]}")
        address = self.give(f"getelementptr inbounds {value.type.element.llvm}, ptr {value.parts[0]}, i64 {place}")
        if len(indices) == len(extents):
            return Value(value.type.element, (address,)), value.type.element
        row = Array(value.type.element, len(extents) - len(indices))
        return Value(row, (address, *extents[len(indices) :])), row

    def times(self, place: str, extent: str) -> str:
        if place.isdigit() and extent.isdigit():
            return str(int(place) * int(extent))
        return self.give(f"mul nsw i64 {place}, {extent}")

    def index(self, value: Value, extent: str) -> str:
        """The index counted from the front: a negative one counts from the end."""
        if value.type not in (INTEGER, TRUTH):
            raise self.fault(f"an index must be a whole number, not {value.type}; say int(...)")
        (part,) = arithmetic.converted(self, value, INTEGER).parts
        if value.constant is not None and value.constant < 0:
            return self.give(f"add i64 {extent}, {part}")
        if value.not_negative:
            return part
        is_negative = self.give(f"icmp slt i64 {part}, 0")
        return self.give(f"select i1 {is_negative}, i64 {self.give(f'add i64 {part}, {extent}')}, i64 {part}")

    def place(self, target: ast.expr) -> tuple[str, Number]:
        """Address of a field or element that is assigned to, and what it holds."""
        match target:
            case ast.Attribute(value=owner, attr=name):
                place, kind, shape = self.field(self.expression(owner), name)
                if shape or isinstance(kind, Layout):
                    raise self.fault(f"{name} is an array; assign its elements in a loop")
                return place, kind
            case ast.Subscript(value=owner, slice=index):
                part, element = self.element(self.expression(owner), index)
                if isinstance(element, Array):
                    raise self.fault("a row cannot be assigned; assign its elements in a loop")
                return part.parts[0], element
        raise self.fault(f"{ast.unparse(target)} cannot be assigned in a kernel")


def items_of(value: Value) -> list[Value]:
    """The items of a tuple; what is known of whole numbers goes with them."""
    assert isinstance(value.type, Group)
    items, start = [], 0
    for kind in value.type.items:
        parts = value.parts[start : start + len(kind.parts)]
        start += len(parts)
        constant = None
        if kind == INTEGER and parts[0].lstrip("-").isdigit():
            constant = int(parts[0])
        items.append(Value(kind, parts, constant, constant is not None and constant >= 0))
    return items


def together(items: list[Value]) -> Value:
    return Value(Group(tuple(item.type for item in items)), tuple(part for item in items for part in item.parts))


def returned(kind: Type) -> str:
    """LLVM's type of a result."""
    if len(kind.parts) <= 1:
        return kind.parts[0] if kind.parts else "void"
    return "{ " + ", ".join(kind.parts) + " }"


def nearest(name: str, known: list[str]) -> str:
    close = difflib.get_close_matches(name, known, 3)
    return f"; did you mean {', '.join(close)}?" if close else ""


def only_counters(tree: ast.FunctionDef) -> set[str]:
    """Names that get their values from ``for`` alone, and are no arguments."""
    counters = {node.target.id for node in ast.walk(tree) if isinstance(node, ast.For) and isinstance(node.target, ast.Name)}
    stored = [node.id for node in ast.walk(tree) if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)]
    loops = [node.target.id for node in ast.walk(tree) if isinstance(node, ast.For) and isinstance(node.target, ast.Name)]
    arguments = {argument.arg for argument in tree.args.args}
    return {name for name in counters - arguments if stored.count(name) == loops.count(name)}
