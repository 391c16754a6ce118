"""Contacts that starve after a time: the grease has left them, and no film comes back.

    k = k_0 [1 + a S(t)],  S = 1/[1 + exp(-(t - t_s)/w)]

t is the operating time since the grease was filled (``grease_change`` of debris abrasion fills it anew), t_s
the time at which half of it has happened, w how long it takes (a tenth to nine tenths: 4.4 w).  Grease that ages
(``grease_ageing``) makes wear grow from the first hour on and ever more slowly.

Source: grease life as an event after a time, 1,000 to 10,000 h (Lugt, Grease Lubrication in Rolling Bearings, 2013);
wear 3 to 100 times after it.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

HOUR = 3600.0
EFFECT = Effect(
    0, "starvation after a time",
    "k = k_0 [1 + a/(1 + exp(-(t - t_s)/w))]",
    "Lugt 2013; t_s 1,000 to 10,000 h, a 2 to 100",
    "wear as ever for some time, then a bend to a steeper line; put off by a change of grease",
    (
        amplitude("starvation_growth", "1", "a: growth of the wear coefficient once contacts starve", 2.0, 0.0, 200.0, sign=1),
        shape("starvation_onset", "s", "t_s: time at which half of the growth is there", 3000 * HOUR, 10 * HOUR, 1e6 * HOUR,
              "assumed: 1,000 to 10,000 h", grid=(500 * HOUR, 1500 * HOUR, 4000 * HOUR)),
        shape("starvation_width", "s", "w: how long starvation takes to come", 200 * HOUR, HOUR, 1e5 * HOUR, "assumed: some weeks", grid=(200 * HOUR,)),
    ),
    signals=WEAR,
)  # fmt: skip


@kernel
def prepare(r):
    if r.starvation_growth != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if r.starvation_growth == 0.0:
        return 1.0
    age = r.operating_time
    if r.grease_change > 0.0:
        age -= r.grease_change * math.floor(age / r.grease_change)
    # Far before the onset the exponential would overflow.
    return 1.0 + r.starvation_growth / (1.0 + math.exp(min(700.0, (r.starvation_onset - age) / r.starvation_width)))
