"""A record of very many samples by means of neighbours: where a pattern lies shows in them as well, in a small part of the time."""

from dataclasses import replace

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats

# Samples of one turn of the output that show what a drive does: ten of a wave of its pins' meshing.
ENOUGH = 16384
# An axis that leaps by more than this share of its range begins anew: no neighbours there.
LEAP = 0.1


def fewer(record: Record, turns: float) -> Record:
    """The record itself, or means of so many neighbours that ``turns`` of the output have ``ENOUGH`` samples each."""
    count = len(record.values)
    step = int(count / (ENOUGH * max(turns, 1.0)))
    columns = {name: np.asarray(axis, np.float64) for name, axis in record.axes.items()}
    if step < 2 or any(np.abs(np.diff(axis)).max() > LEAP * max(float(np.ptp(axis)), 1e-300) for axis in columns.values()):
        return record

    def means(values: Floats) -> Floats:
        found: Floats = values[: count // step * step].reshape(-1, step).mean(axis=1)
        return found

    return replace(record, values=means(np.asarray(record.values, np.float64)), axes={name: means(axis) for name, axis in columns.items()}, far_off=())
