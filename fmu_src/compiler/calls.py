"""Calls in a kernel: of other kernels, of ``math`` and of the builtin functions that kernels have."""

import ast
import builtins
import types as python_types
from typing import Any

from fmu_src.compiler import arithmetic, elements, names
from fmu_src.compiler.function import Function
from fmu_src.compiler.source import Source
from fmu_src.compiler.types import FLOAT, INTEGER, TRUTH, Group, Number, Value, items_of, returned

BUILTINS = ("abs", "min", "max", "int", "float", "bool", "len")


def call(e: Function, node: ast.Call) -> Value:
    if node.keywords:
        raise e.fault("kernels are called with plain arguments, without names")
    name = node.func.id if isinstance(node.func, ast.Name) else None
    function = callee(e, node.func)
    # A name of the module stands before a builtin one.
    if name in BUILTINS and function is getattr(builtins, name):
        return builtin(e, name, [e.expression(argument) for argument in node.args])
    if isinstance(function, python_types.BuiltinFunctionType) and function.__module__ == "math":
        return arithmetic.of_math(e, function.__name__, [e.number(e.expression(a)) for a in node.args])
    if not isinstance(function, Source):
        raise e.fault(f"{ast.unparse(node.func)} is no kernel; kernels call kernels, math, {', '.join(BUILTINS)}")
    return call_kernel(e, function, [e.expression(argument) for argument in node.args])


def callee(e: Function, node: ast.expr) -> Any:
    if isinstance(node, ast.Name):
        found = names.outer(e, node.id)
        return getattr(builtins, node.id, None) if found is None else found
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        owner = names.outer(e, node.value.id)
        if isinstance(owner, python_types.ModuleType):
            return names.in_module(e, owner, node.value.id, node.attr)
    raise e.fault(f"{ast.unparse(node)} cannot be called in a kernel")


def call_kernel(e: Function, kernel: Source, values: list[Value]) -> Value:
    if kernel.is_entry:
        values = [arithmetic.converted(e, value, FLOAT) if isinstance(value.type, Number) else value for value in values]
    called = e.module.instance(kernel, tuple(value.type for value in values), is_called=True)
    taken = 1 if called.is_separate else None
    arguments = ", ".join(f"{kind} {part}" for value in values for kind, part in list(zip(value.type.parts, value.parts))[:taken])
    result = called.result
    if result is None:
        raise e.fault(f"{kernel.name} calls itself")
    if not result.parts:
        e.write(f"call void {called.symbol}({arguments})")
        return Value(result, ())
    whole = e.give(f"call {returned(result)} {called.symbol}({arguments})")
    if len(result.parts) == 1:
        return Value(result, (whole,))
    return Value(result, tuple(e.give(f"extractvalue {returned(result)} {whole}, {i}") for i in range(len(result.parts))))


def builtin(e: Function, name: str, values: list[Value]) -> Value:
    if name == "len":
        (value,) = values
        if isinstance(value.type, Group):
            return arithmetic.literal(len(value.type.items))
        return items_of(elements.extents(e, value))[0]
    numbers = [e.number(value) for value in values]
    if name in ("min", "max"):
        if len(numbers) < 2:
            raise e.fault(f"{name} takes two numbers or more")
        return arithmetic.extreme(e, numbers, name == "max")
    if len(numbers) != 1:
        raise e.fault(f"{name} takes one number")
    if name == "abs":
        return arithmetic.absolute(e, numbers[0])
    return arithmetic.converted(e, numbers[0], {"int": INTEGER, "float": FLOAT, "bool": TRUTH}[name])
