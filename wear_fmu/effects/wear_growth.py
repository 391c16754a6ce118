"""Wear coefficient that grows with the time of operation, whatever has been worn off.

    k = k_0 [1 + g (t/t_0)^p]

Beside ``debris_abrasion``, whose coefficient grows with the iron in the grease: at one load and speed both bend the
depth upwards alike, at another load iron comes in proportion to the wear and time does not; and a change
of grease takes iron away, not time.

Source: form of fits to wear tests that run to the end of life; p = 1 linear.
"""

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

HOUR = 3600.0
EFFECT = Effect(
    0, "wear coefficient growing with time",
    "k = k_0 [1 + g (t/t_0)^p]",
    "fits of wear tests to the end of life; p = 1",
    "depth over time bends upwards by the same factor at every load and speed; a change of grease makes no difference",
    (
        amplitude("wear_growth", "1", "g: growth of the wear coefficient in the time t_0", 0.5, -0.95, 100.0, sign=1),
        shape("wear_growth_time", "s", "t_0: time in which the wear coefficient grows by g", 1000 * HOUR, HOUR, 1e6 * HOUR, "by definition of g", held=True),
        shape("wear_growth_power", "1", "p: 1 in proportion to time", 1.0, 0.2, 5.0, "assumed: linear", grid=(1.0,)),
    ),
    signals=WEAR,
)  # fmt: skip


@kernel
def prepare(r):
    if r.wear_growth != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if r.wear_growth == 0.0:
        return 1.0
    return max(0.0, 1.0 + r.wear_growth * (r.operating_time / r.wear_growth_time) ** r.wear_growth_power)
