"""Numbers in kernels: Python's operators and functions of ``math``, as LLVM code.

Integers have 64 bits and wrap.  Division by zero gives inf or nan (0 for whole numbers)
and no error, as in C and NumPy; so do functions outside their domain.
"""

import ast
import math
import struct
from typing import Protocol

from fmu_src.compiler.types import FLOAT, INTEGER, TRUTH, KernelFault, Number, Value


class Writer(Protocol):
    """What writes the function that the arithmetic stands in."""

    def give(self, instruction: str) -> str:
        """Writes an instruction; the name of its result."""

    def intrinsic(self, name: str, arguments: int) -> str:
        """The symbol of a function of LLVM."""

    def library(self, name: str, arguments: int) -> str:
        """The symbol of a function of libm."""

    def fault(self, text: str) -> KernelFault: ...

# Functions that LLVM knows, and those of libm.
INTRINSICS = {"sin": "sin", "cos": "cos", "exp": "exp", "log": "log", "log10": "log10", "log2": "log2", "sqrt": "sqrt", "fabs": "fabs"}
LIBM = {
    "tan": 1, "asin": 1, "acos": 1, "atan": 1, "sinh": 1, "cosh": 1, "tanh": 1, "expm1": 1, "log1p": 1, "atan2": 2,
    "hypot": 2, "fmod": 2,
}  # fmt: skip
# To whole numbers: through the rounding, then the conversion.
ROUNDINGS = {"floor": "floor", "ceil": "ceil", "trunc": "trunc"}

SYMBOLS: dict[type[ast.AST], str] = {
    ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.FloorDiv: "//", ast.Mod: "%", ast.Pow: "**",
}  # fmt: skip
FLOAT_COMPARISONS: dict[type[ast.AST], str] = {
    ast.Lt: "olt", ast.LtE: "ole", ast.Gt: "ogt", ast.GtE: "oge", ast.Eq: "oeq", ast.NotEq: "une",
}  # fmt: skip
INTEGER_COMPARISONS: dict[type[ast.AST], str] = {
    ast.Lt: "slt", ast.LtE: "sle", ast.Gt: "sgt", ast.GtE: "sge", ast.Eq: "eq", ast.NotEq: "ne",
}  # fmt: skip


def literal(number: bool | int | float) -> Value:
    """A constant as LLVM writes it; floats by their bits."""
    if isinstance(number, bool):
        return Value(TRUTH, ("true" if number else "false",), int(number), True)
    if isinstance(number, int):
        return Value(INTEGER, (str(number),), number, number >= 0)
    bits = struct.unpack("<Q", struct.pack("<d", number))[0]
    return Value(FLOAT, (f"0x{bits:016X}",), number)


def converted(e: Writer, value: Value, wanted: Number) -> Value:
    """The same number as another kind."""
    if value.type == wanted:
        return value
    if value.constant is not None:
        number = {FLOAT: float, INTEGER: int, TRUTH: bool}[wanted](value.constant)
        return literal(number)
    (part,) = value.parts
    if wanted == FLOAT:
        operation = "sitofp" if value.type == INTEGER else "uitofp"
        return Value(FLOAT, (e.give(f"{operation} {value.type.parts[0]} {part} to double"),))
    if wanted == INTEGER:
        if value.type == TRUTH:
            return Value(INTEGER, (e.give(f"zext i1 {part} to i64"),), not_negative=True)
        return Value(INTEGER, (e.give(f"fptosi double {part} to i64"),))
    return truth(e, value)


def truth(e: Writer, value: Value) -> Value:
    """Whether the number is not zero."""
    if value.type == TRUTH:
        return value
    (part,) = value.parts
    test = f"fcmp une double {part}, 0.0" if value.type == FLOAT else f"icmp ne i64 {part}, 0"
    return Value(TRUTH, (e.give(test),))


def common(e: Writer, a: Value, b: Value) -> tuple[Number, str, str]:
    """Both as the kind that holds both, at least an integer."""
    kind = FLOAT if FLOAT in (a.type, b.type) else INTEGER
    return kind, converted(e, a, kind).parts[0], converted(e, b, kind).parts[0]


def binary(e: Writer, operator: ast.operator, a: Value, b: Value) -> Value:
    """a operator b."""
    folded = folded_constant(operator, a, b)
    if folded is not None:
        return folded
    match operator:
        case ast.Add() | ast.Sub() | ast.Mult():
            kind, x, y = common(e, a, b)
            name = {ast.Add: "add", ast.Sub: "sub", ast.Mult: "mul"}[type(operator)]
            positive = a.not_negative and b.not_negative and not isinstance(operator, ast.Sub)
            prefix = "f" if kind == FLOAT else ""
            return Value(kind, (e.give(f"{prefix}{name} {kind.llvm} {x}, {y}"),), not_negative=positive and kind == INTEGER)
        case ast.Div():
            x, y = converted(e, a, FLOAT).parts[0], converted(e, b, FLOAT).parts[0]
            return Value(FLOAT, (e.give(f"fdiv double {x}, {y}"),))
        case ast.FloorDiv() | ast.Mod():
            return floor_division(e, operator, a, b)
        case ast.Pow():
            return power(e, a, b)
    raise e.fault(f"the operator {type(operator).__name__} is none that kernels have; they have {' '.join(SYMBOLS.values())}")


