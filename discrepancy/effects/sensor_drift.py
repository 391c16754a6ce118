"""A sensor whose zero wanders in the course of a run: value + d (i/n - 1/2), i the sample's number.

Source: warming amplifiers.
"""

from collections.abc import Callable

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude

PER = "quantity"
EFFECT = Effect(
    0, "sensor drift", "value + d (i/n - 1/2)", "warming amplifiers", "a slope along each run; not reversible, no angle order",
    (amplitude("sensor_drift", "1", "drift in a run over the signal's mean size", 0.01, -5.0, 5.0),),
)


def change(values: Floats, record: Record, at: Callable[[str], float], size: float) -> Floats:
    n = len(values)
    return values + at("sensor_drift") * size * ((np.arange(n) + 0.5) / n - 0.5) if n > 1 else values
