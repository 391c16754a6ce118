"""How the files of a campaign look."""

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Style:
    """Delimiter, decimal sign, units of quantities and axes where they are not the usual ones, side of the speeds, a line of units."""

    delimiter: str = ","
    decimal: str = "."
    units: Mapping[str, str] = field(default_factory=dict)
    speed_at: str = "input"
    units_line: bool = False
