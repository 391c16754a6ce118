"""Effects of one's own, looked at before anything is compiled: what is wrong is said with file and line.

A unit takes an effect only if its hooks change nothing but what the unit's ``ALLOWED`` gives them, by adding or
multiplying, and read nothing that others change at the same time: then the order of the effects cannot matter.
"""

import ast
import importlib
import importlib.util
import keyword
import os
import re
import sys
import traceback
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

from fmu_src.effect_fields import line_of, of_kernels, of_variables
from fmu_src.effect_finding import EffectFault, Finding, Frame
from fmu_src.faults import nearest
from fmu_src.kernel_reading import Source, is_kernel, source_of
from fmu_src.source_hash import IN_FMU, KERNEL_PACKAGES, ROOT, USER_EFFECTS, readable, user_effect_files

# Units that take effects.
UNITS = tuple(name for name in KERNEL_PACKAGES if (ROOT / name / "effects").is_dir())
WHERE = " or ".join(f"DIR/{unit}/" for unit in UNITS)
LOOKS_LIKE_EFFECT = re.compile(r"^(EFFECT\b|from fmu_src\.effect\b)", re.MULTILINE)


def require_sound_effects(package: str) -> None:
    """EffectFault if anything is wrong with the user's effects of a unit, or with their folder."""
    folder = None if IN_FMU else os.environ.get(USER_EFFECTS)
    findings = findings_of(package, folder) if folder else ()
    if findings:
        raise EffectFault("\n".join(map(str, findings)))


@cache
def findings_of(package: str, folder: str) -> tuple[Finding, ...]:
    files = [file for _, file in user_effect_files(package) if file.stem != "__init__"]
    return (*folder_findings(Path(folder)), *(found for file in files for found in check_file(file, package)))


def folder_findings(folder: Path) -> list[Finding]:
    """Of the folder named by RVWEAR_EFFECTS: that it is there, and that no effect lies where no unit looks."""
    folder = folder.resolve()
    if not folder.is_dir():
        return [Finding(folder, 0, f"{USER_EFFECTS} names this folder, and there is none; effects lie in {WHERE}")]
    findings = [
        Finding(file, 1, f"no unit looks here for effects; put it into {WHERE}")
        for file in sorted([*folder.glob("[!.]*.py"), *folder.glob("*/[!.]*.py")])
        if file.parent.name not in UNITS and readable(file) and LOOKS_LIKE_EFFECT.search(file.read_text(encoding="utf-8", errors="replace"))
    ]
    here = [file for unit in UNITS for file in sorted((folder / unit).glob("[!.]*.py"))]
    findings += [Finding(file, 0, "no file, or one that cannot be read") for file in here if not readable(file)]
    if not any((folder / unit).is_dir() for unit in UNITS):
        findings.append(Finding(folder, 0, f"{USER_EFFECTS} names this folder, which has neither {' nor '.join(UNITS)} in it"))
    return findings


def check_any_file(file: Path) -> list[Finding]:
    """Everything that is wrong with an effect's file; its folder says which unit it is for."""
    # As it is called: a link lies where it lies.
    file = file.absolute()
    if not readable(file):
        return [Finding(file, 0, "there is no such file, or it cannot be read")]
    if file.parent.name in UNITS:
        return check_file(file, file.parent.name)
    text = f"no unit would look for it in this folder; put it into {WHERE}, and name DIR by {USER_EFFECTS}"
    return [Finding(file, 1, text), *check_file(file, likely_unit(file))]


def all_sound(folder: Path) -> bool:
    """Whether nothing is wrong with any effect's file in a folder of effects."""
    return not any(check_any_file(file) for unit in UNITS for file in (folder / unit).glob("[!.]*.py") if file.stem != "__init__")


def likely_unit(file: Path) -> str:
    """The unit most of whose hooks a file has."""
    text = file.read_text(encoding="utf-8", errors="replace")
    return max(UNITS, key=lambda unit: sum(f"def {hook}({a})" in text for hook, (a, _) in frame_of(unit, file).hooks.items()))


def check_file(file: Path, package: str) -> list[Finding]:
    """Everything that is wrong with the file of an effect of a unit, in the order of its lines."""
    frame = frame_of(package, file)
    try:
        tree = ast.parse(file.read_bytes(), str(file))
    except SyntaxError as error:
        return [Finding(file, error.lineno or 1, f"syntax error: {error.msg}")]
    except ValueError as error:
        return [Finding(file, 1, f"no text of a Python file: {error}")]
    source = source_of(file, tree)
    findings = [*of_name(file, frame), *of_hooks(source, frame)]
    if "EFFECT" not in source.names:
        findings.append(Finding(file, 1, "no EFFECT: the file must say EFFECT = Effect(...), see docs/effects.md"))
    module, faults = imported(file, package)
    findings += faults
    effect = getattr(module, "EFFECT", None)
    if is_effect(effect):
        findings += of_variables(tree, file, effect, frame)
        findings += of_kernels(source, effect, frame)
    elif module is not None and effect is not None:
        findings.append(Finding(file, line_of(tree, "EFFECT"), "EFFECT is no Effect of fmu_src.effect"))
    return sorted(set(findings))


