"""One full meshing cycle (every lobe meets every pin) that stands for many hours, and what its transmission error shows."""

import math
from collections.abc import Sequence

import numpy as np

from fmu_src.arrays import Floats
from studies.coupled_master import CoupledMaster
from studies.pair import Pair
from studies.solve import ARCSEC

HOUR = 3600.0


def run_cycle(pair: Pair, hours: float) -> tuple[float, Floats]:
    """One full meshing cycle that counts as ``hours``; with a duty, cycles of its segments by their shares.

    Returned are the hours of the last cycle and its transmission error after each step [rad].

    Segments really alternate all the time.  Run one after the other, the first would find
    the surfaces less run in than the last, an error that goes with the hours.  There and
    back (1 2 3 2 1, the outer ones by halves) all have the same mean age, and it goes with
    the hours' square.
    """
    if not pair.duty:
        return hours, count_cycle(pair, hours)
    *outer, last = pair.duty
    there = [(segment, 0.5 * segment.share) for segment in outer]
    for segment, share in [*there, (last, last.share), *reversed(there)]:
        pair.set_operation(segment.speed, segment.torque)
        span, errors = hours * share, count_cycle(pair, hours * share)
    return span, errors


def count_cycle(pair: Pair, hours: float) -> Floats:
    """One full meshing cycle at the present speed and torque; the transmission error after each step [rad].

    Wear rises through the first crank turn and falls through one turn more.  A contact that the cycle meets early
    in each turn is then as old on average as one that it meets late; cut off sharply, the two would differ by
    the wear of a turn.
    """
    positions = pair.positions
    steps = pair.reducer.topology.lobes * positions
    full = hours * HOUR / (steps * pair.master.step_size)
    rise = (np.arange(positions) + 0.5) / positions
    errors = [count_steps(pair, full * share, 1) for share in rise]
    errors.append(count_steps(pair, full, steps - positions))
    errors += [count_steps(pair, full * share, 1) for share in rise[::-1]]
    return np.concatenate(errors)


def count_steps(pair: Pair, acceleration: float, steps: int) -> Floats:
    """Steps whose wear, time and distance count ``acceleration`` times; the transmission error after each [rad]."""
    pair.wear.set("acceleration", acceleration)
    errors = np.zeros(steps)
    if isinstance(pair.master, CoupledMaster) and pair.master.scheme == "gauss-seidel":
        pair.master.run_compiled(steps, errors)
        return errors
    buffer, done = np.zeros(1), pair.master.steps_done
    read = pair.plant.reader(pair.plant.signal("transmission_error").references[:1], buffer)

    def keep() -> None:
        read()
        errors[pair.master.steps_done - 1 - done] = buffer[0]

    pair.master.run(steps, keep)
    return errors


def drift_of(errors: Floats, positions: int) -> float:
    """How far the output went on by wear [rad] in a cycle, which ends with a crank turn where it began."""
    turn = len(errors) - positions
    return float((errors[turn:] - errors[:positions]).mean())


def swing_over_turn(errors: Floats, positions: int, before: Sequence[float], now: Sequence[float]) -> float:
    """Peak to peak [arcsec] over a turn of the output, less how the output falls behind while the jump wears it.

    ``before`` and ``now``: hours from and to, and drift [rad], of the jump before and of this one.  With a times the root
    of the hours and b times the hours both are met: parts that run in wear fast at first, which a straight line would leave in the error.
    """
    rows = np.array([[math.sqrt(end) - math.sqrt(max(start, 0.0)), end - start] for start, end, _ in (before, now)])
    a, b = np.linalg.solve(rows, [before[2], now[2]])
    turn = len(errors) - positions
    passed = np.arange(turn) - 0.5 * positions
    hours = now[0] + (now[1] - now[0]) * np.clip(passed / turn, 0.0, 1.0)
    return float(np.ptp(errors[:turn] - a * np.sqrt(np.maximum(hours, 0.0)) - b * hours)) * ARCSEC
