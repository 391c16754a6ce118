"""Play of output pins in the holes of the disc beyond the reducer file's.

    hole radius = roller + eccentricity + clearance + p

The output can turn by 2 p/R freely, R the radius of the pins' circle (a little more between the pins).

Source: geometry; printed parts 0.05 to 0.5 mm.
"""

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel

UM = 1e-6
EFFECT = Effect(
    0, "output play",
    "hole radius = roller + eccentricity + clearance + p",
    "geometry; 5 to 50 um in steel, 50 to 500 um in printed parts",
    "lost motion 2 p/R at any torque; a loop with a step of that height at no torque, the same at every load",
    (amplitude("output_play", "m", "p: radial clearance of the output pins beyond the file's", 100 * UM, 0.0, 1e-3, sign=1, needs=("output_pins", 1)),),
    signals=("hysteresis", "lost_motion", "transmission_error"),
    needs="output pins",
)


@kernel
def prepare(r):
    r.output_gap_added += r.output_play
