"""Wear that grows faster than the load.

    k = k_0 (q/q_0)^m, so that depth ~ q^(1 + m)

Source: m = 0 (Archard) to 1.219 (Janakiraman, Li and Kahraman 2014); fits of pin-on-disc tests.
"""

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

EFFECT = Effect(
    16, "load-dependent wear exponent",
    "k = k_0 (q/q_0)^m",
    "Archard 0, Janakiraman 1.219",
    "wear at two loads; the shape of the worn profile follows the pressure more sharply",
    (amplitude("load_exponent_added", "1", "m: exponent beyond that of the wear law", 0.3, -1.5, 3.0),),
    signals=WEAR,
)


@kernel
def prepare(r):
    if r.load_exponent_added != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if r.load_exponent_added == 0.0:
        return 1.0
    return (line_load / r.reference_line_load) ** r.load_exponent_added
