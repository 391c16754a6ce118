"""A sensor that does not read zero at zero: value + b.

Source: data sheets; a percent or so of the range.
"""

from collections.abc import Callable

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude

PER = "quantity"
# Relative to the size of what is measured.
EFFECT = Effect(
    0, "sensor offset", "value + b", "data sheets", "the same at every condition, whatever is measured",
    (amplitude("sensor_offset", "1", "offset over the signal's mean size", 0.01, -1.0, 1.0),),
)


def change(values: Floats, record: Record, at: Callable[[str], float], size: float) -> Floats:
    return values + at("sensor_offset") * size
