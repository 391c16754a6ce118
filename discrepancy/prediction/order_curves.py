"""Orders of a transmission error are predicted as those of the curve that the bench and its measuring chain would have shown."""

import math
from dataclasses import replace

import numpy as np

from discrepancy.campaign.order_analysis import EvenCurve, numbers_of
from discrepancy.problem import ERROR, ORDERS, Record
from fmu_src.arrays import Floats

# Samples of a turn, at least; and those of a wave of the highest order, so that the meshing order (1560 of 40 pins) folds into none that is asked for.
LEAST, PER_WAVE = 2048, 8
# Turns in which orders that are no whole numbers must be whole.
MOST_TURNS = 12


def turns_of(order: Floats) -> int:
    """The fewest turns of the output in which all orders make whole waves."""
    for turns in range(1, MOST_TURNS + 1):
        if np.all(np.abs(order * turns - np.rint(order * turns)) < 1e-6 * turns):
            return turns
    return MOST_TURNS


def curve_of(record: Record) -> Record:
    """The curve over whole turns of which a record of orders is made; any other record itself.

    Its angle is the record's: where that is counted from is one unknown angle for all orders of a mounting.  Its mean counts, for
    order 0 is only there where the zero is known.
    """
    if record.quantity != ORDERS:
        return record
    order = np.asarray(record.axes["order"], np.float64)
    turns = turns_of(order)
    size = turns * max(LEAST, 2 ** math.ceil(math.log2(max(PER_WAVE * float(order.max()), 1.0))))
    angle = 2.0 * math.pi * turns * np.arange(size) / size
    factors = dict(record.factors) | {name: float(column[0]) for name, column in record.axes.items() if name not in ("order", "part")}
    return replace(record, quantity=ERROR, values=np.zeros(size), axes={"angle": angle}, factors=factors, zero_known=True)


def orders_shown(record: Record, curve: Floats) -> Floats:
    """The record's numbers [rad] that the values of its ``curve_of`` show."""
    order = np.asarray(record.axes["order"], np.float64)
    turns = turns_of(order)
    angle = 2.0 * math.pi * turns * np.arange(len(curve)) / len(curve)
    return numbers_of(EvenCurve(angle, curve, turns), order, np.asarray(record.axes["part"]))
