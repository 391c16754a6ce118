"""How parameters of the wear unit are declared."""

from typing import Any

from fmu_src.variables import Variable

# The source of what a reducer file must say.
FILE = "reducer file"


def parameter(
    name: str, unit: str, text: str, start: float, minimum: float | None = None, maximum: float | None = None,
    source: str = FILE, **more: Any,
) -> Variable:  # fmt: skip
    return Variable(name, "parameter", unit, text, start, minimum=minimum, maximum=maximum, source=source, **more)
