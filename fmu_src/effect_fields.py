"""What an effect declares, reads and changes, held against what its unit lets it: ``effect_check`` for its variables and its kernels."""

import ast
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any

from fmu_src.effect_finding import OWN, Finding, Frame
from fmu_src.kernel_reading import RECORD, Reading, Source, source_of
from fmu_src.units import UnitError, all_below, fmi_base_unit
from fmu_src.variables import Variable

# Runs for the whole of a run; of the inputs that of the surroundings at its start alone may be read there (docs/effects.md).
ONCE, TEMPERATURE = "prepare", "temperature"
# What an operator of ALLOWED stands for.
SAME = {"+=": ("+=", "-="), "*=": ("*=", "/=")}
# How a role reads in a sentence.
ROLE = {"input": "an input", "parameter": "a parameter", "output": "an output", "local": "a diagnostic", "state": "a state", "scratch": "work space"}


def of_variables(tree: ast.Module, file: Path, effect: Any, frame: Frame) -> list[Finding]:
    """Names that the unit or another effect has already, or that the effect itself has twice."""
    taken = {v.name: owned("the unit", v) for v in frame.own}
    for name, (other, _) in frame.effects.items():
        taken |= {v.name: owned(f"the effect {name}", v) for v in other.variables()}
    findings = []
    for v in effect.variables():
        if v.name in taken:
            findings.append(Finding(file, line_of(tree, v.name), f"{taken[v.name]}; choose another name"))
        taken[v.name] = owned("the effect itself", v)
        if said := wrong_unit(v, frame) or wrong_bounds(v):
            findings.append(Finding(file, line_of(tree, v.name), said))
    return findings


def owned(owner: str, v: Variable) -> str:
    """Who has a variable already, and what it is.  Work space of kernels stands on no page, so that its role alone would say nothing."""
    if v.role == "scratch":
        return f"{owner} has {v.name} already, {'an array' if v.shape else 'a number'} that its kernels compute with"
    return f"{owner} has {ROLE[v.role]} {v.name} already"


def wrong_bounds(v: Variable) -> str:
    """What is wrong with a variable's bounds, between which its start must lie."""
    if v.minimum >= v.maximum:
        return f"{v.name}: the lowest value, {v.minimum:g} {v.unit}, is not below the highest, {v.maximum:g} {v.unit}; change them round"
    if not v.minimum <= v.start <= v.maximum:
        return f"{v.name}: its start, {v.start:g} {v.unit}, lies outside of its bounds, {v.minimum:g} to {v.maximum:g} {v.unit}"
    return ""


def wrong_unit(v: Variable, frame: Frame) -> str:
    """What is wrong with a variable's unit: kernels get the number as it stands, so it has to be SI."""
    if v.unit in {own.unit for own in frame.own}:
        return ""
    if (meant := all_below(v.unit)) != v.unit:
        first, _, rest = meant.replace("(", "").replace(")", "").partition(".")
        return f"{v.name}: {v.unit} reads as {first} times {rest}; write {meant}"
    try:
        base = fmi_base_unit(v.unit)
    except UnitError as fault:
        return f"{v.name}: {fault}"
    if base.get("factor", 1.0) == 1.0 and base.get("offset", 0.0) == 0.0:
        return ""
    return (
        f"{v.name}: {v.unit} is no SI unit, and kernels get the number as it stands; declare the SI unit (N.m, m, rad, K, Pa, m/(N.m));"
        " people may give any other"
    )


def line_of(tree: ast.Module, name: str) -> int:
    """The line that writes a name as text, or else that of EFFECT."""
    texts = [n.lineno for n in ast.walk(tree) if isinstance(n, ast.Constant) and n.value == name]
    effects = [n.lineno for n in ast.walk(tree) if isinstance(n, ast.Name) and n.id == "EFFECT"]
    return texts[-1] if texts else effects[0] if effects else 1


