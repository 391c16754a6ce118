"""Pin ring, or its seat, of a stiffness that varies round the circle: thin walls, bolts, a split housing.

    force of pin j on its contact   F = K (1 + c cos 2 eta_j + s sin 2 eta_j) d^n,  eta_j = 2 pi j/z_p

Each disc leans on one side of the ring, which goes round with the cranks: where the ring is soft the output falls
back further.  What two opposite discs see differs by pi, so that of a stiffness with m waves the even ones
remain, at the order m z_c.  Of four waves a quarter as much would be left as of two: many pins share the load.

Source: springs in series, in first order; oval or two-sided seats, 5 to 20 % [assumed].
"""

import math

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel


def _share(name: str, text: str):
    return amplitude(name, "1", f"stiffness round the ring, {text} part of two waves over the mean", 0.05, -0.6, 0.6)


EFFECT = Effect(
    0, "ring stiffness round the circle",
    "K_j = K (1 + c cos 2 eta_j + s sin 2 eta_j)",
    "springs in series; 5 to 20 % assumed",
    "order 78 (2 z_c) of the output in proportion to the torque, nothing without load;"
    " an oval ring has the same order whatever the load",
    (_share("ring_stiffness_cos", "cosine"), _share("ring_stiffness_sin", "sine")),
    signals=("transmission_error", "vibration", "hysteresis", "input_torque"),
)  # fmt: skip


@kernel
def prepare(r):
    for j in range(r.pin_stiffness.shape[0]):
        eta = r.pin_angle[j]
        r.pin_stiffness[j] *= 1.0 + r.ring_stiffness_cos * math.cos(2.0 * eta) + r.ring_stiffness_sin * math.sin(2.0 * eta)