def folded_constant(operator: ast.operator, a: Value, b: Value) -> Value | None:
    """Whole numbers known at compile time, which indices are made of."""
    if not (isinstance(a.constant, int) and isinstance(b.constant, int)):
        return None
    match operator:
        case ast.Add():
            return literal(a.constant + b.constant)
        case ast.Sub():
            return literal(a.constant - b.constant)
        case ast.Mult():
            return literal(a.constant * b.constant)
    return None


def floor_division(e: Writer, operator: ast.operator, a: Value, b: Value) -> Value:
    """// and % with Python's sign: the rest has that of the divisor."""
    kind, x, y = common(e, a, b)
    of_rest = isinstance(operator, ast.Mod)
    if kind == INTEGER:
        is_zero = e.give(f"icmp eq i64 {y}, 0")
        divisor = e.give(f"select i1 {is_zero}, i64 1, i64 {y}")
        rest = e.give(f"srem i64 {x}, {divisor}")
        differs = e.give(f"xor i64 {rest}, {divisor}")
        opposite = e.give(f"icmp slt i64 {differs}, 0")
        inexact = e.give(f"icmp ne i64 {rest}, 0")
        below = e.give(f"and i1 {opposite}, {inexact}")
        if of_rest:
            moved = e.give(f"add i64 {rest}, {divisor}")
            result = e.give(f"select i1 {below}, i64 {moved}, i64 {rest}")
            return Value(INTEGER, (e.give(f"select i1 {is_zero}, i64 0, i64 {result}"),), not_negative=b.not_negative)
        quotient = e.give(f"sdiv i64 {x}, {divisor}")
        lower = e.give(f"sub i64 {quotient}, 1")
        result = e.give(f"select i1 {below}, i64 {lower}, i64 {quotient}")
        return Value(INTEGER, (e.give(f"select i1 {is_zero}, i64 0, i64 {result}"),), not_negative=a.not_negative and b.not_negative)
    # As Python has it: the quotient follows from the rest, which is exact.
    rest = e.give(f"frem double {x}, {y}")
    inexact = e.give(f"fcmp une double {rest}, 0.0")
    rest_below, divisor_below = e.give(f"fcmp olt double {rest}, 0.0"), e.give(f"fcmp olt double {y}, 0.0")
    opposite = e.give(f"xor i1 {rest_below}, {divisor_below}")
    below = e.give(f"and i1 {opposite}, {inexact}")
    if of_rest:
        moved = e.give(f"fadd double {rest}, {y}")
        result = e.give(f"select i1 {below}, double {moved}, double {rest}")
        return Value(FLOAT, (e.give(f"select i1 {inexact}, double {result}, double {signed_zero(e, y)}"),))
    divided = e.give(f"fdiv double {x}, {y}")
    whole = e.give(f"fdiv double {e.give(f'fsub double {x}, {rest}')}, {y}")
    whole = e.give(f"select i1 {below}, double {e.give(f'fsub double {whole}, 1.0')}, double {whole}")
    lower = intrinsic(e, "floor", whole)
    is_nearer_above = e.give(f"fcmp ogt double {e.give(f'fsub double {whole}, {lower}')}, 0.5")
    nearest = e.give(f"select i1 {is_nearer_above}, double {e.give(f'fadd double {lower}, 1.0')}, double {lower}")
    is_some = e.give(f"fcmp une double {whole}, 0.0")
    result = e.give(f"select i1 {is_some}, double {nearest}, double {signed_zero(e, divided)}")
    is_zero = e.give(f"fcmp oeq double {y}, 0.0")
    return Value(FLOAT, (e.give(f"select i1 {is_zero}, double {divided}, double {result}"),))


def signed_zero(e: Writer, sign: str) -> str:
    """0 with the sign of a number."""
    return e.give(f"call double {e.intrinsic('llvm.copysign.f64', 2)}(double 0.0, double {sign})")


