"""How something that wears grows over the hours, and what is known of it before anybody has looked.

    L(t) = L_0 + integral of v(u) (1 + (r - 1) exp(-u/tau)) du,  v(t) = v_0 exp(d(s)),  s = ln(1 + t/T)

v is the rate when run in; running-in multiplies it by r at first (1 + (r - 1) exp(-t/tau), as ``wear_fmu.wear_laws`` has it).  What else
may happen to a wear rate (debris, hardness, grease) has no form here: d is a walk in the logarithm of the hours, so that a rate
may change as much from 1,000 to 2,000 h as from 5,000 to 10,000 h.  Its steps are not alike both ways: what slows wear down is running-in, and it is over
for good; what quickens it (grease that has run out, a hard layer worn through) is rare and large.  So a step is TREND + a normal part + JUMP (exp(SKEW z) - 1).
With normal steps alone lives ended before the interval six times as often as the law meant, and after it a sixth of it: chances to fall that no drive takes.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from fmu_src.arrays import Floats
from rv_reducer.estimate import LEVEL_DEVIATION

# Hours [h] from which on time is counted by its logarithm, steps of the walk and of the integral in it.
FIRST = 300.0
STEP, FINE = 0.5, 0.05
# What is known before: rate of a typical life, running-in (r - 1, tau [h]), each with the deviation of its logarithm; the sources have r 3 to 10
# and 50 to 500 h, and some units do not run in at all.
RATE_DEVIATION = 1.5
RUN_IN, RUN_IN_DEVIATION = 2.0, 1.0
TIME, TIME_DEVIATION = 200.0, 0.8
# Of the rate's logarithm the rise per step of 1 in s, its deviation per root of it, and the rare rise in a step of STEP: chosen so that both ends of
# intervals hold on lives of benchmarks.forecasts with seeds that are not those of the judgement.
TREND, DRIFT = 0.12, 0.12
JUMP, SKEW = 0.08, 1.1
LEVEL, RATE, EXCESS, DECAY = range(4)


@dataclass(frozen=True)
class Growth:
    """The law with what is known before; ``x`` (n, dim) are deviations from it in units of their standard deviation.

    ``level`` and ``rate`` are typical ones, in the quantity's unit and in that per hour; ``horizon`` [h] is as far as anybody looks.
    """

    level: float
    rate: float
    horizon: float
    drift: float = DRIFT

    @cached_property
    def hours(self) -> Floats:
        """Where the growth is computed [h]."""
        end = np.log1p(self.horizon / FIRST)
        return FIRST * np.expm1(np.linspace(0.0, end, int(np.ceil(end / FINE)) + 1))

    @property
    def dimensions(self) -> int:
        return 4 + int(np.ceil(np.log1p(self.horizon / FIRST) / STEP))

    @property
    def variance(self) -> float:
        """Of the walk per step of 1 in s."""
        once, twice = np.exp(0.5 * SKEW**2), np.exp(2.0 * SKEW**2)
        jumps = JUMP**2 * (twice - once**2) / STEP + 2.0 * self.drift * JUMP * SKEW * once / np.sqrt(STEP)
        return float(self.drift**2 + jumps)

    def numbers(self, x: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """(level, rate when run in at 0 h, r - 1, tau [h])."""
        return (
            self.level * (1.0 + LEVEL_DEVIATION * x[:, LEVEL]), self.rate * np.exp(RATE_DEVIATION * x[:, RATE]),
            RUN_IN * np.exp(RUN_IN_DEVIATION * x[:, EXCESS]), TIME * np.exp(TIME_DEVIATION * x[:, DECAY]),
        )  # fmt: skip

    def rates(self, x: Floats) -> Floats:
        """Rate when run in (n, hours)."""
        walk = np.cumsum(self.drift * np.sqrt(STEP) * x[:, 4:] + JUMP * np.expm1(SKEW * x[:, 4:]), axis=1)
        nodes = np.concatenate([np.zeros((len(x), 1)), walk], axis=1)
        place = np.log1p(self.hours / FIRST) / STEP
        first = np.minimum(place.astype(np.intp), nodes.shape[1] - 2)
        share = place - first
        drift = nodes[:, first] * (1.0 - share) + nodes[:, first + 1] * share + TREND * np.log1p(self.hours / FIRST)
        found: Floats = self.numbers(x)[1][:, None] * np.exp(np.clip(drift, -20.0, 20.0))
        return found

    def levels(self, x: Floats) -> Floats:
        """L (n, hours)."""
        level, _, excess, decay = self.numbers(x)
        t = self.hours
        running = self.rates(x) * (1.0 + excess[:, None] * np.exp(-t / decay[:, None]))
        grown = np.cumsum(0.5 * (running[:, 1:] + running[:, :-1]) * np.diff(t), axis=1)
        found: Floats = level[:, None] + np.concatenate([np.zeros((len(x), 1)), grown], axis=1)
        return found

    def at(self, curves: Floats, hours: Floats) -> Floats:
        """Curves (n, hours) at other hours (k,): (n, k)."""
        grid = self.hours
        first = np.clip(np.searchsorted(grid, hours) - 1, 0, len(grid) - 2)
        share = (hours - grid[first]) / (grid[first + 1] - grid[first])
        found: Floats = curves[:, first] * (1.0 - share) + curves[:, first + 1] * share
        return found

    def crossings(self, curves: Floats, limit: float) -> Floats:
        """Hours (n,) at which curves first reach the limit; infinite where they do not before the horizon."""
        over = curves >= limit
        found = np.full(len(curves), np.inf)
        rows = np.flatnonzero(over.any(axis=1))
        k = over[rows].argmax(axis=1)
        t = self.hours
        before, after = curves[rows, np.maximum(k - 1, 0)], curves[rows, k]
        share = np.where(k > 0, (limit - before) / np.maximum(after - before, 1e-300), 0.0)
        found[rows] = t[np.maximum(k - 1, 0)] + share * (t[k] - t[np.maximum(k - 1, 0)])
        return found
