"""A column of a run, and for what it is taken."""

from dataclasses import dataclass
from typing import Any

from discrepancy.campaign.guess.assign import unit_words
from discrepancy.campaign.guess.said import Guess


@dataclass(frozen=True)
class Entry:
    """A column of a run, with the keys that go with it."""

    column: Guess[str]
    header: str
    unit: Guess[str]
    keys: dict[str, Any]

    @property
    def why(self) -> list[str]:
        """For what it is taken, and its unit, which may be a reason of the former."""
        unit = unit_words(self.unit.value, self.unit.reason)
        return [self.column.reason] if unit in self.column.reason else [self.column.reason, unit]

    def as_json(self) -> dict[str, object]:
        return {"column": self.column.as_json(), "header": self.header, "unit": self.unit.as_json(), "why": self.why, **self.keys}
