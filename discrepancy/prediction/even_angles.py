"""Angles that err from sample to sample: an encoder's noise in what a signal is written over, of a shaft that turned evenly.

A sample is then shown beside where it was taken, and what repeats itself fast is seen too small: order k by (k s)^2/2 of itself, where s [rad] is the noise
of the angles (errors in variables: Fuller, Measurement Error Models, 1987).  Or the samples were taken as unevenly as they are written.  Runs
that repeat each other tell which: what they differ by follows the slope times what their angles differ by, or it does not.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain, combinations

import numpy as np
from scipy.signal import savgol_filter

from discrepancy.outlying_samples import bridged
from discrepancy.prediction.whitening import whitening
from discrepancy.problem import Record
from discrepancy.repetitions import repetitions_of
from discrepancy.rounding import jumps_of
from fmu_src.arrays import Floats

# Fewer samples show neither how even a turning was nor what stands between them.
FEWEST = 100
# Of a step: angles that are off by less are even.
EVEN = 0.01
# What an even turning leaves of the angles is as large as what jumps from sample to sample, within this factor.
NO_MORE = 1.1
# Means of so many samples are off even angles by no more than so many of their standard deviations.
BLOCK, MOST = 50, 4.0
# Samples over which a turning that is not even as a whole is a parabola.
WINDOWS = (1001, 201)
# Standard deviations by which differences have to fall short of following the angles as written.
SURE = 3.0


@dataclass(frozen=True)
class Turning:
    """Angles (n,) [rad] of an ``even`` turning, and by how much those that are written are ``off``."""

    even: Floats
    off: Floats

    @property
    def noise(self) -> float:
        return float(np.std(self.off))


def with_even_angles(records: Sequence[Record]) -> list[Record]:
    """The records; those over angles that err from sample to sample at the angles of an even turning."""
    turnings = erring(records)

    def evened(record: Record, turning: Turning) -> Record:
        return replace(record, axes={**record.axes, "angle": turning.even}, angle_noise=turning.noise)

    return [evened(r, turnings[r.name]) if r.name in turnings else r for r in records]


def erring(records: Sequence[Record]) -> dict[str, Turning]:
    """By name the runs over angles that err from sample to sample: all of a quantity do, or none."""
    found: dict[str, Turning] = {}
    for quantity in {r.quantity for r in records}:
        measured = [r for r in records if r.quantity == quantity]
        turnings = {r.name: turning for r in measured if (turning := turning_of(r)) is not None}
        followed, error = following([r for r in measured if r.name in turnings and r.fitted and np.isfinite(r.values).all()], turnings)
        if SURE * error + max(followed, 0.0) < 1.0:
            found |= turnings
    return found


def turning_of(record: Record) -> Turning | None:
    """The even turning of a record whose angles differ from one by what jumps from sample to sample; None of others."""
    angle = np.asarray(record.axes.get("angle", ()), np.float64)
    if len(angle) < FEWEST or not np.isfinite(angle).all():
        return None
    numbers = np.linspace(-1.0, 1.0, len(angle))
    line = np.polynomial.Polynomial.fit(numbers, angle, 1)(numbers)
    step = abs(line[1] - line[0])
    if float(np.std(angle - line)) <= EVEN * step:
        return None
    nearby = (savgol_filter(angle, window, 2, mode="interp") for window in WINDOWS if window < len(angle))
    for even in chain([line], nearby):
        turning = Turning(even, angle - even)
        if goes_along(turning.off):
            # Noise beyond many steps is another order of the rows.
            return turning if EVEN * step < turning.noise < len(angle) ** 0.5 * step and np.ptp(np.sign(np.diff(even))) == 0.0 else None
    return None


def goes_along(off: Floats) -> bool:
    """Whether angles are ``off`` (n,) an even turning by what jumps from sample to sample alone."""
    jumps = jumps_of(off)
    means = off[: len(off) // BLOCK * BLOCK].reshape(-1, BLOCK).mean(axis=1)
    return float(np.std(off)) <= NO_MORE * jumps and float(np.abs(means).max()) <= MOST * jumps / BLOCK**0.5


def following(records: Sequence[Record], turnings: dict[str, Turning]) -> tuple[float, float]:
    """The share, and its standard deviation, in which runs that repeat each other differ by the slope times what their angles are off: 1 where the
    samples were taken at the angles as written, 0 where they were at even ones."""
    followed = expected = variance = 0.0
    for difference, one, other in differences(records, turnings):
        white = whitening(difference)
        left, one, other = white(difference), white(one), white(other)
        # The noise of one slope is not that of the other; that of their mean is not that of the difference.
        both = 0.5 * left * (one + other)
        followed, expected, variance = followed + float(both.sum()), expected + float(one @ other), variance + float(both @ both)
    return (followed / expected, variance**0.5 / expected) if expected > 0.0 else (1.0, np.inf)


def differences(records: Sequence[Record], turnings: dict[str, Turning]) -> Iterator[tuple[Floats, Floats, Floats]]:
    """Of each two runs that repeat each other what they differ by (m,), and what they would by the slope of one and of the other."""
    for members in repetitions_of(records):
        shown = [bridged(r).values for r in members]
        turned = [turnings[r.name] for r in members]
        for one, other in combinations(zip(shown, turned, map(slope_of, shown, turned)), 2):
            (value, first, slope), (beside, second, its_slope) = one, other
            steps = [np.diff(t.even).mean() for t in (first, second)]
            if steps[0] * steps[1] < 0.0:
                continue
            rows = np.rint((first.even - second.even[0]) / steps[1]).astype(np.intp)
            kept = (rows >= 0) & (rows < len(second.even))
            if kept.sum() < FEWEST:
                continue
            rows, apart = rows[kept], first.off[kept] - second.off[rows[kept]]
            yield value[kept] - beside[rows], slope[kept] * apart, its_slope[rows] * apart


def slope_of(values: Floats, turning: Turning) -> Floats:
    """(n,) how ``values`` (n,) change with the angle, up to what repeats itself with every second sample."""
    mirrored = np.concatenate([values, values[::-1]])
    waves = np.fft.rfft(mirrored) * 2j * np.pi * np.fft.rfftfreq(len(mirrored))
    # The steps of an even turning are alike nearby.
    slope: Floats = np.fft.irfft(waves, len(mirrored))[: len(values)] / np.gradient(turning.even)
    return slope
