"""What a record is called and along which axis its noise is correlated."""

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats


def stream_of(record: Record) -> str:
    """Name of the signal: the quantity with its tags."""
    if not record.tags:
        return record.quantity
    return f"{record.quantity}[{','.join(f'{k}={v}' for k, v in sorted(record.tags.items()))}]"


def position_of(record: Record) -> Floats:
    """Time if given and rising, else the first axis that runs one way, else the sample's number."""
    axes = record.axes
    for name in ("time", "angle", *axes):
        if name in axes:
            axis = np.asarray(axes[name], dtype=float)
            steps = np.diff(axis)
            if axis.size > 1 and np.all(np.isfinite(axis)) and (np.all(steps > 0) or np.all(steps < 0)):
                return axis
    return np.arange(np.size(record.values), dtype=float)


def order_axis(record: Record) -> Floats | None:
    """Angle of the output [rad] if the record runs over it."""
    axis = record.axes.get("angle")
    return None if axis is None or np.ptp(axis) == 0 else np.asarray(axis, dtype=float)
