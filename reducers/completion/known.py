"""Measured numbers as a user writes them: ``pin.radius=3mm``."""

import math
import re
from collections.abc import Iterable

from fmu_src.display import usual_unit
from fmu_src.faults import InputFault, nearest
from fmu_src.units import UnitError, conversion
from reducers.completion.complete import UNITS

# What follows from ratio, torque and speed, and the option that says it.
FROM_OPTIONS = {
    "first_stage.ratio": "--ratio and --pins", "input.speed": "--ratio and --speed", "output.load_torque": "--rated",
    "wear.run_in_crank_speed": "--speed and --pins",
}  # fmt: skip
NUMBER = re.compile(r"\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)\s*(.*?)\s*$")


def known_numbers(texts: Iterable[str]) -> dict[str, float]:
    """By name in the units of ``UNITS``; InputFault names option, value, unit and remedy."""
    found: dict[str, float] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not equals:
            raise InputFault(f"--known {text}: write NAME=VALUE with a unit, for instance --known pin.radius=3mm")
        if name in FROM_OPTIONS:
            raise InputFault(f"--known {text}: {name} follows from {FROM_OPTIONS[name]}; give these")
        if name not in UNITS:
            names = sorted(UNITS.keys() - FROM_OPTIONS.keys())
            raise InputFault(f"--known {text}: there is no number {name!r} to complete{nearest(name, names) or f'; there are {chr(44).join(names)}'}")
        if name in found:
            raise InputFault(f"--known {text}: {name} is given twice; keep one")
        found[name] = number(text, name, value)
    return found


def number(text: str, name: str, value: str) -> float:
    unit = UNITS[name]
    match = NUMBER.match(value)
    if not match or not (match[2] or unit == "1"):
        raise InputFault(f"--known {text}: give a number with its unit, for instance --known {name}={'3' if unit == '1' else f'3{usual_unit(unit, 1.0)}'}")
    try:
        factor, offset = conversion(match[2] or "1", unit)
    except UnitError as problem:
        raise InputFault(f"--known {text}: {problem}") from None
    given = factor * float(match[1]) + offset
    if not math.isfinite(given) or (unit in ("mm", "N", "kg", "kg.m^2") and given <= 0.0):
        raise InputFault(f"--known {text}: {name} must be a finite number above 0 {unit}")
    return given
