"""C expressions of what a kernel computes: text, how tightly it binds, and what must not change before it is evaluated."""

import math
import struct
from collections.abc import Callable
from dataclasses import dataclass

from fmu_src.compiler.assembly import Instruction
from fmu_src.compiler.types import KernelFault

# How tightly C binds, from a name down to a choice.
NAME, SIGN, PRODUCT, SUM, ORDER, EQUALITY, BITS, BOTH, CHOICE = range(9, 0, -1)

C_TYPES = {"double": "double", "i64": "int64_t", "i1": "int", "ptr": "union cell *", "void": "void"}
MEMBERS = {"double": "real", "i64": "integer"}
OPERATORS = {
    "fadd": ("+", SUM), "fsub": ("-", SUM), "fmul": ("*", PRODUCT), "fdiv": ("/", PRODUCT), "add": ("+", SUM), "sub": ("-", SUM),
    "mul": ("*", PRODUCT), "sdiv": ("/", PRODUCT), "srem": ("%", PRODUCT),
}  # fmt: skip
COMPARISONS = {
    "olt": ("<", ORDER), "ole": ("<=", ORDER), "ogt": (">", ORDER), "oge": (">=", ORDER), "oeq": ("==", EQUALITY), "une": ("!=", EQUALITY),
    "slt": ("<", ORDER), "sle": ("<=", ORDER), "sgt": (">", ORDER), "sge": (">=", ORDER), "eq": ("==", EQUALITY), "ne": ("!=", EQUALITY),
}  # fmt: skip


@dataclass(frozen=True)
class Expression:
    """``reads`` are the variables in it that may be assigned anew; ``cells`` says that it looks into the record.

    Of an address ``place`` is (where it counts from, how many cells on), of a result of
    several values ``parts`` are these, of a denial ``denied`` is what it denies.
    """

    text: str
    binds: int = NAME
    reads: frozenset[str] = frozenset()
    cells: bool = False
    place: "tuple[Expression, Expression] | None" = None
    parts: "tuple[Expression | None, ...]" = ()
    denied: "Expression | None" = None

    def within(self, binds: int) -> str:
        """As an operand of what binds so tightly."""
        return self.text if self.binds >= binds else f"({self.text})"


def made(text: str, binds: int, *of: Expression, cells: bool = False) -> Expression:
    """An expression made of others."""
    reads: frozenset[str] = frozenset().union(*(part.reads for part in of))
    return Expression(text, binds, reads, cells or any(part.cells for part in of))


def number(operand: str) -> Expression:
    """A literal of LLVM: floats by their bits, so that the C compiler reads the very same number."""
    if operand in ("true", "false"):
        return Expression("1" if operand == "true" else "0")
    if operand.startswith("0x"):
        value = struct.unpack("<d", int(operand, 16).to_bytes(8, "little"))[0]
        if math.isnan(value):
            return Expression("NAN")
        text = "INFINITY" if math.isinf(value) else repr(value) if abs(value) < 2**53 and (value * 1024).is_integer() else abs(value).hex()
        return Expression(f"-{text.lstrip('-')}", SIGN) if math.copysign(1.0, value) < 0.0 else Expression(text)
    value = int(operand)
    if value == -(2**63):
        return Expression("INT64_MIN")
    text = str(abs(value)) if abs(value) < 2**31 else f"INT64_C({abs(value)})"
    return Expression(f"-{text}", SIGN) if value < 0 else Expression(text)


def infix(sign: str, binds: int, a: Expression, b: Expression) -> Expression:
    """Of equals the left one is evaluated first, as in C."""
    return made(f"{a.within(binds)} {sign} {b.within(binds + 1)}", binds, a, b)


def denial(test: Expression) -> Expression:
    if test.denied is not None:
        return test.denied
    return Expression(f"!{test.within(SIGN)}", SIGN, test.reads, test.cells, denied=test)


def called(name: str, arguments: list[Expression]) -> Expression:
    return made(f"{name}({', '.join(argument.text for argument in arguments)})", NAME, *arguments)


def address(base: Expression, steps: Expression) -> Expression:
    """A place some cells further on."""
    if base.place is not None:
        base, before = base.place
        steps = infix("+", SUM, before, steps)
    whole = infix("+", SUM, base, steps)
    return Expression(whole.text, whole.binds, whole.reads, whole.cells, (base, steps))


def cell(place: Expression, kind: str) -> Expression:
    """What stands in the cell at an address."""
    base, steps = place.place or (place, Expression("0"))
    return made(f"{base.within(NAME)}[{steps.text}].{MEMBERS[kind]}", NAME, base, steps, cells=True)


def arithmetic(one: Instruction, get: Callable[[str], Expression]) -> Expression:
    """Of an instruction that only computes; ``get`` gives its operands."""
    values = [get(operand) for operand in one.operands]
    match one.operation:
        # Whole numbers wrap: unsigned in C, where signed ones must not.
        case "add" | "sub" | "mul" if one.detail != "nsw":
            return called(f"wrapped_{one.operation}", values)
        case "frem":
            return called("fmod", values)
        case operation if operation in OPERATORS:
            return infix(*OPERATORS[operation], *values)
        case "and" if one.kinds == ("i1",):
            return infix("&&", BOTH, *values)
        case "xor" if one.operands[1] == "true":
            return denial(values[0])
        case "xor":
            return infix("^", BITS, *values) if one.kinds == ("i64",) else infix("!=", EQUALITY, *values)
        case "fcmp" if one.detail == "uno":
            return called("isnan", values[:1])
        case "icmp" | "fcmp" if one.detail in COMPARISONS:
            return infix(*COMPARISONS[one.detail], *values)
        case "fneg":
            return made(f"-{values[0].within(NAME)}", SIGN, *values)
        case "select":
            test, first, second = values
            return made(f"{test.within(CHOICE + 1)} ? {first.within(CHOICE + 1)} : {second.within(CHOICE)}", CHOICE, *values)
        case "sitofp" | "uitofp":
            return made(f"(double){values[0].within(SIGN)}", SIGN, *values)
        case "fptosi":
            return called("whole", values)
        case "zext":
            return made(f"(int64_t){values[0].within(SIGN)}", SIGN, *values)
    raise KernelFault(f"C source: {one.operation} {one.detail} of {', '.join(one.kinds)} has no form in C")
