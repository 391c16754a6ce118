"""Where the zero of a mounting's angles may lie, as the campaign states it under ``nuisances.encoder_phase``."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from discrepancy.campaign.model import ENCODER_PHASE, Nuisance
from fmu_src.arrays import Floats

# Within it [rad] two angles are the same.
ROUNDING = 1e-9


@dataclass(frozen=True)
class ZeroBounds:
    """``lower`` and ``upper`` [rad of the output]; a whole turn or more is anywhere. ``start``: of places that look alike the nearest to it is taken."""

    lower: float = -np.pi
    upper: float = np.pi
    start: float = 0.0

    @property
    def anywhere(self) -> bool:
        return self.upper - self.lower > 2.0 * np.pi - ROUNDING

    def hold(self, zero: float) -> bool:
        return self.anywhere or self.lower - ROUNDING <= zero <= self.upper + ROUNDING

    def of(self, zero: float, reach: float) -> tuple[float, float]:
        """Bounds of a fit from ``zero``, ``reach`` to either side of it."""
        return (zero - reach, zero + reach) if self.anywhere else (max(self.lower, zero - reach), min(self.upper, zero + reach))

    def in_a_wave(self, shares: Floats, wave: float) -> Floats:
        """Places to look at: at ``shares`` of the ``wave`` about the start, or of what the bounds leave of it."""
        if self.anywhere:
            return self.start + shares * wave
        if self.upper - self.lower <= wave:
            return np.linspace(self.lower, self.upper, len(shares))
        middle = min(max(self.start, self.lower + 0.5 * wave), self.upper - 0.5 * wave)
        return middle + shares * wave

    def waves(self, shares: Floats, wave: float, near: float) -> Floats:
        """Places to look at, a row for each wave: of a turn about ``near``, or of what the bounds hold."""
        if self.anywhere:
            half, nearest = round(np.pi / wave), round(near / wave)
            return wave * (np.arange(nearest - half, nearest + half)[:, None] + shares)
        rows = max(1, int(np.ceil((self.upper - self.lower) / wave - 1e-9)))
        return np.linspace(self.lower, self.upper, rows * len(shares)).reshape(rows, -1)

    def held(self, zero: float) -> float:
        """The zero, or the bound beyond which it lies."""
        return zero if self.anywhere else min(max(zero, self.lower), self.upper)

    def among(self, places: Floats) -> Floats:
        """Those of the ``places`` that the bounds hold."""
        return places if self.anywhere else places[(places >= self.lower - ROUNDING) & (places <= self.upper + ROUNDING)]

    def nearest(self, zero: float, wave: float, near: float) -> float:
        """Of what is a whole number of waves from ``zero``, which they hold, that nearest to ``near``."""
        waves = round((near - zero) / wave)
        while waves and not self.hold(zero + wave * waves):
            waves -= int(np.sign(waves))
        return zero + wave * waves


ANYWHERE = ZeroBounds()


def zero_bounds(nuisances: Sequence[Nuisance]) -> ZeroBounds:
    """As a campaign declares them."""
    declared = [n.parameter for n in nuisances if n.parameter.name == ENCODER_PHASE]
    return ZeroBounds(declared[0].lower, declared[0].upper, declared[0].off) if declared else ANYWHERE
