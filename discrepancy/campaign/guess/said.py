"""A guess with its reason."""

from dataclasses import dataclass
from typing import Generic, TypeVar

Value = TypeVar("Value")


@dataclass(frozen=True)
class Guess(Generic[Value]):
    """What is guessed, why, and whether somebody should look at it."""

    value: Value
    reason: str
    sure: bool = True

    def as_json(self) -> dict[str, object]:
        return {"value": self.value, "reason": self.reason, "sure": self.sure}


@dataclass(frozen=True)
class Doubt:
    """What is not known or not sure, and the option that settles it."""

    place: str
    text: str
    remedy: str

    def as_json(self) -> dict[str, str]:
        return vars(self).copy()
