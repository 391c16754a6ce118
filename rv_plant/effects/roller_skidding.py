"""Rollers that skid when they are hardly loaded: the cage lags behind pure rolling.

    omega_cage = (1 - s) omega_rolling,  s = s_0 exp(-F/F_s)

F is the mean load of a bearing.  The wear unit's half raises the slip ratio.

Source: skidding of lightly loaded rolling bearings (Harris, Rolling Bearing Analysis); slip ratio 0.01 to 0.2.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel

EFFECT = Effect(
    19, "roller skidding",
    "omega_cage = (1 - s) omega_rolling, slip ratio + s, s = s_0 exp(-F/F_s)",
    "Harris, Rolling Bearing Analysis; slip ratio 0.01 to 0.2",
    "cage order below 17.4; raceways wear although the load is low",
    (
        amplitude("skid_share", "1", "s_0: share of rolling lost at no load", 0.05, 0.0, 0.9, sign=1),
        shape("skid_load", "N", "F_s: load of a bearing at which skidding has fallen to 37 %", 500.0, 1.0, 1e6, "assumed",
              grid=(200.0, 500.0, 2000.0)),
    ),
    signals=("cage_speed", "wear_profile", "wear_depth", "mass_loss"),
    also_in="wear_fmu",
)


@kernel
def after(r):
    if r.skid_share == 0.0:
        return
    discs, cranks, rollers = r.roller_force_now.shape
    total = 0.0
    for d in range(discs):
        for c in range(cranks):
            for k in range(rollers):
                total += r.roller_force_now[d, c, k]
    r.cage_share *= 1.0 - r.skid_share * math.exp(-total / (discs * cranks) / r.skid_load)
