"""Statements of a kernel: assignments, ``return`` and ``if``; loops stand in ``loops``."""

import ast

from fmu_src.compiler import arithmetic, elements, expressions, loops
from fmu_src.compiler.function import Function, Wider
from fmu_src.compiler.types import FLOAT, INTEGER, NOTHING, Group, Number, Value, items_of, joined, returned


def statements(e: Function, body: list[ast.stmt]) -> None:
    for node in body:
        if e.ended:
            # Behind return, break or continue; types are not looked for there.
            return
        statement(e, node)


def statement(e: Function, node: ast.stmt) -> None:
    e.node = node
    match node:
        case ast.Expr(value=ast.Constant()) | ast.Pass():
            pass
        case ast.Expr(value=value):
            e.expression(value)
        case ast.Assign(targets=targets, value=value):
            given = e.expression(value)
            for target in targets:
                assign(e, target, given)
        case ast.AnnAssign(target=target, value=value) if value is not None:
            assign(e, target, e.expression(value))
        case ast.AugAssign():
            add_to(e, node)
        case ast.Return(value=value):
            give_back(e, e.expression(value) if value is not None else Value(NOTHING, ()))
        case ast.If():
            choose(e, node)
        case ast.For():
            loops.count_through(e, node)
        case ast.While():
            loops.repeat(e, node)
        case ast.Break() | ast.Continue():
            e.go(e.loops[-1].end if isinstance(node, ast.Break) else e.loops[-1].onward)
        case _:
            raise e.fault(f"kernels have no {type(node).__name__.lower()}; they are made of assignments, if, for, while and return")


def assign(e: Function, target: ast.expr, value: Value) -> None:
    match target:
        case ast.Name(id=name):
            e.store_name(name, value)
        case ast.Tuple(elts=targets):
            if not isinstance(value.type, Group) or len(value.type.items) != len(targets):
                raise e.fault(f"{value.type} cannot be laid into {len(targets)} names")
            for inner, item in zip(targets, items_of(value)):
                assign(e, inner, item)
        case _:
            place, kind = elements.place_of(e, target)
            store(e, place, kind, value)


def store(e: Function, place: str, kind: Number, value: Value) -> None:
    if not isinstance(value.type, Number):
        raise e.fault(f"{value.type} cannot be stored in a field or element that holds {kind}")
    if kind == INTEGER and value.type == FLOAT:
        raise e.fault("a number with a fraction cannot be stored in a whole-number field; say int(...)")
    (part,) = arithmetic.converted(e, value, kind).parts
    e.write(f"store {kind.llvm} {part}, ptr {place}, align 8")


def add_to(e: Function, node: ast.AugAssign) -> None:
    if isinstance(node.target, ast.Name):
        before = e.load_name(node.target.id)
        assign(e, node.target, e.number(arithmetic.binary(e, node.op, e.number(before), e.number(e.expression(node.value)))))
        return
    place, kind = elements.place_of(e, node.target)
    before = Value(kind, (e.give(f"load {kind.llvm}, ptr {place}, align 8"),))
    store(e, place, kind, arithmetic.binary(e, node.op, before, e.number(e.expression(node.value))))


def give_back(e: Function, value: Value) -> None:
    if e.result is None:
        e.result = value.type
    else:
        wider = joined(e.result, value.type)
        if wider is None:
            raise e.fault(f"{e.instance.kernel.name} returns {value.type} here and {e.result} elsewhere")
        if wider != e.result:
            e.result = wider
            raise Wider
    value = e.cast(value, e.result)
    parts = e.result.parts
    if not parts:
        e.write("ret void")
    elif len(parts) == 1:
        e.write(f"ret {parts[0]} {value.parts[0]}")
    else:
        whole = "poison"
        for i, (kind, part) in enumerate(zip(parts, value.parts)):
            whole = e.give(f"insertvalue {returned(e.result)} {whole}, {kind} {part}, {i}")
        e.write(f"ret {returned(e.result)} {whole}")
    e.ended = True


def choose(e: Function, node: ast.If) -> None:
    test = expressions.condition(e, node.test)
    if test.constant is not None:
        e.statements(node.body if test.constant else node.orelse)
        return
    yes, no, end = e.new_block("yes"), e.new_block("no"), e.new_block("end")
    e.branch(test.parts[0], yes, no if node.orelse else end)
    reached = not node.orelse
    for block, body in ((yes, node.body), (no, node.orelse)):
        if not body:
            continue
        e.start(block)
        e.statements(body)
        if not e.ended:
            e.go(end)
            reached = True
    if reached:
        e.start(end)
