"""Case-hardened surfaces get softer with depth.

    H(z) = H_s [1 - b (1 - exp(-(z/d)^2))],  k = k_0 H_s/H(z)

b = 1 - H_core/H_surface.

Source: carburised steels, 7.4 GPa at the surface, 4 GPa in the core, case 0.5 to 1 mm;
retained austenite in the top 5 to 20 um.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

UM = 1e-6
EFFECT = Effect(
    17, "case-hardness gradient",
    "H(z) = H_s [1 - b (1 - exp(-(z/d)^2))]",
    "carburised steels: 7.4 to 4 GPa over 0.5 to 1 mm",
    "wear accelerates with depth and not with time; a change of grease makes no difference",
    (
        amplitude("core_softness", "1", "b: 1 - hardness of the core over that of the surface", 0.3, -2.0, 0.95),
        shape("case_depth", "m", "d: depth of the hard case", 20 * UM, 0.1 * UM, 5000 * UM, "assumed",
              grid=(2 * UM, 10 * UM, 50 * UM)),
    ),
    signals=WEAR,
)


@kernel
def prepare(r):
    if r.core_softness != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if r.core_softness == 0.0:
        return 1.0
    share = depth / r.case_depth
    return 1.0 / (1.0 - r.core_softness * (1.0 - math.exp(-share * share)))
