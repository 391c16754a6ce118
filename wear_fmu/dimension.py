"""How parameters of the wear unit are declared."""

from typing import Any

from fmu_src.variables import USUAL, Variable

# The source of what a reducer file must say.
FILE = "reducer file"


def parameter(
    name: str, unit: str, text: str, start: float, minimum: float = USUAL, maximum: float = USUAL,
    source: str = FILE, **more: Any,
) -> Variable:  # fmt: skip
    return Variable(name, "parameter", unit, text, start, minimum=minimum, maximum=maximum, source=source, **more)
