"""SI values in the units of a bench, for axes and for text."""

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from discrepancy.scales import USUAL
from fmu_src.arrays import Floats
from fmu_src.units import UnitError, conversion, parse, registry
from pages.words import number

# A fit moves nothing along directions that the data do not see; its interval then has no width.
UNDETERMINED = "not determined"
# Units of two parts that read well with a prefix.
PREFIXED = ("m/N", "N/m", "m/s")
# Factors and axes, as one reads them: (unit, factor, offset).
AXES = {
    "speed": ("rpm", 30.0 / math.pi, 0.0),
    "load": ("N·m", 1.0, 0.0),
    "temperature": ("°C", 1.0, -273.15),
    "hours": ("h", 1.0 / 3600.0, 0.0),
    "angle": ("°", 180.0 / math.pi, 0.0),
    "depth_angle": ("°", 180.0 / math.pi, 0.0),
    "torque": ("N·m", 1.0, 0.0),
    "time": ("s", 1.0, 0.0),
    "order": ("", 1.0, 0.0),
    "direction": ("", 1.0, 0.0),
    "normal_force": ("N", 1.0, 0.0),
    "sliding_speed": ("m/s", 1.0, 0.0),
    "sliding_distance": ("m", 1.0, 0.0),
}
TITLES = {
    "speed": "input speed",
    "load": "load torque",
    "hours": "operating hours",
    "angle": "output angle",
    "depth_angle": "place on the surface",
    "order": "order of the output's turn",
}


def pretty(unit: str) -> str:
    """A unit's name in print."""
    return "" if unit == "1" else unit.replace("um", "µm").replace("N.m", "N·m").replace("degC", "°C").replace("^2", "²")


def scale(unit: str) -> tuple[float, str]:
    """(factor, unit) of a signal's SI unit; differences of temperature stay in kelvin."""
    usual = USUAL.get(unit, unit)
    return (1.0, pretty(unit)) if usual in ("degC", unit) else (conversion(unit, usual)[0], pretty(usual))


def text(value: float | None, unit: str) -> str:
    """A signal's value with its unit."""
    if value is None:
        return "–"
    factor, name = scale(unit)
    return f"{number(factor * value)} {name}".rstrip()


def axis_values(name: str, values: npt.ArrayLike) -> Floats:
    _, factor, offset = AXES.get(name, ("", 1.0, 0.0))
    return np.asarray(values, np.float64) * factor + offset


def axis_title(name: str) -> str:
    unit = AXES.get(name, ("", 1.0, 0.0))[0]
    title = TITLES.get(name, name.replace("_", " "))
    return f"{title} [{unit}]" if unit else title


def chance(p: float) -> str:
    """``p = 2e-07``; computers run out of digits before nature does."""
    return f"p = {p:.1g}" if p > 1e-300 else "p < 1e-300"


def effect_title(name: str) -> str:
    """``sensor_gain.input_torque`` as words."""
    effect, _, variant = name.replace("_", " ").partition(".")
    return effect + (f" ({variant})" if variant else "")


def signal_title(signal: str) -> str:
    """``wear_depth[surface=pin]`` as words."""
    name, _, tags = signal.partition("[")
    words = name.replace("_", " ")
    return words + (f" ({tags.rstrip(']').replace('=', ' ').replace(',', ', ').replace('_', ' ')})" if tags else "")


def signal_axis(signal: str, unit: str) -> str:
    """Without tags, which the figure's title has."""
    name = scale(unit)[1]
    return signal_title(signal.partition("[")[0]) + (f" [{name}]" if name else "")


def estimate(entry: dict[str, Any]) -> tuple[str, str, str]:
    """(value, interval, unit) of a parameter, all in one unit that suits its size."""
    low, high = entry["interval"]
    size = max((abs(v) for v in (entry["value"], low, high) if math.isfinite(v)), default=0.0)
    factor, unit = fitting(size, entry["unit"])
    if high - low <= 1e-9 * size:
        return number(factor * entry["value"]), UNDETERMINED, unit
    # As many digits as tell the ends apart.
    digits = next((d for d in range(3, 8) if number(factor * low, d) != number(factor * high, d)), 8)
    return number(factor * entry["value"], digits), f"{number(factor * low, digits)} to {number(factor * high, digits)}", unit


def fitting(size: float, unit: str) -> tuple[float, str]:
    """(factor, unit): the usual unit, or the SI unit with a prefix; pint knows them."""
    if unit in USUAL:
        return scale(unit)
    try:
        quantity = registry().Quantity(size, parse(unit))
    except UnitError:
        return 1.0, pretty(unit)
    if quantity.dimensionless or not 0.0 < size < math.inf or (len(dict(quantity.unit_items())) > 1 and unit not in PREFIXED):
        return 1.0, pretty(unit)
    if unit.startswith("1/"):
        # 1/GK and the like are nobody's units.
        return 1.0, pretty(unit)
    compact = quantity.to_compact()
    return float(compact.magnitude / size), f"{compact.units:~P}"
