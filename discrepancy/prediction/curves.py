"""What the bench shows at a record's samples: computed at nodes as fine as the noise asks for, and interpolated.

A prediction is the base model's, at fine nodes and once, and what the values change in it, at nodes of their own.
"""

from dataclasses import dataclass
from typing import Protocol, TypeVar

import numpy as np

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.conditions import Values, angle_zero, angles_of, as_turned, condition_of, held_condition
from discrepancy.prediction.support import AngleNodes, TorqueNodes, angle_nodes, torque_nodes
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from fmu_src.arrays import Floats
from studies.coupled import COLUMNS
from studies.hysteresis import LOST_MOTION_SHARE

Nodes = TypeVar("Nodes", AngleNodes, TorqueNodes)
# Share of the rated torque below which a loop has no nodes: the output floats.
NEAR_NOTHING = 0.009
# Where a pattern lies is seen at some thousand nodes a turn.
LEVEL_OF_A_PATTERN = 2
# Where parameters do nearly the same, their derivatives differ by little: 2 % of errors were 20 times that.
LEVEL_OF_SLOPES = 6


class Curve(Protocol[Nodes]):
    """A signal of the bench over the axis of a record."""

    @property
    def bench(self) -> Bench: ...

    @property
    def record(self) -> Record: ...

    def nodes(self, level: int) -> Nodes | None:
        """Nodes for the record's samples; None where every sample is computed."""
        ...

    def places(self, values: Values) -> Floats:
        """Where the samples lie on the axis."""
        ...

    def run(self, values: Values, nodes: Nodes) -> Floats:
        """The signal at nodes."""
        ...

    def directly(self, values: Values) -> Floats:
        """The signal at every sample."""
        ...


@dataclass(frozen=True)
class OverAngle:
    """Column ``name`` of the running bench (``studies.coupled.COLUMNS``); cages ``cage`` ahead [rad]."""

    bench: Bench
    record: Record
    name: str
    cage: float = 0.0

    @property
    def condition(self) -> Condition:
        return condition_of(self.bench, self.record)

    def nodes(self, level: int) -> AngleNodes | None:
        return angle_nodes(angles_of(self.bench, self.record, 0.0), self.condition.direction, level)

    def places(self, values: Values) -> Floats:
        return angles_of(self.bench, self.record, values.get(angle_zero(self.record), 0.0))

    def run(self, values: Values, nodes: AngleNodes) -> Floats:
        return self.column(self.bench.running(self.condition, values, nodes.angles, self.cage))

    def directly(self, values: Values) -> Floats:
        angles, place = as_turned(self.bench, self.record, values)
        return self.column(self.bench.running(self.condition, values, angles, self.cage))[place]

    def column(self, series: Floats) -> Floats:
        return series[:, COLUMNS.index(self.name)]


@dataclass(frozen=True)
class OverTorque:
    """Turning [rad] of the output under the record's torques, input held."""

    bench: Bench
    record: Record

    @property
    def condition(self) -> Condition:
        return held_condition(self.bench, self.record)

    def nodes(self, level: int) -> TorqueNodes | None:
        torques = self.places({})
        # Where a way turns back is looked for sample by sample: once.
        return self.bench.kept(("nodes", torques.tobytes(), level), lambda: torque_nodes(torques, NEAR_NOTHING * self.bench.rated_load, level))

    def places(self, values: Values) -> Floats:
        return np.asarray(self.record.axes["torque"], np.float64)

    def run(self, values: Values, nodes: TorqueNodes) -> Floats:
        return self.along(values, nodes.torques)

    def directly(self, values: Values) -> Floats:
        return self.along(values, self.places(values))

    def along(self, values: Values, torques: Floats) -> Floats:
        path, lead = entered(self.bench, torques)
        return self.bench.held(self.condition, values, path)[lead:]


