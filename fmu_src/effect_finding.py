"""What is found wrong with an effect, and what a unit offers its effects."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fmu_src.faults import InputFault
from fmu_src.variables import Variable

# What a unit's ALLOWED calls states of the effect itself.
OWN = "own states"


class EffectFault(InputFault):
    """Effects that a unit does not take: one line each, with file and line."""


@dataclass(frozen=True, order=True)
class Finding:
    """One thing that is wrong."""

    file: Path
    line: int
    text: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}: {self.text}" if self.line else f"{self.file}: {self.text}"


@dataclass(frozen=True)
class Frame:
    """What a unit offers its effects, see ``rv_plant.effects``; ``effects`` are all others, each with its file."""

    hooks: Mapping[str, tuple[str, str]]
    allowed: Mapping[str, Mapping[str, str]]
    needs: Mapping[str, str]
    own: tuple[Variable, ...]
    effects: Mapping[str, tuple[Any, Path]]
