"""What was found with effects, each set of them for itself."""

from collections.abc import Mapping
from typing import TypeVar

# The names of the amplitudes that are on.
Effects = frozenset[str]
Found = TypeVar("Found")


def with_most(found: Mapping[Effects, Found], effects: Effects, without: Found) -> Found:
    """What was found with these effects, else with the most of them; ``without`` where none was."""
    known = [other for other in found if other <= effects]
    return found[max(known, key=len)] if known else without
