"""Names for NumPy's types of arrays, and the fields of records."""

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Mask = npt.NDArray[np.bool_]
# Of the plane, as complex numbers.
Points = npt.NDArray[np.complex128]
# One or several records; what is in their fields NumPy's typing cannot say.
Records = npt.NDArray[np.void]


def field_of(record: np.dtype, name: str) -> tuple[np.dtype, int]:
    """(type, place in bytes) of a field of a structured type."""
    assert record.fields is not None
    kind, place = record.fields[name][:2]
    return kind, place


def copied(records: Records) -> Records:
    """A copy of one or several records, byte by byte: NumPy goes through their fields, which takes forty times as long."""
    found = np.ndarray(records.shape, records.dtype, bytearray(records.view(np.uint8)))
    return found if type(records) is np.ndarray else found.view(type(records))
