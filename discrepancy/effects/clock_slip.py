"""A recorder whose clock (or pulse count) runs fast: the axis is stretched, value(x (1 + e)).

Source: free-running sample clocks, 10 to 1000 ppm; lost encoder pulses.
"""

from collections.abc import Callable

import numpy as np
from scipy.interpolate import CubicSpline

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude

PER = "campaign"
# Of the usual distance of samples: what lies closer to its neighbour says nothing new of the curve.
CLOSE = 0.1
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
    places, first = np.unique(axis, return_index=True)
    apart = np.diff(places)
    known = np.append(True, apart > CLOSE * np.median(apart)) if len(apart) else np.array([True])
    if known.sum() < 3:
        return values
    # Smooth: by straight lines a clock that runs fast and one that runs slow would move the curve along different slopes.
    curve = CubicSpline(places[known], values[first][known])
    return np.asarray(curve(np.clip(axis * (1.0 + slip), places[0], places[-1])), np.float64)
