"""The catalogue's effects as other textbooks write them."""

from benchmarks.blind_trial.generator.laws.chain import ClockFault, DriftFault, Encoder, GainFault, OffsetFault
from benchmarks.blind_trial.generator.laws.drive import Flange, PlanetRunout, Skidding, TeethPlay, Unbalance
from benchmarks.blind_trial.generator.laws.friction import DahlLoop, Drag, DryFriction
from benchmarks.blind_trial.generator.laws.parts import Clearance, DiscTeeth, Hole, Lobe, PinRing, Relief, Warming
from benchmarks.blind_trial.generator.laws.races import Pit, RaceHollow
from benchmarks.blind_trial.generator.laws.rig import SoftCoupling
from benchmarks.blind_trial.generator.laws.supports import AskewRing, HangingWeight, PlayTurn, SlippingSeat, SoftSeat
from benchmarks.blind_trial.generator.laws.wearing import (
    Ageing,
    Debris,
    DryRun,
    Film,
    LoadPower,
    MildWear,
    OldGrease,
    RunIn,
    SoftCore,
    StuckPins,
    TenKelvin,
    Tilt,
)
from benchmarks.blind_trial.generator.truth import Truth

CATALOGUE: tuple[type[Truth], ...] = (
    Clearance, RaceHollow, PinRing, DiscTeeth, Relief, Lobe, Hole, Flange, PlanetRunout, TeethPlay, Warming, DryFriction, DahlLoop,
    Drag, OldGrease, Unbalance, Skidding, Pit, RunIn, Debris, Film, LoadPower, SoftCore, Tilt, StuckPins, Encoder, GainFault,
    OffsetFault, DriftFault, ClockFault, SoftSeat, AskewRing, HangingWeight, PlayTurn, SlippingSeat, SoftCoupling, TenKelvin,
    MildWear, DryRun, Ageing,
)  # fmt: skip
