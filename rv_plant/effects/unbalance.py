"""Unbalance of the cranks with their discs: a force that turns with the cranks.

    F = U omega_crank^2, U = m e of what the two discs leave unbalanced

Source: m e omega^2; 0.387 kg x 0.9 mm at 67.5 rad/s is 1.6 N.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel

EFFECT = Effect(
    21, "unbalance",
    "F = U omega^2, turning with the cranks",
    "m e omega^2",
    "vibration of the housing at order 39 (cranks in the housing), in proportion to the square of the speed and"
    " independent of the load",
    (
        amplitude("unbalance", "kg.m", "mass times eccentricity that is not balanced", 1e-4, 0.0, 1.0, sign=1),
        shape("unbalance_angle", "rad", "direction of the unbalance, from the eccentric direction of disc 1", 0.0, -20.0, 20.0, "assumed",
              grid=(0.0, 1.5708, 3.1416, 4.7124)),
    ),
    signals=("vibration",),
)


@kernel
def after(r):
    force = r.unbalance * r.crank_speed * r.crank_speed
    r.housing_force_x += force * math.cos(r.crank_angle + r.unbalance_angle)
    r.housing_force_y += force * math.sin(r.crank_angle + r.unbalance_angle)
