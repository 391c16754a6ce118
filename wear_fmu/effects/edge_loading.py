"""Misalignment: a tilted contact carries and wears more at one edge.

With the tilt theta over the length L and the penetration d of a line contact

    x = theta L/(2 d),  largest over mean load = 1 + 10/9 x (x < 1), (1 + 10/9) sqrt(x) beyond

d = 3.84e-5 Q^0.9/L^0.8 in mm and N (Palmgren).  Depths are those of the worse edge.

Source: Palmgren 1959.  Tilts of 10 to 60 urad wear locally up to 1.6 times as much where a roller carries
100 N, 1.1 times at 650 N; three times needs some 500 urad.
"""

import math

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

EFFECT = Effect(
    18, "edge loading and misalignment",
    "q_max/q = 1 + 10/9 theta L/(2 d), d after Palmgren",
    "Palmgren 1959; 10 to 60 urad usual, felt at light load",
    "wear print one-sided along the axis; relatively more at low load; torque nearly unchanged",
    (
        amplitude("misalignment", "rad", "theta: tilt of the discs against the pins", 2e-5, 0.0, 1e-2, sign=1),
        amplitude("roller_misalignment", "rad", "theta: tilt of the rollers against their races", 2e-5, 0.0, 1e-2, sign=1),
    ),
    signals=WEAR,
)


@kernel
def prepare(r):
    if r.misalignment != 0.0 or r.roller_misalignment != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    tilt, length = (r.misalignment, r.mesh_width) if surface == 0 else (r.roller_misalignment, r.roller_length)
    if tilt == 0.0:
        return 1.0
    penetration = 1e-3 * 3.84e-5 * (line_load * length) ** 0.9 / (1e3 * length) ** 0.8
    x = tilt * length / (2.0 * penetration)
    return 1.0 + 10.0 / 9.0 * x if x < 1.0 else (1.0 + 10.0 / 9.0) * math.sqrt(x)
