"""Laws of the wear rate, and of where the pins wear."""

import math
from collections.abc import Mapping

import numpy as np

from benchmarks.blind_trial.generator.laws.shared import UM, WEAR
from benchmarks.blind_trial.generator.reducer import HOUR, Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats

# Mean line load [N/m] of carrying contacts of the RV20E-121 at 167 N m, each weighed with itself, as wear weighs it.
LINE_LOAD = {"flank": 2.3e4, "race": 7.5e4}
# Film after Hamrock and Dowson over that of a flank: rollers of 1.5 mm on races of 10.25 mm (1.31 mm reduced) turn at half of 0.72 m/s; flanks
# (2.5 mm reduced) slide on their pins at some 0.06 m/s, half of which draws oil in: 12^0.68 (1.31/2.5)^0.46 (7.5/2.3)^-0.073.
FILM = {"flank": 1.0, "race": 3.7}


class Wearing(Truth):
    """Base of the laws that act on the wear rate."""

    blocks: tuple[str, ...] = ("wear",)
    quantities: tuple[str, ...] = WEAR


class RunIn(Wearing):
    """Running-in by a power law of the way: 1 + a/(1 + s/s0)^p, or two exponentials."""

    name, effect = "running-in by a power law", "running_in"
    typical, low, high = 1.0, 0.005, 12.0

    def draw(self, rng: np.random.Generator) -> None:
        self.travel = 67.5 * HOUR * float(np.exp(rng.uniform(math.log(60.0), math.log(350.0))))
        self.power = float(rng.uniform(1.5, 2.5))
        self.double = bool(rng.random() < 0.5)

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        s = life["travel"] / self.travel
        if self.double:
            return 1.0 + self.a * (0.6 * math.exp(-1.6 * s) + 0.4 * math.exp(-0.6 * s))
        return 1.0 + self.a / float((1.0 + s / self.power) ** (self.power + 1.0))


class Debris(Wearing):
    """Abrasion by debris: grows like a logistic curve of the iron that is worn off."""

    name, effect = "abrasion by debris, logistic", "debris_abrasion"
    typical, low, high = 1.0, 0.01, 30.0

    def draw(self, rng: np.random.Generator) -> None:
        self.middle = float(rng.uniform(3e-5, 1e-4))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        share = life["iron"] / self.middle
        return 1.0 + self.a * share / (1.0 + 0.15 * share)


class Film(Wearing):
    """Film by Hamrock and Dowson's exponents (speed 0.68, load -0.073), wear by a Gaussian of film over roughness."""

    name, effect = "lubricant film after Hamrock and Dowson", "lubrication_regime"
    typical, low, high = 0.3, 0.005, 0.95

    def draw(self, rng: np.random.Generator) -> None:
        self.half = float(rng.uniform(0.7, 1.5))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        warm = setting.temperature - 273.15
        viscosity = math.exp(880.0 / (warm + 105.0) - 880.0 / 145.0)
        film = FILM[surface] * (viscosity * setting.speed / 209.4) ** 0.68 * (setting.load / 167.0) ** -0.073
        return 1.0 - self.a * (1.0 - math.exp(-((film / self.half) ** 1.5)))


class LoadPower(Wearing):
    """Wear that grows as a power of a surface's mean line load over the one at which its coefficient holds."""

    name, effect = "wear by a power of the load", "load_exponent"
    typical, low, high = 0.2, 0.003, 1.5

    def draw(self, rng: np.random.Generator) -> None:
        self.sign = float(rng.choice([-1.0, 1.0, 1.0]))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return float((LINE_LOAD[surface] / 5e4 * setting.load / 167.0) ** (self.sign * self.a))


class SoftCore(Wearing):
    """Hardness that falls in proportion to the depth."""

    name, effect = "hardness falling with depth", "hardness_gradient"
    typical, low, high = 0.1, 0.002, 0.9

    def draw(self, rng: np.random.Generator) -> None:
        self.depth = float(rng.uniform(4.0, 8.0)) * UM

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 / (1.0 - self.a * min(1.0, life[surface] / self.depth))


class Tilt(Wearing):
    """Tilted contacts wear more at the edge, the more the lower the load."""

    name, effect = "tilted contacts", "edge_loading"
    typical, low, high = 0.5, 0.005, 5.0

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 + self.a * float((100.0 / setting.load) ** 0.8)


class OldGrease(Wearing):
    """Grease that ages: wear grows as a power of the time since it was filled."""

    name, effect = "ageing grease", "grease_ageing"
    typical, low, high = 0.3, 0.005, 8.0

    def draw(self, rng: np.random.Generator) -> None:
        self.life = float(rng.uniform(2000.0, 5000.0))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        t = life["hours"] / self.life
        return 1.0 + self.a * t / (1.0 + t)


class StuckPins(Wearing):
    """Pins that stand for a share of the time: two bands in their print.

    The bands are those of pins that never turn, which their own wear has made wide and shallow; with the effect's share they are deeper.  So
    the share is not the effect's number (an estimate is half of it).
    """

    name, effect = "pins that stand", "pin_rotation"
    blocks, quantities = ("wear", "prints"), ("wear_profile",)
    typical, low, high = 0.1, 0.001, 1.0

    def standing(self, setting: Setting) -> float:
        return self.a


class TenKelvin(Wearing):
    """The rule of the ten kelvin: for each of them wear grows by the same factor."""

    name, effect = "wear by the rule of ten kelvin", "arrhenius"
    typical, low, high = 0.1, 0.001, 1.2

    def draw(self, rng: np.random.Generator) -> None:
        self.sign = float(rng.choice([-1.0, 1.0, 1.0]))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return math.exp(self.sign * self.a * (setting.temperature - 303.0) / 10.0)


class MildWear(Wearing):
    """Mild wear below a force, whatever the curvature of the contact."""

    name, effect = "mild wear below a force", "pressure_threshold"
    typical, low, high = 0.3, 0.005, 0.98

    def draw(self, rng: np.random.Generator) -> None:
        self.force = float(rng.uniform(90.0, 220.0))

    def mild(self) -> Floats:
        return np.array([self.a, self.force, 0.7 * self.force])


class DryRun(Wearing):
    """Grease that runs out: from an hour on wear grows along a straight line, until all of it has gone."""

    name, effect = "grease that runs out", "starvation"
    typical, low, high = 1.0, 0.01, 30.0

    def draw(self, rng: np.random.Generator) -> None:
        self.onset = float(rng.uniform(300.0, 1400.0))
        self.width = float(rng.uniform(200.0, 700.0))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 + self.a * min(1.0, max(0.0, (life["hours"] - self.onset) / self.width))


class Ageing(Wearing):
    """Surfaces that tire: wear grows as a power of the hours."""

    name, effect = "surfaces that tire", "wear_growth"
    typical, low, high = 0.2, 0.003, 10.0

    def draw(self, rng: np.random.Generator) -> None:
        self.power = float(rng.uniform(0.9, 1.25))

    def rate(self, surface: str, life: Mapping[str, float], setting: Setting) -> float:
        return 1.0 + self.a * math.pow(life["hours"] / 1000.0, self.power)
