"""Results as JSON by the names and in the units that screen and page have; ``si`` beside says the same in SI units."""

from collections.abc import Mapping, Sequence
from typing import Any

from discrepancy.campaign.model import Campaign
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.verdict import BaseError
from discrepancy.model_file import ModelFile, every_effect, parameter_variable
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import is_direction as bounds_of_direction
from discrepancy.scales import largest, of_axis, of_calibrated, of_estimate, of_parameter, of_signal
from discrepancy.words.intervals import relied_on
from fmu_src.table import Table
from reducers.reducer import Reducer


def told_name(name: str, tables: Sequence[Table]) -> str:
    """What people call the variable (or an element of it) that kernels call so: ``mesh.stiffness``, ``effects.thermal_expansion.expansion``."""
    base, bracket, rest = name.partition("[")
    found = next((t.by_name[base] for t in tables if base in t.by_name), None)
    return (found.path if found else base) + bracket + rest


def tables_of(model: object) -> Sequence[Table]:
    """Where the names of the variables of a model, or of a model file, stand."""
    if isinstance(model, ModelFile) and isinstance(model.reducer, Reducer):
        return model.reducer.plant, model.reducer.wear
    return model.bench.tables if isinstance(model, PhysicalModel) else ()


def effect_name(effect: str, parameter: str) -> str:
    """``told_name`` of an effect's parameter, which needs no reducer."""
    base, bracket, rest = parameter.partition("[")
    known = every_effect()
    path = next((p.variable.path for p in known[effect].parameters if p.variable.name == base), base) if effect in known else base
    return path + bracket + rest


def is_direction(effect: str, parameter: str) -> bool:
    """Whether an effect's parameter says where something stands."""
    known = every_effect().get(effect)
    v = parameter_variable(known, parameter) if known else None
    return v is not None and bounds_of_direction(v.unit, v.minimum, v.maximum)


def row(entry: Mapping[str, Any], signal: str, unit: str, keys: Sequence[str]) -> dict[str, Any]:
    """An entry whose ``keys`` are differences or sizes of a signal [``unit``, SI]."""
    scale = of_signal(signal, unit)
    here = [key for key in keys if entry.get(key) is not None]
    return {**entry, **{key: scale.number(entry[key]) for key in here}, "unit": scale.unit, "si": {key: entry[key] for key in here} | {"unit": unit}}


def figures(found: Sequence[KeyFigure]) -> list[dict[str, Any]]:
    return [row(f.as_json(), f.told_as, f.unit, ("measured", "model", "noise", "model_curve")) for f in found]


def parameter(entry: Mapping[str, Any]) -> dict[str, Any]:
    """An estimate: value, interval and standard deviation in the field's unit."""
    low, high = relied_on(entry)
    scale = of_estimate(entry)
    told = {"value": scale.number(entry["value"]), "interval": [scale.number(low), scale.number(high)], "unit": scale.unit}
    if "alike" in entry:
        told["alike"] = scale.number(entry["alike"])
    if "standard_deviation" in entry:
        told["standard_deviation"] = abs(scale.factor) * entry["standard_deviation"]
    if "interval_with_base" in entry:
        # Of the noise alone, with the base model's numbers as its file has them.
        told["interval_with_base_as_it_is"] = [scale.number(v) for v in entry["interval"]]
    si = {**entry, "interval": [low, high], "interval_with_base_as_it_is": entry["interval"]}
    plain = {key: value for key, value in entry.items() if key != "interval_with_base"}
    return {**plain, **told, "si": {key: si[key] for key in told}}


def parameters(entries: Mapping[str, Mapping[str, Any]], tables: Sequence[Table]) -> dict[str, dict[str, Any]]:
    """Estimates by their structured names."""
    found = {}
    for name, entry in entries.items():
        others = {"told_with": [told_name(other, tables) for other in entry["told_with"]]} if "told_with" in entry else {}
        found[told_name(name, tables)] = parameter(entry) | others
    return found


def numbers(values: Mapping[str, float], units: Mapping[str, str], tables: Sequence[Table]) -> dict[str, dict[str, Any]]:
    """Single values (nuisances, base numbers) by their structured names; ``units`` are SI."""
    found = {}
    for name, value in values.items():
        unit = units.get(name, "1")
        scale = of_calibrated(name, abs(value), unit)
        found[told_name(name, tables)] = {"value": scale.number(value), "unit": scale.unit, "si": {"value": value, "unit": unit}}
    return found


def added(effect: str, parameter: str, entry: Mapping[str, Any]) -> dict[str, Any]:
    """A parameter as a model file has it: value, ends of its interval, the other value that shows the same."""
    keys = [key for key in ("value", "low", "high", "alike") if key in entry]
    ends = [entry[key] for key in keys]
    scale = of_parameter(largest(*ends), entry.get("unit", "1"), is_direction(effect, parameter))
    told = {key: scale.number(entry[key]) for key in keys} | {"unit": scale.unit}
    return {**entry, **told, "si": dict(entry)}


def base_error(e: BaseError, tables: Sequence[Table]) -> dict[str, Any]:
    """What of the base model is off."""
    scale = of_parameter(largest(e.value, *e.interval), e.unit)
    told = {"value": scale.number(e.value), "interval": [scale.number(v) for v in e.interval], "assumed": scale.number(e.assumed),
            "within": [scale.number(v) for v in e.within], "unit": scale.unit}  # fmt: skip
    plain = e.to_dict()
    return {**plain, **told, "name": told_name(e.name, tables), "si": {key: plain[key] for key in told}}


def noises(streams: Mapping[str, Mapping[str, Any]], units: Mapping[str, str]) -> dict[str, dict[str, Any]]:
    """Noise of each signal [``units``, SI]."""
    found = {}
    for signal, stream in streams.items():
        if signal not in units:
            found[signal] = dict(stream)
            continue
        told = row(stream, signal, units[signal], ("scale",))
        factor = of_signal(signal, units[signal]).factor
        told["si"]["between_runs"] = stream["between_runs"]
        found[signal] = told | {"between_runs": {kind: factor * size for kind, size in stream["between_runs"].items()}}
    return found


def setting(name: str, value: float, campaign: Campaign) -> dict[str, Any]:
    """What a bench would be set to."""
    scale = of_axis(name, campaign)
    return {"value": scale.number(value), "unit": scale.unit, "si": value}
