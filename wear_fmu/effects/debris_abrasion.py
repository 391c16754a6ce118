"""Debris in the grease abrades: wear feeds on what it has worn off.

    k = k_0 (1 + g c/c_0),  dc/dt = rho dV/dt/m_grease - c/tau_c,  c_0 = 0.1 % iron

A change of grease (every ``grease_change`` hours, 0: never) sets c to 0.

Source: iron in grease of worn reducers 0.01 to 1 %; gain 1 to 10.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from fmu_src.variables import Variable
from wear_fmu.effects.running_in import WEAR

HOUR = 3600.0
STEEL = 7850.0
EFFECT = Effect(
    2, "debris abrasion",
    "k = k_0 (1 + g c/0.1 %), dc/dt = rho dV/dt/m - c/tau_c",
    "iron in grease 0.01 to 1 %, gain 1 to 10",
    "wear accelerates late (positive curvature of depth over time) and drops when the grease is changed",
    (
        amplitude("debris_gain", "1", "g: growth of the wear coefficient at 0.1 % of iron", 1.0, 0.0, 100.0, sign=1),
        shape("grease_mass", "kg", "grease in the reducer", 0.1, 1e-3, 10.0, "assumed: RV-20E", held=True),
        shape("debris_settling", "s", "time constant tau_c with which debris settles", 1e4 * HOUR, HOUR, 1e6 * HOUR, "assumed: slow", held=True),
        shape("grease_change", "s", "time between changes of the grease; 0: never", 0.0, 0.0, 1e6 * HOUR, "assumed: never", display="h", held=True),
    ),
    states=(
        Variable("debris", "state", "1", "iron in the grease, share of mass"),
        Variable("debris_volume", "state", "m^3", "volume worn off when it was last looked at"),
    ),
    signals=WEAR,
)


@kernel
def prepare(r):
    if r.debris_gain != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    return 1.0 + r.debris_gain * r.debris / 1e-3


@kernel
def advance(r, duration):
    volume = r.flank_volume + r.pin_volume + r.inner_race_volume + r.outer_race_volume
    r.debris += STEEL * (volume - r.debris_volume) / r.grease_mass
    r.debris_volume = volume
    r.debris *= math.exp(-duration / r.debris_settling)
    if r.grease_change > 0.0:
        before = math.floor((r.operating_time - duration) / r.grease_change)
        if math.floor(r.operating_time / r.grease_change) > before:
            r.debris = 0.0