def entered(bench: Bench, torques: Floats) -> tuple[Floats, int]:
    """The way into a loop and through it, and the length of the way in: from little torque, for with none the output floats."""
    first = torques[0] if torques[0] != 0.0 else LOST_MOTION_SHARE * bench.rated_load
    lead = np.linspace(0.1 * first, torques[0], 9)[:-1]
    return np.concatenate([lead, torques]), len(lead)


def signal(curve: Curve[Nodes], values: Values) -> Floats:
    """What the record's samples show with ``values``."""
    fine, coarse = nodes_of(curve, {}), nodes_of(curve, values)
    if fine is None or coarse is None:
        return curve.directly(values)
    places = curve.places(values)
    found = fine.samples(curve.run({}, fine), places)
    if curve.bench.relevant(values, True):
        found += coarse.samples(curve.run(values, coarse) - curve.run({}, coarse), places)
    return found


def shifted_errors(bench: Bench, record: Record, values: Values, zeros: Floats) -> list[Floats]:
    """Transmission error [rad] of the record's samples for several places of its angle 0 [rad], from one run."""
    curve = OverAngle(bench, record, "transmission_error")
    nodes = angle_nodes(curve.places({}), curve.condition.direction, LEVEL_OF_A_PATTERN, always=True)
    assert nodes is not None
    series = curve.run(values, nodes)
    return [nodes.samples(series, curve.places({angle_zero(record): float(zero)})) for zero in zeros]


def nodes_of(curve: Curve[Nodes], values: Values, slopes: bool = False) -> Nodes | None:
    """Nodes at which ``values`` change the signal smoothly enough; of the signal itself where none are given.

    ``slopes``: for derivatives, which jump where the signal has a kink.
    """
    fineness, bench = curve.bench.fineness, curve.bench
    if fineness is None:
        return None

    def errs(level: int, more: Values) -> tuple[float, float] | None:
        nodes = curve.nodes(level)
        if nodes is None:
            return None
        at = curve.run(more, nodes) - (curve.run({}, nodes) if more else 0.0)
        return nodes.error(at), float(np.std(at))

    level = fineness.level(curve.record, bench.away(values), values, errs)
    return curve.nodes(max(level, LEVEL_OF_SLOPES) if slopes and not fineness.rough else level)


def error_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    """What ``values`` change in the transmission error [rad] next to ``base``, to first order; None where that is not cheaper."""
    curve = OverAngle(bench, record, "transmission_error")
    condition = curve.condition
    if condition.hours > 0.0:
        return None
    nodes = nodes_of(curve, {**base, **values}, slopes=True)
    if nodes is None:
        angles, place = as_turned(bench, record, values)
        before, place_before = as_turned(bench, record, base)
        high = bench.error_beside(condition, values, angles, base, before)[place]
        return high - bench.error_beside(condition, base, before, base, before)[place_before]
    high, low = (bench.error_beside(condition, v, nodes.angles, base, nodes.angles) for v in (values, base))
    change = nodes.samples(high - low, curve.places(values))
    if values.get(angle_zero(record), 0.0) != base.get(angle_zero(record), 0.0):
        # The angle from which the record counts: along the curve.
        change += signal(curve, {**base, angle_zero(record): values[angle_zero(record)]}) - signal(curve, base)
    return change


def loop_change(bench: Bench, record: Record, values: Values, base: Values) -> Floats | None:
    """What ``values`` change in a loop [rad] next to ``base``, to first order; None where that is not cheaper or the loop remembers."""
    curve = OverTorque(bench, record)
    condition = curve.condition
    if condition.hours > 0.0 or bench.remembers(values) or bench.remembers(base):
        return None
    nodes = nodes_of(curve, {**base, **values}, slopes=True)
    path, lead = entered(bench, curve.places(values) if nodes is None else nodes.torques)
    high, low = (bench.held_beside(condition, v, path, base)[lead:] for v in (values, base))
    return high - low if nodes is None else nodes.samples(high - low, curve.places(values))
