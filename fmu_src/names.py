"""Structured names: how effects' parameters get theirs, and what happens to old names.

Up to version 0.2 tools and files saw the names that kernels have for their variables (``mesh_force``).  What each is called
now stands beside its declaration (``Variable.path``), so the table of old and new names is that of every unit
(``Table.renamed``).  Old names go on working in files and settings through the next version, each with a warning.
"""

import warnings
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

from fmu_src.effect import Effect, EffectParameter
from fmu_src.faults import OldName
from fmu_src.table import Table
from fmu_src.variables import SETTABLE, Variable

EFFECTS_GROUP = "effects"


def warn_of_old_name(old: str, new: str, place: str = "") -> None:
    """``place`` says where the old name was found, for instance a file."""
    where = f"{place}: " if place else ""
    warnings.warn(f"{where}{old} is now called {new}; the old name works through version 0.3", OldName, stacklevel=3)


def found_by_name(tables: Sequence[Table], name: str, place: str = "", roles: Sequence[str] = ()) -> list[tuple[Table, Variable]]:
    """The variables (of some roles) of a name, with the tables that have them; an old name is said to be one."""
    found = [(t, v) for t in tables if (v := t.find(name)) is not None and (not roles or v.role in roles)]
    base, bracket, rest = name.partition("[")
    if found and all(base != v.path for _, v in found):
        warn_of_old_name(name, found[0][1].path + bracket + rest, place)
    return found


def settable_names(tables: Sequence[Table]) -> tuple[list[str], dict[str, str]]:
    """(names, old names and what they are now) of all that may be set."""
    given = [v for t in tables for v in t.of_role(*SETTABLE)]
    return [v.path for v in given], {v.name: v.path for v in given}


def with_paths(name: str, effect: Effect) -> Effect:
    """The effect of a name, its parameters called ``effects.NAME.parameter``."""
    short = [short_name(p.variable.name, name) for p in effect.parameters]
    if len(set(short)) < len(short):
        short = [p.variable.name for p in effect.parameters]
    return replace(effect, parameters=tuple(called(p, f"{EFFECTS_GROUP}.{name}.{end}") for p, end in zip(effect.parameters, short)))


def called(parameter: EffectParameter, path: str) -> EffectParameter:
    return replace(parameter, variable=replace(parameter.variable, path=path))


def short_name(parameter: str, effect: str) -> str:
    """The parameter's name without the leading words that the effect's name has too; the last word stays."""
    words = parameter.split("_")
    for word in effect.split("_"):
        if len(words) < 2 or words[0] != word or words[1].isdigit():
            break
        del words[0]
    return "_".join(words)


def dotted(table: Mapping[str, Any], entry: Collection[str] = ()) -> dict[str, Any]:
    """Tables within tables, which TOML makes of keys with dots, as one with dots in its keys.

    A table that has one of the keys of an ``entry`` is no group but a value.
    """
    found: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, Mapping) and not set(value) & set(entry):
            found |= {f"{key}.{inner}": v for inner, v in dotted(value, entry).items()}
        else:
            found[key] = value
    return found


def last_part(path: str) -> str:
    """What a variable is called within its group."""
    return path.rpartition(".")[2]
