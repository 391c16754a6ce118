"""Laws that the catalogue does not have."""

from benchmarks.blind_trial.generator.outside.angle import (
    Beating,
    Belt,
    Chip,
    Cogging,
    FlyingArm,
    LoadedTurn,
    OddPins,
    SevenScrews,
    StickSlip,
    ThreeLobes,
    WarmRipple,
)
from benchmarks.blind_trial.generator.outside.drive import (
    Bump,
    FastCage,
    HeldCage,
    Humidity,
    Resonance,
    Rubbing,
    Sidebands,
    Ventilation,
    WhippingBelt,
)
from benchmarks.blind_trial.generator.outside.loops import Creep, Cubic, Cycling, LiftingFoot, SlippingFlange
from benchmarks.blind_trial.generator.outside.wear import Accident, Chatter, Overheating, Shifts
from benchmarks.blind_trial.generator.truth import Truth

# Those that no trial before the final one had.
NEW: tuple[type[Truth], ...] = (
    Chip, SevenScrews, FlyingArm, Creep, SlippingFlange, Rubbing, WhippingBelt, Sidebands, HeldCage, Overheating, Shifts,
)  # fmt: skip
OUTSIDE: tuple[type[Truth], ...] = (
    Cogging, Belt, ThreeLobes, StickSlip, LoadedTurn, WarmRipple, Beating, OddPins, Cubic, LiftingFoot, Cycling, Ventilation, Bump,
    Humidity, Chatter, Accident, Resonance, FastCage, *NEW,
)  # fmt: skip
