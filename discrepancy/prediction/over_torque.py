"""Loops of the held bench: turning of the output over its torque."""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from discrepancy.prediction.bench import TORQUE_STEP, Bench
from discrepancy.prediction.conditions import Values, held_condition
from discrepancy.prediction.curves import nodes_of, nodes_of_slopes
from discrepancy.prediction.support import TorqueNodes, torque_nodes
from discrepancy.prediction.torque_way import NEAR_NOTHING, entered, way
from discrepancy.prediction.turning_torque import applied
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from fmu_src.arrays import Floats


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

    def between(self, nodes: TorqueNodes) -> None:
        """Nothing: turning under one torque depends on the way there."""

    def places(self, values: Values) -> Floats:
        return applied(self.bench, self.record)

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
