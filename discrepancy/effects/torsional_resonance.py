"""Torsional resonance of rig or load: a flywheel behind the coupling follows the output as a spring lets it.

    y = x + g (H - 1) x at every order k,  H = (1 + 2 i (1 - s) z r)/(1 - r^2 + 2 i z r),  r = k n/f_0

x is the transmission error of the reducer, y what the encoder sees, n the output's turns a second, f_0 and z frequency and
damping ratio, of which the share s stands to the ground (bearings and seals of the load) and the rest in the soft part;
g = 1 where the encoder turns with the load, less where it sits before the soft part.  Orders well below f_0/n pass, those
near it are lifted up to 1/(2 z) times and delayed, those above it vanish (g = 1), sooner where damping stands to the
ground.  Only other speeds tell it from an error of a part, which stays at its order.

A series over whole turns in even steps is taken apart by Fourier's transform, any other by least squares over the whole
orders of the output, or where samples lie densely put into even steps by a spline.  What this does not hold passes
unchanged, and near the ends of less than a turn the result is uncertain for as long as the resonance rings.

Source: base excitation of a damped oscillator (Den Hartog 1956); rigs 10 to 100 Hz, z 0.01 to 0.1.
"""

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np
import numpy.typing as npt

from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.effect import Effect, amplitude, shape

PER = "campaign"
EFFECT = Effect(
    0, "torsional resonance of rig or load", "y = x + g (H - 1) x, H = (1 + 2 i (1 - s) z r)/(1 - r^2 + 2 i z r), r = k n/f_0",
    "base excitation of a damped oscillator, Den Hartog 1956; 10 to 100 Hz, damping ratio 0.01 to 0.1",
    "orders of the transmission error near one frequency are lifted and delayed, other ones at another speed; orders far above it are missing",
    (
        amplitude("resonance_share", "1", "g: share of the transmission error that goes over the spring", 0.3, 0.0, 2.0, sign=1),
        shape("resonance_frequency", "Hz", "f_0: frequency of load on spring", 30.0, 0.5, 5000.0, "assumed: 10 to 100 Hz",
              grid=(6.0, 9.0, 13.0, 19.0, 28.0, 42.0, 63.0, 95.0)),
        shape("resonance_damping", "1", "z: its damping ratio", 0.05, 1e-3, 2.0, "assumed: 0.01 to 0.1", grid=(0.05,)),
        shape("resonance_grounded", "1", "s: share of the damping that stands to the ground", 0.0, 0.0, 1.0, "assumed: none", grid=(0.0,)),
    ),
    signals=("transmission_error",),
    # At one speed any order may be off by anything: it is by following a frequency that a resonance shows.
    needs="speeds",
)  # fmt: skip
# Steps that differ by less are even, turns that differ by less from whole ones are whole.
EVEN = 1e-6
# Steps that may be missing at the end of whole turns.
MISSING = 3.0
# Samples in uneven steps up to which orders are found by least squares; more lie so densely that a spline holds them.
MOST_UNEVEN = 800
# Share of the orders that samples could tell apart at best, and damping of the least squares.
TOLD_APART, RIDGE = 0.9, 1e-7
Complex = npt.NDArray[np.complex128]
Transfer = Callable[[Floats], Complex]


def transfer_of(share: float, frequency: float, damping: float, grounded: float, turns_a_second: float) -> Transfer:
    """What an order of the output is multiplied by; ``turns_a_second`` with the sense of turning."""

    def transfer(order: Floats) -> Complex:
        r = order * turns_a_second / frequency
        damped = 2j * damping * r
        return np.asarray(1.0 + share * ((1.0 + (1.0 - grounded) * damped) / (1.0 - r * r + damped) - 1.0), np.complex128)

    return transfer


