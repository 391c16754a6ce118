"""A forecast as tables for other programs: what was known after each inspection, and the readings."""

from collections.abc import Sequence

from discrepancy.forecast.forecast import Forecast, Range
from discrepancy.forecast.readings import Inspections, Limit
from exports.tables import Table, rows_table

# What a row holds, each with middle and ends of its interval, and its unit; {} is that of the readings.
RANGES = {"remaining": "h", "level": "{}", "rate": "{}/h", "first_level": "{}", "run_in_ratio": "1", "run_in_time": "h"}


def forecast_tables(forecasts: Sequence[Forecast], found: Inspections, limit: Limit) -> list[Table]:
    """A row an inspection; a row a reading, with what is expected there where it was not used."""
    units = {name: unit.format(limit.unit) for name, unit in RANGES.items()}
    rows = [
        {"hours": f.hours, "readings": f.readings, **{key: value for name in RANGES for key, value in columns(name, getattr(f, name)).items()},
         "never_reached": f.beyond}
        for f in forecasts
    ]  # fmt: skip
    heads = {"hours": "h"} | {key: unit for name, unit in units.items() for key in columns(name, None)}
    nothing = Range(float("nan"), float("nan"), float("nan"))
    later = forecasts[-1].later
    readings = [
        {"hours": r.hours, "value": r.value, "noise": r.noise, "used": used, **columns("expected", nothing if used else later[r.hours])}
        for used, some in ((True, found.readings), (False, found.held_out)) for r in some
    ]  # fmt: skip
    own = dict.fromkeys(("value", "noise", *columns("expected", None)), limit.unit) | {"hours": "h"}
    return [rows_table("forecast", rows, heads), rows_table("readings", readings, own)]


def columns(name: str, found: Range | None) -> dict[str, float]:
    """``name`` for the middle, with ``_low`` and ``_high`` for the ends."""
    found = found or Range(0.0, 0.0, 0.0)
    return {name: found.middle, f"{name}_low": found.low, f"{name}_high": found.high}
