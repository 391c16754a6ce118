"""Mild wear, or none, below a threshold of pressure.

    k = k_0 [1 - a/(1 + (p/p_t)^n)],  p = sqrt(q E*/(pi R)), E* = E/(2 (1 - nu^2))

p is the largest Hertz pressure of the contact, p_t the threshold; a = 1: no wear far below it.  With n = 8, smooth
enough for a fit, three quarters of a are missing at 0.87 p_t and one quarter at 1.15 p_t.

Source: transition of mild to severe wear (Archard and Hirst 1956; Lim and Ashby 1987), 0.1 to 0.3 of the hardness.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

MPA = 1e6
EFFECT = Effect(
    0, "wear threshold of pressure",
    "k = k_0 [1 - a/(1 + (p/p_t)^n)], p Hertz",
    "Archard and Hirst 1956, Lim and Ashby 1987; p_t 0.1 to 0.3 of the hardness",
    "wear falls away below a load, and at the worn profile's edges, where the pressure is low; nothing changes far above it",
    (
        amplitude("threshold_share", "1", "a: share of wear that is missing far below the threshold", 0.5, 0.0, 1.0, sign=1),
        shape("threshold_pressure", "Pa", "p_t: pressure at which half of that share is missing", 600 * MPA, 10 * MPA, 5000 * MPA,
              "assumed: about a tenth of the hardness", grid=(400 * MPA, 600 * MPA, 900 * MPA)),
        shape("threshold_sharpness", "1", "n: how sharp the threshold is", 8.0, 1.0, 60.0, "assumed: done within a factor of 1.6", held=True),
    ),
    signals=WEAR,
)  # fmt: skip


@kernel
def prepare(r):
    if r.threshold_share != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if r.threshold_share == 0.0:
        return 1.0
    modulus = 0.5 * r.elastic_modulus / (1.0 - r.poisson_ratio * r.poisson_ratio)
    pressure = math.sqrt(line_load * modulus / (math.pi * radius))
    return 1.0 - r.threshold_share / (1.0 + (pressure / r.threshold_pressure) ** r.threshold_sharpness)
