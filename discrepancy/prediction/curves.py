"""What the bench shows at a record's samples: computed at nodes as fine as the noise asks for, and interpolated.

A prediction is the base model's, at fine nodes and once, and what the values change in it, at nodes of their own.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple, Protocol, TypeVar

import numpy as np
import numpy.typing as npt

from discrepancy.prediction.bench import TORQUE_STEP, Bench, Starts
from discrepancy.prediction.conditions import Values, angle_zero, angles_of, condition_of, held_condition, places_of_zero, zero_of
from discrepancy.prediction.fineness import EVERY_SAMPLE, ErrsAt
from discrepancy.prediction.stations import Stations, own_stations
from discrepancy.prediction.support import BEYOND, COARSEST, WHOLE, WORTHWHILE, AngleNodes, SplineNodes, TorqueNodes, angle_nodes, banded_nodes, torque_nodes
from discrepancy.prediction.torque_way import NEAR_NOTHING, entered, way
from discrepancy.prediction.units import Condition
from discrepancy.problem import NEAR, Record
from fmu_src.arrays import Floats

# Fewer samples than these are computed where they are.
LEAST_SAMPLES = 16
# Of what a prediction may err, what moving it to where the record's angle 0 lies may add; where anchors would have to stand closer
# than this share of the samples' distance, there are none.
FIRMLY, LEAST_SHARE = 0.1, 0.01
# Decimals of an angle [rad] to which outputs that lag alike stand in one place.
ALIKE = 10
# Where a pattern lies is seen at some thousand nodes a turn.
LEVEL_OF_A_PATTERN = 2
# Where parameters do nearly the same, their derivatives differ by little: 2 % of errors were 20 times that.
LEVEL_OF_SLOPES = 6


Nodes = TypeVar("Nodes", AngleNodes, TorqueNodes)


class Curve(Protocol[Nodes]):
    """A signal of the bench over the axis of a record."""

    @property
    def bench(self) -> Bench: ...

    @property
    def record(self) -> Record: ...

    def nodes(self, level: int) -> Nodes | None:
        """Nodes for the record's samples; None where every sample is computed."""
        ...

    def exact(self) -> "Curve[Nodes]":
        """The same of a bench that is not rough, where that matters between nodes, too."""
        ...

    def places(self, values: Values) -> Floats:
        """Where the samples lie on the axis."""
        ...

    def unchanged(self, values: Values) -> dict[str, float]:
        """Of the values those that say where the samples lie."""
        ...

    def run(self, values: Values, nodes: Nodes) -> Floats:
        """The signal at nodes."""
        ...

    def directly(self, values: Values) -> Floats:
        """The signal at every sample."""
        ...

    def seen(self, at: Callable[[Floats | float], Floats]) -> Floats:
        """What the record shows of a signal that is known ``at`` any distance ahead of its samples."""
        ...


class Support(NamedTuple):
    """``angles`` [rad] at which a curve is computed, how the record's ``samples`` follow from a series there, and near which runs it ``starts``."""

    angles: Floats
    samples: Callable[[Floats], Floats]
    starts: Starts | None


