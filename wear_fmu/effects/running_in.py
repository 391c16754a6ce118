"""Running-in: new surfaces wear faster until their peaks are gone.

    k(s) = k_ss [1 + (r - 1) exp(-s/s_0)]

s is the turning of the cranks since the parts were new, not time; s_0 is given as the time
that it takes at rated speed.  On all surfaces, whatever their wear law.

Source: form fitted to pin-on-disc tests (BX-40E document); r 3 to 10, 50 to 500 h.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel

HOUR = 3600.0
WEAR = ("wear_profile", "wear_depth", "mass_loss", "lost_motion", "pin_on_disc", "debris")
EFFECT = Effect(
    1, "running-in",
    "k(s) = k_ss [1 + (r - 1) exp(-s/s_0)]",
    "BX-40E document; r 3 to 10, 50 to 500 h at rated speed",
    "wear rate falls monotonically, once only, with revolutions and not with time; starts anew after parts are exchanged",
    (
        amplitude("running_in_excess", "1", "r - 1: wear coefficient when new over run in, less 1", 2.0, -0.95, 50.0, sign=1),
        shape("running_in_time", "s", "time that s_0 takes at run_in_crank_speed", 200 * HOUR, HOUR, 5000 * HOUR,
              "assumed: 50 to 500 h", grid=(50 * HOUR, 200 * HOUR, 600 * HOUR)),
    ),
    signals=WEAR,
)


@kernel
def prepare(r):
    if r.running_in_excess != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if r.running_in_excess == 0.0:
        return 1.0
    return 1.0 + r.running_in_excess * math.exp(-r.crank_travel / (r.running_in_time * r.run_in_crank_speed))
