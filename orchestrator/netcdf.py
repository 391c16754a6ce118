"""Results as NetCDF: every array with its unit, every file with its inputs."""

import json
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from fmu_src.source_hash import source_hash

LIBRARIES = ("llvmlite", "numpy", "scipy", "xarray", "fmpy", "pythonfmu")


def provenance(inputs: dict[str, Any]) -> dict[str, str]:
    """Attributes that say how a result came about."""
    return {
        "inputs": json.dumps(inputs, sort_keys=True),
        "source_hash": source_hash(),
        "software": json.dumps(
            {"rvwear": version("rvwear"), "python": sys.version.split()[0]} | {n: version(n) for n in LIBRARIES}
        ),
    }


def series_dataset(series: dict[str, np.ndarray], units: dict[str, str], inputs: dict[str, Any]) -> xr.Dataset:
    """Series of a run over ``time``; names ``component.signal``."""
    variables = {}
    for name, values in series.items():
        if name != "time":
            axes = tuple(f"{name}_{i}" for i in range(1, values.ndim))
            variables[name] = xr.Variable(("time", *axes), values, {"units": units[name]})
    return xr.Dataset(variables, {"time": ("time", series["time"], {"units": "s"})}, provenance(inputs))


def write(dataset: xr.Dataset, path: Path) -> Path:
    """Write compressed; beside the target first, so that an interruption leaves no half file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(".part")
    encoding = {n: {"zlib": True, "complevel": 4} for n, v in dataset.data_vars.items() if v.ndim}
    dataset.to_netcdf(partial, engine="netcdf4", encoding=encoding)
    partial.replace(path)
    return path


def read(path: Path) -> xr.Dataset:
    """A result file in memory."""
    with xr.open_dataset(path, engine="netcdf4", decode_timedelta=False) as dataset:
        return dataset.load()
