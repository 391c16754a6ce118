"""From a record to what the bench is set to, and to the angles at which it is sampled."""

from collections.abc import Hashable, Mapping

import numpy as np

from discrepancy.held_names import LOCKED_AT
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from fmu_src.arrays import Floats

Values = Mapping[str, float]
# Nuisance: the output's lag under load, of that of the base model: one number for all conditions, for what gives way gives way in all of them.
LAG_SHARE = "lag_share"
DEFAULTS = {"temperature": 293.15, "hours": 0.0}


def settings_of(bench: Bench, record: Record) -> list[Floats | float]:
    """Speed, load, temperature and hours, and where the input is locked if that is stated, each one number or one a row."""
    defaults = {**DEFAULTS, "speed": bench.rated_speed, "load": bench.rated_load}
    found = [record.axes.get(name, record.factors.get(name, defaults[name])) for name in ("speed", "load", "temperature", "hours")]
    locked = record.axes.get(LOCKED_AT, record.factors.get(LOCKED_AT))
    return found if locked is None else [*found, locked / abs(bench.ratio) + bench.zeros.get(angle_zero(record), 0.0)]


def row_conditions(bench: Bench, record: Record) -> list[Condition]:
    """The condition of every row (rows may differ in speed, load, temperature, hours, and in where the input is locked)."""
    direction = int(record.factors.get("direction", 1))
    return [Condition(speed, load, temperature, hours, direction, *at) for speed, load, temperature, hours, *at in rows_of(bench, record).tolist()]


def distinct_conditions(bench: Bench, record: Record) -> list[Condition]:
    """Each condition that a row has, once: a record has up to a million rows."""
    rows = rows_of(bench, record)
    direction = int(record.factors.get("direction", 1))
    distinct = dict.fromkeys(map(tuple, rows[: 1 if (rows == rows[0]).all() else None].tolist()))
    return [Condition(speed, load, temperature, hours, direction, *at) for speed, load, temperature, hours, *at in distinct]


def rows_of(bench: Bench, record: Record) -> Floats:
    """Speed, load, temperature and hours of every row (n, 4), and where the input is locked (n, 5) if that is stated."""
    return np.column_stack([np.broadcast_to(c, len(record.values)) for c in settings_of(bench, record)])


def condition_of(bench: Bench, record: Record) -> Condition:
    """The one condition of a record whose rows share it."""
    speed, load, temperature, hours, *at = (c if isinstance(c, float) else float(np.ravel(c)[0]) for c in settings_of(bench, record))
    return Condition(speed, load, temperature, hours, int(record.factors.get("direction", 1)), *at)


def identity(record: Record) -> tuple[Hashable, ...]:
    """What a prediction depends on in a record: equal for runs that repeat each other."""
    axes = tuple((name, np.asarray(axis).tobytes()) for name, axis in sorted(record.axes.items()))
    stated = tuple(sorted(record.factors.items())), tuple(sorted(record.tags.items()))
    return record.quantity, record.mounting, axes, *stated, len(record.values), record.zero_known, record.of_output, record.closed


def angles_of(bench: Bench, record: Record, zero: float) -> Floats:
    """Output angles [rad] of the samples."""
    if "angle" in record.axes:
        return np.asarray(record.axes["angle"], np.float64) + zero
    condition = condition_of(bench, record)
    time = np.asarray(record.axes["time"], np.float64)
    return condition.direction * condition.speed / abs(bench.ratio) * (time - float(time[0])) + zero


def turns_of(bench: Bench, record: Record) -> float:
    """Turns of the output that the samples span."""
    return float(np.ptp(angles_of(bench, record, 0.0))) / (2.0 * np.pi)


def angle_zero(record: Record) -> str:
    """Nuisance: the output angle of the model at which the record's angle is 0."""
    return f"angle_zero[{record.mounting}]"


def zero_of(bench: Bench, record: Record, values: Values) -> float:
    """Angle [rad] by which the model's output is ahead of the record's angle if nothing gave way or turned unevenly."""
    zero = values.get(angle_zero(record), 0.0)
    if not record.of_output:
        return zero
    return zero - values.get(LAG_SHARE, 1.0) * (bench.lag(condition_of(bench, record)) + values.get(lag_added(record), 0.0))


def lag_added(record: Record) -> str:
    """What effects add to the lag of the base model under the record's condition (``lags``)."""
    return f"lag_added[{record.condition}]"


def places_of_zero(record: Record) -> tuple[str, ...]:
    """Names of what ``zero_of`` depends on."""
    return (angle_zero(record), LAG_SHARE, lag_added(record)) if record.of_output else (angle_zero(record),)


def held_condition(bench: Bench, record: Record) -> Condition:
    return at_rest(bench, condition_of(bench, record))


def at_rest(bench: Bench, c: Condition) -> Condition:
    """The held test of a unit that ran at rated speed and load before."""
    return Condition(bench.rated_speed, bench.rated_load, c.temperature, c.hours, locked_at=c.locked_at)
