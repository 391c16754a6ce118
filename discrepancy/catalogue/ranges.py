"""Unit, start and bounds of an effect's parameters as people read them."""

from discrepancy.problem import is_direction
from discrepancy.scales import Scale, of_variable
from fmu_src.effect import EffectParameter


def scale_of(p: EffectParameter) -> Scale:
    """The unit that answers give a parameter in: of its usual size, or of where it starts."""
    return of_variable(p.variable, abs(p.scale) if p.kind == "amplitude" else abs(float(p.variable.start)))


def range_of(p: EffectParameter) -> tuple[str, str, str]:
    """Unit, start and bounds, or the names that may be chosen."""
    v, scale = p.variable, scale_of(p)
    if v.choices:
        return "", v.choices[int(v.start)], ", ".join(v.choices)
    start, low, high = (scale.number(value) + 0.0 for value in (float(v.start), v.minimum, v.maximum))
    bounds = "any" if is_direction(v.unit, v.minimum, v.maximum) else f"{low:.4g} to {high:.4g}"
    return "" if scale.unit == "1" else scale.unit, f"{start:.4g}", bounds
