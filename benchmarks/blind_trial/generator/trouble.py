"""What is wrong with a campaign that hides nothing: a base that is a little off, or noise that is no textbook's."""

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from benchmarks.blind_trial.generator.designs import Design, Series
from benchmarks.blind_trial.generator.laws.shared import WEAR
from benchmarks.blind_trial.generator.reducer import QUICK, ROLLER_STIFFNESS, WHOLE, WHOLE_STEP, Setting
from benchmarks.blind_trial.generator.truth import Bench, Truth
from fmu_src.arrays import Floats
from wear_fmu.variables import Resolution

# Base errors: of wear after 10,000 h, of bins and cycle, of a contact's stiffness; then noise.
WORN, COARSE, STIFF = "worn base", "coarse base", "stiff base"
TAILS, DRIFT, UNEVEN = "heavy tails", "drift", "uneven sampling"
BASES, NOISES = (WORN, COARSE, STIFF), (TAILS, DRIFT, UNEVEN)
# Blocks that show each of them.
BLOCKS: Mapping[str, tuple[tuple[str, ...], ...]] = {
    WORN: (("old", "prints"), ("old",)), COARSE: (("te",), ("loops",), ("old", "prints")), STIFF: (("te",), ("loops",), ("te", "loops")),
    TAILS: (("te",), ("loops",), ("torque",), ("cage",)), DRIFT: (("te",), ("loops",)), UNEVEN: (("te",),),
}  # fmt: skip
COARSER = Resolution(flank=36, pin=30, raceway=72)
# By how much a base is off: what solvers of the same equations differ by on a wear profile, and a stiffness that nobody measured.
OFF = (0.02, 0.06)


class SlightlyOff(Truth):
    """Wear of the base that is off by a few percent: all of it by one share, along a profile by another."""

    name, quantities, typical = "wear of the base a few percent off", WEAR, 0.04

    def draw(self, rng: np.random.Generator) -> None:
        self.a = float(rng.uniform(*OFF) * rng.choice([-1.0, 1.0]))
        self.along = float(rng.uniform(*OFF))
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        if series.quantity != "wear_profile":
            return y * (1.0 + self.a)
        return y * (1.0 + self.a + self.along * np.cos(2.0 * series.axes["depth_angle"] + self.phase))


def bench_of(trouble: str, parameters: Mapping[str, float], rng: np.random.Generator, base: str) -> tuple[Bench, dict[str, float]]:
    """The true reducer as it is measured, of the ``base`` model but for what is wrong, and its parameters."""
    found = dict(parameters)
    if trouble == STIFF:
        found["roller_stiffness"] = float(ROLLER_STIFFNESS[base] * (1.0 + rng.uniform(*OFF) * rng.choice([-1.0, 1.0])))
    if trouble == COARSE:
        coarse = Bench(found, QUICK, COARSER, base)
        # It is surfaces that are coarse: a loop is measured as it is.
        coarse.plain.torque_step = WHOLE_STEP
        return coarse, found
    return Bench(found, WHOLE, name=base), found


def spoil(trouble: str, design: Design) -> None:
    """Puts its noise into a design."""
    if trouble == UNEVEN:
        design.uneven = True
    for s in design.series:
        if trouble == TAILS:
            s.noise = replace(s.noise, tail=3.0)
        elif trouble == DRIFT:
            s.noise = replace(s.noise, drift=2.5)
