"""What the place of the roller cages changes in curves of the bench: in a transmission error, and in a loop at one locked place."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TypeVar

import numpy as np

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.conditions import Values, identity
from discrepancy.prediction.curves import nodes_of, signal
from discrepancy.prediction.over_angle import OverAngle, mean
from discrepancy.prediction.over_torque import OverTorque
from discrepancy.prediction.support import angle_nodes
from discrepancy.problem import Record
from fmu_src.arrays import Floats

# What the ripple of the cages to first order misses, of itself (0.1 to 0.45 by load), and of what a prediction may err.
OF_RIPPLE, HARDLY_SEEN = 0.5, 0.25
# The rollers' ripple has kinks: at these it errs by 6 % of itself.
LEVEL_OF_A_RIPPLE = 7

AnyCurve = TypeVar("AnyCurve", OverAngle, OverTorque)


def errors_of_cages(bench: Bench, record: Record, values: Values, cages: Sequence[float]) -> list[Floats]:
    """Transmission error [rad] of the record's samples for several places of the cages [rad], finely enough to see where they are."""
    curves = [OverAngle(bench, record, "transmission_error", cage) for cage in cages]
    nodes = angle_nodes(curves[0].places({}), curves[0].condition.direction, LEVEL_OF_A_RIPPLE, always=True)
    assert nodes is not None
    return [nodes.samples(curve.run(values, nodes), curve.places(values)) for curve in curves]


def cage_ripples(bench: Bench, record: Record, values: Values, cages: Sequence[float], exactly: bool = False) -> list[Floats]:
    """What cages that stand each of ``cages`` [rad] ahead change in the transmission error [rad]: unless ``exactly``, to first order where nobody
    could see what that misses."""
    plain = OverAngle(bench, record, "transmission_error")
    if not exactly and plain.condition.hours == 0.0 and bench.allowed(record) > 0.0 and not is_seen(plain):
        found: list[Floats] = []
        at = plain.support(nodes_of(plain, values), values)
        for change in to_first_order(plain, values, at.angles, cages):
            if misses(plain, change):
                break
            found.append(at.samples(change))
        else:
            return found
    return ripples(plain, values, cages)


def is_seen(curve: OverAngle) -> bool:
    """Whether one could see what the base model's ripple misses to first order: that of effects is then not asked, it would be seen as well."""

    def seen() -> bool:
        angles = curve.support(nodes_of(curve, {}), {}).angles
        quarter = 0.25 * curve.bench.reducer.topology.roller_pitch
        return any(misses(curve, change) for change in to_first_order(curve, {}, angles, [quarter]))

    return curve.bench.kept(("ripple is seen", *identity(curve.record)), seen)


def to_first_order(curve: OverAngle, values: Values, angles: Floats, cages: Sequence[float]) -> Iterator[Floats]:
    """What cages each of ``cages`` [rad] ahead change at ``angles`` [rad]."""

    def ahead(cage: float) -> Floats:
        return curve.bench.error_beside(curve.condition, values, angles, values, angles, cage)

    there = mean([ahead(cage) for cage in curve.cages(values)])
    for cage in cages:
        yield ahead(cage) - there


def misses(curve: OverAngle, change: Floats) -> bool:
    """Whether one could see what a ripple misses that is this ``change`` to first order."""
    return OF_RIPPLE * float(np.std(change)) > HARDLY_SEEN * curve.bench.allowed(curve.record)


def locked_ripples(bench: Bench, record: Record, values: Values, cages: Sequence[float]) -> list[Floats]:
    """What cages that stand each of ``cages`` [rad] ahead change in a loop [rad] at one locked place."""
    return ripples(OverTorque(bench, record), values, cages)


def ripples(curve: AnyCurve, values: Values, cages: Sequence[float]) -> list[Floats]:
    """What cages that stand each of ``cages`` [rad] ahead change in a curve."""
    without = signal(curve, values)
    return curve.bench.threads.map(lambda cage: signal(replace(curve, cage=cage), values) - without, cages)
