"""Model files: a reducer, what is set on it, the effects that were added, and how they came in.

    [model]
    name = "gearbox 7"
    reducer = "RV20E-121"

    [settings]
    bearing.clearance = "3 um"

    [effects.needle_clearance]
    added = { value = 2.1, unit = "um", low = 1.9, high = 2.3 }    # or "2.1 um"

    [[steps]]                       # the ladder, one entry per attempt
"""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import tomlkit
from pydantic import Field, ValidationError, field_validator
from tomlkit.items import InlineTable, Table

from discrepancy.campaign.amount import is_number, split
from discrepancy.counted_from import ZERO, zero_texts, zeros_of
from discrepancy.effects import EFFECTS as CHAIN_EFFECTS
from discrepancy.refused_file import only_refused
from discrepancy.words.written_number import told_of, written_entry, written_setting
from fmu_src.checked_file import write_text
from fmu_src.display import display_unit
from fmu_src.effect import Effect
from fmu_src.effect_check import UNITS, require_sound_effects
from fmu_src.effect_words import effect_words
from fmu_src.faults import InputFault, nearest
from fmu_src.file_name import FILE_NAME
from fmu_src.names import dotted, last_part, warn_of_old_name
from fmu_src.reading import quoted, read_toml, reading, shown
from fmu_src.source_hash import USER_EFFECTS
from fmu_src.strict_file import Strict, described, validated
from fmu_src.units import UnitError, conversion
from fmu_src.unstated_unit import check_given
from fmu_src.variables import ValueFault, Variable
from orchestrator.settings import parse_setting
from reducers.reducer import Reducer, load_reducer
from rv_plant.effects import EFFECTS as PLANT_EFFECTS
from wear_fmu.effects import EFFECTS as WEAR_EFFECTS

REMEDY = "docs/diagnosis.md shows a model file"


class Head(Strict):
    name: str = Field(pattern=FILE_NAME)
    reducer: str = Field(min_length=1)


class Number(Strict):
    """A parameter of an effect, its interval, and another value that shows the same in what it was fitted to."""

    value: float
    unit: str = ""
    low: float | None = None
    high: float | None = None
    alike: float | None = None


class SignalEntry(Strict):
    """Root mean square errors of a signal [``unit``, SI] before and after a step, and its noise."""

    signal: str
    held_out: bool
    unit: str
    before: float
    after: float
    noise_floor: float


class StepEntry(Strict):
    """A step of the ladder, as ``extend`` writes it."""

    campaign: str = ""
    effects: list[str]
    verdict: str = ""
    reason: str = ""
    training_before: float | None = None
    training_after: float | None = None
    held_out_before: float | None = None
    held_out_after: float | None = None
    unseen: bool = False
    nuisances: dict[str, float] = {}
    positions: dict[str, float] = {}
    signals: list[SignalEntry] = []
    other_forms: dict[str, list[str]] = {}
    untold: list[str] = []
    kept: bool = True


class Content(Strict):
    """Of the effects' parameters only the form: which there are is known from the effects."""

    model: Head
    settings: dict[str, str | float | int] = {}
    effects: dict[str, dict[str, Any]] = {}
    steps: list[StepEntry] = []

    @field_validator("settings", mode="before")
    @classmethod
    def by_structured_name(cls, given: Any) -> Any:
        return dotted(given) if isinstance(given, dict) else given


