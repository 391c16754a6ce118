"""A guess with its reason."""

from dataclasses import dataclass, field
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
    """What is not known or not sure, and the option that settles it; ``so``: of a guess the options that state it as it is, so that it is asked no more."""

    place: str
    text: str
    remedy: str
    so: str = field(default="", kw_only=True)

    def as_json(self) -> dict[str, str]:
        return {"place": self.place, "text": self.text, "remedy": self.remedy, "so": self.so}


@dataclass(frozen=True)
class Unplaced(Doubt):
    """Loops of which nobody says where the input was locked; ``angles``: conditions whose names hold an angle that may be it ("90 deg")."""

    angles: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class AngleAssumed(Doubt):
    """Angles that nobody says whose they are."""


@dataclass(frozen=True)
class SpeedBySize(Doubt):
    """A ``speed`` ("600 rpm") that was taken for ``key`` by its size alone, which is ``size`` ("faster than outputs turn")."""

    speed: str
    key: str
    size: str