def of_kernels(source: Source, effect: Any, frame: Frame) -> list[Finding]:
    """What the hooks read and change, held against what they may."""
    states = {v.name for v in effect.states}
    known = {v.name: v for v in [*effect.variables(), *of_others(frame), *frame.own]}
    dimensions = {name: len(v.shape) for name, v in known.items()}
    findings, changed = [], set()
    for hook in frame.hooks:
        if hook not in source.functions:
            continue
        reading = read_hook(source, hook, dimensions, counts_of(hook, known, frame))
        findings += [Finding(t.file, t.line, t.text) for t in reading.troubles]
        for use in reading.uses:
            rule = of_reading if use.action == "read" else of_change
            text = rule(hook, use.name, use.action, states, known, frame)
            if text:
                findings.append(Finding(use.file, use.line, text))
        changed |= {use.name for use in reading.uses if use.action != "read"}
    for hook, name in frame.needs.items():
        if hook in source.functions and name not in changed:
            text = f"{hook} is called only where prepare does r.{name} += 1: let it do so where the effect is on"
            findings.append(Finding(source.file, source.functions[hook].lineno, text))
    return findings


def of_others(frame: Frame) -> list[Variable]:
    return [v for other, _ in frame.effects.values() for v in other.variables()]


def counts_of(hook: str, known: Mapping[str, Variable], frame: Frame) -> dict[str, str]:
    """What a hook gets the number of discs, cranks, rollers ... from: the length of a field, one of those that it may change if any has it."""
    changed = [name for changes in (frame.allowed[hook], *frame.allowed.values()) for name in changes if name in known]
    counts: dict[str, str] = {}
    for v in (*(known[name] for name in changed), *frame.own):
        for number, axis in enumerate(v.axes):
            counts.setdefault(f"{axis.replace(' ', '_')}s", f"{v.name}.shape[{number}]")
    return counts


def read_hook(source: Source, hook: str, dimensions: Mapping[str, int], counts: Mapping[str, str] = MappingProxyType({})) -> Reading:
    reading = Reading(source, dimensions, counts)
    others = len(source.functions[hook].args.args) - 1
    reading.follow(source, hook, (RECORD, *(frozenset() for _ in range(others))))
    return reading


def of_change(hook: str, name: str, action: str, states: set[str], known: Mapping[str, Variable], frame: Frame) -> str:
    """Why a hook may not change a field so; empty if it may."""
    allowed = frame.allowed[hook]
    if name in states and OWN in allowed:
        return ""
    if name not in allowed:
        others = [other for other in frame.hooks if name in frame.allowed[other] or (name in states and OWN in frame.allowed[other])]
        elsewhere = f" ({', '.join(others)} may)" if others else ""
        may = ", ".join(f"its {field}" if field == OWN else field for field in allowed) or "nothing"
        return f"{hook} may not change r.{name}, {meaning(known[name])}{elsewhere}; it may change {may}"
    if action not in SAME[allowed[name]]:
        return f"{hook} must not change r.{name} by {action}, because other effects act on it too: write {allowed[name]}"
    return ""


def of_reading(hook: str, name: str, action: str, states: set[str], known: Mapping[str, Variable], frame: Frame) -> str:
    """Why a hook may not read a field: other effects change it at the same stage, or it has changed long before the hook runs again."""
    if hook == ONCE and known[name].role == "input" and name != TEMPERATURE:
        later = list(frame.hooks)[list(frame.hooks).index(hook) + 1 :]
        return (f"{hook} reads r.{name}, {meaning(known[name])}: it runs at the start alone, and what comes in later in a run would go unseen;"
                f" read it in {' or '.join([', '.join(later[:-1]), later[-1]] if later[1:] else later)}, which run at every step")
    if name in frame.allowed[hook]:
        later = [other for other in list(frame.hooks)[list(frame.hooks).index(hook) + 1 :] if name not in frame.allowed[other]]
        hint = f"; {', '.join(later)} may read it" if later else ""
        return f"{hook} reads r.{name}, {meaning(known[name])}, on which other effects act in the same stage{hint}"
    owner = "" if name in states else owner_that_changes(hook, name, frame)
    return f"{hook} reads r.{name}, {meaning(known[name])}, which the effect {owner} changes in the same stage" if owner else ""


def owner_that_changes(hook: str, name: str, frame: Frame) -> str:
    """The effect whose state this is, if its own hook of this name changes it."""
    for owner, (other, file) in frame.effects.items():
        if name in {v.name for v in other.states}:
            source = source_of(file, ast.parse(file.read_bytes()))
            fields = {v.name: len(v.shape) for v in [*of_others(frame), *frame.own]}
            if hook in source.functions and any(u.name == name and u.action != "read" for u in read_hook(source, hook, fields).uses):
                return owner
    return ""


def meaning(v: Variable) -> str:
    return f"{ROLE[v.role]} ({v.description})" if v.description else ROLE[v.role]
