"""Results as NetCDF: every array with its unit, every file with its inputs."""

import json
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from fmu_src.checked_file import replacing, require_seal, seal
from fmu_src.faults import InputFault, RunFault, nearest_path
from fmu_src.reading import reading, require_size
from fmu_src.reading_apart import plain, read_apart, restored
from fmu_src.source_hash import source_hash

# Attribute of a file that ends with its checksum, and the most that is read [bytes] (assumed: the longest lives take a tenth).
SEALED = "sha256 of all bytes before the last line, in the last line"
MOST = 1_000_000_000
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
    """Write compressed, whole or not at all, with a checksum behind the end that NetCDF knows."""
    encoding = {n: {"zlib": True, "complevel": 4} for n, v in dataset.data_vars.items() if v.ndim}
    with replacing(path) as partial:
        try:
            dataset.assign_attrs(checksum=SEALED).to_netcdf(partial, engine="netcdf4", encoding=encoding)
        except RuntimeError as problem:
            # What the NetCDF library makes of a full disk.
            raise RunFault(f"{path} was not written: {problem}; what stood there before is unharmed. Make room, or choose another place") from None
        seal(partial)
    return path


def read(path: Path) -> xr.Dataset:
    """A result file in memory; Damaged if it is not what was written, InputFault if it is none.  Others' NetCDF files have no checksum."""
    if not path.is_file():
        raise InputFault(f"no result file at {path}{nearest_path(path)}; rvwear life and rvwear run write one")
    with reading(path, "a NetCDF file"):
        require_size(path, MOST)
        if SEALED.encode() in path.read_bytes():
            require_seal(path)
            return opened(path)
        # What others wrote may be more than the library can bear.
        content = restored(read_apart("orchestrator.netcdf:read_plain", path))
        return xr.Dataset({name: (dimensions, values) for name, (dimensions, values) in content["variables"].items()}, attrs=content["attributes"])


def opened(path: Path) -> xr.Dataset:
    with xr.open_dataset(path, engine="netcdf4", decode_times=False) as dataset:
        if sum(variable.nbytes for variable in dataset.variables.values()) > MOST:
            raise InputFault(f"{path}: more than {MOST / 1e9:g} GB of values; write fewer of them")
        return dataset.load()


def read_plain(path: Path) -> dict[str, Any]:
    """A NetCDF file as data: {"variables": {name: (dimensions, values)}, "attributes": {name: text}}."""
    with reading(path, "a NetCDF file"):
        dataset = opened(path)
    variables = {str(name): [[str(d) for d in v.dims], plain(np.asarray(v.values))] for name, v in dataset.variables.items()}
    return {"variables": variables, "attributes": {str(name): str(value) for name, value in dataset.attrs.items()}}
