"""Orders of the output's turn: from a curve over the angle to complex amplitudes, and these as two numbers an order.

    TE(theta) = a_0 + sum a_k cos(k theta + p_k) = a_0 + sum Re(A_k exp(i k theta)),  A_k = a_k exp(i p_k)

theta is the output's angle against the housing, positive the way the output turns forward, in both senses of rotation; TE is the angle
of the output less that of the input over the ratio.  A curve is put into even steps of theta through whole turns, so that whole orders do
not leak into each other.  What a drift D from end to end leaks into order k of N turns, m = k N, is D/(pi m) as it is, and
D/(pi m (m^2 - 1)) under Hann's window, which needs two turns; ``leakage`` says which D would be that of the curve.

Source: Harris 1978, Proc. IEEE 66(1), for the windows.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicSpline

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault

# Samples that a wave needs: at 6 the spline errs by 1 % of it, at 12 by 0.05 %.
PER_WAVE = 6.0
# Steps that may be missing at the end of whole turns.
MISSING = 3.0
# A leap over more steps is a gap, and what stands in it is not known.
LEAP = 10.0
# Samples that are nearer to each other than this share of the usual step are one: an encoder that stands, or trembles.
NEAR = 0.25
# By less than this share of a step samples are off even ones by rounding alone.
EXACT = 1e-6
# Share of a turn, at either end, over which a drift is measured.
ENDS = 0.01
# What the two numbers of an order are called on the axis ``part``.
REAL, IMAGINARY = 0.0, 1.0
WINDOWS = ("none", "hann")
Complex = npt.NDArray[np.complex128]


@dataclass(frozen=True)
class EvenCurve:
    """A curve in even steps of the output's angle [rad] through whole ``turns``; the angle rises, whichever way the output turned."""

    angle: Floats
    values: Floats
    turns: int


def rising(angle: Floats, values: Floats) -> tuple[Floats, Floats]:
    """The samples along rising angles: backward runs turned round, without those at which the encoder stands or trembles."""
    if angle[-1] < angle[0]:
        angle, values = angle[::-1], values[::-1]
    step = (angle[-1] - angle[0]) / max(len(angle) - 1, 1)
    furthest = np.maximum.accumulate(angle)
    kept = np.concatenate([[True], angle[1:] > furthest[:-1]])
    angle, values = angle[kept], values[kept]
    group = np.concatenate([[0], np.cumsum(np.diff(angle) > NEAR * step)])
    count = np.bincount(group)
    return np.bincount(group, angle) / count, np.bincount(group, values) / count


