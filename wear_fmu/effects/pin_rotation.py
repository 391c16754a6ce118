"""Pins that do not turn all the time: part of their wear stays where discs touch them.

    worn area: share phi in two bands at the turning points of the contact, the rest all round

Source: stick and slide of a pin in its groove (mu_disc R against mu_groove R); 0 to 100 %.
"""

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel
from wear_fmu.effects.running_in import WEAR

EFFECT = Effect(
    20, "pin rotation in its groove",
    "share phi of the pin's wear stays in place, 1 - phi goes round",
    "stick and slide in the groove; 0 to 100 %",
    "wear print of the pins: even all round, or two bands at +-48/44 degrees",
    (amplitude("pin_standing_share", "1", "phi: share of time that a turning pin stands", 0.3, 0.0, 1.0, sign=1),),
    signals=WEAR,
)


@kernel
def prepare(r):
    if r.pins == 0:
        r.standing += r.pin_standing_share