@dataclass(frozen=True)
class OverAngle:
    """Column ``name`` of the running bench (``studies.coupled.COLUMNS``); cages ``cage`` ahead [rad]."""

    bench: Bench
    record: Record
    name: str
    cage: float = 0.0

    @cached_property
    def condition(self) -> Condition:
        return condition_of(self.bench, self.record)

    def exact(self) -> "OverAngle":
        return self

    def nodes(self, level: int) -> AngleNodes | None:
        angles, direction = angles_of(self.bench, self.record, 0.0), self.condition.direction
        if level >= 0 or np.ptp(angles) < WHOLE * 2.0 * np.pi:
            return angle_nodes(angles, direction, max(level, 0))
        topology = self.bench.reducer.topology
        nodes = banded_nodes(topology.lobes, topology.pins, level, direction)
        return nodes if len(nodes.angles) < WORTHWHILE * len(angles) else None

    def places(self, values: Values) -> Floats:
        return angles_of(self.bench, self.record, zero_of(self.bench, self.record, values))

    def unchanged(self, values: Values) -> dict[str, float]:
        return {name: values[name] for name in places_of_zero(self.record) if name in values}

    def run(self, values: Values, nodes: AngleNodes) -> Floats:
        return self.bench.column(self.name, self.condition, values, nodes.angles, self.cage)

    def directly(self, values: Values) -> Floats:
        at = self.support(None, values)
        return at.samples(self.bench.column(self.name, self.condition, values, at.angles, self.cage, at.starts))

    def starts(self, values: Values, anchor: float) -> Starts:
        """Angles of runs near that with its angle 0 at ``anchor`` [rad]."""
        near, distance = NEAR.get(), self.anchors()
        beside = anchor if near is None else self.anchored({**values, **near})[0]
        return self.at_stations(beside), self.at_stations(distance * round(anchor / distance) if distance else anchor)

    def seen(self, at: Callable[[Floats | float], Floats]) -> Floats:
        """An encoder on the output turns with the error itself: a sample is shown at the input's angle over the ratio and the error there.  Orders of
        a large one show at twice themselves so (an order 80 of 20 arcsec: 0.08 arcsec of order 160)."""
        found = at(0.0)
        if not self.record.of_output or self.name != "transmission_error" or len(found) < LEAST_SAMPLES:
            return found
        angles = self.places({})
        order = np.argsort(angles, kind="stable")
        steps, behind = np.diff(angles[order]), found - found.mean()
        if steps.min() <= 0.0 or np.abs(behind).max() * np.median(np.abs(np.diff(found[order])) / steps) < self.bench.allowed(self.record):
            return found
        # Twice is enough: what is left is the third power of it.
        return at(-behind)

    def support(self, nodes: AngleNodes | None, values: Values) -> Support:
        """``nodes``, else its stations, near their anchor."""
        if nodes is not None:
            places = self.places(values)
            return Support(nodes.angles, lambda series: nodes.samples(series, places), None)
        anchor, beyond = self.anchored(values)
        return Support(self.at_stations(anchor), lambda series: self.from_stations(series, beyond), self.starts(values, anchor))

    def beside(self, values: Values, base: Values, angles: Floats, starts: Starts | None = None) -> Floats:
        """What ``values`` change in a transmission error next to ``base`` at ``angles`` [rad], to first order."""
        high, low = (self.bench.error_beside(self.condition, v, angles, base, angles, starts=starts) for v in (values, base))
        return high - low

    def at_stations(self, zero: float) -> Floats:
        """Angles [rad] of the stations in the order in which they are passed, with the record's angle 0 at ``zero``."""
        return self.stations.angles[:: self.condition.direction] + zero

    def from_stations(self, series: Floats, beyond: float) -> Floats:
        """The record's samples of a ``series`` there, ``beyond`` [rad] further on."""
        return self.stations.samples(series[:: self.condition.direction], beyond)

    def anchored(self, values: Values) -> tuple[float, float]:
        """One of few places [rad] for the record's angle 0, and how far it is from there: runs are shared by all zeros near one.

        Roughly, or of the base model: kinks of a large effect would be where their place is not, and its direction with them.
        """
        zero, fineness = zero_of(self.bench, self.record, values), self.bench.fineness
        loose = fineness is None or fineness.rough or not self.bench.relevant(values, True)
        distance = self.anchors() if loose else 0.0
        anchor = distance * round(zero / distance) if distance else round(zero, ALIKE)
        return anchor, zero - anchor if distance else 0.0

    @cached_property
    def stations(self) -> Stations:
        """Where its samples are computed: with other records, if what lies between is known as well as it must be."""
        shared = self.shared_stations
        near = not shared.off.any() or 2.0 * float(np.abs(shared.off).max()) <= self.anchors()
        return shared if near else own_stations(angles_of(self.bench, self.record, 0.0))

    @cached_property
    def shared_stations(self) -> Stations:
        angles = angles_of(self.bench, self.record, 0.0)
        return self.bench.stations.get(angles.tobytes()) or own_stations(angles)

    def anchors(self) -> float:
        """Distance [rad] of the places at which angle 0 is anchored, so that what lies between is known as well as it must be; 0: everywhere."""
        angles = self.shared_stations.angles
        if self.bench.fineness is None or self.condition.hours > 0.0 or len(angles) < LEAST_SAMPLES or np.diff(angles).min() <= 0.0:
            return 0.0
        allowed = min(map(self.bench.allowed, self.shared_stations.sharers), default=self.bench.allowed(self.record))

        def found() -> float:
            # Wherever the cages stand: whoever asks first, all have the same.
            series = self.bench.column(self.name, self.condition, {}, angles[:: self.condition.direction])
            error = SplineNodes(angles).error(series[:: self.condition.direction])
            share = FIRMLY * allowed / error if error > 0.0 else 1.0
            if share <= LEAST_SHARE:
                return 0.0
            # By powers of two: other conditions have the same places.
            return float(np.median(np.diff(angles)) * 2.0 ** np.floor(np.log2(2.0 / np.pi * np.arcsin(min(share, 1.0)))))

        return self.bench.kept(("anchors", self.name, self.condition, allowed, angles.tobytes()), found)


