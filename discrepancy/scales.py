"""SI values in the units that a bench uses; what is computed stays in SI."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from discrepancy.campaign.amount import readable
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.problem import is_direction
from discrepancy.words.intervals import both_texts, digits_of, estimate_text, is_any, relied_on
from fmu_src.display import display_unit
from fmu_src.units import UnitError, conversion, parse, registry
from fmu_src.variables import Variable

# What numbers of no one quantity are shown in, by their SI unit.
USUAL = {
    "m": "um", "m/s^2": "m/s^2", "kg": "mg", "rad/s": "rpm", "N.m/rad": "N.m/arcmin", "rad/(N.m)": "arcmin/(N.m)", "kg.m": "g.mm",
    "m/(N.m)": "um/(N.m)",
}  # fmt: skip
# Units of two parts that read well with a prefix.
PREFIXED = ("m/N", "N/m", "m/s")
ABSOLUTE_ZERO = -273.15
# From here on a number in kelvin is a temperature and no difference of two: no test rig warms by so much (assumed).
TEMPERATURE = 150.0
ARCMIN, DEGREE = math.pi / 180.0 / 60.0, math.pi / 180.0
# From here on a length is that of a part and no error of one.
MILLIMETRE = 1e-3
# What calibrated numbers are called that say where an angle counts from, with the mounting in brackets behind it.
ZERO_OF_ANGLES = "angle_zero"
# An angle is told in the next larger unit from this many on.
MANY = 120.0


@dataclass(frozen=True)
class Scale:
    """A way to tell an SI value: ``factor * value + offset`` in ``unit``."""

    factor: float = 1.0
    unit: str = "1"
    offset: float = 0.0

    def number(self, value: float) -> float:
        return self.factor * value + self.offset

    def text(self, value: float, digits: int = 3) -> str:
        return f"{readable(self.number(value), digits)} {'' if self.unit == '1' else self.unit}".rstrip()

    def span(self, low: float, high: float, digits: int = 3) -> str:
        """``1.2 um to 3.4 um``, with more digits than these where the ends would look alike."""
        digits = digits_of(self.number(low), self.number(high), digits, readable)
        return f"{self.text(low, digits)} to {self.text(high, digits)}"


def of_signal(signal: str, unit: str) -> Scale:
    """Of a difference of a signal (``quantity[tags]``, its SI unit), in its quantity's usual unit; temperatures in kelvin."""
    quantity = QUANTITIES.get(signal.partition("[")[0])
    usual = quantity.usual_unit if quantity and quantity.unit == unit else "arcsec" if unit == "rad" else USUAL.get(unit, unit)
    return Scale(1.0, unit) if usual in ("degC", unit) else Scale(conversion(unit, usual)[0], usual)


def of_parameter(size: float, unit: str, direction: bool = False) -> Scale:
    """Of a parameter of about ``size`` (SI): the field's unit, or the SI unit with a prefix; pint knows them.

    ``direction``: an angle that says where something stands, which is told in degrees however small it is.
    """
    if unit == "rad":
        usual = "deg" if direction else "arcsec" if size < MANY * ARCMIN / 60.0 else "arcmin" if size < MANY * ARCMIN else "deg"
        return Scale(conversion(unit, usual)[0], usual)
    if unit == "K":
        return Scale(1.0, "degC", ABSOLUTE_ZERO) if size > TEMPERATURE else Scale(1.0, unit)
    if unit == "s" and size >= 3600.0:
        return Scale(1.0 / 3600.0, "h")
    if unit == "m" and size >= MILLIMETRE:
        return Scale(1e3, "mm")
    if unit in USUAL:
        return Scale(conversion(unit, USUAL[unit])[0], USUAL[unit])
    try:
        quantity = registry().Quantity(size, parse(unit))
    except UnitError:
        return Scale(1.0, unit)
    # A quotient that is not known to take a prefix, whether parts of it cancel (m.m/(N.m)) or not: 1/GN, 1/GK and the like are nobody's units.
    if quantity.dimensionless or not 0.0 < size < math.inf or (unit not in PREFIXED and ("/" in unit or len(dict(quantity.unit_items())) > 1)):
        return Scale(1.0, unit)
    compact = quantity.to_compact()
    return Scale(float(compact.magnitude / size), f"{compact.units:~P}")


