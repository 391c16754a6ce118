"""A recorder whose clock (or pulse count) runs fast: the axis is stretched, value(x (1 + e)).

Source: free-running sample clocks, 10 to 1000 ppm; lost encoder pulses.
"""

from collections.abc import Callable

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude

PER = "campaign"
EFFECT = Effect(
    0, "clock slip", "value at x (1 + e)", "free-running clocks, 10 to 1000 ppm",
    "phases of all orders drift along the record, in proportion to the order",
    (amplitude("clock_slip", "1", "relative error of the axis", 1e-4, -0.02, 0.02),),
    signals=("transmission_error", "vibration", "input_torque"),
)


def change(values: Floats, record: Record, at: Callable[[str], float], size: float) -> Floats:
    slip = at("clock_slip")
    name = next((n for n in ("angle", "time") if n in record.axes), None)
    if slip == 0.0 or name is None or len(values) < 3:
        return values
    axis = np.asarray(record.axes[name], float)
    order = np.argsort(axis)
    return np.interp(axis * (1.0 + slip), axis[order], values[order])
