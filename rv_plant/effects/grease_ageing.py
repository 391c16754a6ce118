"""Grease that ages: base oil leaves, viscosity and supply change with the hours run.

    nu(t)/nu(0) = exp(g t/t_a)

In the plant: churning follows the viscosity.  In the wear unit: wear grows as contacts starve.

Source: grease life of reducers, 2000 to 20000 h between changes.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel

HOUR = 3600.0
EFFECT = Effect(
    24, "grease ageing",
    "nu(t) = nu_0 exp(g t/t_a)",
    "grease life 2,000 to 20,000 h",
    "slow change of friction, temperature and film with the hours run; restored when grease is changed",
    (
        amplitude("grease_ageing", "1", "g: log of the viscosity's change in the time t_a", 0.3, -5.0, 5.0),
        shape("grease_life", "s", "t_a: time in which the grease ages", 10_000 * HOUR, 10 * HOUR, 1e6 * HOUR, "assumed: 2,000 to 20,000 h", held=True),
        shape("grease_age", "s", "hours since the grease was filled", 0.0, 0.0, 1e6 * HOUR, "new grease", display="h", held=True),
    ),
    signals=("input_torque", "no_load_torque", "efficiency", "temperature"),
    also_in="wear_fmu",
)


@kernel
def before(r):
    r.grease_thinning *= math.exp(r.grease_ageing * r.grease_age / r.grease_life)
