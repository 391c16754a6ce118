"""Raceways that are not whole: laws that act on the surfaces."""

import math

import numpy as np

from benchmarks.blind_trial.generator.laws.shared import BOTH, UM
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth, worn_places


class RaceHollow(Truth):
    """Hollow of Gaussian shape worn into one kind of race before the campaign."""

    name, effect, blocks, quantities = "hollow in the raceways", "raceway_wear", ("te", "loops"), BOTH
    typical, low, high = 1.0 * UM, 0.02 * UM, 12 * UM

    def draw(self, rng: np.random.Generator) -> None:
        self.inner = bool(rng.random() < 0.5)
        self.width = math.radians(rng.uniform(28.0, 40.0))

    def surfaces(self, w: np.ndarray, setting: Setting) -> None:
        race = "inner_race_wear" if self.inner else "outer_race_wear"
        bins = w[race].shape[-1]
        angle = (np.arange(bins) + 0.5) * 2.0 * math.pi / bins - worn_places()[0 if self.inner else 1]
        away = (angle + math.pi) % (2.0 * math.pi) - math.pi
        w[race][0] = self.a * np.exp(-0.5 * (away / self.width) ** 2)


class Pit(Truth):
    """A pit of parabolic section in one race."""

    name, effect, blocks, quantities = "pit in a race", "race_spall", ("vibration", "te"), ("vibration_order", "transmission_error")
    typical, low, high = 3 * UM, 0.1 * UM, 60 * UM

    def draw(self, rng: np.random.Generator) -> None:
        self.inner = bool(rng.random() < 0.5)
        self.disc, self.crank = int(rng.integers(2)), int(rng.integers(2))
        self.width = float(rng.uniform(0.12, 0.3))
        self.shift = float(rng.uniform(-0.2, 0.2))

    def surfaces(self, w: np.ndarray, setting: Setting) -> None:
        race = "inner_race_wear" if self.inner else "outer_race_wear"
        bins = w[race].shape[-1]
        angle = (np.arange(bins) + 0.5) * 2.0 * math.pi / bins - worn_places()[0 if self.inner else 1] - self.shift
        away = (angle + math.pi) % (2.0 * math.pi) - math.pi
        w[race][0, self.disc, self.crank] += self.a * np.clip(1.0 - (2.0 * away / self.width) ** 2, 0.0, None)
