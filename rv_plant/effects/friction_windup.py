"""Friction that winds the drive up while it turns.

    the output falls back by  phi = w T exp(-n/n_w) against the motion, T the load torque, n the input's speed

What friction in mesh and bearings holds in proportion to the load, what stands before it in the way of the power must carry besides: springs c
between yield by c mu T more, so that w = c mu.  At creeping speed friction is that of the boundary, with speed a film forms and it falls
(Stribeck).  With the input held nothing turns, and there is none of it.  A part that does not fall with speed looks as
more compliance, one that does not depend on the load as play of the first stage: only loops with the input held tell.

Source: Stribeck 1902, Armstrong-Helouvry 1991 (fall of friction with speed); springs in series; 1 to 20 % of a drive's compliance assumed.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from rv_plant.gear_stage import fall_back

EFFECT = Effect(
    0, "friction that winds up",
    "phi = w T exp(-n/n_w), against the motion",
    "Stribeck 1902, Armstrong-Helouvry 1991; springs in series, 1 to 20 % of a drive's compliance assumed",
    "mean transmission error, over the torque, steeper at creeping speed than at speed, both ways; nothing with the input held",
    (
        amplitude("friction_windup", "rad/(N.m)", "w: turning back per load torque that friction brings at creeping speed", 1e-8, 0.0, 1e-3, sign=1,
                  source="none, as in both sources"),
        shape("friction_windup_speed", "rad/s", "n_w: speed of the input with which it falls", 60.0, 0.1, 1e4, "assumed: some 600 rpm", grid=(60.0,)),
    ),
    signals=("transmission_error", "input_torque"),
)  # fmt: skip


@kernel
def before(r):
    if r.friction_windup == 0.0 or r.input_speed == 0.0:
        return
    # A load that drives is held back by friction all the same.
    sense = 1.0 if r.input_speed > 0.0 else -1.0
    fall_back(r, sense * r.friction_windup * abs(r.load_torque) * math.exp(-abs(r.input_speed) / r.friction_windup_speed), 0.0)
