"""Expressions of a kernel: Python's operators, comparisons, ``and``, ``or`` and choices."""

import ast
from collections.abc import Callable

from fmu_src.compiler import arithmetic, calls, elements, names
from fmu_src.compiler.function import Function
from fmu_src.compiler.types import TRUTH, Value, joined, together


def condition(e: Function, node: ast.expr) -> Value:
    if isinstance(node, ast.BoolOp):
        return both_or_either(e, node, condition)
    return arithmetic.truth(e, e.number(e.expression(node)))


def expression(e: Function, node: ast.expr) -> Value:
    match node:
        case ast.Constant(value=bool() | int() | float() as number):
            return arithmetic.literal(number)
        case ast.Name(id=name):
            return names.named(e, name)
        case ast.Tuple(elts=items):
            return together([e.expression(item) for item in items])
        case ast.BinOp(left=left, op=op, right=right):
            first = e.number(e.expression(left))
            return arithmetic.binary(e, op, first, e.number(e.expression(right)))
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return arithmetic.negative(e, e.number(e.expression(operand)))
        case ast.UnaryOp(op=ast.UAdd(), operand=operand):
            return e.number(e.expression(operand))
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            test = condition(e, operand)
            if test.constant is not None:
                return arithmetic.literal(not test.constant)
            return Value(TRUTH, (e.give(f"xor i1 {test.parts[0]}, true"),))
        case ast.Compare():
            return compare(e, node)
        case ast.BoolOp():
            return both_or_either(e, node, truth_alone)
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return either(e, condition(e, test), body, orelse)
        case ast.Call():
            return calls.call(e, node)
        case ast.Attribute():
            return elements.attribute(e, node)
        case ast.Subscript():
            return elements.subscript(e, node)
    raise e.fault(f"kernels have no {type(node).__name__}: {ast.unparse(node)}")


def compare(e: Function, node: ast.Compare) -> Value:
    left = e.number(e.expression(node.left))
    right = e.number(e.expression(node.comparators[0]))
    result = arithmetic.comparison(e, node.ops[0], left, right)
    for op, comparator in zip(node.ops[1:], node.comparators[1:]):
        left, right = right, e.number(e.expression(comparator))
        following = arithmetic.comparison(e, op, left, right)
        result = Value(TRUTH, (e.give(f"and i1 {result.parts[0]}, {following.parts[0]}"),))
    return result


def truth_alone(e: Function, node: ast.expr) -> Value:
    value = e.number(e.expression(node))
    if value.type != TRUTH:
        raise e.fault("and, or of numbers would give one of the numbers in Python, and true or false in a kernel; write x != 0.0")
    return value


def both_or_either(e: Function, node: ast.BoolOp, look: Callable[[Function, ast.expr], Value]) -> Value:
    """``and`` and ``or`` of what ``look`` sees as tests; what comes later is looked at only if it matters."""
    ends_with = "false" if isinstance(node.op, ast.And) else "true"
    end, arrivals = e.new_block("end"), []
    for i, part in enumerate(node.values):
        test = look(e, part).parts[0]
        if i == len(node.values) - 1:
            arrivals.append(f"[ {test}, %{e.block} ]")
            e.go(end)
            break
        onward = e.new_block("and" if ends_with == "false" else "or")
        arrivals.append(f"[ {ends_with}, %{e.block} ]")
        e.branch(test, *((onward, end) if ends_with == "false" else (end, onward)))
        e.start(onward)
    e.start(end)
    return Value(TRUTH, (e.give(f"phi i1 {', '.join(arrivals)}"),))


def either(e: Function, test: Value, body: ast.expr, orelse: ast.expr) -> Value:
    if test.constant is not None:
        return e.expression(body if test.constant else orelse)
    yes, no, end = e.new_block("yes"), e.new_block("no"), e.new_block("end")
    # What both give is known only after both are written: they end in blocks of their own.
    e.branch(test.parts[0], yes, no)
    given = []
    for block, node in ((yes, body), (no, orelse)):
        e.start(block)
        value = e.expression(node)
        given.append((value, e.block, len(e.lines)))
        e.ended = True
    kind = joined(given[0][0].type, given[1][0].type)
    if kind is None:
        raise e.fault(f"one side of the choice is {given[0][0].type}, the other {given[1][0].type}")
    tail = e.lines[given[0][2] :]
    del e.lines[given[0][2] :]
    arrivals = []
    for (value, block, _), rest in zip(given, (tail, [])):
        e.block, e.ended = block, False
        value = e.cast(value, kind)
        arrivals.append((value.parts, block))
        e.go(end)
        e.lines += rest
    e.start(end)
    parts = tuple(
        e.give(f"phi {part} {', '.join(f'[ {parts[i]}, %{block} ]' for parts, block in arrivals)}")
        for i, part in enumerate(kind.parts)
    )
    return Value(kind, parts, not_negative=all(value.not_negative for value, _, _ in given))
