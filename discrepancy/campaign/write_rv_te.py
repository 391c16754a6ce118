"""The campaign of ``from_rv_te``: campaign.toml and one table of orders."""

import os
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from discrepancy.campaign.file_format import FILE
from discrepancy.campaign.from_rv_te import RATIO, Measured
from fmu_src.checked_file import write_text
from fmu_src.faults import InputFault

TABLE = "orders.csv"
ARCSEC = 180.0 * 3600.0 / np.pi
# Which conditions are held out hangs on nothing but their names.
SEED = 81
HEAD = """\
# Orders of the transmission error of a real RV reducer, ratio 81, 40 pins and 39 lobes; made by rvwear campaign from-rv-te.
# TE = a0 + sum a_k cos(k theta + p_k), TE = output - input/81, theta counted forward, in both senses of rotation.
[campaign]
name = "{name}"
description = "XiLab-Robotics/Physics-Informed-Neural-Networks; doi 10.1016/j.rcim.2024.102838"
{reducer}

# The encoder's zero on the reducer is not known: one angle theta_0 for all orders, p_k + k theta_0.
[nuisances.encoder_phase]
unit = "deg"
lower = -180
upper = 180
per = "mounting"

{means}
[layouts.orders]
quantity = "transmission_order"
noise = "{noise}"                        # standard deviation of each of an order's two numbers{assumed}
file = "{table}"
columns.order = {{ column = "order", unit = "1" }}
columns.value = {{ column = "amplitude", unit = "arcsec" }}
columns.phase = {{ column = "phase", unit = "rad" }}
"""
CONDITION = """
[conditions.{name}]
input_speed = "{speed:g} rpm"
load_torque = "{torque:g} N.m"
temperature = "{temperature:g} degC"
hours = "0 h"
direction = "{direction}"
mounting = "1"
"""
RUN = """
[[runs]]
layout = "orders"
id = "{id}"
condition = "{condition}"
replicate = {replicate}
where = {{ run = "{id}" }}
"""
NOISE = "0.3 arcsec"
UNUSED = """\
# The mean (order 0) stands in the table and is not used unless its zero is said to be known:
# [quantities.transmission_order]
# zero = "absolute"
"""
# The zero is not known, and one for all runs: no part of the reducer is blamed for it.
USED = """\
[quantities.transmission_order]
zero = "absolute"
zero_noise = "8 arcsec"                      # zeros jump from session to session (by eye, over the torque)

# All runs share one zero of the encoders, over the mean size of what was measured.
[nuisances."sensor_offset[transmission_error]"]
unit = "1"
lower = -10
upper = 10
"""


def write_campaign(folder: Path, runs: Sequence[Measured], reducer: str | None, rated: float, noise: str | None, share: float,
                   means: bool = False) -> list[Path]:  # fmt: skip
    """Write the campaign; a ``share`` of the whole conditions is held out.  Without a ``reducer`` its ratio and ``rated`` torque [N m] are stated.

    With ``means`` order 0 counts: all runs share one zero.
    """
    if not 0.0 <= share < 1.0:
        raise InputFault(f"--held-out {share:g}: give a share of the conditions from 0 to below 1")
    for path in (folder / FILE, folder / TABLE):
        if path.exists():
            raise InputFault(f"{path} exists already; choose another folder, nothing is overwritten")
    runs = sorted(runs, key=lambda r: (r.direction, r.temperature, r.speed, r.torque))
    conditions = {r.condition: r for r in runs}
    held = held_out(sorted(conditions), share)
    if reducer and reducer.endswith(".toml"):
        reducer = os.path.relpath(reducer, folder).replace(os.sep, "/")
    stated = f'reducer = "{reducer}"' if reducer else f'ratio = {RATIO:g}                 # without a reducer file\nrated_torque = "{rated:g} N.m"'
    assumed = "" if noise else " (assumed)"
    head = HEAD.format(name="rig of ratio 81", reducer=stated, noise=noise or NOISE, assumed=assumed, table=TABLE, means=USED if means else UNUSED)
    parts, lines, counted = [head], ["run,order,amplitude,phase"], Counter[str]()
    for name, r in conditions.items():
        text = CONDITION.format(name=name, speed=r.speed, torque=r.torque, temperature=r.temperature, direction=r.direction)
        parts.append(text + ("held_out = true\n" if name in held else ""))
    for r in runs:
        counted[r.condition] += 1
        name = r.condition + (f"_{counted[r.condition]}" if counted[r.condition] > 1 else "")
        units = {"load_torque": "N.m", "temperature": "degC"}
        actual = ", ".join(f'{key} = "{number:.6g} {units[key]}"' for key, number in r.actual.items())
        text = RUN.format(id=name, condition=r.condition, replicate=counted[r.condition])
        parts.append(text + (f"actual = {{ {actual} }}\n" if actual else ""))
        for order, a in zip(r.orders, r.amplitudes):
            amplitude, phase = (a.real, 0.0) if order == 0.0 else (abs(a), float(np.angle(a)))
            lines.append(f"{name},{order:g},{amplitude * ARCSEC:.6g},{phase:.6g}")
    write_text(folder / TABLE, "\n".join(lines) + "\n")
    write_text(folder / FILE, "".join(parts))
    return [folder / FILE, folder / TABLE]


def held_out(names: Sequence[str], share: float, seed: int = SEED) -> set[str]:
    """Whole combinations of torque, speed, temperature and sense of rotation: of each sense its share.

    A name begins with its sense (``fw_1000rpm_300Nm_25degC``).  Drawn from all together, 13 of 49 forward and 15 backward conditions had 2 backward ones,
    on which no error can rest.
    """
    whole = round(share * len(names))
    by_sense: dict[str, list[str]] = {}
    for k in np.random.default_rng(seed).permutation(len(names)):
        by_sense.setdefault(names[k].partition("_")[0], []).append(names[k])
    counts = {sense: int(share * len(own)) for sense, own in by_sense.items()}
    # What rounding leaves goes to those that are furthest below their share.
    short = sorted(by_sense, key=lambda sense: (counts[sense] - share * len(by_sense[sense]), sense))
    for sense in short[: whole - sum(counts.values())]:
        counts[sense] += 1
    return {name for sense, own in by_sense.items() for name in own[: counts[sense]]}
