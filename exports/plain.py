"""Results as data that every program takes: neither JSON nor Excel has a sign for NaN and infinity."""

import json
import math
from dataclasses import asdict
from typing import Any

import numpy as np
import numpy.typing as npt


def plain(value: Any) -> Any:
    """Of dictionaries, lists, arrays, dataclasses and what is in them: numbers that are not finite become None."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(v) for v in value]
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    if hasattr(value, "__dataclass_fields__"):
        return plain(asdict(value))
    return None if isinstance(value, float) and not math.isfinite(value) else value


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


def plain_json(content: object, indent: int | None = None) -> str:
    """As JSON has it."""
    return json.dumps(plain(content), indent=indent, allow_nan=False, default=str)
