"""What loops at single positions of the cranks differ by in the base model: its principal components, for whoever does not know the position."""

import numpy as np

from discrepancy.effects.locked_position import COMPONENTS
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.curves import nodes_of
from discrepancy.prediction.held import HELD_ANGLES
from discrepancy.prediction.lives import SHORT_CYCLE
from discrepancy.prediction.over_torque import OverTorque
from discrepancy.prediction.torque_way import way
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from fmu_src.arrays import Floats

# Shares of the rated torque of the loop by which positions are compared: finely where clearances are closed.
WAY = np.array([1.0, 0.75, 0.5, 0.25, 0.1, 0.05, 0.02])


def departures(bench: Bench, record: Record) -> Floats:
    """Of the new base model's loop at each position (positions, n) [rad] from the mean of all, each about its own mean: its zero is free."""
    return departures_along(bench, OverTorque(bench, record).places({}), record.closed)


def departures_along(bench: Bench, torques: Floats, closed: bool = False) -> Floats:
    """The same under torques [N m] at rated speed and load."""
    path, places = way(bench, {}, torques, closed=closed)
    turning = bench.held_turnings(Condition(bench.rated_speed, bench.rated_load), {}, path, HELD_ANGLES, SHORT_CYCLE)[:, places]
    off = turning - turning.mean(axis=0)
    found: Floats = off - off.mean(axis=1, keepdims=True)
    return found


def position_scores(bench: Bench) -> Floats:
    """How much of each component a loop at each position has (COMPONENTS, positions), of mean square 1: those of one loop hold for all, or a position
    would have other amounts at another torque."""

    def found() -> Floats:
        torques = bench.rated_load * np.concatenate([WAY, -WAY[::-1], -WAY[-2::-1], WAY[::-1]])
        scores = np.linalg.svd(departures_along(bench, torques), full_matrices=False)[0][:, :COMPONENTS].T
        # Signed by the first position, at which a model begins.
        signed: Floats = np.sqrt(HELD_ANGLES) * scores * np.where(scores[:, :1] < 0.0, -1.0, 1.0)
        return signed

    return bench.kept(("position scores",), found)


def position_patterns(bench: Bench, record: Record) -> Floats:
    """What one of each component adds to a loop of the base model [rad] at the record's samples (COMPONENTS, n)."""
    curve = OverTorque(bench, record).exact()

    def found() -> Floats:
        fine = nodes_of(curve, {})
        path, places = curve.way({}, curve.places({}) if fine is None else fine.torques)
        turning = bench.held_turnings(curve.condition, {}, path, HELD_ANGLES, SHORT_CYCLE)[:, places]
        patterns: Floats = position_scores(bench) @ (turning - turning.mean(axis=0)) / HELD_ANGLES
        return patterns if fine is None else np.array([fine.samples(pattern, curve.places({})) for pattern in patterns])

    # Every prediction with some of it asks again.
    return bench.kept(("position patterns", curve.condition, curve.places({}).tobytes()), found)
