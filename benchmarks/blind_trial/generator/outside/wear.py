"""Laws of the wear rate that the catalogue does not have."""

import math
from collections.abc import Mapping

import numpy as np

from benchmarks.blind_trial.generator.laws.wearing import Wearing
from benchmarks.blind_trial.generator.reducer import Setting


class Chatter(Wearing):
    """Cranks that chatter at one speed: wear has a peak there."""

    name = "wear peak at one speed"
    typical, low, high = 0.3, 0.005, 20.0

    def draw(self, rng: np.random.Generator) -> None:
        self.middle = float(rng.uniform(130.0, 190.0))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 + self.a * math.exp(-(((setting.speed - self.middle) / 25.0) ** 2))


class Accident(Wearing):
    """An accident at one hour: dust gets in, wear jumps up for 300 h and is as before."""

    name = "accident at one hour"
    typical, low, high = 1.0, 0.01, 30.0

    def draw(self, rng: np.random.Generator) -> None:
        self.hour = float(rng.uniform(400.0, 900.0))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 + self.a * (self.hour < life["hours"] < self.hour + 300.0)


class Overheating(Wearing):
    """A limit of load times speed above which surfaces overheat: wear grows along a straight line from there."""

    name = "wear beyond a limit of load times speed"
    typical, low, high = 0.5, 0.005, 20.0

    def draw(self, rng: np.random.Generator) -> None:
        self.limit = float(rng.uniform(1.2e4, 1.8e4))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 + self.a * max(0.0, abs(setting.load) * setting.speed / self.limit - 1.0)


class Shifts(Wearing):
    """A shop that is dusty every few weeks: wear comes and goes over the hours."""

    name = "wear that comes and goes over the hours"
    typical, low, high = 0.4, 0.005, 1.0

    def draw(self, rng: np.random.Generator) -> None:
        self.period = float(rng.uniform(700.0, 1500.0))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 + self.a * math.sin(2.0 * math.pi * life["hours"] / self.period)
