"""An empty campaign to fill in: it loads, and the check says what is missing."""

from importlib.util import find_spec
from pathlib import Path

import pandas as pd

from discrepancy.campaign.file_format import FILE
from discrepancy.campaign.quantities import AXES, QUANTITIES, TAGS, USUAL, VALUE, Quantity, roles_of
from fmu_src.checked_file import replacing, write_text
from fmu_src.faults import InputFault, MissingPart
from fmu_src.file_name import name_of_folder

FORMATS = ("csv", "parquet")

HEAD = """\
# A measurement campaign.  docs/campaigns.md explains every key; rvwear campaign check FOLDER says what is missing.
# Numbers carry their unit: "15 rpm" or {{ value = 15, unit = "rpm" }}.  What stands here are examples: put in yours.

[campaign]
name = "{name}"
description = ""
reducer = "{reducer}"                    # a reducer of the library, or the path of a reducer file

# One section for every state of the rig.  Whole conditions are held out, not single runs.
[conditions.rated]
output_speed = "15 rpm"                  # or input_speed
load_torque = "100 %"                    # of the rated torque, or "167 N.m"
temperature = "40 degC"
hours = "0 h"                            # operating hours of the unit so far
direction = "forward"                    # or "reverse"
# locked_at = "90 deg"                   # of loops: angle of the input at which it was locked, or "mean" of positions over a turn of the cranks
mounting = "1"                           # a new word whenever unit or encoder was taken off and put back
{pin_on_disc}
[conditions.half]
output_speed = "15 rpm"
load_torque = "50 %"
temperature = "40 degC"
hours = "0 h"
direction = "forward"
mounting = "1"
held_out = true                          # kept for the test of what was found
{pin_on_disc}"""

PIN_ON_DISC = """\
normal_force = "50 N"
sliding_speed = "0.1 m/s"
sliding_distance = "1 km"
"""

TAIL = """
# Parameters that are not known and may be calibrated.
# [nuisances.encoder_phase]
# unit = "deg"
# lower = -180
# upper = 180
# per = "mounting"                       # "campaign", "mounting", "condition" or "run"

# What the rig can do, for the proposal of the next experiment.
# [rig]
# output_speed = ["1 rpm", "30 rpm"]
# load_torque = ["0 N.m", "300 N.m"]
# temperature = ["20 degC", "60 degC"]
# directions = ["forward", "reverse"]
# quantities = [{quantities}]
# cost_per_run = 100
# cost_per_hour = 20
# currency = "EUR"
"""

RUNS = (("rated", 1), ("rated", 2), ("half", 1))


def write_template(
    folder: str | Path, quantities: tuple[str, ...] = USUAL, kind: str = "csv", reducer: str = "RV20E-121"
) -> list[Path]:
    """Write campaign.toml and an empty file for each run; nothing is overwritten."""
    folder = Path(folder)
    for quantity in quantities:
        if quantity not in QUANTITIES:
            raise InputFault(f"--quantities {quantity}: not a quantity; choose from {', '.join(QUANTITIES)}")
    if kind not in FORMATS:
        raise InputFault(f"--format {kind}: choose one of {', '.join(FORMATS)}")
    if kind == "parquet" and find_spec("pyarrow") is None:
        raise MissingPart("--format parquet", "pyarrow", "measurements")
    if not quantities:
        raise InputFault(f"--quantities: give at least one of {', '.join(QUANTITIES)}")
    runs = [(QUANTITIES[q], condition, replicate) for q in quantities for condition, replicate in RUNS]
    files = {folder / file_name(*run, kind): columns_of(run[0]) for run in runs}
    existing = [path for path in (folder / FILE, *files) if path.exists()]
    if existing:
        raise InputFault(f"{existing[0]} exists already; choose another folder, nothing is overwritten")
    write_text(folder / FILE, campaign_text(folder.resolve().name, quantities, runs, kind, reducer))
    for path, columns in files.items():
        frame = pd.DataFrame({heading(*column): pd.Series(dtype=float) for column in columns})
        with replacing(path) as partial:
            if kind == "parquet":
                frame.to_parquet(partial)
            else:
                frame.to_csv(partial, index=False)
    return [folder / FILE, *files]


def campaign_text(name: str, quantities: tuple[str, ...], runs: list[tuple[Quantity, str, int]], kind: str, reducer: str) -> str:
    tribology = any("normal_force" in QUANTITIES[q].factors for q in quantities)
    parts = [HEAD.format(name=name_of_folder(name), reducer=reducer, pin_on_disc=PIN_ON_DISC if tribology else "")]
    parts += [layout_text(QUANTITIES[quantity]) for quantity in quantities]
    parts += [run_text(*run, kind) for run in runs]
    parts.append(TAIL.format(quantities=", ".join(f'"{q}"' for q in quantities)))
    return "\n".join(parts)


def layout_text(quantity: Quantity) -> str:
    """What all runs of a quantity share."""
    lines = [f"# {quantity.description[0].upper()}{quantity.description[1:]}.", f"[layouts.{quantity.name}]"]
    lines.append(f'quantity = "{quantity.name}"')
    for name in quantity.tags:
        tag = TAGS[name]
        choice = tag.choices[0] if tag.choices else "NAME"
        lines.append(f'tags.{name} = "{choice}"'.ljust(40) + f" # {', '.join(tag.choices) or tag.description}")
    for role, unit in columns_of(quantity):
        lines.append(f'columns.{role} = {{ column = "{heading(role, unit)}", unit = "{unit}" }}')
    return "\n".join(lines) + "\n"


def run_text(quantity: Quantity, condition: str, replicate: int, kind: str) -> str:
    name = file_name(quantity, condition, replicate, kind)
    return f"""\
[[runs]]
layout = "{quantity.name}"
id = "{name.rpartition(".")[0]}"
condition = "{condition}"
replicate = {replicate}
file = "{name}"
"""


def file_name(quantity: Quantity, condition: str, replicate: int, kind: str) -> str:
    return f"{quantity.name}_{condition}_{replicate}.{kind}"


def columns_of(quantity: Quantity) -> list[tuple[str, str]]:
    """Role and unit of the columns of a run: the axes, then the value."""
    axes = [key for key in AXES if key.name == key.key and key.name in quantity.axes]
    return [(key.key, key.example) for key in axes] + [(VALUE, roles_of(quantity)[VALUE].example)]


def heading(role: str, unit: str) -> str:
    return role if unit == "1" else f"{role} [{unit}]"
