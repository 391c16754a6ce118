"""Rollers that skid when they are hardly loaded: slip and wear of the raceways.

    slip ratio + s,  s = s_0 exp(-F/F_s)

F is the mean load of a bearing.  The plant's half slows the cage.

Source: Harris, Rolling Bearing Analysis; slip ratio 0.01 to 0.2.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from fmu_src.variables import Variable
from wear_fmu.effects.running_in import WEAR

EFFECT = Effect(
    19, "roller skidding",
    "slip ratio + s_0 exp(-F/F_s)",
    "Harris, Rolling Bearing Analysis; slip ratio 0.01 to 0.2",
    "cage order below 17.4; raceways wear although the load is low",
    (
        amplitude("skid_share", "1", "s_0: share of rolling lost at no load", 0.05, 0.0, 0.9, sign=1),
        shape("skid_load", "N", "F_s: load of a bearing at which skidding has fallen to 37 %", 500.0, 1.0, 1e6, "assumed",
              grid=(200.0, 500.0, 2000.0)),
    ),
    states=(Variable("skid", "state", "1", "slip by skidding at present"),),
    signals=("cage_speed", *WEAR),
    also_in="rv_plant",
)


@kernel
def prepare(r):
    if r.skid_share != 0.0:
        r.effects_on += 1


@kernel
def advance(r, duration):
    r.skid = 0.0
    if r.skid_share == 0.0:
        return
    discs, cranks, rollers = r.roller_mean.shape
    total = 0.0
    for d in range(discs):
        for c in range(cranks):
            for k in range(rollers):
                total += r.roller_mean[d, c, k]
    r.skid = r.skid_share * math.exp(-total / (discs * cranks) / r.skid_load)


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if surface == 0:
        return 1.0
    slip = r.slip_ratio_inner if surface == 1 else r.slip_ratio_outer
    return 1.0 + r.skid / slip if slip > 0.0 else 1.0
