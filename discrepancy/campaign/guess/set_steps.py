"""By how much at least numbers differ that somebody set: what differs by less was meant to be the same and was measured."""

from collections.abc import Sequence

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.units import conversion

# Nobody sets steps that are smaller (assumed).
TEMPERATURE_STEP = 1.0  # K
SHARE_STEP = 0.01  # of a speed or load
# What varies by less in a column is held (assumed).
HELD_WITHIN = 0.05
# The temperature last: a rig drifts with the hours, while speeds and loads are held.
MEASURED = ("input_speed", "output_speed", "load_torque", "temperature")


def step_at(number: float, key: str, unit: str) -> float:
    """The smallest difference that is set on purpose, in the number's unit."""
    return TEMPERATURE_STEP / conversion(unit, "K")[0] if key == "temperature" else SHARE_STEP * abs(number)


def spans_no_step(numbers: Sequence[float], key: str, unit: str) -> bool:
    # Without the last digits: 26.1 - 25.1 is a whole step.
    return round(max(numbers) - min(numbers), 9) < round(step_at(max(numbers, key=abs), key, unit), 9)


def held_level(column: Floats) -> float:
    """The number that a column holds throughout, but for a few rows in a hundred; NaN where it does not."""
    low, middle, high = np.nanpercentile(column, (5.0, 50.0, 95.0)) if np.isfinite(column).any() else (np.nan,) * 3
    return float(middle) if high - low <= HELD_WITHIN * abs(middle) else np.nan
