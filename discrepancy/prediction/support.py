"""Where a run is computed, and how its samples follow from there.

A bench writes thousands of samples of what a reducer does smoothly.  Runs are computed at nodes, over the angle at equal
distances, along a torque's way on each branch between two reversals, and the samples are interpolated.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import pairwise
from typing import TypeVar

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicSpline

from discrepancy.prediction.monotone import monotone_cubic
from fmu_src.arrays import Floats
from fmu_src.kernel import kernel

# Nodes of one turn of the output by level; the last err by 1e-5 arcsec.
PER_TURN = (509, 727, 1021, 1447, 2039, 2887, 4099, 5779, 8191, 11587, 16381, 23173, 32771, 46349, 65537, 92683, 131071, 185369)
# Coarser than these: nodes for what a cycloidal drive shows and no more, orders about the multiples of lobes and pins.  By level the highest multiple, how
# far orders stand off, and nodes per unknown.
BANDS = {-3: (4, 3, 1.7), -2: (6, 4, 1.4), -1: (6, 4, 1.6)}
COARSEST = min(BANDS)
# At this one with the orders about the multiples of the pins, at which a drive without errors repeats itself, to beyond that of pins and lobes together, at
# which teeth come into contact: 900 nodes show a relieved profile as 4,600 do without knowing of orders.  How much further, and how far orders stand off.
COMB, BEYOND_TEETH, ASIDE = -1, 7, 2
# A record of less than this share of a turn has no orders.
WHOLE = 0.98
# Places of a turn from which samples are interpolated, for each order: it is within a thousandth.
GRID = 64
# Nodes of a branch on either side of no torque.
PER_SIDE = (8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256, 384, 512, 1024, 2048, 4096)
# Nodes stand off equal distances by up to half this share of them: else a high order looks like a low one on all nodes
# alike, and nothing shows the error.
SCATTERED = 0.4
GOLDEN = 0.5 * (np.sqrt(5.0) - 1.0)
# Places between nodes at which an error is looked at: it is known within a tenth.
LOOKED_AT = 64
# Turns, with what nodes stand beyond a record of one.
JUDGED = 1.25
# How far beyond a record's angles nodes go [rad]: where its angle 0 lies is estimated within a pitch of the pins.
BEYOND = 2.0 * np.pi / 64
# Runs of one condition that begin a little apart share their nodes: the ends are rounded to this [rad].
ROUNDED = 2.0 * np.pi / 16
# A way back shorter than this share of the whole range of torque is the sensor's noise and no reversal.
REVERSAL = 0.02
# Nodes must be fewer than this share of the samples, or each sample is computed itself.
WORTHWHILE = 0.7
# By how much half the distance makes the error less: between kinks (1.5 powers) and smooth.
HALVING = 2.8


@dataclass(frozen=True)
class AngleNodes(ABC):
    """Nodes over the output's angle [rad]: ``angles`` (m,) in the order in which they are passed."""

    angles: Floats

    @property
    def places(self) -> Floats:
        return self.angles

    @abstractmethod
    def samples(self, values: Floats, angles: Floats) -> Floats:
        """``values`` (m,) at the nodes, at ``angles`` [rad]."""

    @abstractmethod
    def error(self, values: Floats) -> float:
        """Error of interpolated ``values``, root mean square."""

    def beginning(self: "Angles") -> "Angles":
        """Those of the first turns, by which an error is judged."""
        within = np.abs(self.angles - self.angles[0]) <= JUDGED * 2.0 * np.pi
        return self if within.all() else replace(self, angles=self.angles[within])


Angles = TypeVar("Angles", bound=AngleNodes)


@dataclass(frozen=True)
class SplineNodes(AngleNodes):
    """Nodes between which a signal is smooth."""

    def samples(self, values: Floats, angles: Floats) -> Floats:
        rising = slice(None) if self.angles[-1] > self.angles[0] else slice(None, None, -1)
        found: Floats = CubicSpline(self.angles[rising], values[rising])(angles)
        return found

    def error(self, values: Floats) -> float:
        """From every second node by the others."""
        rising = slice(None) if self.angles[-1] > self.angles[0] else slice(None, None, -1)
        angles, values = self.angles[rising], values[rising]
        between = CubicSpline(angles[::2], values[::2])(angles[1::2])
        inside = slice(2, -2)
        return float(np.sqrt(np.mean((between - values[1::2])[inside] ** 2))) / HALVING


