"""Where each mounting counts its angles from, by the pattern of the transmission error."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from discrepancy.outlying_samples import bridged
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.cage_ripples import cage_ripples
from discrepancy.prediction.cages import LONG
from discrepancy.prediction.conditions import angle_zero, turns_of
from discrepancy.prediction.curves import signal
from discrepancy.prediction.fewer import fewer
from discrepancy.prediction.order_curves import curve_of, orders_shown
from discrepancy.prediction.over_angle import OverAngle, shifted_errors
from discrepancy.prediction.parabola import vertex
from discrepancy.prediction.whitening import gain
from discrepancy.prediction.zero_bounds import ANYWHERE, ZeroBounds
from discrepancy.problem import ERROR, ORDERS, Record
from fmu_src.arrays import Floats

# Places in a wave of the pattern that fixes where an angle is counted from.
PHASES = 48
SHARES = np.linspace(-0.5, 0.5, PHASES, endpoint=False)
# Samples by which a likely wave is found; of how many of them, and to either side of the nearest, it is looked up which it is.
FEW, LIKELY, NEAREST = 2048, 12, 2
# A campaign's zero is the model's if another place leaves so little less of the misfit, or of the pattern's own variance; chi-square that is no noise's.
OF_MISFIT, OF_PATTERN, SURELY = 0.02, 0.1, 25.0
# Of a misfit that is noise, what cages make that stand elsewhere, at most.
OF_CAGES = 0.25


def angle_zeros(bench: Bench, records: Sequence[Record], wave: float, for_record: Callable[[Record, Mapping[str, float]], dict[str, float]],
                standing: Mapping[str, float], always: bool, known: Mapping[str, float] | None = None,
                bounds: ZeroBounds = ANYWHERE) -> dict[str, float]:  # fmt: skip
    """The output angle [rad] of the model at which a mounting's angle is 0, by its nuisance; one ``wave`` [rad] of the pattern is looked through.

    Of a model with parts that are off waves are not alike: then it is one that leaves least, of those alike that nearest to what is ``known``, or to 0.

    A zero that the campaign shares with the model is none, unless the campaign declares the encoder's phase as unknown (``always``), or the effects of the
    model were fitted beside one. None lies outside of the ``bounds``.
    """
    zeros: dict[str, float] = {}
    for name, record in telling(bench, records).items():
        own = for_record(record, {**zeros, **standing})
        place = 0.0 if known is None else place_in_turn(bench, record, own, wave, known.get(name, bounds.start), bounds)
        if round(place / wave):
            zeros[name] = place
            continue
        shifts = bounds.in_a_wave(SHARES, wave)
        found, left = shown_at(bench, record, own, shifts)
        misfits = [misfit(record, e) for e in left]
        best = int(np.argmin(misfits))
        least, more = misfits[best], misfits[PHASES // 2] - misfits[best]
        # Beside a large effect the pattern is a small part of all misfit: then it counts what its place changes in itself, if noise could not.
        elsewhere = more > OF_PATTERN * float(np.var(found[best])) and gain(left[PHASES // 2], left[best]) > SURELY
        if more > OF_MISFIT * least or elsewhere or always or name in (known or {}):
            zeros[name] = bounds.held(between(shifts, misfits, best))
    return zeros


def place_in_turn(bench: Bench, record: Record, own: dict[str, float], wave: float, near: float, bounds: ZeroBounds = ANYWHERE) -> float:
    """The record's angle 0 [rad] within half a turn of ``near``, or within the ``bounds``: of waves that tell it alike in the nearest."""
    shifts = bounds.waves(SHARES, wave, near)
    few = thinned(record)
    misfits = np.reshape([misfit(few, e) for e in shown_at(bench, few, own, shifts.ravel())[1]], shifts.shape)
    # Waves are told apart by less than a step of phase changes, and than what lies between few nodes.
    # Where many are alike, those about the middle, too: a nearest one is among them.
    middle = int(np.argmin(np.abs(shifts.mean(axis=1) - near)))
    likely = {*np.argsort(misfits.min(axis=1))[:LIKELY].tolist(), *range(max(middle - NEAREST, 0), min(middle + NEAREST + 1, len(shifts)))}
    places = {k: bounds.held(between(shifts[k], misfits[k], int(np.argmin(misfits[k][1:-1])) + 1)) for k in sorted(likely)}
    left = {k: record.values - predicted_at(bench, record, own, at) for k, at in places.items()}
    best = min(left, key=lambda k: misfit(record, left[k]))
    # Rollers, whose cages are not placed yet, make some difference, too: nothing else may tell places apart.
    by_cages = [k for k, e in left.items() if misfit(record, e) <= (1.0 + OF_CAGES) * misfit(record, left[best])]
    nearest_one = min(by_cages, key=lambda k: abs(places[k] - near))
    for k in {best, nearest_one} if nearest_one != best and record.quantity == ERROR else ():
        left[k] = without_cages(bench, record, own, places[k], left[k])
    alike = [k for k, e in left.items() if gain(e, left[best]) <= SURELY or misfit(record, e) <= (1.0 + OF_MISFIT) * misfit(record, left[best])]
    return min((places[k] for k in alike), key=lambda place: abs(place - near))


