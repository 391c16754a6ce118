"""Key figures of what a reducer takes at its input: its mean torque, and that at both ends of the speeds."""

from collections.abc import Callable

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats

DRAG = ("no_load_torque", "input_torque")
MEAN, SLOWEST, FASTEST = "mean torque", "torque at the lowest speed", "torque at the highest speed"
DRAG_UNITS = {MEAN: "N.m", SLOWEST: "N.m", FASTEST: "N.m"}
# Samples within this share of the range count to its end: a ramp passes no speed twice.
END = 0.05


def of_drag(record: Record) -> Callable[[Floats], dict[str, float]]:
    """How figures [N m] are read from torques (n,) of a record; those of both ends where its speed varies."""
    good = np.isfinite(record.values) & record.counted
    speed = np.asarray(record.axes.get("speed", np.zeros(len(good))), float)
    rows = {MEAN: good}
    if good.any() and np.size(speed) == len(good) and np.ptp(speed[good]) > 0.0:
        low, high = float(speed[good].min()), float(speed[good].max())
        rows |= {SLOWEST: good & (speed <= low + END * (high - low)), FASTEST: good & (speed >= high - END * (high - low))}
    return lambda values: {name: float(np.mean(values[kept])) for name, kept in rows.items() if kept.any()}
