"""The units that people read variables in: FMI's display units.

Values are exchanged in the variable's own unit, SI; a tool shows them in its display unit.  Which of several fits is decided by
the variable's nominal value, unless the variable says so itself.
"""

from dataclasses import dataclass
from functools import cache

from fmu_src.units import conversion
from fmu_src.variables import Variable

# Unit -> (display unit, smallest nominal value that reads well in it), the largest first.
USUAL = {
    "m": (("mm", 1e-4), ("um", 0.0)),
    "rad": (("turn", 1e6), ("deg", 1e-2), ("arcmin", 2e-4), ("arcsec", 0.0)),
    "rad/s": (("rpm", 1e-9), ("arcsec/h", 0.0)),
    "rad/s^2": (("rpm/s", 0.0),),
    "s": (("h", 3600.0), ("s", 0.1), ("us", 0.0)),
    "K": (("degC", 0.0),),
    "Pa": (("GPa", 1e9), ("MPa", 0.0)),
    "1/Pa": (("1/GPa", 0.0),),
    "W": (("kW", 1e4), ("W", 0.0)),
    "N": (("N", 0.0), ("kN", 0.0)),
    "rad/(N.m)": (("arcmin/(N.m)", 0.0),),
    "m/N": (("um/kN", 0.0),),
    "m/(N.m)": (("um/(N.m)", 0.0),),
    "m/rad": (("um/deg", 0.0),),
    "N.rad": (("N.deg", 0.0),),
    "N/m": (("N/mm", 0.0),),
    "m^3": (("mm^3", 0.0),),
    "kg.m": (("g.mm", 0.0),),
    "kg.m^2": (("kg.cm^2", 0.0),),
    "Pa.s": (("mPa.s", 0.0),),
    "J/mol": (("kJ/mol", 0.0),),
    "1/K": (("1/K", 1e-3), ("ppm/K", 0.0)),
}
# What is read as its inverse: stiffness from compliance.  A choice that FMI 3 alone can offer.
INVERSES = {"rad/(N.m)": ("N.m/arcmin", "arcmin/(N.m)"), "m/N": ("kN/um", "um/kN")}


@dataclass(frozen=True)
class Display:
    """Value in this unit = factor * value + offset, or factor / value if ``inverse``."""

    name: str
    factor: float
    offset: float = 0.0
    inverse: bool = False


def display_unit(v: Variable) -> str:
    """The unit that people read it in; empty where that is its own."""
    if v.is_integer:
        return ""
    found = v.display or usual_unit(v.unit, v.nominal)
    return "" if found == v.unit else found


def usual_unit(unit: str, size: float) -> str:
    """The unit that people read numbers of this size in, given in ``unit``."""
    return next((name for name, smallest in USUAL.get(unit, ()) if abs(size) >= smallest), unit)


def read_in(unit: str, *values: float) -> tuple[str, list[float]]:
    """The unit that people read the first of ``values`` in, given in ``unit``, and all of them in it."""
    found = usual_unit(unit, values[0])
    factor, offset = conversion(unit, found)
    return found, [factor * value + offset for value in values]


def read_text(value: float, unit: str, digits: int) -> str:
    """A number of ``unit`` in the unit that people read it in: 8.9e-9 m/N as "8.9 um/kN"."""
    found, (number,) = read_in(unit, value)
    return f"{number:.{digits}g}{'' if found == '1' else f' {found}'}"


@cache
def displays(unit: str) -> tuple[Display, ...]:
    """All that a tool may offer for a unit, those of single variables not included."""
    found = [Display(name, *conversion(unit, name)) for name, _ in USUAL.get(unit, ()) if name != unit]
    if unit in INVERSES:
        name, straight = INVERSES[unit]
        found.append(Display(name, 1.0 / conversion(unit, straight)[0], inverse=True))
    return tuple(found)
