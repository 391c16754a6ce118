"""Where each mounting counts its angles from, by the pattern of the transmission error."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from discrepancy.outlying_samples import bridged
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.cages import LONG
from discrepancy.prediction.conditions import angle_zero, turns_of
from discrepancy.prediction.curves import shifted_errors
from discrepancy.prediction.fewer import fewer
from discrepancy.prediction.order_curves import curve_of, orders_shown
from discrepancy.prediction.whitening import gain
from discrepancy.problem import ERROR, ORDERS, Record
from fmu_src.arrays import Floats

# Places in a wave of the pattern that fixes where an angle is counted from.
PHASES = 48
SHARES = np.linspace(-0.5, 0.5, PHASES, endpoint=False)
# A campaign's zero is the model's if another place leaves so little less of the misfit, or of the pattern's own variance; chi-square that is no noise's.
OF_MISFIT, OF_PATTERN, SURELY = 0.02, 0.1, 25.0


def angle_zeros(bench: Bench, records: Sequence[Record], wave: float, for_record: Callable[[Record, Mapping[str, float]], dict[str, float]],
                standing: Mapping[str, float], always: bool) -> dict[str, float]:  # fmt: skip
    """The output angle [rad] of the model at which a mounting's angle is 0, by its nuisance; one ``wave`` [rad] of the pattern is looked through.

    A zero that the campaign shares with the model is none, unless the campaign declares the encoder's phase as unknown (``always``).
    """
    shifts = SHARES * wave
    zeros: dict[str, float] = {}
    for name, record in telling(bench, records).items():
        found, left = shown_at(bench, record, for_record(record, {**zeros, **standing}), shifts)
        misfits = [misfit(record, e) for e in left]
        best = int(np.argmin(misfits))
        least, more = misfits[best], misfits[PHASES // 2] - misfits[best]
        # Beside a large effect the pattern is a small part of all misfit: then it counts what its place changes in itself, if noise could not.
        elsewhere = more > OF_PATTERN * float(np.var(found[best])) and gain(left[PHASES // 2], left[best]) > SURELY
        if more > OF_MISFIT * least or elsewhere or always:
            zeros[name] = float(shifts[best])
    return zeros


def best_zeros(bench: Bench, records: Sequence[Record], wave: float, for_record: Callable[[Record, Mapping[str, float]], dict[str, float]],
               values: Mapping[str, float], names: Sequence[str]) -> tuple[float, dict[str, float]]:  # fmt: skip
    """Those of the zeros ``names`` [rad] that leave least of one record each beside an effect of ``values``, and what they leave, in its variance."""
    shifts = SHARES * wave
    zeros, whole = {}, 0.0
    for name, record in telling(bench, records).items():
        if name in names:
            misfits = [misfit(record, e) / misfit(record, record.values) for e in shown_at(bench, record, for_record(record, values), shifts)[1]]
            best = int(np.argmin(misfits))
            zeros[name], whole = float(shifts[best]), whole + misfits[best]
    return whole, zeros


def telling(bench: Bench, records: Sequence[Record]) -> dict[str, Record]:
    """By zero the record that tells it, with as many samples as that takes: the pattern hardly depends on the condition."""
    first: dict[str, Record] = {}
    for record in records:
        if tells(record):
            first.setdefault(angle_zero(record), record)
    bridges = {name: bridged(record) for name, record in first.items()}
    return {name: fewer(r, turns_of(bench, r)) if r.quantity == ERROR else r for name, r in bridges.items()}


def shown_at(bench: Bench, record: Record, own: dict[str, float], shifts: Floats) -> tuple[list[Floats], list[Floats]]:
    """What a record would show with its angle 0 at each of ``shifts`` [rad], and what that leaves."""
    found = shifted_errors(bench, curve_of(record), own, shifts)
    if record.quantity == ORDERS:
        found = [orders_shown(record, predicted) for predicted in found]
    return found, [record.values - predicted for predicted in found]


def misfit(record: Record, left: Floats) -> float:
    return float(np.mean(left**2) if record.quantity == ORDERS else np.var(left))


def tells(record: Record) -> bool:
    """Whether the pattern shows in a record."""
    return "angle" in record.axes and len(record.values) >= LONG if record.quantity == ERROR else record.quantity == ORDERS
