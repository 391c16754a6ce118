"""Numbers of tables without the digits that a conversion of their unit has left."""

from typing import Any

import numpy as np
import numpy.typing as npt

# So many digits a number has that somebody wrote, and a share of it by which conversions of units move it: some tens of its last binary places.
DIGITS, MOVED = 12, 1e-14


def decimal(values: npt.ArrayLike) -> Any:
    """Numbers as they were before their unit was converted: 1450 rpm where 1450.0000000000002 came back; all others keep every digit."""
    found = np.asarray(values)
    if found.dtype.kind != "f":
        return values
    short = np.array([float(f"{value:.{DIGITS}g}") for value in found.flat], found.dtype).reshape(found.shape)
    with np.errstate(invalid="ignore"):
        return np.where(np.abs(short - found) <= MOVED * np.abs(found), short, found)
