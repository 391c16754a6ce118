"""What the life came from: every parameter with value, unit, meaning and source."""

import json
import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

import rv_plant.effects
import wear_fmu.effects
from fmu_src.table import Table
from fmu_src.variables import Variable
from pages.words import number
from rv_plant.variables import plant_table
from studies.report.result import Result
from wear_fmu.variables import Resolution, wear_table

# Units that read better than SI: unit -> (shown unit, factor, smallest shown value).
SHOWN = {
    "m": (("mm", 1e3, 0.05), ("µm", 1e6, 0.0)), "rad": (("°", math.degrees(1.0), 0.0),),
    "rad/s": (("rpm", 30.0 / math.pi, 0.0),), "Pa": (("GPa", 1e-9, 0.1), ("MPa", 1e-6, 0.0)),
    "s": (("h", 1.0 / 3600.0, 0.0),), "N.m": (("N m", 1.0, 0.0),), "rad/(N.m)": (("rad/(N m)", 1.0, 0.0),),
    "1": (("", 1.0, 0.0),),
}  # fmt: skip
# At their starts an effect is off, whatever its other parameters are.
AMPLITUDES = {p.variable.name for effects in (rv_plant.effects.EFFECTS, wear_fmu.effects.EFFECTS) for effect in effects.values() for p in effect.amplitudes()}
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def groups(result: Result) -> list[dict[str, Any]]:
    """Tables of parameters: heading and rows (name, value, unit, meaning, source, assumed, set for the run), those of effects that are off by themselves."""
    sizes = result.dataset.sizes
    bins = Resolution(sizes["flank_bin"], sizes["pin_bin"], sizes["race_bin"])
    plant, wear = plant_table(result.topology), wear_table(result.topology, bins)
    found: list[dict[str, Any]] = [
        {"title": "Operation", "rows": rows(result, result.plant, plant, lambda v: v.role == "input")},
        {"title": "Reducer",
         "rows": rows(result, result.plant, plant, lambda v: v.role == "parameter" and not v.shape)},
        {"title": "Wear", "rows": rows(result, result.wear, wear, lambda v: is_own(v, plant))},
        {"title": "Deviations of single parts",
         "rows": rows(result, result.plant, plant, lambda v: v.role == "parameter" and bool(v.shape))},
    ]  # fmt: skip
    return [group | parted(group["rows"]) for group in found]


def parted(every: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Rows of what acts, those of effects that are off, and how many effects these are."""
    acting = {row["effect"] for row in every if row["acts"]}
    off = [row for row in every if row["effect"] and row["effect"] not in acting]
    return {"rows": [row for row in every if row not in off], "off": off, "effects_off": len({row["effect"] for row in off})}


def is_own(variable: Variable, plant: Table) -> bool:
    """A parameter of the wear unit alone; its inputs come from the plant, the acceleration from the master."""
    return variable.role == "parameter" and variable.name not in plant.by_name and variable.name != "acceleration"


def rows(
    result: Result, values: dict[str, Any], table: Table, belongs: Callable[[Variable], bool]
) -> list[dict[str, str | bool]]:
    """Rows of the recorded values that belong to a group; unknown names go with the parameters."""
    made = []
    settings = {name.partition("[")[0] for name in named_settings(result)}
    sources = result.inputs.get("sources", {})
    order = {v.name: i for i, v in enumerate(table.variables)}
    for name in sorted(values, key=lambda n: order.get(n, len(order))):
        variable = table.by_name.get(name) or Variable(name, "parameter", "1", "")
        if not belongs(variable):
            continue
        value, unit = shown(values[name], variable.unit)
        chosen = name in settings
        acts = name in AMPLITUDES and not np.array_equal(np.asarray(values[name]), np.asarray(variable.start))
        source = "set for this run" if chosen else sources.get(name) or own_source(variable)
        made.append({
            "name": variable.path, "value": value, "unit": unit, "meaning": variable.description, "source": source,
            "assumed": source.startswith("assumed"), "chosen": chosen,
            "effect": variable.path.split(".")[1] if variable.path.startswith("effects.") else "", "acts": chosen or acts,
        })  # fmt: skip
    return made


def own_source(variable: Variable) -> str:
    """The table's own source; a start value that no reducer file changed is a default."""
    return "default" if variable.source == "reducer file" else variable.source


def named_settings(result: Result) -> dict[str, Any]:
    settings = result.inputs.get("settings", {})
    return settings if isinstance(settings, dict) else {}


def shown(value: npt.ArrayLike, unit: str) -> tuple[str, str]:
    """Value and unit as text; an array as its range."""
    if isinstance(value, str):
        return value, ""
    array = np.asarray(value, float)
    choices = SHOWN.get(unit, ((unit.replace(".", "·"), 1.0, 0.0),))
    largest = float(np.abs(array).max())
    text, factor, _ = next(c for c in choices if c[1] * largest >= c[2])
    if largest == 0.0:
        text = choices[0][0]
    low, high = float(array.min()) * factor, float(array.max()) * factor
    if array.ndim and low != high:
        return f"{value_text(low)} … {value_text(high)}", text
    return f"all {value_text(low)}" if array.ndim else value_text(low), text


def value_text(value: float) -> str:
    """Six significant digits without trailing zeros."""
    text = f"{value:.6g}"
    if "e" in text:
        digits, _, power = text.partition("e")
        return f"{digits}·10".replace("-", "−") + str(int(power)).translate(SUPERSCRIPT)
    if abs(value) >= 1e4:
        text = f"{value:,.6g}"
    return text.replace("-", "−")


def run_rows(result: Result) -> list[tuple[str, str]]:
    """How the run was made: settings, stepping, versions, fingerprint of the source."""
    made = [(f"setting {name}", f"{value:.6g}") for name, value in sorted(named_settings(result).items())]
    life = result.inputs.get("life")
    if isinstance(life, dict):
        made += [(f"life, {key.replace('_', ' ')}", f"{value:,.6g}") for key, value in life.items() if value is not None]
    made += [
        (key, str(result.inputs[key])) for key in ("scheme", "positions", "units") if key in result.inputs
    ]
    attributes = result.dataset.attrs
    if "cycles_simulated" in attributes:
        made.append(("full meshing cycles simulated", str(int(attributes["cycles_simulated"]))))
    versions = json.loads(attributes.get("software", "{}"))
    made += [(name, text) for name, text in versions.items()]
    return [*made, ("hash of the source", attributes.get("source_hash", "not recorded"))]


def counts(result: Result) -> list[tuple[str, str]]:
    """The topology."""
    t = result.topology
    return [("discs", str(t.discs)), ("cranks", str(t.cranks)), ("pins", str(t.pins)), ("lobes", str(t.lobes)),
            ("rollers per bearing", str(t.rollers)), ("K1", number(result.generating[2], 4))]  # fmt: skip
