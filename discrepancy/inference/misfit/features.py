"""Generic functions of a record, by which a misfit is localised without knowing its cause.

Mean; cosines along an axis (place, torque, time); for loops the branch that the axis runs on;
orders of the output's angle, in families whose harmonics belong together.
"""

from collections.abc import Mapping, Sequence
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
FINE = 16


@dataclass(frozen=True)
class Feature:
    """Columns that belong together, in one record."""

    name: str
    columns: Floats


def features(record: Record, orders: Mapping[str, Sequence[float]] = ORDERS, comb: int = COMB) -> list[Feature]:
    """All generic functions of a record."""
    if record.quantity == TABLES:
        return of_orders(record, orders)
    count = np.size(record.values)
    result = [Feature("mean", np.ones((count, 1)))]
    if count < SHORT:
        return result
    angle = order_axis(record)
    if angle is not None:
        turns = np.ptp(angle) / (2 * np.pi)
        highest = 0.9 * np.pi / max(np.median(np.abs(np.diff(angle))), 1e-12)
        named = set()
        for name, family in orders.items():
            inside = [o for o in family if 0.6 / max(turns, 1e-9) <= o <= highest]
            if inside:
                named.update(inside)
                result.append(Feature(f"orders: {name}", waves(angle, inside)))
        spacing = max(1, int(np.ceil(0.8 / max(turns, 1e-9))))
        for order in range(spacing, comb + 1, spacing):
            if order not in named and order <= highest:
                result.append(Feature(f"order {order}", waves(angle, [order])))
    for name, axis in record.axes.items():
        axis = np.asarray(axis, dtype=float)
        if name == "angle" or axis.size != count or not np.all(np.isfinite(axis)) or np.ptp(axis) == 0:
            continue
        if angle is not None and np.all(np.diff(axis) > 0):
            continue
        x = (axis - axis.min()) / np.ptp(axis)
        waves_along = np.column_stack([np.cos(np.pi * j * x) for j in range(1, COSINES + 1)])
        result.append(Feature(f"along {name}", waves_along))
        if count >= 64:
            result.append(Feature(f"finely along {name}", np.column_stack([np.cos(np.pi * j * x) for j in range(COSINES + 1, FINE + 1)])))
        steps = np.gradient(axis)
        if np.any(steps > 0) and np.any(steps < 0):
            branch = np.sign(steps)[:, None]
            result.append(Feature(f"branch of {name}", branch * np.column_stack([np.ones(count), waves_along[:, :2]])))
    return result


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
