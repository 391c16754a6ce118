"""Wear activated by temperature: chemistry of the lubricant's films, oxidation, softening.

    k = k_0 exp[-E/R (1/T - 1/T_0)]

T is the temperature of the contacts.  Between 20 and 60 C some 20 kJ/mol raise the wear coefficient 2.7 times.

Source: Arrhenius; oxidational wear (Quinn 1983) and decay of additive films, 10 to 100 kJ/mol.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

GAS_CONSTANT = 8.314462618
EFFECT = Effect(
    0, "wear over temperature (Arrhenius)",
    "k = k_0 exp[-E/R (1/T - 1/T_0)]",
    "Arrhenius; oxidational wear after Quinn 1983, 10 to 100 kJ/mol",
    "wear per turn grows with the temperature by the same factor at every speed and load, which a film's does not",
    (
        amplitude("activation_energy", "J/mol", "E: energy that activates wear (negative: less wear when warm)", 1e4, -1e5, 2e5),
        shape("activation_reference", "K", "T_0: temperature at which the coefficient is that of the wear law", 293.15, 200.0, 500.0,
              "assumed: room temperature, as the wear law's", held=True),
    ),
    signals=WEAR,
)  # fmt: skip


@kernel
def prepare(r):
    if r.activation_energy != 0.0:
        r.effects_on += 1


@kernel
def factor(r, surface, line_load, radius, speed, depth):
    if r.activation_energy == 0.0:
        return 1.0
    return math.exp(-r.activation_energy / GAS_CONSTANT * (1.0 / r.temperature - 1.0 / r.activation_reference))