def even_curve(angle: Floats, values: Floats, per_turn: int | None, place: str) -> EvenCurve:
    """The curve in even steps, ``per_turn`` of them (default: as many as were measured), through as many whole turns as it holds."""
    if len(angle) < 8:
        raise InputFault(f"{place}: {len(angle)} samples are no curve; orders need whole turns of the output")
    angle, values = rising(np.asarray(angle, np.float64), np.asarray(values, np.float64))
    span, step = angle[-1] - angle[0], float(np.median(np.diff(angle))) if len(angle) > 1 else math.inf
    turns = math.floor((span + (1.0 + MISSING) * step) / (2.0 * math.pi))
    if turns < 1 or len(angle) < 8:
        raise InputFault(
            f"{place}: the angle spans {math.degrees(span):.4g} deg in one sense: orders need at least one whole turn of the output"
            " (360 deg); if the encoder jumps at each turn, state unwrap = true in its column"
        )
    gap = float(np.diff(angle).max())
    size = turns * (per_turn or max(8, round(2.0 * math.pi / step)))
    if gap > LEAP * step:
        where = angle[int(np.argmax(np.diff(angle)))]
        raise InputFault(
            f"{place}: after {math.degrees(where):.5g} deg the angle leaps by {math.degrees(gap):.3g} deg, {gap / step:.0f} times the usual step;"
            " orders need a curve without gaps: take a stretch without one by where = { ... }"
        )
    # As finely as was measured, so that nothing folds; then without the orders that fewer steps cannot hold.
    finer = max(1, math.ceil(turns * 2.0 * math.pi / step / size - 0.01)) if per_turn else 1
    end = angle[0] + 2.0 * math.pi * turns
    if angle[-1] < end - NEAR * step:
        # The few steps that are missing lead back to where the curve began.
        angle, values = np.append(angle, end), np.append(values, values[0])
    fine = angle[0] + 2.0 * math.pi * turns * np.arange(finer * size) / (finer * size)
    # Samples that stand there already are what a spline through them has.
    there = len(angle) >= len(fine) and bool(np.all(np.abs(angle[: len(fine)] - fine) <= EXACT * step))
    found = values[: len(fine)] if there else CubicSpline(angle, values)(fine)
    if finer > 1:
        spectrum = np.fft.rfft(found)[: size // 2 + 1]
        if size % 2 == 0:
            spectrum[-1] = 0.0
        found = np.fft.irfft(spectrum, size) / finer
    return EvenCurve(fine[::finer], found, turns)


def amplitudes(curve: EvenCurve, orders: Sequence[float] | Floats, window: str = "none") -> Complex:
    """A_k of each order; of order 0 the mean, real.  Orders must be whole over the curve's turns."""
    weights = 1.0 - np.cos(2.0 * math.pi * np.arange(len(curve.angle)) / len(curve.angle)) if window == "hann" else np.ones(len(curve.angle))
    spectrum = np.fft.rfft(weights * curve.values) / len(curve.angle)
    lines = np.rint(np.asarray(orders, np.float64) * curve.turns).astype(np.intp)
    factor = np.where(lines == 0, 1.0, 2.0)
    found: Complex = factor * spectrum[lines] * np.exp(-1j * np.asarray(orders, np.float64) * curve.angle[0])
    return found


def leakage(curve: EvenCurve, orders: Sequence[float] | Floats, window: str = "none") -> Floats:
    """What a drift from end to end of the curve, as large as its ends differ, leaks into each order at most, in the unit of the curve."""
    some = max(1, round(ENDS * len(curve.values) / curve.turns))
    # A periodic curve differs between its ends by its slope only, which the first and last samples carry on.
    ahead, behind = curve.values[:some], curve.values[-some:]
    drift = abs(float(behind.mean() + (behind[-1] - behind[0]) / 2.0 - ahead.mean() + (ahead[-1] - ahead[0]) / 2.0))
    line = np.asarray(orders, np.float64) * curve.turns
    found = np.divide(drift, math.pi * line, out=np.zeros(len(line)), where=line > 0.0)
    return found / np.maximum(line**2 - 1.0, 1.0) if window == "hann" else found


def measured_orders(angle: Floats, values: Floats, orders: Sequence[float], window: str, per_turn: int | None, place: str) -> tuple[Complex, Floats]:
    """(A_k, what may have leaked into each) of a measured curve; refused where the curve cannot show an order."""
    curve = even_curve(angle, values, per_turn, place)
    samples = len(curve.angle) / curve.turns
    for order in orders:
        line = order * curve.turns
        if order < 0.0 or abs(line - round(line)) > 1e-9 * max(line, 1.0):
            raise InputFault(f"{place}.orders: {order:g} makes {line:g} waves in {curve.turns} turn(s) of the output; only whole ones do not leak")
        if order * PER_WAVE > samples:
            raise InputFault(
                f"{place}.orders: {order:g} needs {PER_WAVE * order:.0f} samples per turn of the output, there are {samples:.0f};"
                f" sample more densely, or take orders up to {samples / PER_WAVE:.0f}"
            )
    if window == "hann" and curve.turns < 2:
        raise InputFault(f'{place}.window = "hann": needs two turns of the output, there are {curve.turns}; state window = "none"')
    return amplitudes(curve, orders, window), leakage(curve, orders, window)


def rows_and_parts(order: Floats) -> tuple[npt.NDArray[np.intp], Floats]:
    """(row, part) of every number of a table of orders, by rising order: the real part, then the imaginary one; of order 0 there is only one."""
    waves = np.flatnonzero(order > 0.0)
    rows = np.concatenate([np.arange(len(order)), waves])
    parts = np.concatenate([np.full(len(order), REAL), np.full(len(waves), IMAGINARY)])
    place = np.lexsort((parts, order[rows]))
    return rows[place], parts[place]


def as_numbers(orders: Sequence[float] | Floats, found: Complex) -> dict[str, Floats]:
    """``value``, and the axes ``order`` and ``part``, of a record."""
    order = np.asarray(orders, np.float64)
    rows, part = rows_and_parts(order)
    return {"value": np.where(part == IMAGINARY, found.imag[rows], found.real[rows]), "order": order[rows], "part": part}


def numbers_of(curve: EvenCurve, order: Floats, part: Floats) -> Floats:
    """The numbers of ``as_numbers`` that a curve shows, in the order of a record's axes."""
    found = amplitudes(curve, order)
    return np.where(np.asarray(part) == IMAGINARY, found.imag, found.real)
