"""A completed reducer against a full file of the same one: is what the file says inside the range?"""

from dataclasses import dataclass, replace

from fmu_src.display import read_in
from fmu_src.names import found_by_name
from fmu_src.units import conversion
from reducers.completion.complete import RULES, Completion, Number
from reducers.completion.supports import SUPPORT_UNITS
from reducers.reducer import Reducer


@dataclass(frozen=True)
class Row:
    """One number in its unit: completed, its range, what the full file says and where it has that from."""

    name: str
    unit: str
    completed: float
    low: float
    high: float
    in_file: float
    source: str
    by_published_rule: bool

    @property
    def as_read(self) -> "Row":
        """In the unit that people read it in."""
        unit, (completed, low, high, in_file) = read_in(self.unit, self.completed, self.low, self.high, self.in_file)
        return replace(self, unit="" if unit == "1" else unit, completed=completed, low=low, high=high, in_file=in_file)

    @property
    def inside(self) -> bool:
        spare = 1e-9 * max(abs(self.low), abs(self.high))
        return self.low - spare <= self.in_file <= self.high + spare

    @property
    def tests(self) -> bool:
        """Whether it tests a rule: the file has the number from its source, and the completion has it by a rule that was published.

        Ranges that are assumed were so with the library's reducers in sight: that these lie inside says nothing.  Nor do supports and
        friction, which the library's files have by the same rules.
        """
        return self.name not in SUPPORT_UNITS and not self.source.startswith("assumed") and self.by_published_rule


def against(completion: Completion, full: Reducer) -> list[Row]:
    """A row for every completed number that the full file has too."""
    rows = []
    for number in completion.numbers.values():
        (_, variable), *_ = found_by_name((full.plant, full.wear), number.name)
        if variable.name not in full.starts:
            continue
        factor, offset = conversion(variable.unit, number.unit)
        value = factor * full.starts[variable.name] + offset
        rows.append(Row(number.name, number.unit, number.value, number.low, number.high, value, full.sources[variable.name], published(number)))
    return rows


def published(number: Number) -> bool:
    """Whether the number has a dial of its own, and that one a range that is not assumed."""
    own = number.name == "pin.circle_radius" or RULES.get(number.name, ("", ""))[1] != ""
    return own and not (number.is_given or number.is_found) and "assumed: " not in number.source
