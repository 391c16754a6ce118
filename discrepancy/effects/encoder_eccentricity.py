"""An encoder disc off its shaft's centre.

    error = c1 cos(theta) + s1 sin(theta) + c2 cos(2 theta) + s2 sin(2 theta), theta the output angle

An eccentricity eps on a graduation of diameter D gives 2 eps/D at order 1.

Source: encoder data sheets; 5 um on 50 mm: 20 to 40 arcsec.
"""

from collections.abc import Callable

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude

PER = "mounting"
EFFECT = Effect(
    22, "encoder eccentricity", "c1 cos + s1 sin (theta), c2 cos + s2 sin (2 theta)", "2 eps/D; 5 um on 50 mm: 40 arcsec",
    "orders 1 and 2 of the output, locked to the encoder; independent of load, speed, temperature and time",
    tuple(amplitude(f"encoder_{part}{order}", "rad", f"{part} part of order {order}", 2e-5, -1e-2, 1e-2)
          for order in (1, 2) for part in ("cos", "sin")),
    signals=("transmission_error",),
)  # fmt: skip


def change(values: Floats, record: Record, at: Callable[[str], float], size: float) -> Floats:
    if record.quantity != "transmission_error" or "angle" not in record.axes:
        return values
    angle = np.asarray(record.axes["angle"])
    for order in (1, 2):
        values = values + at(f"encoder_cos{order}") * np.cos(order * angle) + at(f"encoder_sin{order}") * np.sin(order * angle)
    return values
