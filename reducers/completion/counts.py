"""How many numbers of a completed file say what was given, and where the others are from."""

from typing import NamedTuple

from reducers.completion.complete import Completion
from reducers.completion.known import FROM_OPTIONS


class Counts(NamedTuple):
    """``given``: names of numbers that say what was given; ``found``: of those that were looked for, so that figures of the catalogue are met."""

    given: list[str]
    found: list[str]
    by_rule: int
    assumed: int

    @property
    def whole(self) -> int:
        return len(self.given) + len(self.found) + self.by_rule + self.assumed

    @property
    def short(self) -> str:
        found = f", {len(self.found)} looked for to meet the catalogue" if self.found else ""
        rest = f"{self.by_rule} come by published rules, {self.assumed} are assumed"
        return f"{self.whole} numbers: {len(self.given)} follow from what is given alone{found}, {rest}"

    @property
    def words(self) -> str:
        verb = "was" if len(self.found) == 1 else "were"
        found = f", {len(self.found)} {verb} looked for to meet the catalogue ({', '.join(self.found)})" if self.found else ""
        return (
            f"of the file's {self.whole} numbers {len(self.given)} follow from that alone ({', '.join(self.given)}){found}, {self.by_rule} come by published"
            f" rules, {self.assumed} are assumed"
        )


def counts_of(completion: Completion) -> Counts:
    numbers = completion.numbers.values()
    given = [n.name for n in numbers if n.is_given or n.name in FROM_OPTIONS]
    found = [n.name for n in numbers if n.is_found]
    rest = [n for n in numbers if n.name not in (*given, *found)]
    assumed = sum("assumed" in n.source for n in rest)
    return Counts(given, found, len(rest) - assumed, assumed)