def likely_in_turn(bench: Bench, record: Record, own: dict[str, float], wave: float, zero: float, bounds: ZeroBounds = ANYWHERE) -> float:
    """About the same as ``place_in_turn`` in a tenth of its time, for a hand that waits: the phase in a wave is that of ``zero``, or the best near it."""
    few = thinned(record)
    turn: Floats = wave * np.arange(-round(np.pi / wave), round(np.pi / wave)).astype(np.float64)
    shares: Floats = wave * SHARES

    def best(*shifts: Floats) -> list[float]:
        """Of each row of places [rad] the one that leaves least."""
        left = iter([misfit(few, e) for e in shown_at(bench, few, own, np.concatenate(shifts))[1]])
        misfits = [np.array([next(left) for _ in row]) for row in shifts]
        return [float(row[np.argmin(off)]) for row, off in zip(shifts, misfits)]

    here, there = best(bounds.among(zero + shares), bounds.among(zero + turn))
    nearby, elsewhere = best(bounds.among(there + shares), bounds.among(here + turn))
    [found] = best(np.concatenate([np.array([here, nearby]), bounds.among(elsewhere + shares)]))
    return found


def without_cages(bench: Bench, record: Record, own: dict[str, float], zero: float, left: Floats) -> Floats:
    """What a record is off (n,) by with its angle 0 at ``zero`` [rad], without what cages that stand elsewhere could make of it."""
    pitch = bench.reducer.topology.roller_pitch
    ahead = cage_ripples(bench, record, {**own, angle_zero(record): zero}, [share * pitch for share in (0.25, 0.5, 0.75)])
    waves = np.column_stack([np.ones(len(left)), ahead[1], ahead[0] - ahead[2]])
    rest: Floats = left - waves @ np.linalg.lstsq(waves, left, rcond=None)[0]
    return rest


def thinned(record: Record) -> Record:
    """The record, or every so many of its samples."""
    step = -(-len(record.values) // FEW)
    if step == 1 or record.quantity == ORDERS:
        return record
    return replace(record, values=record.values[::step], axes={name: np.asarray(axis)[::step] for name, axis in record.axes.items()}, far_off=())


def predicted_at(bench: Bench, record: Record, own: dict[str, float], zero: float) -> Floats:
    """What a record shows with its angle 0 at ``zero`` [rad], as finely as any prediction."""
    shown = signal(OverAngle(bench, curve_of(record), "transmission_error"), {**own, angle_zero(record): zero})
    return orders_shown(record, shown) if record.quantity == ORDERS else shown


def between(places: Floats, misfits: Sequence[float] | Floats, k: int) -> float:
    """Where the least of ``misfits`` at even ``places``, the ``k``-th, would be: of a parabola through three of them.  Behind the last comes the first: places
    in a wave follow each other so, and beyond ``ZeroBounds`` nobody looks."""
    return float(places[k] + vertex(*(misfits[(k + step) % len(misfits)] for step in (-1, 0, 1))) * (places[1] - places[0]))


def best_zeros(bench: Bench, records: Sequence[Record], wave: float, for_record: Callable[[Record, Mapping[str, float]], dict[str, float]],
               values: Mapping[str, float], names: Sequence[str], bounds: ZeroBounds = ANYWHERE) -> tuple[float, dict[str, float]]:  # fmt: skip
    """Those of the zeros ``names`` [rad] that leave least of one record each beside an effect of ``values``, and what they leave, in its variance."""
    shifts = bounds.in_a_wave(SHARES, wave)
    zeros, whole = {}, 0.0
    for name, record in telling(bench, records).items():
        if name in names:
            misfits = [misfit(record, e) / misfit(record, record.values) for e in shown_at(bench, record, for_record(record, values), shifts)[1]]
            best = int(np.argmin(misfits))
            zeros[name], whole = bounds.held(between(shifts, misfits, best)), whole + misfits[best]
    return whole, zeros


def telling(bench: Bench, records: Sequence[Record]) -> dict[str, Record]:
    """By zero the record that tells it, with as many samples as that takes: the pattern hardly depends on the condition."""
    first: dict[str, Record] = {}
    for record in records:
        if tells(record) and not record.left_out:
            first.setdefault(angle_zero(record), record)
    bridges = {name: bridged(record) for name, record in first.items()}
    return {name: fewer(r, turns_of(bench, r)) if r.quantity == ERROR else r for name, r in bridges.items()}


def shown_at(bench: Bench, record: Record, own: dict[str, float], shifts: Floats) -> tuple[list[Floats], list[Floats]]:
    """What a record would show with its angle 0 at each of ``shifts`` [rad], and what that leaves."""
    found = shifted_errors(bench, curve_of(record), own, shifts)
    if record.quantity == ORDERS:
        found = [orders_shown(record, predicted) for predicted in found]
    return found, [record.values - predicted for predicted in found]


def misfit(record: Record, left: Floats) -> float:
    return float(np.mean(left**2) if record.quantity == ORDERS else np.var(left))


def tells(record: Record) -> bool:
    """Whether the pattern shows in a record."""
    return "angle" in record.axes and len(record.values) >= LONG if record.quantity == ERROR else record.quantity == ORDERS
