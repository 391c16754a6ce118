"""What a result exports: tables of columns with units."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr


@dataclass(frozen=True)
class Column:
    """``values`` (n,) in ``unit``; "1" or "" for what has none."""

    name: str
    unit: str
    values: Any

    @property
    def head(self) -> str:
        """Name and unit as files show them: ``torque [N.m]``, which ``rvwear campaign from`` reads back."""
        return self.name if self.unit in ("", "1") else f"{self.name} [{self.unit}]"


@dataclass(frozen=True)
class Table:
    """``note``: what one has to know of its numbers, which goes with them into a file."""

    name: str
    columns: tuple[Column, ...]
    note: str = ""

    def frame(self) -> pd.DataFrame:
        """One row an entry, heads with units."""
        frame = pd.DataFrame({column.head: column.values for column in self.columns})
        if self.note:
            frame.attrs["note"] = self.note
        return frame


def figure_table(figures: Mapping[str, Any], unit_of: Mapping[str, str], name: str = "figures") -> Table:
    """Single numbers, a row each."""
    return Table(name, (
        Column("figure", "", list(figures)), Column("value", "", list(figures.values())), Column("unit", "", [unit_of.get(key, "1") for key in figures]),
    ))  # fmt: skip


def rows_table(name: str, rows: Sequence[Mapping[str, Any]], units: Mapping[str, str]) -> Table:
    """Rows that have the same keys; nothing at all where there are none."""
    keys = list(rows[0]) if rows else []
    return Table(name, tuple(Column(key, units.get(key, ""), [row[key] for row in rows]) for key in keys))


def tables_of(dataset: xr.Dataset) -> list[Table]:
    """Variables that share their first dimension stand side by side, arrays as ``mesh_force[1,7]``; single numbers as a table of figures.

    What is spread over two or more large dimensions (surfaces over hours) is a table of its own, a row a value.
    """
    found = []
    single = {str(name): v for name, v in dataset.data_vars.items() if not v.dims}
    groups: dict[str, list[str]] = {}
    for name, variable in dataset.data_vars.items():
        if variable.dims and not is_long(dataset, variable):
            groups.setdefault(str(variable.dims[0]), []).append(str(name))
    for dimension, names in groups.items():
        columns = axis_columns(dataset, dimension)
        for name in names:
            columns += spread(name, dataset[name])
        found.append(Table(dimension, tuple(columns)))
    found += [long_table(dataset, str(name)) for name, v in dataset.data_vars.items() if is_long(dataset, v)]
    if single:
        found.append(figure_table({n: v.item() for n, v in single.items()}, {n: str(v.attrs.get("units", "1")) for n, v in single.items()}))
    return found


# More columns than this are no table to read: rows are taken instead.
MOST_COLUMNS = 250


def is_long(dataset: xr.Dataset, variable: xr.DataArray) -> bool:
    return int(np.prod(variable.shape[1:])) > MOST_COLUMNS


def axis_columns(dataset: xr.Dataset, dimension: str) -> list[Column]:
    """Coordinates along a dimension; its numbers from 1 where there are none."""
    own = [Column(str(n), str(c.attrs.get("units", "1")), c.values) for n, c in dataset.coords.items() if c.dims == (dimension,)]
    return own or [Column(dimension, "1", np.arange(1, dataset.sizes[dimension] + 1))]


def spread(name: str, variable: xr.DataArray) -> list[Column]:
    """A column for each element of the further dimensions, counted from 1."""
    unit = str(variable.attrs.get("units", "1"))
    if variable.ndim == 1:
        return [Column(name, unit, variable.values)]
    places = product(*(range(n) for n in variable.shape[1:]))
    rows = variable.values.reshape(len(variable), -1).T
    return [Column(f"{name}[{','.join(str(k + 1) for k in place)}]", unit, row) for place, row in zip(places, rows)]


def long_table(dataset: xr.Dataset, name: str) -> Table:
    """A row a value, with where it stands."""
    variable = dataset[name]
    numbers = np.indices(variable.shape).reshape(variable.ndim, -1)
    columns = []
    for dimension, index in zip(variable.dims, numbers):
        columns += [Column(c.name, c.unit, np.asarray(c.values)[index]) for c in axis_columns(dataset, str(dimension))]
    return Table(name, (*columns, Column(name, str(variable.attrs.get("units", "1")), variable.values.reshape(-1))))
