"""Signals of the running bench over the output's angle, transmission error above all."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.conditions import Values, angle_zero, angles_of, condition_of, places_of_zero, zero_of
from discrepancy.prediction.curves import LEVEL_OF_SLOPES, nodes_of_slopes, signal
from discrepancy.prediction.running import Starts
from discrepancy.prediction.stations import Stations, own_stations
from discrepancy.prediction.support import BEYOND, COARSEST, WHOLE, WORTHWHILE, AngleNodes, SplineNodes, angle_nodes, banded_nodes, between_angles
from discrepancy.prediction.units import Condition
from discrepancy.problem import NEAR, Record
from fmu_src.arrays import Floats
from rv_plant.effects import EFFECTS as PLANT

# Fewer samples than these are computed where they are.
LEAST_SAMPLES = 16
# Of what a prediction may err, what moving it to where the record's angle 0 lies may add; where anchors would have to stand closer
# than this share of the samples' distance, there are none.
FIRMLY, LEAST_SHARE = 0.1, 0.01
# Decimals of an angle [rad] to which outputs that lag alike stand in one place.
ALIKE = 10
# How far a record's cages stand ahead [rad], among its factors; where there is none nobody knows it.
CAGES = "cages"
# Places of the cages, in parts of the rollers' pitch, whose mean is that of all.
QUARTERS = (0.0, 0.25, 0.5, 0.75)
# Amplitudes of effects that act as each roller passes, where they are off, and the angles that rollers pass.
ROLLED_OVER = {p.variable.name: p.variable.start for effect in PLANT.values() if effect.rolled_over for p in effect.amplitudes()}
PASSED = {p.variable.name: p.variable.start for effect in PLANT.values() for p in effect.parameters if p.variable.name == effect.rolled_over}
# Where a pattern lies is seen at some thousand nodes a turn.
LEVEL_OF_A_PATTERN = 2


def is_rolled_over(bench: Bench, values: Values) -> bool:
    """Whether an effect is on that acts as each roller passes."""
    return any(values.get(name, bench.starts[0][name]) != off for name, off in ROLLED_OVER.items())


def passed_at(values: Values) -> float:
    """Sum of the angles [rad] that rollers pass: what moves one of them moves the cages as far, or the bursts would be elsewhere."""
    return sum(values.get(name, start) for name, start in PASSED.items())


def mean(curves: list[Floats]) -> Floats:
    found: Floats = curves[0] if len(curves) == 1 else np.mean(curves, axis=0)
    return found


class Support(NamedTuple):
    """``angles`` [rad] at which a curve is computed, how the record's ``samples`` follow from a series there, and near which runs it ``starts``."""

    angles: Floats
    samples: Callable[[Floats], Floats]
    starts: Starts | None


@dataclass(frozen=True)
class OverAngle:
    """Column ``name`` of the running bench (``studies.coupled.COLUMNS``); cages ``cage`` ahead [rad], None: where the record has them."""

    bench: Bench
    record: Record
    name: str
    cage: float | None = None

    def cages(self, *shown: Values) -> list[float]:
        """Where the cages stand ahead [rad]: equally often anywhere in a pitch where an effect is on that shows another curve with each place."""
        cage = self.record.factors.get(CAGES) if self.cage is None else self.cage
        if cage is not None:
            return [cage]
        if not any(is_rolled_over(self.bench, values) for values in shown):
            return [0.0]
        return [share * self.bench.reducer.topology.roller_pitch for share in QUARTERS]

    def column(self, values: Values, angles: Floats, starts: Starts | None = None) -> Floats:
        """The signal at ``angles`` [rad]: of the base model with its cages at 0, and what ``values`` change in it wherever they stand."""

        def at(shown: Values, cage: float) -> Floats:
            return self.bench.column(self.name, self.condition, shown, angles, cage, starts)

        cages, own = self.cages(values), self.cages({})
        if cages == own:
            return mean([at(values, cage) for cage in cages])
        return at({}, own[0]) + mean([at(values, cage) - at({}, cage) for cage in cages])

    def first_order(self, high: tuple[Values, Floats], low: tuple[Values, Floats], run: Floats, starts: Starts | None = None) -> Floats:
        """What a transmission error differs by to first order, of ``high`` values at some angles [rad] from ``low`` ones at others, next to the ``run``
        with those at angles [rad] of its own."""

        def at(shown: tuple[Values, Floats], cage: float) -> Floats:
            return self.bench.error_beside(self.condition, *shown, low[0], run, cage, starts)

        return mean([at(high, cage) - at(low, cage) for cage in self.cages(high[0], low[0])])

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

    def between(self, nodes: AngleNodes) -> AngleNodes:
        angles = angles_of(self.bench, self.record, 0.0)
        return between_angles(float(angles.min()), float(angles.max()), self.condition.direction)

    def places(self, values: Values) -> Floats:
        return angles_of(self.bench, self.record, zero_of(self.bench, self.record, values))

    def unchanged(self, values: Values) -> dict[str, float]:
        return {name: values[name] for name in places_of_zero(self.record) if name in values}

    def run(self, values: Values, nodes: AngleNodes) -> Floats:
        return self.column(values, nodes.angles)

    def directly(self, values: Values) -> Floats:
        at = self.support(None, values)
        return at.samples(self.column(values, at.angles, at.starts))

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
        return self.first_order((values, angles), (base, angles), angles, starts)

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


def shifted_errors(bench: Bench, record: Record, values: Values, zeros: Floats) -> list[Floats]:
    """Transmission error [rad] of the record's samples for several places of its angle 0 [rad], from one run."""
    curve = OverAngle(bench, record, "transmission_error")
    # Nodes go a pitch beyond what they are for.
    ends = curve.places({})[:, None] + [min(float(zeros.min()) + BEYOND, 0.0), max(float(zeros.max()) - BEYOND, 0.0)]
    nodes = angle_nodes(ends, curve.condition.direction, LEVEL_OF_A_PATTERN, always=True)
    assert nodes is not None
    series = curve.run(values, nodes)
    places = [curve.places({angle_zero(record): float(zero)}) for zero in zeros]
    return np.split(nodes.samples(series, np.concatenate(places)), len(places))


def error_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    """What ``values`` change in the transmission error [rad] next to ``base``, to first order; None where that is not cheaper."""
    curve = OverAngle(bench, record, "transmission_error")
    if curve.condition.hours > 0.0:
        return None
    high, low = (bench.fineness.largest(v) if bench.fineness else v for v in (values, base))
    # Of a shape alone nothing would be left.
    shown = (high, low) if high != low else (values, base)
    nodes = nodes_of_slopes(curve, values, base, lambda nodes: curve.beside(*shown, nodes.angles))
    turned = zero_of(bench, record, values) != zero_of(bench, record, base)
    if nodes is None and turned:
        at = curve.support(None, base)
        there, here = ((v, curve.at_stations(zero_of(bench, record, v))) for v in (values, base))
        return curve.from_stations(curve.first_order(there, here, at.angles, at.starts), 0.0)
    # How finely a signal must be known that noise hardly hides says nothing of slopes, of which a share is enough.
    at = curve.support(nodes or curve.nodes(LEVEL_OF_SLOPES), values)
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