def change(values: Floats, record: Record, at: Callable[[str], float], size: float) -> Floats:
    share = at("resonance_share")
    name = next((n for n in ("angle", "time") if n in record.axes), None)
    if share == 0.0 or name is None or record.quantity != "transmission_error" or len(values) < 3:
        return values
    speed = at("output_speed") * record.factors.get("direction", 1.0)
    axis = np.asarray(record.axes[name], np.float64)
    angle = axis if name == "angle" else speed * (axis - axis[0])
    shape_of = at("resonance_frequency"), at("resonance_damping"), at("resonance_grounded")
    return filtered(values, angle, transfer_of(share, *shape_of, speed / (2.0 * math.pi)))


def filtered(values: Floats, angle: Floats, transfer: Transfer) -> Floats:
    """A series over the output's ``angle`` [rad], in any order, with every order changed by ``transfer``."""
    order = np.argsort(angle, kind="stable")
    found = np.empty(len(values))
    found[order] = in_order(np.asarray(values, np.float64)[order], angle[order], transfer)
    return found


def in_order(values: Floats, angle: Floats, transfer: Transfer) -> Floats:
    n = len(values)
    step = (angle[-1] - angle[0]) / (n - 1)
    turns = n * step / (2.0 * math.pi)
    even = bool(np.abs(np.diff(angle) - step).max() < EVEN * step)
    if even and turns > 0.5 and abs(turns - round(turns)) < EVEN * turns:
        return even_turns(values, round(turns), transfer)
    if n > MOST_UNEVEN:
        whole = max(1, round(turns))
        turns = whole if abs(turns - whole) * n < MISSING * turns else turns
        return values + change_by_spline(values, angle, turns, transfer)
    basis, inverse, orders = least_squares(angle.tobytes(), max(turns, 0.1))
    parts = inverse @ values
    middle = len(orders)
    waves = (parts[:middle] - 1j * parts[middle:]) * (transfer(orders) - 1.0)
    changed: Floats = values + basis @ np.concatenate([waves.real, -waves.imag])
    return changed


def even_turns(values: Floats, turns: float, transfer: Transfer) -> Floats:
    """Of a series in even steps through ``turns``, as if it repeated itself then."""
    spectrum = np.fft.rfft(values)
    found: Floats = np.fft.irfft(spectrum * transfer(np.arange(len(spectrum)) / turns), len(values))
    return found


def change_by_spline(values: Floats, angle: Floats, turns: float, transfer: Transfer) -> Floats:
    """What ``transfer`` adds to a dense series that is taken to repeat itself after ``turns``."""
    # Here, so that who only lists the effects does not load it: half of what ``rvwear effects`` takes.
    from scipy.interpolate import CubicSpline

    end = angle[0] + 2.0 * math.pi * turns
    inside = (angle < end) & np.concatenate([[True], np.diff(angle) > 0.0])
    spline = CubicSpline(np.append(angle[inside], end), np.append(values[inside], values[0]), bc_type="periodic")
    regular = np.linspace(angle[0], end, 2 * len(values) + 1)
    before = spline(regular[:-1])
    added = even_turns(before, turns, transfer) - before
    found: Floats = CubicSpline(regular, np.append(added, added[0]), bc_type="periodic")(angle)
    return found


@lru_cache(maxsize=32)
def least_squares(angles: bytes, turns: float) -> tuple[Floats, Floats, Floats]:
    """(cosines and sines at the angles, their coefficients by the values, orders) of the whole orders that samples can tell apart."""
    angle = np.frombuffer(angles)
    orders = np.arange(1.0, max(2.0, 0.5 * TOLD_APART * len(angle) / turns))
    basis = np.hstack([np.cos(np.outer(angle, orders)), np.sin(np.outer(angle, orders))])
    # The mean is an order too, which no resonance changes.
    full = np.column_stack([basis, np.ones(len(angle))])
    inverse = full.T @ np.linalg.inv(full @ full.T + RIDGE * len(angle) * np.eye(len(angle)))
    return basis, inverse[:-1], orders
