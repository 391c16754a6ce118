"""MATLAB files: up to version 7 through scipy, 7.3 (HDF5) through h5py.

A column is a variable that is a vector (``te``), a field of a structure (``data.te``), or a
column of a matrix, counted from 1 (``data[2]``).
"""

import re
import warnings
from pathlib import Path

import numpy as np
import scipy.io

from discrepancy.campaign.readers import Options, ReadFault, missing_column

HDF = b"\x89HDF\r\n\x1a\n"
COLUMN_OF_MATRIX = re.compile(r"(.+)\[(\d+)\]$")


def read(path: Path, names: set[str], options: Options) -> dict[str, np.ndarray]:
    arrays = hdf_arrays(path) if is_hdf(path) else scipy_arrays(path)
    return {name: vector(arrays, name) for name in sorted(names)}


def is_hdf(path: Path) -> bool:
    """HDF5 files have their signature at byte 0, 512, 1024, 2048 ...: before it is room for a head, MATLAB's for instance."""
    size = path.stat().st_size
    with path.open("rb") as file:
        place = 0
        while place < size:
            file.seek(place)
            if file.read(len(HDF)) == HDF:
                return True
            place = max(512, 2 * place)
    return False


def scipy_arrays(path: Path) -> dict[str, np.ndarray]:
    found: dict[str, np.ndarray] = {}

    def add(name: str, item: object) -> None:
        if isinstance(item, scipy.io.matlab.mat_struct):
            for field, value in vars(item).items():
                if field != "_fieldnames":
                    add(f"{name}.{field}", value)
        else:
            found[name] = np.asarray(item)

    with warnings.catch_warnings():
        # "Returned data may be corrupt", or two variables of one name.
        warnings.simplefilter("error", UserWarning)
        content = scipy.io.loadmat(path, struct_as_record=False, squeeze_me=True)
    for name, item in content.items():
        if not name.startswith("__"):
            add(name, item)
    return found


def hdf_arrays(path: Path) -> dict[str, np.ndarray]:
    import h5py

    found: dict[str, np.ndarray] = {}

    def add(name: str, item: object) -> None:
        if isinstance(item, h5py.Dataset) and not name.startswith("#"):
            # MATLAB stores column by column: its arrays appear transposed.
            found[name.replace("/", ".")] = item[()].T

    with h5py.File(path) as file:
        file.visititems(add)
    return found


def vector(arrays: dict[str, np.ndarray], name: str) -> np.ndarray:
    match = COLUMN_OF_MATRIX.match(name)
    base = match[1] if match else name
    if base not in arrays:
        raise missing_column(name, arrays)
    array = np.squeeze(arrays[base])
    if match:
        number = int(match[2])
        if array.ndim != 2 or not 1 <= number <= array.shape[1]:
            raise ReadFault(f"column {name!r}: {base} has the shape {array.shape}; columns count from 1")
        return array[:, number - 1]
    if array.ndim > 1:
        raise ReadFault(f"column {name!r}: a matrix of shape {array.shape}; name one column of it, {name}[1]")
    return np.atleast_1d(array)


def contents(path: Path) -> dict[str, str]:
    """Vectors and columns of matrices that hold numbers; the format has no units."""
    found: dict[str, str] = {}
    for name, array in (hdf_arrays(path) if is_hdf(path) else scipy_arrays(path)).items():
        array = np.squeeze(array)
        if array.dtype.kind not in "iufb" or array.size < 2 or array.ndim > 2:
            continue
        columns = [name] if array.ndim == 1 else [f"{name}[{k + 1}]" for k in range(array.shape[1])]
        found |= dict.fromkeys(columns, "")
    return found
