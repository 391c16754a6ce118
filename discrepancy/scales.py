"""SI values in the units that a bench uses."""

from discrepancy.campaign.quantities import QUANTITIES
from fmu_src.units import conversion

USUAL = {q.unit: q.usual_unit for q in QUANTITIES.values() if q.usual_unit not in ("arcmin", "1/min")}


def shown(value: float, unit: str) -> str:
    """``value`` [unit] with three digits in the usual unit; differences of temperature stay in kelvin."""
    usual = USUAL.get(unit, unit)
    if usual in ("degC", unit):
        return f"{value:.3g} {'' if unit == '1' else unit}".rstrip()
    factor, _ = conversion(unit, usual)
    return f"{factor * value:.3g} {usual}"