def of_calibrated(name: str, size: float, unit: str) -> Scale:
    """Of a number of about ``size`` (SI) that a campaign calibrates: zeros of angles in degrees, as a campaign's angles and a model file have them."""
    return of_parameter(size, unit, name.startswith(ZERO_OF_ANGLES))


# Axes and factors as one reads them; a speed as the campaign states it.
AXES = {
    "speed": Scale(30.0 / math.pi, "rpm"), "load": Scale(1.0, "N.m"), "temperature": Scale(1.0, "degC", ABSOLUTE_ZERO),
    "hours": Scale(1.0 / 3600.0, "h"), "angle": Scale(1.0 / DEGREE, "deg"), "depth_angle": Scale(1.0 / DEGREE, "deg"),
    "locked_at": Scale(1.0 / DEGREE, "deg"),
    "torque": Scale(1.0, "N.m"), "time": Scale(1.0, "s"), "normal_force": Scale(1.0, "N"), "sliding_speed": Scale(1.0, "m/s"),
    "sliding_distance": Scale(1.0, "m"),
}  # fmt: skip


def of_axis(name: str, campaign: Campaign | None = None) -> Scale:
    """Of an axis or a factor; its speed counts at the output where the campaign states it there."""
    scale = AXES.get(name, Scale())
    if name == "speed" and campaign is not None and campaign.speed_at == "output" and campaign.ratio:
        return Scale(scale.factor / campaign.ratio, scale.unit)
    return scale


def unit_of_axis(name: str, campaign: Campaign) -> str:
    """The unit that ``of_axis`` leads to, with where speeds are counted; empty without one."""
    unit = of_axis(name, campaign).unit
    if name == "speed":
        return f"{unit} at the {'output' if campaign.speed_at == 'output' and campaign.ratio else 'input'}"
    return "" if unit == "1" else unit


def shown(value: float, unit: str, signal: str = "") -> str:
    """A difference of a signal [``unit``, SI] with three digits."""
    return of_signal(signal, unit).text(value)


def parameter_texts(value: float, interval: tuple[float, float], unit: str, direction: bool = False) -> tuple[str, str, str]:
    """(value, interval, unit) of an estimate, all in one unit."""
    scale = of_parameter(largest(value, *interval), unit, direction)
    low, high = (scale.number(v) for v in interval)
    return *estimate_text(scale.number(value), (low, high), 4, readable), "" if scale.unit == "1" else scale.unit


def of_variable(variable: Variable, size: float) -> Scale:
    """Of an effect's parameter, or another variable, of about ``size`` (SI)."""
    return of_parameter(size, variable.unit, is_direction(variable.unit, variable.minimum, variable.maximum))


def of_number(variable: Variable) -> Scale:
    """Of a number of the reducer, whatever its size: as its page, its file and the list of all variables have it."""
    unit = display_unit(variable) or variable.unit
    factor, offset = conversion(variable.unit, unit)
    return Scale(factor, unit, offset)


def of_estimate(entry: Mapping[str, Any]) -> Scale:
    """Of an estimate as a diagnosis has it, which fits value and interval."""
    return of_parameter(largest(entry["value"], *relied_on(entry)), entry["unit"], entry.get("direction", False))


def estimate_texts(entry: Mapping[str, Any]) -> tuple[str, str, str]:
    """``parameter_texts`` of an estimate as a diagnosis has it, with the other value that shows the same where there is one."""
    scale = of_estimate(entry)
    return *both_texts(entry, scale.number, 4, readable), "" if scale.unit == "1" or is_any(entry) else scale.unit


def largest(*values: float) -> float:
    """The largest size among finite numbers; 0 without any."""
    return max((abs(v) for v in values if math.isfinite(v)), default=0.0)