def power(e: Writer, a: Value, b: Value) -> Value:
    """a ** b; whole constant powers by squaring, as in every C library's neighbourhood of rounding."""
    if isinstance(b.constant, int) and abs(b.constant) <= 64 and (a.type == FLOAT or b.constant >= 0):
        kind = FLOAT if a.type == FLOAT else INTEGER
        multiply = "fmul double" if kind == FLOAT else "mul i64"
        square, result, left = converted(e, a, kind).parts[0], None, abs(b.constant)
        while left:
            if left & 1:
                result = square if result is None else e.give(f"{multiply} {result}, {square}")
            left >>= 1
            if left:
                square = e.give(f"{multiply} {square}, {square}")
        if result is None:
            return literal(1.0 if kind == FLOAT else 1)
        if b.constant < 0:
            result = e.give(f"fdiv double {literal(1.0).parts[0]}, {result}")
        return Value(kind, (result,))
    x, y = converted(e, a, FLOAT).parts[0], converted(e, b, FLOAT).parts[0]
    return Value(FLOAT, (e.give(f"call double {e.intrinsic('llvm.pow.f64', 2)}(double {x}, double {y})"),))


def negative(e: Writer, value: Value) -> Value:
    if value.constant is not None:
        return literal(-value.constant)
    kind = FLOAT if value.type == FLOAT else INTEGER
    (part,) = converted(e, value, kind).parts
    return Value(kind, (e.give(f"fneg double {part}" if kind == FLOAT else f"sub i64 0, {part}"),))


def comparison(e: Writer, operator: ast.cmpop, a: Value, b: Value) -> Value:
    kind, x, y = common(e, a, b)
    known = FLOAT_COMPARISONS if kind == FLOAT else INTEGER_COMPARISONS
    if type(operator) not in known:
        raise e.fault("kernels compare numbers with < <= > >= == != only")
    compare = "fcmp" if kind == FLOAT else "icmp"
    return Value(TRUTH, (e.give(f"{compare} {known[type(operator)]} {kind.llvm} {x}, {y}"),))


def extreme(e: Writer, values: list[Value], largest: bool) -> Value:
    """max or min of numbers: the first of those that no later one beats, as in Python."""
    best = values[0]
    for value in values[1:]:
        kind, x, y = common(e, best, value)
        operator: ast.cmpop = ast.Gt() if largest else ast.Lt()
        (beats,) = comparison(e, operator, value, best).parts
        sure = (best.not_negative or value.not_negative) if largest else (best.not_negative and value.not_negative)
        best = Value(kind, (e.give(f"select i1 {beats}, {kind.llvm} {y}, {kind.llvm} {x}"),), not_negative=sure)
    return best


def absolute(e: Writer, value: Value) -> Value:
    if value.type == FLOAT:
        return Value(FLOAT, (intrinsic(e, "fabs", value.parts[0]),))
    (part,) = converted(e, value, INTEGER).parts
    is_negative = e.give(f"icmp slt i64 {part}, 0")
    flipped = e.give(f"sub i64 0, {part}")
    return Value(INTEGER, (e.give(f"select i1 {is_negative}, i64 {flipped}, i64 {part}"),), not_negative=True)


def intrinsic(e: Writer, name: str, part: str) -> str:
    return e.give(f"call double {e.intrinsic(f'llvm.{name}.f64', 1)}(double {part})")


def of_math(e: Writer, name: str, values: list[Value]) -> Value:
    """A function of ``math``."""
    parts = [converted(e, value, FLOAT).parts[0] for value in values]
    wanted = LIBM.get(name, 2 if name == "pow" else 1)
    if name not in {*INTRINSICS, *LIBM, *ROUNDINGS, "pow", "radians", "degrees", "isfinite", "isnan"}:
        raise e.fault(f"kernels have no math.{name}; they have {', '.join(sorted({*INTRINSICS, *LIBM, *ROUNDINGS}))}")
    if len(parts) != wanted:
        raise e.fault(f"math.{name} takes {wanted} argument{'s' if wanted > 1 else ''}, not {len(parts)}")
    if name in ROUNDINGS:
        return Value(INTEGER, (e.give(f"fptosi double {intrinsic(e, ROUNDINGS[name], parts[0])} to i64"),))
    if name in INTRINSICS:
        return Value(FLOAT, (intrinsic(e, INTRINSICS[name], parts[0]),))
    if name == "pow":
        return power(e, converted(e, values[0], FLOAT), values[1])
    if name in ("radians", "degrees"):
        factor = math.pi / 180.0 if name == "radians" else 180.0 / math.pi
        return Value(FLOAT, (e.give(f"fmul double {parts[0]}, {literal(factor).parts[0]}"),))
    if name == "isnan":
        return Value(TRUTH, (e.give(f"fcmp uno double {parts[0]}, 0.0"),))
    if name == "isfinite":
        size = intrinsic(e, "fabs", parts[0])
        return Value(TRUTH, (e.give(f"fcmp olt double {size}, {literal(math.inf).parts[0]}"),))
    arguments = ", ".join(f"double {part}" for part in parts)
    return Value(FLOAT, (e.give(f"call double {e.library(name, len(parts))}({arguments})"),))
