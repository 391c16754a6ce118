"""What a measurement hands back, and how cost is compared at equal accuracy."""

import math
import os
import platform
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from time import process_time


@dataclass(frozen=True)
class Ratio:
    """Cost of a peer over ours, on the same work with the same error.

    ``ours`` and ``peer_cost`` are in ``unit`` (seconds of processor time unless said otherwise);
    ``target`` is what was aimed at, None where nothing was.
    """

    item: str
    work: str
    peer: str
    ours: float
    peer_cost: float
    error: str
    target: float | None = None
    unit: str = "s"
    note: str = ""

    @property
    def ratio(self) -> float:
        return self.peer_cost / self.ours if self.ours > 0.0 else math.nan

    @property
    def met(self) -> bool | None:
        return None if self.target is None else self.ratio >= self.target


@dataclass(frozen=True)
class Figure:
    """A cost or count that has no peer; ``at_most`` (or ``at_least``) is what was aimed at."""

    item: str
    what: str
    value: float
    unit: str
    at_most: float | None = None
    at_least: float | None = None
    note: str = ""

    @property
    def met(self) -> bool | None:
        if self.at_most is not None:
            return self.value <= self.at_most
        return self.value >= self.at_least if self.at_least is not None else None


@dataclass
class Curve:
    """Points of a plot: cost against accuracy, or against size; ``fits`` gives exponents by name of the line."""

    title: str
    x: str
    y: str
    lines: dict[str, list[tuple[float, float]]]
    fits: dict[str, float] = field(default_factory=dict)


@dataclass
class Measured:
    """All that one measurement found."""

    ratios: list[Ratio] = field(default_factory=list)
    figures: list[Figure] = field(default_factory=list)
    curves: list[Curve] = field(default_factory=list)


def cost(function: Callable[[], object], runs: int = 3) -> float:
    """Least processor time of this process [s] over several runs: other load disturbs it little."""
    best = math.inf
    for _ in range(runs):
        begun = process_time()
        function()
        best = min(best, process_time() - begun)
    return best


def cost_at(points: list[tuple[float, float]], error: float) -> float:
    """Cost that brings the error down to ``error`` for good, from points (error, cost); NaN if none does.

    Between two tolerances it is read in logarithms.  Where the loosest suffices, it is that one's.
    """
    points = sorted((c, e) for e, c in points if math.isfinite(e))
    last_bad = max((i + 1 for i, (_, e) in enumerate(points) if e > error), default=0)
    if last_bad == len(points):
        return math.nan
    if last_bad == 0:
        return points[0][0]
    (c0, e0), (c1, e1) = points[last_bad - 1 : last_bad + 1]
    if e1 <= 0.0:
        return c1
    return float(c0 * (c1 / c0) ** (math.log(e0 / error) / math.log(e0 / e1)))


def exponent(points: Sequence[tuple[float, float]]) -> float:
    """p of cost ~ size^p by least squares in logarithms over the larger half of the sizes."""
    points = sorted(points)[len(points) // 2 - (len(points) <= 3) :]
    xs, ys = [math.log(x) for x, _ in points], [math.log(y) for _, y in points]
    mx, my = sum(xs) / len(xs), sum(ys) / len(ys)
    return sum((x - mx) * (y - my) for x, y in zip(xs, ys)) / sum((x - mx) ** 2 for x in xs)


def machine() -> dict[str, str | float]:
    """What the figures were measured on."""
    model = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as info:
            model = next(line.partition(":")[2].strip() for line in info if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    return {"processor": model, "cores": os.cpu_count() or 1, "system": platform.system(), "python": platform.python_version(),
            "load": os.getloadavg()[0] if hasattr(os, "getloadavg") else -1.0}