@dataclass(frozen=True)
class ModelFile:
    """A model: ``settings`` and ``effects`` map variables to SI values; ``steps`` is the ladder so far."""

    name: str
    reducer: Reducer
    settings: dict[str, float] = field(default_factory=dict)
    effects: dict[str, dict[str, dict[str, Any]]] = field(default_factory=dict)
    steps: tuple[dict[str, Any], ...] = ()
    path: Path | None = None

    @property
    def heading(self) -> str:
        """Its name, and that of its file where this is another: several files may carry on one model; with what was refused where that is all of it."""
        if self.path is None or self.path.stem == self.name:
            return self.name
        alone = only_refused({"effects": self.effects, "settings": self.settings, "steps": self.steps})
        refused = f"; refused: {', '.join(' + '.join(step['effects']) for step in self.steps)}" if alone else ""
        return f"{self.path.name} ({self.name}{refused})"

    @property
    def label(self) -> str:
        """What a result of it is called: its name, which may be its reducer's, and that of its file; fit for file names."""
        return self.name if self.path is None or self.path.stem == self.name else f"{self.name}-{self.path.stem}"

    @property
    def in_words(self) -> str:
        """What measurements are held against: the model with its effects by name, or the base model where it has none."""
        effects = ", ".join(map(effect_words, self.effects))
        return f"the model with {effects}" if effects else "the base model"

    def values(self) -> dict[str, float]:
        """Everything that differs from the reducer file: settings and effects' parameters."""
        found = dict(self.settings)
        for parameters in self.effects.values():
            found |= {name: float(entry["value"]) for name, entry in parameters.items()}
        return found

    def zeros_of(self, campaign: str) -> dict[str, float]:
        """By its nuisance (``angle_zero[1]``) the output angle [rad] of the model at which an angle of that campaign is 0, as it was fitted."""
        return {f"{ZERO}{mounting}]": zero for (name, mounting), zero in zeros_of(self.steps).items() if name == campaign}


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
    if path.suffix == ".toml":
        with reading(path, "a model file", REMEDY):
            content = read_toml(path, "such file", "give a model file, a reducer file or the name of a reducer")
            if "model" in content:
                return model_of(content, path)
    reducer = load_reducer(name_or_path)
    return ModelFile(reducer.name, reducer)


def model_of(content: dict[str, Any], path: Path) -> ModelFile:
    stated = validated(Content, content, path, REMEDY)
    near = path.parent / stated.model.reducer
    reducer = load_reducer(near if near.is_file() else stated.model.reducer)
    tables = [reducer.plant, reducer.wear]
    settings = {}
    for name, text in stated.settings.items():
        try:
            setting = parse_setting(f"{name}={text}", tables)
            settings[setting.name] = setting.value
        except InputFault as problem:
            raise InputFault(f"{path}: settings.{name}: {problem}") from None
    known = every_effect()
    effects: dict[str, dict[str, dict[str, Any]]] = {}
    for name, parameters in stated.effects.items():
        if name not in known:
            raise InputFault(
                f"{path}: effects.{shown(name)}: there is no such effect{nearest(name, known, 1)}; `rvwear effects` lists those there are, your own"
                f" with {USER_EFFECTS}=DIR"
            )
        effects[name] = {}
        for written, entry in parameters.items():
            place = f"{path}: effects.{name}"
            key = parameter_of(known[name], written, place)
            effects[name][key] = number_of(known[name], key, entry, f"{place}.{shown(written)}")
    # As they stand in the file, where they are shown from.
    return ModelFile(stated.model.name, reducer, settings, effects, tuple(content.get("steps", ())), path)


def number_of(effect: Effect, key: str, entry: Any, place: str) -> dict[str, Any]:
    """A parameter's value and interval in its own unit, within its bounds; ``key`` is what kernels call it."""
    variable = parameter_variable(effect, key)
    usual = display_unit(variable) or variable.unit
    if isinstance(entry, str):
        value, unit = split(entry, usual, place)
        entry = {"value": value, "unit": unit}
    if not isinstance(entry, dict) or "value" not in entry:
        meant = f"{entry:g}" if is_number(entry) else "0.07"
        raise InputFault(f'{place} = {quoted(entry)}: write "{meant} {usual}", or {{ value = {meant}, unit = "{usual}" }}')
    unknown = sorted(entry.keys() - set(Number.model_fields))
    if unknown:
        raise InputFault(f"{place}.{shown(unknown[0])}: there is no such key{nearest(unknown[0], Number.model_fields, 1)}")
    try:
        number = Number(**entry)
        factor, offset = conversion(number.unit or variable.unit, variable.unit)
        numbers = {name: factor * value + offset for name in ("value", "low", "high", "alike") if (value := getattr(number, name)) is not None}
        check_given(variable, numbers["value"], bool(number.unit))
    except ValidationError as problem:
        raise InputFault(f"{place}.{described(problem, Number, entry)}") from None
    except (UnitError, ValueFault) as problem:
        raise InputFault(f"{place} = {quoted(entry)}: {problem}") from None
    return {"value": numbers["value"], "unit": variable.unit} | numbers


