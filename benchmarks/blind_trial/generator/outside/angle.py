"""Patterns of the transmission error that the catalogue does not have."""

import math

import numpy as np

from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.laws.shared import ARCSEC, BOTH, PINS, UM
from benchmarks.blind_trial.generator.reducer import Setting
from benchmarks.blind_trial.generator.truth import Truth
from fmu_src.arrays import Floats


class Angular(Truth):
    """Base of patterns over the output angle."""

    blocks, quantities = ("te",), ("transmission_error",)
    typical, low, high = 0.3 * ARCSEC, 0.005 * ARCSEC, 100 * ARCSEC

    def draw(self, rng: np.random.Generator) -> None:
        self.phase = float(rng.uniform(0.0, 2.0 * math.pi))

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        """Over the angle [rad], of size 1 or so."""
        raise NotImplementedError

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        change = self.a * self.pattern(series.axes["angle"], rows[0])
        return y + change - float(change.mean())


class Cogging(Angular):
    """Magnetic cogging of a motor with an unlucky slot number: order 47 and its half."""

    name = "cogging at order 47"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(47.0 * angle + self.phase) + 0.3 * np.cos(23.5 * angle + self.phase)


class Belt(Angular):
    """A belt on the input, order 5.5."""

    name = "belt at order 5.5"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(5.5 * angle + self.phase)


class ThreeLobes(Angular):
    """A flange clamped at three points: order 3 in proportion to the load."""

    name = "order 3 with the load"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return s.load / 120.0 * np.cos(3.0 * angle + self.phase)


class StickSlip(Angular):
    """Stick-slip as a saw tooth at order 17, only above 80 N m."""

    name = "stick-slip at order 17"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        x = 17.0 * angle + self.phase
        return (np.sin(x) - 0.5 * np.sin(2.0 * x) + 0.33 * np.sin(3.0 * x)) * (s.load > 80.0)


class LoadedTurn(Angular):
    """Carrier bearing that tips over at a load: order 1 changes its sign at 110 N m."""

    name = "order 1 changing sign with the load"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(angle + self.phase) * math.tanh((s.load - 110.0) / 15.0)


class WarmRipple(Angular):
    """A ripple of order 29 that grows as the square of the warmth."""

    name = "order 29 with the temperature squared"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(29.0 * angle + self.phase) * (0.2 + ((s.temperature - 293.15) / 20.0) ** 2)


class Beating(Angular):
    """A belt's teeth, order 52, that come and go once per turn."""

    name = "order 52 that beats once per turn"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(52.0 * angle + self.phase) * (1.0 + 0.8 * np.cos(angle))


class OddPins(Truth):
    """Every pin out of place by its own normal number."""

    name, blocks, quantities = "pins at random", ("te",), BOTH
    typical, low, high = 1.0 * UM, 0.05 * UM, 8 * UM
    acceptable = ("pin_position_errors",)

    def draw(self, rng: np.random.Generator) -> None:
        self.places = rng.standard_normal(PINS)

    def parts(self, p: np.ndarray, setting: Setting) -> None:
        p["pin_position_error_radial"][0] += self.a * self.places


class Chip(Angular):
    """A chip in the rig's bearing: a bump of a few degrees at one place of the turn, whatever the load."""

    name = "bump at one place of the turn"
    typical, low, high = 1.0 * ARCSEC, 0.01 * ARCSEC, 100 * ARCSEC

    def draw(self, rng: np.random.Generator) -> None:
        super().draw(rng)
        self.width = math.radians(rng.uniform(2.5, 6.0))

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        away = (angle - self.phase + math.pi) % (2.0 * math.pi) - math.pi
        return np.exp(-0.5 * (away / self.width) ** 2)


class SevenScrews(Angular):
    """A warm flange between seven screws: order 7 in proportion to the warmth."""

    name = "order 7 with the temperature"

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(7.0 * angle + self.phase) * (s.temperature - 283.15) / 20.0


class FlyingArm(Angular):
    """A part of the rig that centrifugal force bends: order 33 with the square of the speed."""

    name, blocks = "order 33 with the speed squared", ("speeds",)

    def pattern(self, angle: Floats, s: Setting) -> Floats:
        return np.cos(33.0 * angle + self.phase) * (s.speed / 130.0) ** 2
