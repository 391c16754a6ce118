"""Campaign folders: campaign.toml and CSV files, the sealed truth beside them."""

import hashlib
import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.blind_trial.generator.designs import Design, Run
from benchmarks.blind_trial.generator.laws.shared import RATIO
from benchmarks.blind_trial.generator.reducer import HOUR, RIGID
from benchmarks.blind_trial.generator.style import Style
from fmu_src.arrays import Floats
from fmu_src.units import conversion

RPM = math.pi / 30.0
# Unit in the files, and what one of it is in SI.
UNITS = {
    "transmission_error": ("arcsec", math.pi / 648000.0), "hysteresis": ("arcsec", math.pi / 648000.0), "input_torque": ("N.m", 1.0),
    "wear_depth": ("um", 1e-6), "wear_profile": ("um", 1e-6), "vibration_order": ("m/s^2", 1.0), "cage_speed": ("rpm", RPM),
}  # fmt: skip
SI = {
    "transmission_error": "rad", "hysteresis": "rad", "input_torque": "N.m", "wear_depth": "m", "wear_profile": "m", "torque": "N.m", "angle": "rad",
}  # fmt: skip
AXES = {"angle": ("deg", math.pi / 180.0), "torque": ("N.m", 1.0), "depth_angle": ("deg", math.pi / 180.0), "order": ("1", 1.0)}
ROW_KEYS = {"input_torque": ("input_speed",), "cage_speed": ("load_torque",), "wear_depth": ("hours",)}
ROWS = {"input_speed": ("rpm", "speed", RPM), "load_torque": ("N.m", "load", 1.0), "hours": ("h", "hours", HOUR)}


def seal_of(truth: dict[str, Any]) -> tuple[str, str]:
    """The truth as text, and its SHA-256."""
    text = json.dumps(truth, indent=1, sort_keys=True, default=float) + "\n"
    return text, hashlib.sha256(text.encode()).hexdigest()


def unit_of(name: str, style: Style) -> tuple[str, float]:
    """Unit in the files of a quantity or an axis, and what one of it is in SI."""
    usual = UNITS.get(name) or AXES[name]
    unit = style.units.get(name)
    return (unit, conversion(unit, SI[name])[0]) if unit else usual


def write_campaign(folder: Path, name: str, design: Design, runs: list[Run], seal: str, description: str = "",
                   rig: str = "", reducer: str = RIGID) -> None:
    """``runs`` have id, series, replicate, axes, values (SI); ``rig`` is that section of the file, if it has one; ``reducer`` the base model."""
    folder.mkdir(parents=True, exist_ok=True)
    style = design.style
    lines = ["[campaign]", f'name = "{name}"', f'description = "{description}"', f'reducer = "{reducer}"', f'seal = "sha256:{seal}"', "", rig]
    for key, at in design.conditions.items():
        speed = at.speed / RPM / (RATIO if style.speed_at == "output" else 1.0)
        lines += [f"[conditions.{key}]", f'{style.speed_at}_speed = "{speed:.6g} rpm"', f'load_torque = "{at.load:.6g} N.m"',
                  f'temperature = "{at.temperature - 273.15:.6g} degC"', f'hours = "{at.hours / HOUR:.6g} h"',
                  f'direction = "{"forward" if at.direction > 0 else "reverse"}"', f'mounting = "{design.mounting.get(key, "1")}"']  # fmt: skip
        if any(s.quantity == "hysteresis" and s.condition == key for s in design.series):
            # The plain reducer's loops are means over a turn of the cranks.
            lines.append('locked_at = "mean"')
        if key in design.held_out:
            lines.append("held_out = true")
        lines.append("")
    for key, entry in design.nuisances.items():
        lines += [f"[nuisances.{key}]", f'unit = "{entry["unit"]}"', *(f"{k} = {v!r}" for k, v in entry.items() if k != "unit"), ""]
    for run in runs:
        s = run["series"]
        file = f"{run['id']}.csv"
        unit, size = unit_of(s.quantity, style)
        lines += ["[[runs]]", f'id = "{run["id"]}"', f'quantity = "{s.quantity}"', f'condition = "{s.condition}"',
                  f"replicate = {run['replicate']}", f'file = "{file}"', f'columns.value = {{ column = "y", unit = "{unit}" }}']  # fmt: skip
        if style.units_line:
            lines.append("units_line = true")
        columns: dict[str, Floats] = {}
        units = []
        for axis, values in run["axes"].items():
            axis_unit, axis_size = unit_of(axis, style)
            columns[axis] = values / axis_size
            units.append(axis_unit)
            lines.append(f'columns.{axis} = {{ column = "{axis}", unit = "{axis_unit}" }}')
        for key in ROW_KEYS.get(s.quantity, ()):
            row_unit, attribute, row_size = ROWS[key]
            columns[key] = np.array([getattr(r, attribute) for r in s.rows]) / row_size
            units.append(row_unit)
            lines.append(f'columns.{key} = {{ column = "{key}", unit = "{row_unit}" }}')
        for key, word in s.tags.items():
            lines.append(f'tags.{key} = "{word}"')
        if s.replicates == 1:
            level = float(np.sqrt(np.mean(s.noise.sigma**2 + (s.noise.relative * run["values"]) ** 2)))
            lines.append(f'noise = "{level / size:.4g} {unit}"')
        lines.append("")
        columns["y"] = run["values"] / size
        write_table(folder / file, columns, [*units, unit], style)
    (folder / "campaign.toml").write_text("\n".join(lines), encoding="utf-8")


def write_table(path: Path, columns: dict[str, Floats], units: list[str], style: Style) -> None:
    mark = style.delimiter
    head = [mark.join(columns)] + ([mark.join(units)] if style.units_line else [])
    rows = (mark.join("" if math.isnan(v) else f"{v:.8g}".replace(".", style.decimal) for v in row) for row in zip(*columns.values()))
    path.write_text("\n".join([*head, *rows]) + "\n", encoding="utf-8")
