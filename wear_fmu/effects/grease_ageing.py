"""Grease that ages: contacts starve as the base oil leaves.

    k = k_0 [1 + a (1 - exp(-t/t_a))]

t is the operating time since the grease was filled (``grease_change`` of debris abrasion fills it anew).

Source: grease life of reducers, 2000 to 20000 h between changes.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

HOUR = 3600.0
EFFECT = Effect(
    24, "grease ageing",
    "k = k_0 [1 + a (1 - exp(-t/t_a))]",
    "grease life 2,000 to 20,000 h",
    "slow growth of wear with the hours; restored when grease is changed",
    (
        amplitude("grease_starvation", "1", "a: growth of the wear coefficient with old grease", 1.0, -0.95, 50.0, sign=1),
        shape("grease_life", "s", "t_a: time in which the grease ages", 10_000 * HOUR, 10 * HOUR, 1e6 * HOUR, "assumed: 2,000 to 20,000 h",
              grid=(2000 * HOUR, 10_000 * HOUR)),
    ),
    signals=WEAR,
    also_in="rv_plant",
)


@kernel
def prepare(r):
    if r.grease_starvation != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if r.grease_starvation == 0.0:
        return 1.0
    age = r.operating_time
    if r.grease_change > 0.0:
        age -= r.grease_change * math.floor(age / r.grease_change)
    return 1.0 + r.grease_starvation * -math.expm1(-age / r.grease_life)
