"""One wave over the angle in what a fit leaves: its order, its size, and whether it goes with load or direction, or with a power of what varies.

Means of neighbouring samples (``recover``) show orders up to a dozen; here all samples of the runs are held, whitened, against cosine
and sine of every order that they resolve.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.noise.series import order_axis
from fmu_src.arrays import Floats

# Turns in the runs' range of angle from which a wave is one, steps of the scan and of the finer one (assumed: a wave is as wide as 1).
FEWEST, STEP, FINE = 0.75, 0.25, 0.02
# Share of the samples' rate up to which an order is resolved.
RESOLVED = 0.45
# Chi-square that a wave must gain beyond what the best of so many orders does by chance (assumed: once in some thousand).
BEYOND_CHANCE = 20.0
# Samples of waves that are held at a time, and that are looked through at most: beyond some ten thousand samples a turn the highest orders are left out.
TOGETHER, MOST = 1 << 20, 1 << 29

WAYS: dict[str, Callable[[Mapping[str, float]], float]] = {
    "none": lambda f: 1.0, "load": lambda f: f.get("load", 0.0), "direction": lambda f: f.get("direction", 1.0),
    "load and direction": lambda f: f.get("load", 0.0) * f.get("direction", 1.0),
}  # fmt: skip


# What the size of a wave may go with, by a power between these; steps of the search for it.
GROWING, STEEPEST, POWERS, FINER = ("load", "temperature", "speed", "hours"), 8.0, 0.5, 0.05
# Chi-square that it must gain by a power of its own (assumed), and share of what the wave gains at all: laws have their form to a few percent.
BY_POWER, OF_GAIN = 12.0, 0.02
# No power of 0 is taken.
LEAST = 1e-9


@dataclass(frozen=True)
class Growth:
    """A size goes with ((factor - zero)/top)^exponent, 1 at the largest measured value; in SI, the ``zero`` that of the unit in which it is told."""

    factor: str
    zero: float
    top: float
    exponent: float
    deviation: float = 0.0

    def share(self, factors: Mapping[str, float]) -> float:
        return max((factors[self.factor] - self.zero) / self.top, LEAST)

    def of(self, factors: Mapping[str, float]) -> float:
        return float(self.share(factors) ** self.exponent)


@dataclass(frozen=True)
class Wave:
    """misfit = way * growth * (b cos(n phi) + c sin(n phi)), n per radian; ``covariance`` of (b, c, n); ``gain`` in chi-square, ``error`` left in noise
    units."""

    way: str
    order: float
    b: float
    c: float
    covariance: Floats
    gain: float
    error: float
    growth: Growth | None = None

    def weight(self, factors: Mapping[str, float]) -> float:
        """What the amplitudes are multiplied by in a run at these conditions."""
        return WAYS[self.way](factors) * (self.growth.of(factors) if self.growth else 1.0)

    def about(self, middle: float) -> tuple[float, float, Floats]:
        """(b, c, covariance) of the same wave counted from the angle ``middle`` [rad]."""
        turn = self.order * middle
        cos, sin = math.cos(turn), math.sin(turn)
        b, c = self.b * cos + self.c * sin, self.c * cos - self.b * sin
        moved = np.array([[cos, sin, middle * c], [-sin, cos, -middle * b], [0.0, 0.0, 1.0]])
        return b, c, moved @ self.covariance @ moved.T


def wave_of(space: Workspace, fit: Fit, indices: Sequence[int], zeros: Mapping[str, float] = {}) -> Wave | None:
    """The wave that takes most of the misfit of these records' training runs; None if chance does as much, or no run has an angle.

    ``zeros``: of conditions, in SI, where the unit in which they are told has its 0.
    """
    runs = {i: angle for i in indices if not space.records[i].held_out and (angle := order_axis(space.records[i])) is not None}
    if not runs:
        return None
    records = {i: space.records[i] for i in runs}
    misfit = space.whiten({i: r.values - y for (i, r), y in zip(records.items(), space.predictions(fit.values, list(runs)))})
    span = max(float(np.ptp(a)) for a in runs.values())
    rate = min(2.0 * math.pi / float(np.median(np.abs(np.diff(a)))) for a in runs.values())
    least, most = 2.0 * math.pi * FEWEST / span, RESOLVED * rate
    step = 2.0 * math.pi * STEP / span
    most = min(most, least + step * MOST / sum(map(len, runs.values())))
    if most <= least + step:
        return None
    orders, found = np.arange(least, most, step), []
    names = ways([r.factors for r in records.values()])
    every = [{i: WAYS[way](r.factors) for i, r in records.items()} for way in names]
    for k, (way, weights, scan) in enumerate(zip(names, every, gains(space, runs, every, misfit, orders))):
        gain, order = max(scan)
        near = order + step * np.arange(-1.0, 1.0 + FINE, FINE)
        gain, order = max(gains(space, runs, [weights], misfit, near[near > 0.0])[0])
        # What is the same in all runs is the simplest.
        found.append((gain - 2.0 * (k > 0), way, order, weights))
    gain, way, order, weights = max(found, key=lambda f: f[0])
    if gain < 2.0 * math.log(len(orders)) + BEYOND_CHANCE:
        return None
    grown = max((g for _, way, order, _ in found for g in growths(space, runs, misfit, way, order, zeros)), key=lambda g: g[0], default=None)
    if grown is not None and grown[0] > gain + max(BY_POWER, OF_GAIN * gain):
        return refined(space, runs, misfit, *grown[1:])
    return refined(space, runs, misfit, way, order)


def growths(space: Workspace, runs: Mapping[int, Floats], misfit: Floats, way: str, order: float,
            zeros: Mapping[str, float]) -> Iterator[tuple[float, str, float, Growth]]:  # fmt: skip
    """(gain in chi-square, way, order, growth) of a wave whose size goes with what varies from run to run, for each of that the best power."""
    factors = {i: space.records[i].factors for i in runs}

    def best(some: Sequence[Growth]) -> tuple[float, Growth]:
        every = [{i: WAYS[way](f) * g.of(f) for i, f in factors.items()} for g in some]
        found = [scan[0][0] for scan in gains(space, runs, every, misfit, np.array([order]))]
        return max(found), some[int(np.argmax(found))]

    for name in GROWING:
        levels = {f[name] - zeros.get(name, 0.0) for f in factors.values() if name in f}
        if name in way or len(levels) < 2 or any(name not in f for f in factors.values()) or min(levels) < 0.0:
            continue
        at_most = Growth(name, zeros.get(name, 0.0), max(levels), STEEPEST)
        # What is 0 somewhere has no power below 0.
        least = -STEEPEST if min(levels) > 0.0 else POWERS
        powers = [replace(at_most, exponent=float(p)) for p in np.arange(least, STEEPEST + POWERS, POWERS) if p]
        near = best(powers)[1].exponent + np.arange(-POWERS, POWERS, FINER)
        gain, growth = best([replace(at_most, exponent=float(p)) for p in near if least <= p <= STEEPEST and abs(p) > LEAST])
        yield gain, way, order, growth


def ways(factors: Sequence[Mapping[str, float]]) -> list[str]:
    """What runs at these conditions can tell apart: load and direction where they differ."""
    loads = {f.get("load", 0.0) for f in factors}
    two = {"load": len(loads) > 1 and min(loads) > 0.0, "direction": len({f.get("direction", 1.0) for f in factors}) > 1}
    return ["none", *(name for name, tells in two.items() if tells), *(["load and direction"] if all(two.values()) else [])]


def columns(space: Workspace, runs: Mapping[int, Floats], weights: Mapping[int, float], orders: Floats) -> tuple[Floats, Floats]:
    """Whitened cosines and sines of the orders (N, orders)."""
    phases = {i: np.multiply.outer(angle, orders) for i, angle in runs.items()}
    return (space.whiten({i: weights[i] * np.cos(p) for i, p in phases.items()}), space.whiten({i: weights[i] * np.sin(p) for i, p in phases.items()}))


def gains(
    space: Workspace, runs: Mapping[int, Floats], ways: Sequence[Mapping[int, float]], misfit: Floats, orders: Floats
) -> list[list[tuple[float, float]]]:
    """(gain in chi-square, order) of each order's cosine and sine, for each way of weighting the runs: all weigh the same columns."""
    rows = np.zeros((len(ways), space.size))
    for row, weights in zip(rows, ways):
        for i, weight in weights.items():
            row[space.rows[i]] = weight
    square, even = rows**2, dict.fromkeys(runs, 1.0)
    count = max(1, TOGETHER // space.size)

    def told(some: Floats) -> Floats:
        cos, sin = columns(space, runs, even, some)
        cc, ss, cs = square @ (cos * cos), square @ (sin * sin), square @ (cos * sin)
        ce, se = (rows * misfit) @ cos, (rows * misfit) @ sin
        determinant = np.maximum(cc * ss - cs * cs, 1e-12 * cc * ss + 1e-300)
        found: Floats = (ss * ce * ce - 2.0 * cs * ce * se + cc * se * se) / determinant
        return found

    gained = np.hstack(space.threads.map(told, [orders[start : start + count] for start in range(0, orders.size, count)]))
    return [list(zip(row.tolist(), orders.tolist())) for row in gained]


def refined(space: Workspace, runs: Mapping[int, Floats], misfit: Floats, way: str, order: float, growth: Growth | None = None) -> Wave:
    """Amplitudes and order together, and the power of a growth, one step of Gauss and Newton from the scan's finer grid, with their covariance."""
    factors = {i: space.records[i].factors for i in runs}
    weights = {i: WAYS[way](f) * (growth.of(f) if growth else 1.0) for i, f in factors.items()}
    cos, sin = columns(space, runs, weights, np.array([order]))
    b, c = np.linalg.lstsq(np.hstack([cos, sin]), misfit, rcond=None)[0]
    design = [cos[:, 0], sin[:, 0], space.whiten({i: weights[i] * a * (c * np.cos(order * a) - b * np.sin(order * a)) for i, a in runs.items()})]
    if growth:
        bent = {i: weights[i] * math.log(growth.share(f)) for i, f in factors.items()}
        design.append(space.whiten({i: bent[i] * (b * np.cos(order * a) + c * np.sin(order * a)) for i, a in runs.items()}))
    slopes = np.column_stack(design)
    step = np.linalg.lstsq(slopes, misfit - b * cos[:, 0] - c * sin[:, 0], rcond=None)[0]
    left = misfit - b * cos[:, 0] - c * sin[:, 0] - slopes @ step
    size = float(left @ left) / max(int(np.count_nonzero(misfit)) - len(design), 1)
    covariance = np.asarray(np.linalg.pinv(slopes.T @ slopes) * max(size, 1.0), np.float64)
    gain = float(misfit @ misfit - left @ left)
    grown = replace(growth, exponent=growth.exponent + float(step[3]), deviation=math.sqrt(covariance[3, 3])) if growth else None
    return Wave(way, order + float(step[2]), float(b + step[0]), float(c + step[1]), covariance[:3, :3], gain, math.sqrt(size), grown)