def parameter_variable(effect: Effect, key: str) -> Variable:
    """The variable of a parameter, or of an element of it, that kernels call so."""
    return next(p.variable for p in effect.parameters if p.variable.name == key.partition("[")[0])


def parameter_of(effect: Effect, written: str, place: str) -> str:
    """What kernels call the parameter (or an element of it) of an effect that a file calls so."""
    base, bracket, rest = written.partition("[")
    short = {last_part(p.variable.path): p.variable.name for p in effect.parameters}
    if base in short:
        return short[base] + bracket + rest
    new = next((name for name, old in short.items() if old == base), None)
    if new is None:
        raise InputFault(f"{place}.{shown(written)}: there is no such parameter; the effect's: {', '.join(sorted(short))}{nearest(base, short, 1)}")
    warn_of_old_name(base, new, place)
    return written


def written_name(effect: Effect, parameter: str) -> str:
    """What a file calls the parameter that kernels call so."""
    base, bracket, rest = parameter.partition("[")
    return next(last_part(p.variable.path) for p in effect.parameters if p.variable.name == base) + bracket + rest


def save_model(model: ModelFile, path: Path) -> None:
    """Write the model; the file is replaced at once, never left half written."""
    document = tomlkit.document()
    head = tomlkit.table()
    head.update({"name": model.name, "reducer": reducer_reference(model, path)})
    for text in zero_texts(model.reducer, model.steps):
        head.add(tomlkit.comment(text))
    document["model"] = head
    if model.settings:
        settings = tomlkit.table()
        for name, value in model.settings.items():
            written, given = as_read(model.reducer, name, value)
            settings.add(tomlkit.key(written.split(".")), given)
        document["settings"] = settings
    if model.effects:
        known = every_effect()
        document["effects"] = {
            name: {written_name(known[name], k): inline(written_entry(parameter_variable(known[name], k), v)) for k, v in parameters.items()}
            for name, parameters in model.effects.items()
        }
    if model.steps:
        steps = tomlkit.aot()
        for step in model.steps:
            steps.append(written_step(step))
        document["steps"] = steps
    write_text(path, tomlkit.dumps(document))


def written_step(step: dict[str, Any]) -> Table:
    """A step as the file has it; its calibrated numbers have SI units, of which nothing else there would tell."""
    item: Table = tomlkit.item(told_of(step))
    if item.get("positions"):
        item["positions"].comment("where positions of the input count from: output angle of the model, in rad")
    if item.get("nuisances"):
        item["nuisances"].comment("calibrated with what this step tried, in SI units (angles in rad); compare calibrates anew, to the same within its +-")
    return item


def as_read(reducer: Reducer, name: str, value: float | int) -> tuple[str, float | int | str]:
    """A setting as ``load_model`` takes it: structured name, and a choice by its name or a number with the field's unit."""
    base, bracket, rest = name.partition("[")
    variable = next(t.by_name[base] for t in (reducer.plant, reducer.wear) if base in t.by_name)
    if variable.choices:
        return variable.path + bracket + rest, variable.choices[int(value)]
    return variable.path + bracket + rest, value if variable.is_integer else written_setting(variable, value)


def extended_reducer(file: ModelFile) -> Reducer:
    """The reducer with settings and effects as start values, also of single elements, for FMUs that carry them."""
    known = {v.name for table in (file.reducer.plant, file.reducer.wear) for v in table.variables}
    values = {name: value for name, value in file.values().items() if name.partition("[")[0] in known}
    sources = dict.fromkeys(values, f"model {file.name}")
    return replace(file.reducer, starts=file.reducer.starts | values, sources=file.reducer.sources | sources)


def inline(entry: dict[str, Any]) -> InlineTable:
    table = tomlkit.inline_table()
    table.update(entry)
    return table


def reducer_reference(model: ModelFile, path: Path) -> str:
    """Name of a library reducer, or the path of its file as seen from the model file."""
    if model.reducer.is_of_library and load_or_none(model.reducer.name):
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
