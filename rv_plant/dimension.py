"""How dimensions of parts and their errors are declared."""

from typing import Any

from fmu_src.variables import Variable

# The source of what a reducer file must say.
FILE = "reducer file"


def length(name: str, text: str, minimum: float, start: float = 0.0, source: str = FILE, **more: Any) -> Variable:
    """A dimension of the ideal reducer [m]."""
    return Variable(name, "parameter", "m", text, start, minimum=minimum, nominal=1e-3, source=source, **more)


def deviation(name: str, text: str, **over: Any) -> Variable:
    """An error of every part of a kind [m], up to 1 mm."""
    return Variable(name, "parameter", "m", text, 0.0, **over, minimum=-1e-3, maximum=1e-3, nominal=1e-6, source="ideal part")
