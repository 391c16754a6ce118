"""Model files: a reducer, what is set on it, the effects that were added, and how they came in.

    [model]
    name = "gearbox 7"
    reducer = "RV20E-121"

    [settings]
    bearing_clearance = "3 um"

    [effects.needle_clearance]
    needle_clearance_added = { value = 2.1e-6, unit = "m", low = 1.9e-6, high = 2.3e-6 }

    [[steps]]                       # the ladder, one entry per attempt
"""

import tomllib
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import tomlkit
from tomlkit.items import InlineTable

from discrepancy.effects import EFFECTS as CHAIN_EFFECTS
from fmu_src.effect import Effect
from fmu_src.effect_check import UNITS, require_sound_effects
from fmu_src.faults import InputFault
from fmu_src.source_hash import USER_EFFECTS
from orchestrator.settings import parse_setting
from reducers.library import LIBRARY
from reducers.reducer import Reducer, load_reducer
from rv_plant.effects import EFFECTS as PLANT_EFFECTS
from wear_fmu.effects import EFFECTS as WEAR_EFFECTS


@dataclass(frozen=True)
class ModelFile:
    """A model: ``settings`` and ``effects`` map variables to SI values; ``steps`` is the ladder so far."""

    name: str
    reducer: Reducer
    settings: dict[str, float] = field(default_factory=dict)
    effects: dict[str, dict[str, dict[str, Any]]] = field(default_factory=dict)
    steps: tuple[dict[str, Any], ...] = ()
    path: Path | None = None

    def values(self) -> dict[str, float]:
        """Everything that differs from the reducer file: settings and effects' parameters."""
        found = dict(self.settings)
        for parameters in self.effects.values():
            found |= {name: float(entry["value"]) for name, entry in parameters.items()}
        return found


def every_effect() -> dict[str, Effect]:
    """All effects by name; the two halves of one effect have the union of their parameters."""
    for unit in UNITS:
        require_sound_effects(unit)
    found = dict(PLANT_EFFECTS)
    for name, effect in WEAR_EFFECTS.items():
        found[name] = joined(found[name], effect) if name in found else effect
    return found | CHAIN_EFFECTS


def joined(effect: Effect, other: Effect) -> Effect:
    """Both halves of an effect as one."""
    have = {p.variable.name for p in effect.parameters}
    more = tuple(p for p in other.parameters if p.variable.name not in have)
    searched = {p.variable.name: p.grid for p in other.parameters}
    own = tuple(replace(p, grid=p.grid or searched.get(p.variable.name, ())) for p in effect.parameters)
    return replace(effect, parameters=own + more, signals=tuple(dict.fromkeys(effect.signals + other.signals)))


def halves_of(name: str) -> list[Effect]:
    """What the units have under the name of an effect."""
    return [effects[name] for effects in (PLANT_EFFECTS, WEAR_EFFECTS) if name in effects]


def load_model(name_or_path: str | Path) -> ModelFile:
    """A model file, a reducer file, or the name of a reducer of the library."""
    path = Path(name_or_path)
    if path.suffix == ".toml" and path.is_file():
        try:
            content = tomllib.loads(path.read_text(encoding="utf-8-sig"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as problem:
            raise InputFault(f"{path}: not a TOML file: {problem}") from None
        if "model" in content:
            return model_of(content, path)
    elif path.suffix == ".toml":
        raise InputFault(f"{path}: no such file; give a model file, a reducer file or the name of a reducer")
    reducer = load_reducer(name_or_path)
    return ModelFile(reducer.name, reducer)


def model_of(content: dict[str, Any], path: Path) -> ModelFile:
    head = content["model"]
    for key in ("name", "reducer"):
        if not isinstance(head.get(key), str):
            raise InputFault(f"{path}: model.{key} = {head.get(key)!r}: a text is needed")
    near = path.parent / head["reducer"]
    reducer = load_reducer(near if near.is_file() else head["reducer"])
    tables = [reducer.plant, reducer.wear]
    settings = {}
    for name, text in content.get("settings", {}).items():
        try:
            settings[name] = parse_setting(f"{name}={text}", tables).value
        except InputFault as problem:
            raise InputFault(f"{path}: settings.{name}: {problem}") from None
    known = every_effect()
    effects = content.get("effects", {})
    for name, parameters in effects.items():
        if name not in known:
            raise InputFault(f"{path}: effects.{name}: there is no such effect; `rvwear effects` lists those there are, your own with {USER_EFFECTS}=DIR")
        have = {p.variable.name for p in known[name].parameters}
        for parameter, entry in parameters.items():
            if parameter.partition("[")[0] not in have:
                raise InputFault(f"{path}: effects.{name}.{parameter}: the effect has {', '.join(sorted(have))}")
            if not isinstance(entry, dict) or "value" not in entry:
                raise InputFault(f"{path}: effects.{name}.{parameter} = {entry!r}: write {{ value = ..., unit = \"...\" }}")
    return ModelFile(head["name"], reducer, settings, effects, tuple(content.get("steps", ())), path)


def save_model(model: ModelFile, path: Path) -> None:
    """Write the model; the file is replaced at once, never left half written."""
    document = tomlkit.document()
    document["model"] = {"name": model.name, "reducer": reducer_reference(model, path)}
    if model.settings:
        document["settings"] = {name: as_read(model.reducer, name, value) for name, value in model.settings.items()}
    if model.effects:
        document["effects"] = {name: {k: inline(v) for k, v in parameters.items()} for name, parameters in model.effects.items()}
    if model.steps:
        steps = tomlkit.aot()
        for step in model.steps:
            steps.append(tomlkit.item({k: v for k, v in step.items() if v is not None}))
        document["steps"] = steps
    partial = path.with_suffix(".part")
    partial.write_text(tomlkit.dumps(document), encoding="utf-8")
    partial.replace(path)


def as_read(reducer: Reducer, name: str, value: float | int) -> float | int | str:
    """A setting as ``load_model`` takes it: a choice by its name, a number in the variable's unit."""
    variable = next(t.by_name[name.partition("[")[0]] for t in (reducer.plant, reducer.wear) if name.partition("[")[0] in t.by_name)
    return variable.choices[int(value)] if variable.choices else value


def extended_reducer(file: ModelFile) -> Reducer:
    """The reducer with settings and effects as start values, for FMUs that carry them."""
    known = {v.name for table in (file.reducer.plant, file.reducer.wear) for v in table.variables}
    values = {name: value for name, value in file.values().items() if name in known}
    sources = dict.fromkeys(values, f"model {file.name}")
    return replace(file.reducer, starts=file.reducer.starts | values, sources=file.reducer.sources | sources)


def inline(entry: dict[str, Any]) -> InlineTable:
    table = tomlkit.inline_table()
    table.update(entry)
    return table


def reducer_reference(model: ModelFile, path: Path) -> str:
    """Name of a library reducer, or the path of its file as seen from the model file."""
    if model.reducer.path.resolve().parent == LIBRARY.resolve() and load_or_none(model.reducer.name):
        return model.reducer.name
    try:
        return str(model.reducer.path.resolve().relative_to(path.resolve().parent))
    except ValueError:
        return str(model.reducer.path.resolve())


def load_or_none(name: str) -> Reducer | None:
    try:
        return load_reducer(name)
    except InputFault:
        return None