@dataclass(frozen=True)
class BandedNodes(AngleNodes):
    """Few nodes of one turn; what lies between has only the ``orders`` (n,).

    ``inverse`` (2 n - 1, m) gives cosines and sines of the orders, the mean first.
    """

    orders: npt.NDArray[np.intp]
    inverse: Floats
    leverage: Floats

    def samples(self, values: Floats, angles: Floats) -> Floats:
        found = self.inverse @ values
        grid = 1 << int(GRID * self.orders[-1]).bit_length()
        spectrum = np.zeros(grid // 2 + 1, complex)
        spectrum[0], spectrum[self.orders[1:]] = found[0], 0.5 * (found[1::2] - 1j * found[2::2])
        turn = np.fft.irfft(spectrum * grid, grid)
        place = (angles / (2.0 * np.pi)) % 1.0 * grid
        first = place.astype(np.intp)
        share = place - first
        between: Floats = turn[first % grid] * (1.0 - share) + turn[(first + 1) % grid] * share
        return between

    def error(self, values: Floats) -> float:
        """Each node by all others."""
        left = values - waves(self.angles, self.orders) @ (self.inverse @ values)
        return float(np.sqrt(np.mean((left / (1.0 - self.leverage)) ** 2)))


def waves(angles: Floats, orders: npt.NDArray[np.intp]) -> Floats:
    """One, and cosine and sine of each further order of the turn, at ``angles`` (m,): (m, 2 n - 1)."""
    phases = np.outer(angles, orders[1:])
    found = np.ones((len(angles), 2 * len(orders) - 1))
    found[:, 1::2], found[:, 2::2] = np.cos(phases), np.sin(phases)
    return found


@lru_cache(64)
def banded_nodes(lobes: int, pins: int, level: int, direction: int) -> BandedNodes:
    """Nodes of a turn for the orders that a drive of these numbers of teeth shows."""
    highest, off, per_unknown = BANDS[level]
    low, high = min(lobes, pins), max(lobes, pins)
    bands = [range(max(0, n * low - off), n * high + off + 1) for n in range(highest + 1)]
    if level == COMB:
        bands += [range(n * pins - ASIDE, n * pins + ASIDE + 1) for n in range(highest + 1, lobes + BEYOND_TEETH + 1)]
    orders = np.unique([order for band in bands for order in band])
    count = int(per_unknown * (2 * len(orders) - 1))
    angles: Floats = direction * 2.0 * np.pi / count * scattered(np.arange(float(count)))
    basis = waves(angles, orders)
    # Well conditioned: nodes are half as many again as unknowns.
    inverse = np.asarray(np.linalg.solve(basis.T @ basis, basis.T), np.float64)
    return BandedNodes(angles, orders, inverse, np.einsum("ij,ji->i", basis, inverse))


def scattered(count: Floats) -> Floats:
    """Places off the whole numbers ``count``, see ``SCATTERED``."""
    found: Floats = count + SCATTERED * ((count * GOLDEN) % 1.0 - 0.5)
    return found


def between_angles(low: float, high: float, direction: int) -> SplineNodes:
    """Places of a turn at most, of angles from ``low`` to ``high`` [rad], at which what was interpolated is looked at: no two as far from the nodes."""
    span = min(high - low, 2.0 * np.pi)
    count = np.arange(float(LOOKED_AT))
    places = low + span / LOOKED_AT * (count + (count * GOLDEN) % 1.0)
    return SplineNodes(places[::direction])


def angle_nodes(angles: Floats, direction: int, level: int, always: bool = False) -> SplineNodes | None:
    """Nodes for samples at ``angles`` [rad] wherever their zero lies; None where the samples are hardly more, unless ``always``."""
    if level >= len(PER_TURN):
        return None
    distance = 2.0 * np.pi / PER_TURN[level]
    low = ROUNDED * np.floor((float(angles.min()) - BEYOND) / ROUNDED)
    high = ROUNDED * np.ceil((float(angles.max()) + BEYOND) / ROUNDED)
    count = np.arange(np.floor(low / distance), np.ceil(high / distance) + 1.0)
    nodes = distance * scattered(count)
    if len(nodes) > WORTHWHILE * len(angles) and not always:
        return None
    return SplineNodes(nodes[::direction])


@dataclass(frozen=True)
class Branch:
    """Samples between two reversals: their places in the record, and the places of the branch's nodes on the way."""

    samples: slice
    nodes: slice


@dataclass(frozen=True)
class TorqueNodes:
    """Nodes along the way of a torque [N m]: ``torques`` (m,) in the order in which they are applied."""

    torques: Floats
    branches: tuple[Branch, ...]

    @property
    def places(self) -> Floats:
        return self.torques

    def beginning(self) -> "TorqueNodes":
        """By which an error is judged: all."""
        return self

    def samples(self, values: Floats, applied: Floats) -> Floats:
        """``values`` (m,) at the nodes, at the torques ``applied`` (n,)."""
        found = np.empty(len(applied))
        for branch in self.branches:
            torques, at = self.torques[branch.nodes], values[branch.nodes]
            inside = np.clip(applied[branch.samples], torques.min(), torques.max())
            if len(torques) < 2:
                found[branch.samples] = at[0]
                continue
            rising = slice(None) if torques[-1] > torques[0] else slice(None, None, -1)
            found[branch.samples] = monotone_cubic(torques[rising], at[rising], inside)
        return found

    def error(self, values: Floats) -> float:
        """Error of interpolated ``values``, root mean square, from every second node by the others on one side of no torque."""
        squares: list[Floats] = []
        for branch in self.branches:
            torques, at = self.torques[branch.nodes], values[branch.nodes]
            for side in (torques > 0.0, torques < 0.0):
                t, y = torques[side], at[side]
                if len(t) < 5:
                    continue
                rising = slice(None) if t[-1] > t[0] else slice(None, None, -1)
                t, y = t[rising], y[rising]
                last = len(t) - 1 - (len(t) + 1) % 2
                squares.append((monotone_cubic(t[: last + 1 : 2], y[: last + 1 : 2], t[1:last:2]) - y[1:last:2]) ** 2)
        return float(np.sqrt(np.mean(np.concatenate(squares)))) / HALVING if squares else 0.0


def torque_nodes(applied: Floats, least: float, level: int) -> TorqueNodes | None:
    """Nodes for samples of the torques ``applied`` [N m] in their order; None where the samples are hardly more.

    Nodes lie closer near no torque, none of them below ``least`` [N m]: the output floats there.
    """
    if level >= len(PER_SIDE):
        return None
    most = float(np.abs(applied).max())
    side = least + (most - least) * np.linspace(0.0, 1.0, PER_SIDE[level]) ** 2
    grid = np.concatenate([-side[::-1], side])
    turns = reversals(applied)
    way = [np.array([applied[0]])]
    branches = []
    count = 1
    for begin, end in pairwise(turns):
        a, b = float(applied[begin]), float(applied[end])
        passed = grid[(grid > min(a, b)) & (grid < max(a, b))]
        new = np.append(passed if b > a else passed[::-1], b)
        way.append(new)
        branches.append(Branch(slice(begin if begin == 0 else begin + 1, end + 1), slice(count - 1, count + len(new))))
        count += len(new)
    if count > WORTHWHILE * len(applied):
        return None
    return TorqueNodes(np.concatenate(way), tuple(branches))


def reversals(applied: Floats) -> npt.NDArray[np.intp]:
    """Places where the torque turns back for good, with the first and the last sample."""
    turned = np.zeros(len(applied))
    mark_reversals(np.ascontiguousarray(applied, dtype=np.float64), REVERSAL * float(np.ptp(applied)), turned)
    turned[0] = turned[-1] = 1.0
    return np.flatnonzero(turned)


@kernel
def mark_reversals(applied: Floats, least: float, turned: Floats) -> None:
    """Put 1 into ``turned`` (n,) where ``applied`` (n,) is farthest before it goes back by more than ``least``."""
    highest = 0
    lowest = 0
    sense = 0
    for i in range(applied.shape[0]):
        if applied[i] > applied[highest]:
            highest = i
        if applied[i] < applied[lowest]:
            lowest = i
        if sense >= 0 and applied[highest] - applied[i] > least:
            turned[highest] = 1.0
            sense = -1
            lowest = i
            highest = i
        elif sense <= 0 and applied[i] - applied[lowest] > least:
            turned[lowest] = 1.0
            sense = 1
            lowest = i
            highest = i
