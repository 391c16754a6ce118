"""Unit, start and bounds of an effect's parameters as people read them."""

import math

from discrepancy.scales import Scale, of_variable
from fmu_src.effect import EffectParameter

# Bounds so far apart [rad] leave no direction out; they may be written with few digits.
ANY = 2.0 * math.pi - 0.01


def scale_of(p: EffectParameter) -> Scale:
    """The unit that answers give a parameter in: of its usual size, or of where it starts."""
    return of_variable(p.variable, abs(p.scale) if p.kind == "amplitude" else abs(float(p.variable.start)))


def range_of(p: EffectParameter) -> tuple[str, str, str]:
    """Unit, start and bounds, or the names that may be chosen."""
    v, scale = p.variable, scale_of(p)
    if v.choices:
        return "", v.choices[int(v.start)], ", ".join(v.choices)
    start, low, high = (scale.number(value) + 0.0 for value in (float(v.start), v.minimum, v.maximum))
    return "" if scale.unit == "1" else scale.unit, f"{start:.4g}", "any" if goes_all_round(p) else f"{low:.4g} to {high:.4g}"


def goes_all_round(p: EffectParameter) -> bool:
    """Whether bounds leave no direction out."""
    v = p.variable
    return p.kind == "shape" and v.unit == "rad" and v.maximum - v.minimum >= ANY
