"""Series of a run in files: CSV with one column per element, or NetCDF."""

import csv
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from fmu_src.checked_file import replacing
from fmu_src.faults import InputFault
from fmu_src.reading import read_text, reading, shown
from orchestrator import netcdf

if TYPE_CHECKING:
    import xarray as xr

SUFFIXES = (".csv", ".nc")
# Bytes of a CSV file, and columns (assumed).
MOST_TEXT, MOST_COLUMNS = 300_000_000, 1_000_000


def write_series(series: dict[str, np.ndarray], units: dict[str, str], inputs: dict[str, Any], path: Path) -> Path:
    """CSV or NetCDF by the file's ending; Booleans become 0 and 1."""
    plain = {name: values.astype("i4") if values.dtype == bool else values for name, values in series.items()}
    if path.suffix != ".csv":
        return netcdf.write(netcdf.series_dataset(plain, units, inputs), path)
    columns = flat(plain)
    with replacing(path) as partial, partial.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*(values.tolist() for values in columns.values())))
    return path


def read_series(path: Path) -> dict[str, np.ndarray]:
    """``time`` and one column per element."""
    if not path.is_file():
        raise InputFault(f"no file at {path}")
    with reading(path, "the series of a run", "rvwear run writes one"):
        columns = series_of(netcdf.read(path)) if path.suffix == ".nc" else read_csv(path)
        require_series(columns, path)
    return columns


def series_of(dataset: "xr.Dataset") -> dict[str, np.ndarray]:
    """What a result file has over the time, by element."""
    series = {str(name): values for name, values in dataset.variables.items() if "time" in values.dims[:1]}
    elements = sum(int(np.prod(values.shape[1:])) for values in series.values())
    if elements > MOST_COLUMNS:
        raise InputFault(f"{elements} elements over the time, more than {MOST_COLUMNS}: record fewer")
    return flat({name: values.values for name, values in series.items()})


def require_series(columns: dict[str, np.ndarray], path: Path) -> None:
    """InputFault unless there is a number for each time and variable, and at least one variable."""
    if "time" not in columns or len(columns["time"]) == 0:
        raise InputFault(f"{path}: no column 'time', or no rows; it needs one row per time and a column per variable")
    if len(columns) == 1:
        raise InputFault(f"{path}: nothing but the time: it needs a column per variable")
    for name, values in columns.items():
        if values.dtype.kind not in "fiub":
            raise InputFault(f"{path}: {shown(name)} holds no numbers")
        bad = np.flatnonzero(~np.isfinite(values))
        if len(bad):
            where = "" if name == "time" else f" at time {columns['time'][bad[0]]:g} s"
            raise InputFault(f"{path}: {shown(name)} = {values[bad[0]]}{where} (row {bad[0] + 1}): a finite number is needed; leave the column out")


def read_csv(path: Path) -> dict[str, np.ndarray]:
    rows = list(csv.reader(read_text(path, "reference file", "rvwear run writes one", MOST_TEXT).splitlines()))
    if not rows:
        raise InputFault(f"{path} is empty")
    names = [name.strip() for name in rows[0]]
    if twice := {name for name in names if names.count(name) > 1}:
        raise InputFault(f"{path}: {shown(', '.join(sorted(twice)))}: more than one column of this name; leave one")
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(rows[0]):
            raise InputFault(f"{path}: line {number} has {len(row)} values, the header {len(rows[0])}")
    try:
        values = np.array(rows[1:], float).reshape(len(rows) - 1, len(rows[0]))
    except ValueError as problem:
        raise InputFault(f"{path}: {problem}") from None
    return dict(zip(names, values.T))


def flat(series: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Arrays by element: ``plant.mesh.force[1,7]``."""
    columns = {}
    for name, values in series.items():
        for index in np.ndindex(values.shape[1:]):
            label = f"{name}[{','.join(str(i + 1) for i in index)}]" if index else name
            columns[label] = values[(slice(None), *index)]
    return columns
