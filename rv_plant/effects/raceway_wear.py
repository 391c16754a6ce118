"""Raceways that are already worn: a smooth hollow on the loaded side of either race.

    inner: depth = D_i max(0, -sin theta)^2, theta from the eccentric's direction
    outer: depth = D_o max(0, -sin theta)^2, theta from the hole's outward radial

The side is that of positive load: discs push the cranks forwards, so that eccentric and hole touch behind,
at 270 degrees.  It stands for wear before the campaign, or where no wear unit is connected.

Source: shape of the wear unit's own result (Archard, Janakiraman); 0 to 15 um.
"""

import math

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel
from rv_plant.poses import disc_offset

UM = 1e-6
EFFECT = Effect(
    11, "raceway wear",
    "depth = D max(0, -sin theta)^2 on inner and outer races",
    "the wear unit's own result; 0 to 15 um",
    "lost motion and mean lag grow, on one sign of torque; order 80 hardly grows or falls (clearance raises it)",
    (
        amplitude("inner_race_worn", "m", "depth on the cranks' eccentrics", 2 * UM, 0.0, 100 * UM, sign=1, group="inner"),
        amplitude("outer_race_worn", "m", "depth in the discs' holes", 2 * UM, 0.0, 100 * UM, sign=1, group="outer"),
    ),
    signals=("transmission_error", "lost_motion", "hysteresis", "vibration"),
)


@kernel
def hollow(angle):
    s = math.sin(angle)
    return s * s if s < 0.0 else 0.0


@kernel
def before(r):
    if r.inner_race_worn == 0.0 and r.outer_race_worn == 0.0:
        return
    discs, cranks, rollers = r.roller_gap_now.shape
    lobes = r.lobe_gap_added.shape[1]
    turn = 2.0 * math.pi
    for d in range(discs):
        for c in range(cranks):
            ahead = (1.0 + lobes) * r.ideal_output + turn * c / cranks - disc_offset(r, d)
            for k in range(rollers):
                outer = r.cage + turn * k / rollers
                gap = r.inner_race_worn * hollow(outer + ahead) + r.outer_race_worn * hollow(outer)
                r.roller_gap_now[d, c, k] += gap