@dataclass(frozen=True)
class OverTorque:
    """Turning [rad] of the output under the record's torques, input held; cages ``cage`` ahead [rad]."""

    bench: Bench
    record: Record
    # Where the way matters it is gone along exactly, whatever the bench.
    is_exact: bool = False
    cage: float = 0.0

    def exact(self) -> "OverTorque":
        return replace(self, is_exact=True)

    @property
    def condition(self) -> Condition:
        return replace(held_condition(self.bench, self.record), cage=self.cage)

    def nodes(self, level: int) -> TorqueNodes | None:
        torques = self.places({})
        # Where a way turns back is looked for sample by sample: once.
        return self.bench.kept(("nodes", torques.tobytes(), level), lambda: torque_nodes(torques, NEAR_NOTHING * self.bench.rated_load, max(level, 0)))

    def places(self, values: Values) -> Floats:
        return np.asarray(self.record.axes["torque"], np.float64)

    def unchanged(self, values: Values) -> dict[str, float]:
        return {}

    def run(self, values: Values, nodes: TorqueNodes) -> Floats:
        return self.along(values, nodes.torques)

    def directly(self, values: Values) -> Floats:
        return self.along(values, self.places(values))

    def seen(self, at: Callable[[Floats | float], Floats]) -> Floats:
        return at(0.0)

    def along(self, values: Values, torques: Floats) -> Floats:
        path, places = self.way(values, torques)
        return self.bench.held(self.condition, values, path)[places]

    def way(self, values: Values, torques: Floats) -> tuple[Floats, npt.NDArray[np.intp] | slice]:
        """``torque_way.way`` as finely as the bench asks for."""
        return way(self.bench, values, torques, TORQUE_STEP if self.is_exact else self.bench.torque_step, self.record.closed)


def moved(angles: Floats, series: Floats, by: Floats | float) -> Floats:
    """What a ``series`` at ``angles`` [rad], in any order, is ``by`` [rad], one distance or each its own, further on."""
    if not np.any(by):
        return series
    order = np.argsort(angles, kind="stable")
    return SplineNodes(angles[order]).samples(series[order], angles + by)


def signal(curve: Curve[Nodes], values: Values) -> Floats:
    """What the record's samples show with ``values``."""
    fine, coarse = nodes_of(curve, {}), nodes_of(curve, values)
    changed, exact = bool(curve.bench.relevant(values, True)), curve.exact()
    places = curve.places(values)
    if coarse is None or (fine is None and not changed):
        direct = exact.directly(values)
        return curve.seen(lambda ahead: moved(places, direct, ahead))
    change = curve.run(values, coarse) - curve.run({}, coarse) if changed else None
    # The base model's is had but once at every sample.
    base = exact.directly(curve.unchanged(values)) if fine is None else exact.run({}, fine)

    def at(ahead: Floats | float) -> Floats:
        found = moved(places, base, ahead) if fine is None else fine.samples(base, places + ahead)
        return found if change is None else found + coarse.samples(change, places + ahead)

    return curve.seen(at)


def shifted_errors(bench: Bench, record: Record, values: Values, zeros: Floats) -> list[Floats]:
    """Transmission error [rad] of the record's samples for several places of its angle 0 [rad], from one run."""
    curve = OverAngle(bench, record, "transmission_error")
    # Nodes go a pitch beyond what they are for.
    ends = curve.places({})[:, None] + [min(float(zeros.min()) + BEYOND, 0.0), max(float(zeros.max()) - BEYOND, 0.0)]
    nodes = angle_nodes(ends, curve.condition.direction, LEVEL_OF_A_PATTERN, always=True)
    assert nodes is not None
    series = curve.run(values, nodes)
    return [nodes.samples(series, curve.places({angle_zero(record): float(zero)})) for zero in zeros]


def nodes_of(curve: Curve[Nodes], values: Values) -> Nodes | None:
    """Nodes at which ``values`` change the signal smoothly enough; of the signal itself where none are given."""
    return curve.nodes(level_of(curve, values))


def level_of(curve: Curve[Nodes], values: Values) -> int:
    """The level of ``nodes_of``."""
    fineness, away = curve.bench.fineness, curve.bench.away(values)

    def change(nodes: Nodes) -> Floats:
        return curve.run(values, nodes) - (curve.run({}, nodes) if away else 0.0)

    return fineness.level(curve.record, away, errors_by_level(curve, change)) if fineness else EVERY_SAMPLE


def nodes_of_slopes(curve: Curve[Nodes], values: Values, base: Values, change: Callable[[Nodes], Floats]) -> Nodes | None:
    """Nodes for what ``values`` ``change`` next to ``base`` to first order, which jumps where the signal has a kink."""
    fineness = curve.bench.fineness
    if fineness and fineness.rough:
        return curve.nodes(fineness.level_of_slopes(curve.record, curve.bench.away({**base, **values}), errors_by_level(curve, change)))
    return curve.nodes(max(level_of(curve, {**base, **values}), LEVEL_OF_SLOPES))


