"""Series of a run in files: CSV with one column per element, or NetCDF."""

import csv
from pathlib import Path
from typing import Any

import numpy as np

from fmu_src.faults import InputFault
from orchestrator import netcdf

SUFFIXES = (".csv", ".nc")


def write_series(series: dict[str, np.ndarray], units: dict[str, str], inputs: dict[str, Any], path: Path) -> Path:
    """CSV or NetCDF by the file's ending; Booleans become 0 and 1."""
    plain = {name: values.astype("i4") if values.dtype == bool else values for name, values in series.items()}
    if path.suffix != ".csv":
        return netcdf.write(netcdf.series_dataset(plain, units, inputs), path)
    columns = flat(plain)
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(".part")
    with partial.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(columns)
        writer.writerows(zip(*(values.tolist() for values in columns.values())))
    partial.replace(path)
    return path


def read_series(path: Path) -> dict[str, np.ndarray]:
    """``time`` and one column per element."""
    if not path.is_file():
        raise InputFault(f"no file at {path}")
    if path.suffix == ".nc":
        try:
            dataset = netcdf.read(path)
        except (OSError, ValueError) as problem:
            raise InputFault(f"{path} is not a result of rvwear run: {problem}") from None
        columns = flat({str(name): values.values for name, values in dataset.variables.items()})
    else:
        columns = read_csv(path)
    if "time" not in columns or len(columns["time"]) == 0:
        raise InputFault(f"{path}: no column 'time', or no rows; it needs one row per time and a column per variable")
    return columns


def read_csv(path: Path) -> dict[str, np.ndarray]:
    with path.open(newline="", encoding="utf-8-sig") as file:
        rows = list(csv.reader(file))
    if not rows:
        raise InputFault(f"{path} is empty")
    for number, row in enumerate(rows[1:], 2):
        if len(row) != len(rows[0]):
            raise InputFault(f"{path}: line {number} has {len(row)} values, the header {len(rows[0])}")
    try:
        values = np.array(rows[1:], float).reshape(len(rows) - 1, len(rows[0]))
    except ValueError as problem:
        raise InputFault(f"{path}: {problem}") from None
    return {name.strip(): column for name, column in zip(rows[0], values.T)}


def flat(series: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Arrays by element: ``plant.mesh.force[1,7]``."""
    columns = {}
    for name, values in series.items():
        for index in np.ndindex(values.shape[1:]):
            label = f"{name}[{','.join(str(i + 1) for i in index)}]" if index else name
            columns[label] = values[(slice(None), *index)]
    return columns
