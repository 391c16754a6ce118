"""Try: runs with as many samples as a screen shows."""

import math
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from discrepancy.problem import Record

# Samples of the curve that follows the hand: more than a screen is wide make no picture better.
FEW = 1200


def thinned(record: Record) -> Record:
    """A run with the samples that are ``kept_of`` it."""
    kept, every = kept_of(record), len(record.values)
    if len(kept) == every:
        return record
    axes = {k: np.asarray(v)[kept] if np.size(v) == every else v for k, v in record.axes.items()}
    return replace(record, values=np.asarray(record.values)[kept], axes=axes)


def kept_of(record: Record) -> npt.NDArray[np.intp]:
    """Of an angle the first turn alone, for a line through few samples of many waves shows none of them."""
    kept = np.arange(len(record.values))
    if "angle" in record.axes and len(kept) > FEW:
        angle = np.abs(np.asarray(record.axes["angle"]) - record.axes["angle"][0])
        kept = np.flatnonzero(angle < 2.0 * math.pi) if angle.max() > 2.0 * math.pi else kept
    return kept[:: max(1, math.ceil(len(kept) / FEW))]