def errors_by_level(curve: Curve[Nodes], change: Callable[[Nodes], Floats]) -> ErrsAt:
    """What interpolation errs of a ``change``, and its size."""

    def errs(level: int) -> tuple[float, float] | None:
        nodes = curve.nodes(level)
        if nodes is None:
            return None
        # One turn is like the others.
        nodes = nodes.beginning()
        at = change(nodes)
        return nodes.error(at), float(np.std(at))

    return errs


def error_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    """What ``values`` change in the transmission error [rad] next to ``base``, to first order; None where that is not cheaper."""
    curve = OverAngle(bench, record, "transmission_error")
    if curve.condition.hours > 0.0:
        return None
    nodes = nodes_of_slopes(curve, values, base, lambda nodes: curve.beside(values, base, nodes.angles))
    turned = zero_of(bench, record, values) != zero_of(bench, record, base)
    if nodes is None and turned:
        at = curve.support(None, base)
        high, low = (
            bench.error_beside(curve.condition, v, curve.at_stations(zero_of(bench, record, v)), base, at.angles, starts=at.starts) for v in (values, base)
        )
        return curve.from_stations(high - low, 0.0)
    at = curve.support(nodes, values)
    change = at.samples(curve.beside(values, base, at.angles, at.starts))
    if turned:
        # The angle from which the record counts: along the curve.
        change += signal(curve, {**base, **curve.unchanged(values)}) - signal(curve, base)
    return change


def glimpsed_angles(bench: Bench, record: Record) -> Floats | None:
    """The few angles [rad] at which a glimpse of a transmission error is had; None where these are not fewer, or first order is not cheaper."""
    curve = OverAngle(bench, record, "transmission_error")
    nodes = curve.nodes(COARSEST)
    return None if nodes is None or curve.condition.hours > 0.0 else nodes.angles


def glimpsed_error(bench: Bench, record: Record, values: Values, base: Values, first_order: bool) -> Floats:
    """What ``values`` change in the transmission error [rad] next to ``base`` at ``glimpsed_angles``."""
    curve = OverAngle(bench, record, "transmission_error")
    nodes = curve.nodes(COARSEST)
    assert nodes is not None
    return curve.beside(values, base, nodes.angles) if first_order else curve.run(values, nodes) - curve.run(base, nodes)


def loop_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    """What ``values`` change in a loop [rad] next to ``base``, to first order, or coarsely where its way leaves a mark; None of a worn one, where
    that is not cheaper."""
    if bench.remembers(values) or bench.remembers(base):
        return coarse_loop_change(bench, record, values, base)
    curve = OverTorque(bench, record)
    condition = curve.condition
    if condition.hours > 0.0:
        return None

    def between(torques: Floats) -> Floats:
        path, lead = entered(torques, bench.rated_load, record.closed)
        high, low = (bench.held_beside(condition, v, path, base)[lead:] for v in (values, base))
        return high - low

    nodes = nodes_of_slopes(curve, values, base, lambda nodes: between(nodes.torques))
    return between(curve.places(values)) if nodes is None else nodes.samples(between(nodes.torques), curve.places(values))


def coarse_loop_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    """What ``values`` change in a loop that remembers its way [rad] next to ``base``, from few positions of the cranks and by long steps of torque.

    It errs by a share of itself (RV20E-121: 1 % of springs, clearance and hollow races, 5 to 14 % of profiles, friction and single cranks).  None
    of a loop that does not remember, or is worn: those are not dear, or not cheaper so.
    """
    if not (bench.remembers(values) or bench.remembers(base)):
        return None
    curve = OverTorque(bench.rougher, record)
    if curve.condition.hours > 0.0:
        return None

    def between(torques: Floats) -> Floats:
        return curve.along(values, torques) - curve.along(base, torques)

    # The same nodes for both, however near they are.
    nodes = nodes_of_slopes(curve, values, base, lambda nodes: between(nodes.torques))
    return between(curve.places(values)) if nodes is None else nodes.samples(between(nodes.torques), curve.places(values))


def loop_error(bench: Bench, record: Record) -> Floats:
    """About what the mean over the cranks' positions errs by in a loop of the base model [rad], at the record's samples."""
    curve = OverTorque(bench, record)

    def found() -> Floats:
        fine = nodes_of(curve, {})
        path, lead = entered(curve.places({}) if fine is None else fine.torques, bench.rated_load, record.closed)
        halves = bench.held_halves(curve.condition, path)[lead:]
        return halves if fine is None else fine.samples(halves, curve.places({}))

    # Every prediction with some of it asks again.
    return bench.kept(("loop error", curve.condition, record.closed, curve.places({}).tobytes()), found)