def is_effect(found: Any) -> bool:
    """By what it has: the class stands above this module."""
    return hasattr(found, "variables") and hasattr(found, "states")


def frame_of(package: str, file: Path) -> Frame:
    """The unit's frame as an effect in ``file`` meets it, with the effects that are loaded and those beside it."""
    effects = importlib.import_module(f"{package}.effects")
    variables = importlib.import_module(f"{package}.variables")
    others = {name: (effect, Path(sys.modules[f"{package}.effects.{name}"].__file__ or "")) for name, effect in effects.EFFECTS.items()}
    for beside in filter(readable, file.parent.glob("[!.]*.py")) if file.parent.name == package else ():
        effect = getattr(imported(beside, package)[0], "EFFECT", None)
        if beside.stem not in others and is_effect(effect):
            others[beside.stem] = effect, beside
    others = {name: other for name, other in others.items() if other[1].resolve() != file.resolve()}
    return Frame(effects.HOOKS, effects.ALLOWED, getattr(effects, "NEEDS", {}), tuple(variables.own_variables()), others)


def imported(file: Path, package: str) -> tuple[ModuleType | None, list[Finding]]:
    """The file's module, run anew unless it is loaded; or what went wrong and where."""
    name = f"{package}.effects.{file.stem}"
    loaded = sys.modules.get(name)
    if loaded is not None and Path(loaded.__file__ or "").resolve() == file.resolve():
        return loaded, []
    paths = sys.modules[f"{package}.effects"].__path__
    if str(file.parent) not in paths:
        paths.append(str(file.parent))
    specification = importlib.util.spec_from_file_location(name, file)
    if specification is None or specification.loader is None:
        return None, [Finding(file, 1, "Python cannot load this file")]
    module = importlib.util.module_from_spec(specification)
    try:
        specification.loader.exec_module(module)
    except (Exception, SystemExit) as error:  # noqa: BLE001 (the file may do anything when it is imported)
        lines = [f.lineno or 1 for f in traceback.extract_tb(error.__traceback__) if f.filename == str(file)]
        return None, [Finding(file, lines[-1] if lines else 1, f"{type(error).__name__}: {error}")]
    return module, []


def is_name(text: str) -> bool:
    """Whether Python code can call something so."""
    return text.isidentifier() and not keyword.iskeyword(text)


def of_name(file: Path, frame: Frame) -> list[Finding]:
    if not is_name(file.stem):
        return [Finding(file, 1, "the file's name must be a Python name: letters, digits and _, and no word of Python's own")]
    if file.stem in frame.effects or file.stem == "composed":
        return [Finding(file, 1, f"there is an effect {file.stem} already; rename the file")]
    return []


def of_hooks(source: Source, frame: Frame) -> list[Finding]:
    """Hooks with other arguments than the unit gives, or that are no kernels; kernels that nobody calls; no hook at all."""
    findings, kernels = [], source.kernels()
    for name, function in source.functions.items():
        arguments = ", ".join(a.arg for a in function.args.args)
        if name not in frame.hooks:
            continue
        wanted, operation = frame.hooks[name]
        if len(arguments.split(",")) != len(wanted.split(",")) or not arguments:
            findings.append(Finding(source.file, function.lineno, f"the unit calls {name}({wanted}), here it is {name}({arguments})"))
        if not is_kernel(function):
            findings.append(Finding(source.file, function.lineno, f"{name} is a hook and must be a kernel: write @kernel above it"))
        if operation == "*" and not always_returns(function.body):
            findings.append(Finding(source.file, function.lineno, f"{name} must return a factor on every way through it (1.0 where it is off)"))
    hooks = [name for name in source.functions if name in frame.hooks]
    called = reached(source, hooks)
    for name, function in kernels.items():
        if name not in called:
            close = nearest(name, frame.hooks, 1) or f"; hooks are {', '.join(frame.hooks)}"
            findings.append(Finding(source.file, function.lineno, f"{name} is no hook and no hook calls it{close}"))
    if not hooks and not kernels:
        findings.append(Finding(source.file, 1, f"no hook, so that the effect does nothing; hooks are {', '.join(frame.hooks)}"))
    return findings


def reached(source: Source, names: Iterable[str]) -> set[str]:
    """The file's functions that are met from these."""
    found: set[str] = set()
    left = list(names)
    while left:
        name = left.pop()
        if name not in found:
            found.add(name)
            left += [n.id for n in ast.walk(source.functions[name]) if isinstance(n, ast.Name) and n.id in source.functions]
    return found


def always_returns(body: list[ast.stmt]) -> bool:
    last = body[-1]
    if isinstance(last, ast.If):
        return always_returns(last.body) and bool(last.orelse) and always_returns(last.orelse)
    return isinstance(last, ast.Return) and last.value is not None
