"""A torque that comes and goes k times a turn of the output, in proportion to the load, and what a torsional resonance makes of it.

    y = x + T Re[(c - i s) G exp(i k theta)],  G = 1/(1 - r^2 + 2 i z r),  r = k n/f_0

x is the transmission error of the reducer, T the load torque, n the output's turns a second, f_0 and z frequency and damping ratio of
the load on the drive's spring.  Slowly the spring yields by T c and T s; next to f_0 it swings up to 1/(2 z) times as far.  Unlike a
``torsional_resonance`` it lifts one order alone: errors of parts need not excite a rig whose input follows them.

Source: forced oscillator (Den Hartog 1956); ripple of 0.1 to 1 % of the torque, z 0.005 to 0.05 assumed.
"""

import math
from collections.abc import Callable

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude, shape

PER = "campaign"
EFFECT = Effect(
    0, "torque ripple at a resonance", "y = x + T Re[(c - i s) G exp(i k theta)], G = 1/(1 - r^2 + 2 i z r), r = k n/f_0",
    "forced oscillator, Den Hartog 1956; 0.1 to 1 % of the torque, damping ratio 0.005 to 0.05 assumed",
    "one order of the transmission error, in proportion to the load, large where its frequency is that of the resonance and turned round beyond",
    (
        *(amplitude(f"ripple_{part}", "rad/(N.m)", f"slow turning per load torque, {part} of its order", 1e-9, -1e-5, 1e-5) for part in ("cos", "sin")),
        shape("ripple_order", "1", "k: its order of the output's turn", 156.0, 1.0, 1e4,
              "assumed: four times a turn of the cranks that have 39 to one of the output", held=True),
        shape("ripple_frequency", "Hz", "f_0: frequency of the load on the drive's spring", 54.0, 0.5, 5000.0, "assumed: 10 to 100 Hz",
              grid=(28.0, 42.0, 54.0, 63.0, 95.0)),
        shape("ripple_damping", "1", "z: its damping ratio", 0.01, 1e-3, 2.0, "assumed: 0.005 to 0.05", held=True),
    ),
    signals=("transmission_error",),
)  # fmt: skip


def change(values: Floats, record: Record, at: Callable[[str], float], size: float) -> Floats:
    if record.quantity != "transmission_error" or "angle" not in record.axes or at("ripple_cos") == at("ripple_sin") == 0.0:
        return values
    order, damping = at("ripple_order"), at("ripple_damping")
    sense = record.factors.get("direction", 1.0)
    r = order * sense * at("output_speed") / (2.0 * math.pi * at("ripple_frequency"))
    answer = complex(at("ripple_cos"), -at("ripple_sin")) / complex(1.0 - r * r, 2.0 * damping * r)
    wave = np.exp(1j * order * np.asarray(record.axes["angle"], np.float64))
    changed: Floats = values + record.factors.get("load", 0.0) * (answer * wave).real
    return changed
