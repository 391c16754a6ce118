"""What a record is called and along which axis its noise is correlated."""

import numpy as np
import numpy.typing as npt

from discrepancy.problem import Record
from fmu_src.arrays import Floats


def stream_of(record: Record) -> str:
    """Name of the signal: the quantity with its tags."""
    if not record.tags:
        return record.quantity
    return f"{record.quantity}[{','.join(f'{k}={v}' for k, v in sorted(record.tags.items()))}]"


def position_of(record: Record) -> Floats:
    """Time if given and rising, else the first axis that runs one way (``SAMPLE`` of a loop that lacks some), else the sample's number."""
    axes = record.axes
    for name in ("time", "angle", *axes):
        if name in axes:
            axis = np.asarray(axes[name], dtype=float)
            steps = np.diff(axis)
            if axis.size > 1 and np.all(np.isfinite(axis)) and (np.all(steps > 0) or np.all(steps < 0)):
                return axis
    return np.arange(np.size(record.values), dtype=float)


def path_of(record: Record) -> Floats:
    """The first axis, whichever way it goes, else the sample's number."""
    return next((np.asarray(axis, float) for axis in record.axes.values() if np.size(axis) > 1), np.arange(np.size(record.values), dtype=float))


def spacing_of(*positions: Floats) -> float:
    """Usual distance of neighbouring samples along one or several runs; 1 where no run has two."""
    steps = np.concatenate([np.abs(np.diff(position)) for position in positions])
    return float(np.median(steps)) if steps.size else 1.0


def fast_part(path: Floats, values: Floats) -> tuple[npt.NDArray[np.intp], Floats]:
    """(rows, deviations): what a sample is off the straight line between its neighbours, scaled to the variance of one; only where the ``path``
    goes on one way, unless that is nowhere."""
    before, after = np.diff(path)[:-1], np.diff(path)[1:]
    onward = before * after > 0.0
    if not onward.any():
        before, after = np.ones_like(before), np.ones_like(after)
        onward = np.ones(len(before), bool)
    inner = np.flatnonzero(onward) + 1
    share = before[onward] / (before + after)[onward]
    off = values[inner] - (1.0 - share) * values[inner - 1] - share * values[inner + 1]
    return inner, off / np.sqrt(1.0 + (1.0 - share) ** 2 + share**2)


def order_axis(record: Record) -> Floats | None:
    """Angle of the output [rad] if the record runs over it."""
    axis = record.axes.get("angle")
    return None if axis is None or np.ptp(axis) == 0 else np.asarray(axis, dtype=float)
