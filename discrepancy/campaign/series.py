"""From a file's columns to the arrays of a record: select, convert, drop what is missing, average."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd

from discrepancy.campaign.amount import amount, to_si
from discrepancy.campaign.file_format import Average, Column, Range, Run
from discrepancy.campaign.model import Rows
from discrepancy.campaign.quantities import AXES, ENCODERS, VALUE, Key
from discrepancy.campaign.scales import Scales
from fmu_src.faults import InputFault

Series = dict[str, np.ndarray]


def series_of(run: Run, roles: dict[str, Key], columns: Series, scales: Scales, place: str) -> tuple[Series, Rows]:
    """``value`` and the axes in SI units by their names, and the count of rows."""
    kept = selection(run.where, columns, place)
    found = {}
    for role, column in run.columns.items():
        unit_place = f"{place}.columns.{role}.unit = {column.unit!r}"
        raw = numbers(columns[str(column.column)][kept], column, run.missing, f"{place}.columns.{role}")
        if column.unwrap:
            known = np.isfinite(raw)
            raw[known] = np.unwrap(raw[known], period=to_si("turn", column.unit, f"{unit_place} with unwrap")[0])
        factor, offset = scales.conversion(roles[role], column.unit, unit_place)
        found[role] = factor * column.scale * raw + offset
        require_possible(found[role], roles[role], f"{place}.columns.{role}")
    if found.keys() >= ENCODERS:
        found[VALUE] = found["angle"] - found.pop("input_angle")
    return complete({roles[role].name: column for role, column in found.items()}, run, int(kept.sum()), place)


def require_possible(values: np.ndarray, key: Key, place: str) -> None:
    """A sensor's noise may pass a limit of physics, half of its values may not."""
    known = values[np.isfinite(values)]
    if key.minimum is not None and len(known) and np.median(known) < key.minimum:
        hint = 'use scale = -1, and direction = "reverse"' if key.name == "speed" else "correct unit or scale"
        raise InputFault(
            f"{place}: median {np.median(known):.4g} {key.unit}, below {key.minimum:g}, which {key.key} cannot be; {hint}"
        )


def complete(series: Series, run: Run, selected: int, place: str) -> tuple[Series, Rows]:
    """Without the rows that miss something, averaged if the run says so."""
    whole = np.logical_and.reduce([np.isfinite(column) for column in series.values()])
    series = {name: column[whole] for name, column in series.items()}
    if run.average is not None and whole.any():
        series = averaged(series, run.average, place)
    return series, Rows(selected, selected - int(whole.sum()), len(series[VALUE]))


def selection(where: Mapping[str, float | str | Range], columns: Series, place: str) -> np.ndarray:
    """Rows that meet all conditions of ``where``, in the file's own units."""
    kept = np.ones(len(next(iter(columns.values()))), bool)
    if not len(kept):
        return kept
    for name, wanted in where.items():
        column = columns[name]
        if isinstance(wanted, Range):
            values = pd.to_numeric(pd.Series(column), errors="coerce").to_numpy(float)
            kept &= values >= (-np.inf if wanted.min is None else wanted.min)
            kept &= values <= (np.inf if wanted.max is None else wanted.max)
        elif isinstance(wanted, str):
            kept &= np.char.strip(column.astype(str)) == wanted
        else:
            kept &= pd.to_numeric(pd.Series(column), errors="coerce").to_numpy(float) == wanted
        if not kept.any():
            shown = wanted.model_dump(exclude_none=True) if isinstance(wanted, Range) else wanted
            some = ", ".join(str(v) for v in pd.unique(pd.Series(column))[:10])
            raise InputFault(f"{place}.where.{name} = {shown!r} selects no row; the column holds {some} ...")
    return kept


def numbers(column: np.ndarray, entry: Column, missing: Sequence[float | str], place: str) -> np.ndarray:
    """Floats in the file's unit; NaN where nothing was measured.

    A start is taken off in the file's own type: a clock in ns since 1970 would lose its last
    digits as a float.
    """
    unknown = pd.isna(column)
    if np.issubdtype(column.dtype, np.datetime64):
        column = column.astype("datetime64[ns]").astype(np.int64)
    elif np.issubdtype(column.dtype, np.unsignedinteger):
        column = column.astype(np.int64)
    if np.iscomplexobj(column):
        raise InputFault(f"{place}: column {entry.column!r} is complex; export amplitude or part as a column of its own")
    if not np.issubdtype(column.dtype, np.number) or np.issubdtype(column.dtype, np.bool_):
        column = from_text(column, entry, missing, place)
    absent = unknown | np.isin(column, [float(m) for m in missing if not isinstance(m, str)])
    if entry.from_start and len(known := np.flatnonzero(~absent & ~pd.isna(column))):
        column = column - column[known[0]]
    values = column.astype(float)
    values[absent] = np.nan
    return values


def from_text(column: np.ndarray, entry: Column, missing: Sequence[float | str], place: str) -> np.ndarray:
    """Numbers out of a column in which some cell is a text."""
    texts = pd.Series(column)
    values = pd.to_numeric(texts, errors="coerce")
    listed = texts.astype(str).str.strip().isin([m for m in missing if isinstance(m, str)])
    bad = texts[values.isna() & texts.notna() & ~listed]
    if len(bad):
        raise InputFault(
            f"{place}: column {entry.column!r}, row {bad.index[0] + 1}: {bad.iloc[0]!r} is not a number; correct it, list"
            f" it in missing = [{str(bad.iloc[0])!r}] if nothing was measured, state decimal and thousands (\",\" or \".\") if it is one, or"
            " units_line = true if it is a unit"
        )
    return values.to_numpy(float)


def averaged(series: Series, average: Average, place: str) -> Series:
    """Means of neighbouring rows: of so many points, or of bins along an axis."""
    size = len(series[VALUE])
    if (average.points is None) == (average.width is None):
        raise InputFault(f'{place}.average: give either points = 20, or axis = "angle" with width = "0.5 deg"')
    if average.points is not None:
        # An incomplete last group would have another noise than the rest.
        group = np.arange(size // average.points * average.points) // average.points
        if not len(group):
            raise InputFault(f"{place}.average.points = {average.points}: the run has only {size} rows; take fewer")
    else:
        axis = next((key for key in AXES if key.name == average.axis), None)
        if axis is None or axis.name not in series:
            raise InputFault(f"{place}.average.axis = {average.axis!r}: not an axis of this run; it has {', '.join(series)}")
        if axis.name == "torque":
            raise InputFault(f"{place}.average.axis = 'torque': a loop passes each torque twice; use points = ...")
        width = amount(average.width, axis.unit, f"{place}.average.width")
        if not width > 0.0:
            raise InputFault(f"{place}.average.width = {average.width!r}: must be positive")
        _, group = np.unique(np.floor(series[axis.name] / width), return_inverse=True)
    count = np.bincount(group)
    return {name: np.bincount(group, column[: len(group)]) / count for name, column in series.items()}
