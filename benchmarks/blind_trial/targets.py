"""What a trial is held against: levels fixed before it is run."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

# d' between the truth and its nearest rival below which even the best test takes one for the other in more than 7 of 100 campaigns.
APART = 3.0


@dataclass(frozen=True)
class Target:
    """``key`` of a figure of ``score.score``; ``least`` and ``most`` are inclusive.  ``digits`` of 0: a share, told in percent."""

    key: str
    text: str
    least: float | None = None
    most: float | None = None
    digits: int = 0

    def met(self, value: float) -> bool:
        return (self.least is None or value >= self.least) and (self.most is None or value <= self.most)

    def told(self, value: float | None) -> str:
        if value is None:
            return "-"
        return f"{value:.{self.digits}f}" if self.digits else f"{100.0 * value:.1f} %"

    @property
    def level(self) -> str:
        unit, factor = ("", 1.0) if self.digits else (" %", 100.0)
        if self.least is not None and self.most is not None:
            return f"{factor * self.least:g} to {factor * self.most:g}{unit}"
        if self.least is not None:
            return f"at least {factor * self.least:g}{unit}"
        assert self.most is not None
        return f"at most {factor * self.most:g}{unit}"


TARGETS = (
    Target("false_alarms", "false alarms on data without an effect, troubled noise and slightly wrong bases included", most=0.02),
    Target("false_alarms_with_faults", "a part of the reducer blamed for a sensor's fault", most=0.05),
    Target("first_from_10", "right name first, d' from 10", least=0.95),
    Target("set_holds_6", "the set holds the truth, d' 6", least=0.95),
    Target("set_holds_from_10", "the set holds the truth, d' from 10", least=0.99),
    Target("one_name_is_right", "one name given is right", least=0.98),
    Target("pairs_both", "both of two effects in the set", least=0.85),
    Target("held_out_worse", "held-out error grows, d' from 10", most=0.02),
    Target("outside_10", "truth outside the catalogue not plainly named, d' 10", least=0.80),
    Target("outside_20", "truth outside the catalogue not plainly named, d' 20", least=0.97),
    Target("set_size", "mean size of the set, d' from 6", most=1.5, digits=2),
    Target("held_out_12", "held-out error after/before, median, d' 12", most=0.45, digits=2),
    Target("held_out_20", "held-out error after/before, median, d' 20", most=0.25, digits=2),
    Target("coverage", "95 % intervals hold the truth", least=0.92, most=0.98),
    Target("experiments", "a proposed experiment resolves, times a random one of all that the rig can do", least=3.0, digits=2),
)
# What is shown beside without the campaigns that no test can tell.
TOLD_APART = ("first_from_10", "set_holds_6", "set_holds_from_10", "one_name_is_right", "pairs_both", "set_size", "outside_10",
              "outside_20")


@dataclass(frozen=True)
class Reached:
    """A target with what was reached; ``without`` is the same without the campaigns that no test can tell, with its count."""

    target: Target
    value: float | None
    of: int
    interval: tuple[float, float] | None
    without: tuple[float | None, int] | None

    @property
    def verdict(self) -> str:
        return "-" if self.value is None else "met" if self.target.met(self.value) else "**missed**"


def reached(figures: Mapping[str, Any]) -> list[Reached]:
    """Every target of which ``figures`` know something, in order."""
    rows = []
    for target in TARGETS:
        f = figures["judged"].get(target.key)
        if f is None:
            continue
        other = figures["told_apart"].get(target.key) if target.key in TOLD_APART else None
        rows.append(Reached(target, f["share"], f["of"], f.get("interval"), None if other is None else (other["share"], other["of"])))
    return rows
