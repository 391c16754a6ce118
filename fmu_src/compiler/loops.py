"""Loops of a kernel: ``while``, and ``for`` over a range or a tuple of numbers."""

import ast

from fmu_src.compiler import arithmetic, elements, expressions
from fmu_src.compiler.function import Function, Loop
from fmu_src.compiler.types import INTEGER, Value, items_of


def repeat(e: Function, node: ast.While) -> None:
    head, body, other, end = (e.new_block(hint) for hint in ("while", "do", "else", "end"))
    e.go(head)
    e.start(head)
    e.branch(expressions.condition(e, node.test).parts[0], body, other)
    e.start(body)
    inner(e, node, Loop(head, end))
    e.start(other)
    e.statements(node.orelse)
    leave(e, end)


def inner(e: Function, node: ast.For | ast.While, loop: Loop) -> None:
    e.loops.append(loop)
    e.statements(node.body)
    e.loops.pop()
    if not e.ended:
        e.go(loop.onward)


def leave(e: Function, end: str) -> None:
    if not e.ended:
        e.go(end)
    e.start(end)


def count_through(e: Function, node: ast.For) -> None:
    """``for`` over range(...) or over a tuple of numbers."""
    items: list[Value] = []
    match node:
        case ast.For(target=ast.Name(id=name), iter=ast.Call(func=ast.Name(id="range"), args=limits, keywords=[])) if 1 <= len(limits) <= 3:
            first, last, step = limits_of(e, [e.number(e.expression(limit)) for limit in limits])
        case ast.For(target=ast.Name(id=name), iter=ast.Tuple() as items_node):
            items = items_of(e.expression(items_node))
            first, last, step = arithmetic.literal(0), arithmetic.literal(len(items)), 1
        case _:
            raise e.fault("kernels loop over range(...) or a tuple of numbers only")
    head, body, onward, other, end = (e.new_block(hint) for hint in ("for", "do", "next", "else", "end"))
    counter = e.slot("i64", f"{name}.counter")
    e.write(f"store i64 {first.parts[0]}, ptr {counter}")
    e.go(head)
    e.start(head)
    now = e.give(f"load i64, ptr {counter}")
    e.branch(e.give(f"icmp {'slt' if step > 0 else 'sgt'} i64 {now}, {last.parts[0]}"), body, other)
    e.start(body)
    down_to_zero = step < 0 and isinstance(last.constant, int) and last.constant >= -1
    count = Value(INTEGER, (now,), not_negative=down_to_zero or (step > 0 and first.not_negative))
    e.store_name(name, elements.item_by_number(e, items, count) if items else count)
    inner(e, node, Loop(onward, end))
    e.start(onward)
    before = e.give(f"load i64, ptr {counter}")
    e.write(f"store i64 {e.give(f'add nsw i64 {before}, {step}')}, ptr {counter}")
    e.go(head)
    e.start(other)
    e.statements(node.orelse)
    leave(e, end)


def limits_of(e: Function, values: list[Value]) -> tuple[Value, Value, int]:
    """(first, last, step) of a range."""
    if any(value.type != INTEGER for value in values):
        raise e.fault("range takes whole numbers; say int(...)")
    if len(values) == 1:
        return arithmetic.literal(0), values[0], 1
    step = values[2].constant if len(values) == 3 else 1
    if not isinstance(step, int) or step == 0:
        raise e.fault("the step of range must be a number other than 0, not a variable")
    return values[0], values[1], step
