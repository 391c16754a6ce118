"""Campaign folders: campaign.toml and CSV files, the sealed truth beside them."""

import hashlib
import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.blind_trial.generator.designs import Design, Run
from benchmarks.blind_trial.generator.reducer import HOUR
from fmu_src.arrays import Floats

RPM = math.pi / 30.0
# Unit in the files, and what one of it is in SI.
UNITS = {
    "transmission_error": ("arcsec", math.pi / 648000.0), "hysteresis": ("arcsec", math.pi / 648000.0), "input_torque": ("N.m", 1.0),
    "wear_depth": ("um", 1e-6), "wear_profile": ("um", 1e-6), "vibration_order": ("m/s^2", 1.0), "cage_speed": ("rpm", RPM),
}  # fmt: skip
AXES = {"angle": ("deg", math.pi / 180.0), "torque": ("N.m", 1.0), "depth_angle": ("deg", math.pi / 180.0), "order": ("1", 1.0)}
ROW_KEYS = {"input_torque": ("input_speed",), "cage_speed": ("load_torque",), "wear_depth": ("hours",)}
ROWS = {"input_speed": ("rpm", "speed", RPM), "load_torque": ("N.m", "load", 1.0), "hours": ("h", "hours", HOUR)}


def seal_of(truth: dict[str, Any]) -> tuple[str, str]:
    """The truth as text, and its SHA-256."""
    text = json.dumps(truth, indent=1, sort_keys=True, default=float) + "\n"
    return text, hashlib.sha256(text.encode()).hexdigest()


def write_campaign(folder: Path, name: str, design: Design, runs: list[Run], seal: str, description: str = "",
                   rig: str = "") -> None:
    """``runs`` have id, series, replicate, axes, values (SI); ``rig`` is that section of the file, if it has one."""
    folder.mkdir(parents=True, exist_ok=True)
    lines = ["[campaign]", f'name = "{name}"', f'description = "{description}"', 'reducer = "RV20E-121"', f'seal = "sha256:{seal}"', "", rig]
    for key, at in design.conditions.items():
        lines += [f"[conditions.{key}]", f'input_speed = "{at.speed / RPM:.6g} rpm"', f'load_torque = "{at.load:.6g} N.m"',
                  f'temperature = "{at.temperature - 273.15:.6g} degC"', f'hours = "{at.hours / HOUR:.6g} h"',
                  f'direction = "{"forward" if at.direction > 0 else "reverse"}"', f'mounting = "{design.mounting.get(key, "1")}"']  # fmt: skip
        if key in design.held_out:
            lines.append("held_out = true")
        lines.append("")
    for key, entry in design.nuisances.items():
        lines += [f"[nuisances.{key}]", f'unit = "{entry["unit"]}"', *(f"{k} = {v!r}" for k, v in entry.items() if k != "unit"), ""]
    for run in runs:
        s = run["series"]
        file = f"{run['id']}.csv"
        unit, size = UNITS[s.quantity]
        lines += ["[[runs]]", f'id = "{run["id"]}"', f'quantity = "{s.quantity}"', f'condition = "{s.condition}"',
                  f"replicate = {run['replicate']}", f'file = "{file}"', f'columns.value = {{ column = "y", unit = "{unit}" }}']  # fmt: skip
        columns: dict[str, Floats] = {}
        for axis, values in run["axes"].items():
            axis_unit, axis_size = AXES[axis]
            columns[axis] = values / axis_size
            lines.append(f'columns.{axis} = {{ column = "{axis}", unit = "{axis_unit}" }}')
        for key in ROW_KEYS.get(s.quantity, ()):
            row_unit, attribute, row_size = ROWS[key]
            columns[key] = np.array([getattr(r, attribute) for r in s.rows]) / row_size
            lines.append(f'columns.{key} = {{ column = "{key}", unit = "{row_unit}" }}')
        for key, word in s.tags.items():
            lines.append(f'tags.{key} = "{word}"')
        if s.replicates == 1:
            level = float(np.sqrt(np.mean(s.noise.sigma**2 + (s.noise.relative * run["values"]) ** 2)))
            lines.append(f'noise = "{level / size:.4g} {unit}"')
        lines.append("")
        columns["y"] = run["values"] / size
        write_csv(folder / file, columns)
    (folder / "campaign.toml").write_text("\n".join(lines), encoding="utf-8")


def write_csv(path: Path, columns: dict[str, Floats]) -> None:
    rows = zip(*columns.values())
    text = "\n".join(",".join("" if math.isnan(v) else f"{v:.8g}" for v in row) for row in rows)
    path.write_text(",".join(columns) + "\n" + text + "\n", encoding="utf-8")
