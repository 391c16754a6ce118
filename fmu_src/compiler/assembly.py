"""LLVM's text as this compiler writes it, read back: functions, blocks, instructions.

Only what ``function``, ``emitter`` and their like write is understood, before any
optimisation; other instructions are refused by name.
"""

import re
from dataclasses import dataclass, field

from fmu_src.compiler.types import KernelFault

GROUP = r"\{[^}]*\}"
KIND = rf"(?:{GROUP}|double|i64|i8|i1|ptr|void)"
HEAD = re.compile(rf'define (internal )?({KIND}) @(?:"([^"]+)"|([\w.]+))\((.*)\) #0 \{{')
BINARY = ("fadd", "fsub", "fmul", "fdiv", "frem", "add", "sub", "mul", "sdiv", "srem", "xor", "and", "or")
CONVERSIONS = ("sitofp", "uitofp", "fptosi", "zext")


@dataclass(frozen=True)
class Instruction:
    """``kinds`` are LLVM types in the order of the text, ``labels`` the blocks named; ``detail`` is what else it says."""

    operation: str
    result: str | None = None
    kinds: tuple[str, ...] = ()
    operands: tuple[str, ...] = ()
    labels: tuple[str, ...] = ()
    detail: str = ""


@dataclass
class Definition:
    """A function; blocks by label in the order of the text, the first is where it begins."""

    name: str
    is_internal: bool
    kind: str
    parameters: list[tuple[str, str]]
    blocks: dict[str, list[Instruction]] = field(default_factory=dict)


def definitions(text: str) -> list[Definition]:
    """All functions of a module."""
    found: list[Definition] = []
    block: list[Instruction] = []
    inside = False
    for line in text.splitlines():
        if head := HEAD.match(line):
            internal, kind, quoted, plain, parameters = head.groups()
            found.append(Definition(quoted or plain, bool(internal), kind, typed(parameters)))
            block = found[-1].blocks.setdefault("entry", [])
            inside = True
        elif line == "}":
            inside = False
        elif inside and line.endswith(":"):
            block = found[-1].blocks.setdefault(line[:-1], [])
        elif inside and line:
            block.append(instruction(line.strip()))
    return found


def parts(text: str) -> list[str]:
    """What stands between commas, but not within brackets."""
    found, depth, start = [], 0, 0
    for i, sign in enumerate(text):
        depth += (sign in "{[(") - (sign in "}])")
        if sign == "," and depth == 0:
            found.append(text[start:i].strip())
            start = i + 1
    return [*found, text[start:].strip()] if text.strip() else []


def typed(text: str) -> list[tuple[str, str]]:
    """(type, operand) of each item of a list."""
    return [split_type(item) for item in parts(text)]


def split_type(text: str) -> tuple[str, str]:
    found = re.match(rf"({KIND})\s+(.*)", text)
    if found is None:
        raise KernelFault(f"C source: {text} has no type that kernels use")
    return found.group(1), found.group(2)


def instruction(line: str) -> Instruction:
    result, _, rest = line.partition(" = ") if line.startswith("%") else (None, "", line)
    operation, _, rest = rest.partition(" ")
    if operation == "store":
        (kind, value), (_, place) = typed(", ".join(parts(rest)[:2]))
        return Instruction("store", None, (kind,), (value, place))
    if operation == "load":
        kind, place = parts(rest)[:2]
        return Instruction("load", result, (kind,), (split_type(place)[1],))
    if operation == "alloca":
        return Instruction("alloca", result, (rest,))
    if operation == "getelementptr":
        kind, base, index = parts(rest.removeprefix("inbounds "))
        return Instruction("getelementptr", result, (kind,), (split_type(base)[1], split_type(index)[1]))
    if operation in BINARY:
        nowrap = rest.startswith("nsw ")
        first, second = parts(rest.removeprefix("nsw "))
        kind, first = split_type(first)
        return Instruction(operation, result, (kind,), (first, second), detail="nsw" if nowrap else "")
    if operation in ("icmp", "fcmp"):
        condition, _, rest = rest.partition(" ")
        first, second = parts(rest)
        kind, first = split_type(first)
        return Instruction(operation, result, (kind,), (first, second), detail=condition)
    if operation == "fneg":
        kind, value = split_type(rest)
        return Instruction("fneg", result, (kind,), (value,))
    if operation == "select":
        (_, test), (kind, first), (_, second) = typed(rest)
        return Instruction("select", result, (kind,), (test, first, second))
    if operation in CONVERSIONS:
        value, _, wanted = rest.rpartition(" to ")
        kind, value = split_type(value)
        return Instruction(operation, result, (kind, wanted), (value,))
    return other_instruction(operation, result, rest)


def other_instruction(operation: str, result: str | None, rest: str) -> Instruction:
    if operation == "phi":
        kind, rest = split_type(rest)
        arrivals = [parts(item.strip("[] ")) for item in parts(rest)]
        return Instruction("phi", result, (kind,), tuple(a for a, _ in arrivals), tuple(b[1:] for _, b in arrivals))
    if operation == "call":
        found = re.fullmatch(rf'({KIND}) @(?:"([^"]+)"|([\w.]+))\((.*)\)', rest)
        if found is not None:
            kind, quoted, plain, passed = found.groups()
            arguments = typed(passed)
            kinds = (kind, *(a for a, _ in arguments))
            return Instruction("call", result, kinds, tuple(b for _, b in arguments), detail=quoted or plain)
    if operation == "insertvalue":
        whole, value, place = parts(rest)
        kind, whole = split_type(whole)
        return Instruction("insertvalue", result, (kind,), (whole, split_type(value)[1]), detail=place)
    if operation == "extractvalue":
        whole, place = parts(rest)
        kind, whole = split_type(whole)
        return Instruction("extractvalue", result, (kind,), (whole,), detail=place)
    if operation == "br":
        named = parts(rest)
        labels = tuple(item.removeprefix("label %") for item in named if item.startswith("label"))
        return Instruction("br", None, (), tuple(item[3:] for item in named if item.startswith("i1 ")), labels)
    if operation == "ret":
        return Instruction("ret", None, ("void",)) if rest == "void" else Instruction("ret", None, split_type(rest)[:1], split_type(rest)[1:])
    raise KernelFault(f"C source: the instruction {operation} is none that kernels are made of: {rest}")
