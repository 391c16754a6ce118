"""An encoder disc or ring that its screws pull out of round.

    error = c cos(m theta) + s sin(m theta), theta the output angle, m the number of screws (3 unless set)

A ring that is held in m places bulges m times round; where it bulges the graduation stands apart, and one reading head
reads that as an angle.

Source: geometry; encoder manuals on mounting, some arcsec.
"""

from collections.abc import Callable

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude, shape

PER = "mounting"
EFFECT = Effect(
    0, "encoder pulled out of round", "c cos(m theta) + s sin(m theta)", "geometry; some arcsec at the number of screws, 3 assumed",
    "one order of the output, locked to the encoder; independent of load, speed, temperature and time",
    (
        *(amplitude(f"distortion_{part}", "rad", f"{part} part", 1e-5, -1e-2, 1e-2) for part in ("cos", "sin")),
        shape("distortion_order", "1", "m: screws round the encoder", 3.0, 1.0, 64.0, "assumed", held=True),
    ),
    signals=("transmission_error",),
)  # fmt: skip


def change(values: Floats, record: Record, at: Callable[[str], float], size: float) -> Floats:
    if record.quantity != "transmission_error" or "angle" not in record.axes:
        return values
    angle = at("distortion_order") * np.asarray(record.axes["angle"])
    return values + at("distortion_cos") * np.cos(angle) + at("distortion_sin") * np.sin(angle)
