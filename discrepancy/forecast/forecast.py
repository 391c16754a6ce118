"""Remaining life and wear parameters after each inspection."""

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from discrepancy.forecast.growth import FIRST, Growth
from discrepancy.forecast.posterior import best_misfits, samples
from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from fmu_src.threads import sharing_no_matrices

# Nobody looks further: so many times the hours of the last inspection, at least [h].
FURTHEST, LEAST = 100.0, 1e5
# A rate of which nothing is known: the way to the limit in so many hours.
USUAL_LIFE = 10_000.0
COVERAGE = 0.9


@dataclass(frozen=True)
class Reading:
    """What an inspection showed: hours [h], value and standard deviation in one unit."""

    hours: float
    value: float
    noise: float


@dataclass(frozen=True)
class Range:
    """Middle and ends of an interval of ``COVERAGE``."""

    middle: float
    low: float
    high: float

    def holds(self, value: float) -> bool:
        return self.low <= value <= self.high


@dataclass(frozen=True)
class Forecast:
    """After ``readings`` inspections: hours left from the last one on, and what it rests on; per hour in the unit of the readings."""

    hours: float
    readings: int
    remaining: Range
    level: Range
    rate: Range
    first_level: Range
    run_in_ratio: Range
    run_in_time: Range
    # Standard deviation of the rate's logarithm now, and what the square of it grows by in an hour: what a filter needs.
    rate_deviation: float
    drift: float
    # Share of what is possible in which the limit is not reached at all before anybody looks, and until when that is [h].
    beyond: float
    horizon: float
    # Of the law that the posterior holds for the best: what it says less what was read, over the noise, by reading; and the sum of the squares.
    misfits: tuple[float, ...]
    chi_square: float
    # What the readings' quantity is expected to be at other hours, by hours.
    later: dict[float, Range]

    def as_json(self) -> dict[str, Any]:
        return asdict(self)


def range_of(values: Floats) -> Range:
    low, middle, high = np.quantile(values, [0.5 - COVERAGE / 2, 0.5, 0.5 + COVERAGE / 2], method="inverted_cdf")
    return Range(float(middle), float(low), float(high))


def growth_of(readings: Sequence[Reading], limit: float, rate: float | None = None) -> Growth:
    """The law for these readings; ``rate`` [1/h] where a model says what is usual."""
    last = max(r.hours for r in readings)
    level = readings[0].value
    usual = rate or abs(limit - level) / USUAL_LIFE or abs(limit) / USUAL_LIFE
    return Growth(level, usual, max(FURTHEST * last, LEAST))


@sharing_no_matrices
def forecast(readings: Sequence[Reading], limit: float, rate: float | None = None, asked: Sequence[float] = (), seed: int = 0) -> Forecast:
    """What the readings say of the hours until ``limit``, and of the quantity at the hours that are ``asked``."""
    require_sound(readings, limit)
    ordered = sorted(readings, key=lambda r: r.hours)
    growth = growth_of(ordered, limit, rate)
    hours, values, noise = (np.array([getattr(r, name) for r in ordered]) for name in ("hours", "value", "noise"))
    x = samples(growth, hours, values, noise, seed)
    off = best_misfits(growth, hours, values, noise)
    curves, now = growth.levels(x), np.array([hours[-1]])
    left = np.maximum(growth.crossings(curves, limit) - now[0], 0.0)
    rates = growth.at(growth.rates(x), now)[:, 0]
    _, _, excess, decay = growth.numbers(x)
    running = rates * (1.0 + excess * np.exp(-now[0] / decay))
    return Forecast(
        float(now[0]), len(ordered), range_of(left), range_of(growth.at(curves, now)[:, 0]), range_of(running),
        range_of(curves[:, 0]), range_of(1.0 + excess), range_of(decay), float(np.std(np.log(running))),
        growth.variance / (FIRST + float(now[0])), float(np.mean(~np.isfinite(left))), growth.horizon,
        tuple(map(float, off)), float(off @ off),
        {float(t): range_of(growth.at(curves, np.array([t]))[:, 0]) for t in asked},
    )  # fmt: skip


def narrowing(readings: Sequence[Reading], limit: float, rate: float | None = None, asked: Sequence[float] = ()) -> list[Forecast]:
    """Forecasts after each number of hours that has readings, from the second on."""
    require_sound(readings, limit)
    hours = sorted({r.hours for r in readings})
    return [forecast([r for r in readings if r.hours <= last], limit, rate, asked) for last in hours[1:]]


def require_sound(readings: Sequence[Reading], limit: float) -> None:
    count = len({r.hours for r in readings})
    if count < 2:
        raise InputFault(f"readings at {count} number{'' if count == 1 else 's'} of hours: a forecast needs at least two, better one when new")
    if min(r.hours for r in readings) < 0.0 or not all(r.noise > 0.0 for r in readings):
        raise InputFault("readings need hours from 0 on and a noise above 0")
    if limit <= min(r.value for r in readings):
        raise InputFault(f"the limit {limit:.4g} lies below the first reading {min(r.value for r in readings):.4g}: the life would be over when new")
