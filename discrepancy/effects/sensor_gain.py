"""A sensor with a wrong slope: value (1 + g).

Source: data sheets; a percent or so.
"""

from collections.abc import Callable

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude

PER = "quantity"
EFFECT = Effect(
    0, "sensor gain", "value (1 + g)", "data sheets", "in proportion to the signal, whatever the condition",
    (amplitude("sensor_gain", "1", "relative error of the slope", 0.01, -0.9, 5.0),),
)


def change(values: Floats, record: Record, at: Callable[[str], float], size: float) -> Floats:
    return values * (1.0 + at("sensor_gain"))
