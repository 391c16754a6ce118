"""Generic functions of a record, by which a misfit is localised without knowing its cause.

Mean; cosines along an axis (place, torque, time); for loops the branch that the axis runs on;
orders of the output's angle, in families whose harmonics belong together.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from discrepancy.inference.noise.noise import SHORT
from discrepancy.inference.noise.series import order_axis
from discrepancy.problem import ORDERS as TABLES
from discrepancy.problem import Record
from fmu_src.arrays import Floats

ORDERS: dict[str, tuple[float, ...]] = {
    "output shaft": (1, 2),
    "crank, absolute": (39,),
    "crank against carrier": (40, 80),
    "ring pins": (78, 156, 234),
    "sun": (120, 121),
    "first mesh": (1440,),
    "pin mesh": (1560,),
}
"""Orders per revolution of the output of the RV20E-121."""
COMB = 60
COSINES = 5
# Of a spectrum: half the width of a line, and the highest order that is looked at by itself.
HALF, MOST_LINES = 0.5, 400
FINE = 16


@dataclass(frozen=True)
class Feature:
    """Columns that belong together, in one record."""

    name: str
    columns: Floats


def features(record: Record, orders: Mapping[str, Sequence[float]] = ORDERS, comb: int = COMB) -> Iterator[Feature]:
    """All generic functions of a record, one after the other: together they are a hundred times its values."""
    if record.quantity == TABLES:
        yield from of_orders(record, orders)
        return
    count = np.size(record.values)
    yield Feature("mean", np.ones((count, 1)))
    if count < SHORT:
        # A table over some speeds or hours.
        for name, x in along(record).items():
            levels = np.unique(np.round(x, 9)).size
            yield Feature(f"along {name}", cosines(x, 1, min(COSINES, levels - 1)))
        return
    angle = order_axis(record)
    if angle is not None:
        turns, highest = shown(angle)
        named = set()
        for name, family in orders.items():
            inside = [o for o in family if 0.6 / max(turns, 1e-9) <= o <= highest]
            if inside:
                named.update(inside)
                yield Feature(f"orders: {name}", waves(angle, inside))
        spacing = max(1, int(np.ceil(0.8 / max(turns, 1e-9))))
        step, wave = np.exp(1j * spacing * angle), np.ones(count, complex)
        for order in range(spacing, comb + 1, spacing):
            # Each is the one before times the first: a cosine takes ten times as long.
            wave *= step
            if order not in named and order <= highest:
                yield Feature(f"order {order}", np.column_stack([wave.real, wave.imag]))
    if "order" in record.axes:
        yield from lines(np.asarray(record.axes["order"], float), orders)
    for name, x in along(record).items():
        waves_along = cosines(x, 1, COSINES)
        yield Feature(f"along {name}", waves_along)
        if count >= 64:
            yield Feature(f"finely along {name}", cosines(x, COSINES + 1, FINE))
        steps = np.gradient(np.asarray(record.axes[name], dtype=float))
        if np.any(steps > 0) and np.any(steps < 0):
            branch = np.sign(steps)[:, None]
            yield Feature(f"branch of {name}", branch * np.column_stack([np.ones(count), waves_along[:, :2]]))


def cosines(x: Floats, lowest: int, highest: int) -> Floats:
    """Half waves along ``x`` (n,) from 0 to 1, a column each."""
    return np.column_stack([np.cos(np.pi * j * x) for j in range(lowest, highest + 1)])


def lines(order: Floats, orders: Mapping[str, Sequence[float]]) -> Iterator[Feature]:
    """Lines of a spectrum over ``order``: those of known parts together, every other whole order by itself."""
    named = set()
    for name, family in orders.items():
        inside = [o for o in family if np.any(np.abs(order - o) < HALF)]
        if inside:
            named.update(inside)
            yield Feature(f"orders: {name}", np.column_stack([np.abs(order - o) < HALF for o in inside]).astype(float))
    for o in range(max(1, int(np.ceil(order.min()))), min(int(order.max()), MOST_LINES) + 1):
        here = np.abs(order - o) < HALF
        if o not in named and here.any():
            yield Feature(f"order {o}", here[:, None].astype(float))


def shown(angle: Floats) -> tuple[float, float]:
    """Turns of an angle [rad], and the highest order that its samples show."""
    return float(np.ptp(angle)) / (2 * np.pi), float(0.9 * np.pi / max(np.median(np.abs(np.diff(angle))), 1e-12))


def along(record: Record) -> dict[str, Floats]:
    """Axes (n,) from 0 to 1 along which cosines are laid; not the angle, nor what rises beside it."""
    found = {}
    angle = order_axis(record)
    for name, axis in record.axes.items():
        axis = np.asarray(axis, dtype=float)
        if name == "angle" or axis.size != np.size(record.values) or not np.all(np.isfinite(axis)) or np.ptp(axis) == 0:
            continue
        if angle is not None and np.all(np.diff(axis) > 0):
            continue
        found[name] = (axis - axis.min()) / np.ptp(axis)
    return found


def samples_of_a_wave(record: Record, orders: Mapping[str, Sequence[float]] = ORDERS) -> float:
    """Samples of the shortest wave among the functions of a record."""
    shortest = [float(np.size(record.values))]
    angle = order_axis(record)
    if angle is not None:
        _, highest = shown(angle)
        finest = max([o for family in orders.values() for o in family if o <= highest] + [min(float(COMB), highest)])
        shortest.append(2.0 * highest / (0.9 * finest))
    shortest += [2.0 / (FINE * max(float(np.median(np.abs(np.diff(x)))), 1e-12)) for x in along(record).values() if x.size > 1]
    return min(shortest)


def of_orders(record: Record, orders: Mapping[str, Sequence[float]]) -> list[Feature]:
    """Each order of a table, its two numbers together."""
    order = np.asarray(record.axes["order"], float)
    named = {o: f"{name}, {o:g}" for name, family in orders.items() for o in family}
    return [Feature(f"orders: {named.get(o, f'{o:g}')}", np.eye(order.size)[:, order == o]) for o in np.unique(order).tolist()]


def waves(angle: Floats, orders: Sequence[float]) -> Floats:
    """Cosines and sines."""
    return np.column_stack([f(o * angle) for o in orders for f in (np.cos, np.sin)])


def modulations(records: Sequence[Record]) -> dict[str, Floats]:
    """Functions of the conditions, by name: (n_records, m), each constant within a record and centred but the first."""
    result = {"everywhere": np.ones((len(records), 1))}
    names = sorted({n for r in records for n in r.factors})
    for name in names:
        values = np.array([r.factors.get(name, np.nan) for r in records], dtype=float)
        if not np.all(np.isfinite(values)):
            continue
        levels = np.unique(np.round(values, 12))
        if levels.size < 2 or np.ptp(values) <= 1e-9 * np.max(np.abs(values)):
            continue
        x = (values - values.mean()) / values.std()
        columns = [x]
        if levels.size >= 3:
            square = x**2 - np.polyval(np.polyfit(x, x**2, 1), x)
            if np.std(square) > 1e-6:
                columns.append(square / np.std(square))
        basis = np.column_stack(columns)
        # factors that always change together are one
        if not any(_aliased(basis[:, 0], other[:, 0]) for k, other in result.items() if k != "everywhere"):
            result[name] = basis
    return result


def _aliased(a: Floats, b: Floats) -> bool:
    return bool(abs(np.corrcoef(a, b)[0, 1]) > 0.999)
