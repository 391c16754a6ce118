"""Angles at which runs are computed that repeat each other.

An encoder on the output turns with the error, and one that is read over time is elsewhere each time: the angles of runs that repeat each other lie a
little apart.  Where they are near enough, all are computed at those of the first and interpolated from there, over a small part of a sample's distance.
"""

from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from discrepancy.prediction.support import SplineNodes
from discrepancy.problem import Record
from fmu_src.arrays import Floats

# Angles are near those of another run within this share of the distance of its samples.
NEAR = 0.125
# Of a run that stands for another so many times its samples are computed at most.
MORE = 1.1


@dataclass(frozen=True)
class Stations:
    """Rising ``angles`` (m,) as records count them [rad]; of each sample (n,) its ``place`` among them, and how far ``off`` it lies [rad].

    ``sharers`` are the records that have these angles, each with places of its own.
    """

    angles: Floats
    place: npt.NDArray[np.intp]
    off: Floats
    sharers: list[Record]

    def samples(self, series: Floats, beyond: float) -> Floats:
        """The record's samples of a ``series`` (m,) that is known ``beyond`` [rad] before its angles."""
        if beyond == 0.0 and not self.off.any():
            return series[self.place]
        return SplineNodes(self.angles).samples(series, self.angles[self.place] + self.off + beyond)


def own_stations(angles: Floats) -> Stations:
    """A record's own ``angles`` [rad], in any order."""
    order = np.argsort(angles, kind="stable")
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    return Stations(angles[order], place, np.zeros(len(angles)), [])


def shared_stations(records: Iterable[Record], angles_of: Callable[[Record], Floats]) -> dict[bytes, Stations]:
    """By a record's angles [rad], which ``angles_of`` says, the stations that it shares with others."""
    found: dict[bytes, Stations] = {}
    # Runs under one load may be one run; under others the output stands elsewhere.
    firsts: dict[Hashable, list[Stations]] = {}
    for record in records:
        angles = angles_of(record)
        key, first = angles.tobytes(), firsts.setdefault((record.factors.get("load"), record.factors.get("direction")), [])
        if key not in found:
            own = own_stations(angles)
            if len(angles) < 2 or np.diff(own.angles).min() <= 0.0:
                continue
            near = next((there for known in first if (there := beside(known, angles, own.angles))), None)
            if near is None:
                first.append(own)
            found[key] = near or own
        found[key].sharers.append(record)
    return found


def beside(known: Stations, angles: Floats, rising: Floats) -> Stations | None:
    """Those of another record for samples at ``angles`` [rad], if each of them, ``rising``, is near one of its own there."""
    if not len(angles) <= len(known.angles) <= MORE * len(angles):
        return None
    near = NEAR * float(np.median(np.diff(known.angles)))
    if rising[0] < known.angles[0] - near or rising[-1] > known.angles[-1] + near:
        return None
    after = np.clip(np.searchsorted(known.angles, angles), 1, len(known.angles) - 1)
    place = after - (angles - known.angles[after - 1] < known.angles[after] - angles)
    off = angles - known.angles[place]
    if np.abs(off).max() > near or len(np.unique(place)) < len(place):
        return None
    return Stations(known.angles, place, off, known.sharers)
