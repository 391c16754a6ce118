"""What is given instead of guessed."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from fnmatch import fnmatch
from typing import TypeVar

from discrepancy.campaign.guess.header_units import name_of
from discrepancy.campaign.guess.tag_words import meant_by
from discrepancy.campaign.quantities import FACTOR_KEYS, QUANTITIES, TAGS
from discrepancy.problem import WITH_ZERO
from fmu_src.faults import InputFault, nearest

# What stands in a proposed option for what only the bench knows.
OPEN = "..."
# Whose angle a transmission error may stand over.
OUTPUT, INPUT = "output", "input"
# Whether the mean of a quantity counts: from a zero that is known, or not.
ABSOLUTE, FREE = "absolute", "free"
# As ``locked_at``: the one angle in the name of each loop is where its input was locked; as a speed: those that names and heads say are of that shaft.
NAMED = "named"
SPEEDS = ("input_speed", "output_speed")

Value = TypeVar("Value")


@dataclass(frozen=True)
class Wishes:
    """``names``: patterns of file names.  ``units``: header, or pattern of file names:header -> unit.

    ``columns``: role, or pattern of file names:role -> header.  ``counts``: header -> steps a turn.

    ``quantities``: pattern of file names (``*.csv``) -> quantity.  ``conditions``: key of a condition -> number with unit, for all
    files that do not say otherwise, or condition's name:key for that one.
    ``held_out``: names of conditions, () for none, None for what is proposed.  ``tags``: for runs whose quantity has them.
    ``angle_of``: "output" or "input", whose angle transmission errors stand over; None where nobody says it.
    ``scales``: header, or pattern of file names:header -> what its numbers are multiplied by.
    ``zeros``: quantity -> "absolute" where its zero is known, or "free".
    """

    reducer: str | None = None
    names: tuple[str, ...] = ()
    units: Mapping[str, str] = field(default_factory=dict)
    columns: Mapping[str, str] = field(default_factory=dict)
    counts: Mapping[str, float] = field(default_factory=dict)
    quantities: Mapping[str, str] = field(default_factory=dict)
    conditions: Mapping[str, str] = field(default_factory=dict)
    held_out: tuple[str, ...] | None = None
    tags: Mapping[str, str] = field(default_factory=dict)
    angle_of: str | None = None
    scales: Mapping[str, float] = field(default_factory=dict)
    zeros: Mapping[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """InputFault for what there is not."""
        known = [*FACTOR_KEYS, "direction", "mounting"]
        keys = [key.rpartition(":")[2] for key in self.conditions]
        whose = [self.angle_of] if self.angle_of else []
        options = (("--quantity", list(self.quantities.values()), list(QUANTITIES)), ("--condition", keys, known), ("--tag", list(self.tags), list(TAGS)),
                   ("--angle-of", whose, [OUTPUT, INPUT]), ("--zero", list(self.zeros), list(WITH_ZERO)),
                   ("--zero QUANTITY", list(self.zeros.values()), [ABSOLUTE, FREE]))  # fmt: skip
        for option, given, choices in options:
            for name in given:
                if name not in choices:
                    raise InputFault(f"{option} {name}: there is no such thing; choose from {', '.join(choices)}{nearest(name, choices)}")
        for tag, word in self.tags.items():
            meant_by(tag, word)
        for key, factor in self.scales.items():
            if not math.isfinite(factor) or factor == 0.0:
                raise InputFault(f"--scale {key}={factor:g}: a finite number other than 0 is needed, what the column is multiplied by")
        for key, text in self.conditions.items():
            if text == OPEN:
                example = FACTOR_KEYS[own].example if (own := key.rpartition(":")[2]) in FACTOR_KEYS else "..."
                raise InputFault(f"--condition {key}={OPEN}: put what it is in place of the dots, as in {own}={example}")

    @property
    def for_all(self) -> dict[str, str]:
        """What is given of the conditions of all files, but for whose their speeds are."""
        return {key: text for key, text in self.conditions.items() if ":" not in key and (key, text) not in [(speed, NAMED) for speed in SPEEDS]}

    @property
    def speeds_of(self) -> str | None:
        """Of which shaft the speeds are that files do not say it of; None where nobody says it."""
        return next((speed for speed in SPEEDS if self.conditions.get(speed) == NAMED), None)

    def quantity_for(self, name: str) -> str | None:
        return next((quantity for pattern, quantity in self.quantities.items() if fnmatch(name, pattern)), None)

    def units_for(self, name: str) -> dict[str, str]:
        """Header -> unit for a file; what is given for its name wins."""
        return for_file(self.units, name)

    def scales_for(self, name: str) -> dict[str, float]:
        """Header -> factor for a file; what is given for its name wins."""
        return for_file(self.scales, name)

    def columns_for(self, name: str) -> dict[str, str]:
        """Role -> header for a file; what is given for its name wins."""
        return for_file(self.columns, name)


def of_column(given: Mapping[str, Value], header: str, name: str) -> Value | None:
    """What is given of a column: by its header as the file has it, by the reader's name of it, or without its unit."""
    return next((given[known] for known in (header, name, name_of(header)) if known in given), None)


def for_file(given: Mapping[str, Value], name: str) -> dict[str, Value]:
    """Of ``KEY`` and ``PATTERN:KEY`` those that hold for a file's name, by KEY; a pattern wins."""
    parted = [(*key.rpartition(":"), value) for key, value in given.items()]
    general = {key: value for _, colon, key, value in parted if not colon}
    return general | {key: value for pattern, colon, key, value in parted if colon and fnmatch(name, pattern)}
