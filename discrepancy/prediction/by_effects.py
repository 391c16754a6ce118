"""What was found with effects, each set of them for itself."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TypeVar

# The names of the amplitudes that are on.
Effects = frozenset[str]
Found = TypeVar("Found")


def with_most(found: Mapping[Effects, Found], effects: Effects, without: Found) -> Found:
    """What was found with these effects, else with the most of them; ``without`` where none was."""
    known = [other for other in found if other <= effects]
    return found[max(known, key=len)] if known else without


@contextmanager
def restored(found: dict[Effects, Found]) -> Iterator[None]:
    """What is put there in this block is gone behind it."""
    before = dict(found)
    try:
        yield
    finally:
        found.clear()
        found.update(before)


class ByEffects:
    """Numbers by name that follow the values of a fit, and stay where these move them by less than ``near``; ``without``: those of no fit."""

    def __init__(self, without: Mapping[str, float], near: float):
        self.without, self.near = dict(without), near
        self.found: dict[Effects, dict[str, float]] = {}

    def now(self, values: Mapping[str, float]) -> dict[str, float]:
        """The numbers that ``values`` ask for."""
        raise NotImplementedError

    def taken(self, effects: Effects) -> dict[str, float]:
        """Those found with these effects, else with the most of them."""
        return with_most(self.found, effects, self.without)

    def are_elsewhere(self, effects: Effects, values: Mapping[str, float]) -> bool:
        """Whether ``values`` ask for others than those that are taken with these effects."""
        taken = self.taken(effects)
        return any(abs(number - taken.get(name, 0.0)) > self.near for name, number in self.now(values).items())

    def place(self, effects: Effects, values: Mapping[str, float]) -> bool:
        """Takes those of ``values`` for these effects; False if that changes nothing."""
        if not self.are_elsewhere(effects, values):
            return False
        self.found[effects] = self.now(values)
        return True

    @contextmanager
    def tried(self, effects: Effects, values: Mapping[str, float]) -> Iterator[None]:
        """Those of ``values`` for these effects, for a while."""
        with restored(self.found):
            self.place(effects, values)
            yield
