"""What knows no physics, on the same conditions: a mean for each order, a full quadratic, gradient-boosted trees."""

import importlib.util
from collections.abc import Callable, Sequence

import numpy as np

from discrepancy.problem import Record
from fmu_src.arrays import Floats

TREES = "gradient-boosted trees"
# Of scikit-learn's estimator; depth and rate as it has them.
ROUNDS = 100


def numbers(records: Sequence[Record]) -> tuple[Floats, Floats]:
    """(orders and parts as columns, amplitudes [rad] by record): not a number where a record lacks one."""
    columns = sorted({(o, p) for r in records for o, p in zip(r.axes["order"], r.axes["part"])})
    table = np.full((len(records), len(columns)), np.nan)
    for row, r in zip(table, records):
        for o, p, value in zip(r.axes["order"], r.axes["part"], r.values):
            row[columns.index((o, p))] = value
    return np.array(columns), table


def settings(records: Sequence[Record]) -> Floats:
    """Torque, speed of the input and temperature of each record, each of the size of 1."""
    return np.array([(r.factors["load"] / 1800.0, r.factors["speed"] / 188.5, (r.factors["temperature"] - 303.15) / 5.0) for r in records])


def full_quadratic(x: Floats) -> Floats:
    """(n, 10): one, three settings, their squares and products."""
    first = np.column_stack([np.ones(len(x)), x])
    return np.column_stack([first, *(x[:, i] * x[:, j] for i in range(3) for j in range(i, 3))])


def by_quadratic(x: Floats, y: Floats, at: Floats) -> Floats:
    return full_quadratic(at) @ np.linalg.lstsq(full_quadratic(x), y, rcond=1e-8)[0]


def by_mean(x: Floats, y: Floats, at: Floats) -> Floats:
    return np.full(len(at), y.mean())


def by_trees(x: Floats, y: Floats, at: Floats) -> Floats:
    from sklearn.ensemble import GradientBoostingRegressor

    size = float(np.std(y)) or 1.0
    trees = GradientBoostingRegressor(n_estimators=ROUNDS, random_state=0).fit(x, y / size)
    return np.asarray(trees.predict(at), np.float64) * size


RIVALS: dict[str, Callable[[Floats, Floats, Floats], Floats]] = {"mean of each order": by_mean, "full quadratic of each order": by_quadratic}
MISSING = ""
if importlib.util.find_spec("sklearn"):
    RIVALS[TREES] = by_trees
else:
    MISSING = f'{TREES} are left out: scikit-learn is not installed (pip install "rvwear[rivals]")'


def predictions(name: str, records: Sequence[Record], training: Sequence[int], asked: Sequence[int]) -> dict[int, Floats]:
    """What a rival that saw the ``training`` records says of those that are ``asked``; each sense of rotation has its own."""
    columns, table = numbers(records)
    x = settings(records)
    found = np.full(table.shape, np.nan)
    for direction in (1.0, -1.0):
        given, at = ([i for i in which if records[i].factors["direction"] == direction] for which in (training, asked))
        if not at:
            continue
        for k in range(len(columns)):
            has = [i for i in given if np.isfinite(table[i, k])]
            found[at, k] = RIVALS[name](x[has], table[has, k], x[at])
    places = {tuple(column): k for k, column in enumerate(columns)}
    return {i: np.array([found[i, places[o, p]] for o, p in zip(records[i].axes["order"], records[i].axes["part"])]) for i in asked}


def count(name: str, records: Sequence[Record]) -> str:
    """How many numbers were fitted, both senses together."""
    numbers_of_a_curve = len(numbers(records)[0])
    each = {"mean of each order": 1, "full quadratic of each order": 10}.get(name)
    return "thousands" if each is None else str(2 * numbers_of_a_curve * each)
