"""Whether a loop was gone round before: then it begins where it ends, not where a reducer that was at rest would.

A bench that cycles the torque and writes a whole cycle from no torque on begins at the side of the play, and of what friction holds back,
from which the cycle before had come.
"""

from typing import NamedTuple

import numpy as np

from fmu_src.arrays import Floats

# Of the range of the torque: what is nearer has the torque of the start.
SAME = 0.02
# A loop that ends this much before the torque of its start is followed on along its last step: benches leave out samples about no torque.
BEFORE = 0.04
# Of how far the branches stand apart at that torque: a loop from rest begins half-way between them.
NEARER = 0.25
# Branches no further apart than so many deviations of the samples cannot be told; from so many on there is no doubt.
TOLD, SURELY = 4.0, 12.0
# A first branch is held against a later one by the mean of so many samples; it joins it before this share of its way, or something drifts.
TOGETHER, JOINED = 5, 0.7
# Branches at the opposite torque may lie otherwise by a share of the range of the turning: those that are nearer leave a doubt.
OTHERWISE = 0.05


def is_closed(torques: Floats, turning: Floats) -> bool:
    """Whether the start of a loop (``torques`` [N m] in the order in which they were applied, ``turning`` of the output) lies on the branch that passes
    its torque the same way later; False where none does, as of a loop that begins at its largest torque, and where no play shows."""
    found = branches_at_start(torques, turning)
    if found is None:
        return False
    return bool(found.apart > TOLD * scatter(turning) and abs(turning[0] - found.same) < NEARER * found.apart)


def uncertain(torques: Floats, turning: Floats) -> int:
    """How many of the first samples hang on whether the loop was gone round before, where its branches lie too near to tell."""
    found = branches_at_start(torques, turning)
    if found is None or found.apart > (OTHERWISE * np.ptp(turning) if found.mirrored else SURELY * scatter(turning)):
        return 0
    return int(np.argmax(np.abs(torques - torques[0]) > BEFORE * np.ptp(torques)))


def joined_after(torques: Floats, turning: Floats) -> float:
    """How far the torque [N m] of a loop that begins on neither branch goes before its way joins the branch that passes there the same way later: so far
    it hangs on what was done before.  0 where none passes, or where it never joins: then something drifts."""
    way = way_of(torques)
    turned = first_turn(way)
    come = np.flatnonzero((way[turned:-1] < 0.0) & (way[turned + 1 :] >= 0.0)) + turned
    if not len(come):
        return 0.0
    later = slice(come[-1], come[-1] + 1 + first_turn(way[come[-1] :]))
    covered = int(np.searchsorted(np.maximum.accumulate(way[: turned + 1]), way[later].max(), side="right"))
    if covered < TOGETHER or len(way[later]) < TOGETHER:
        return 0.0
    order = np.argsort(way[later], kind="stable")
    off = turning[:covered] - np.interp(way[:covered], way[later][order], turning[later][order])
    means = np.convolve(off, np.full(TOGETHER, 1.0 / TOGETHER), "valid")
    apart = np.flatnonzero(np.abs(means) > TOLD * scatter(turning) * (2.0 / TOGETHER) ** 0.5)
    there = float(way[apart[-1] + TOGETHER - 1]) if len(apart) else 0.0
    return there if there < JOINED * way[:covered].max() else 0.0


def way_of(torques: Floats) -> Floats:
    """How far torques [N m] are from the first one, the way that they begin to go."""
    way: Floats = first_sense(torques) * (torques - torques[0])
    return way


def first_turn(way: Floats) -> int:
    """The sample at which a ``way`` that rises turns back, by more than a sensor's noise."""
    highest = np.maximum.accumulate(way)
    back = np.flatnonzero(way < highest - SAME * np.ptp(way))
    return int(np.argmax(way[: back[0]])) if len(back) else len(way) - 1


class Branches(NamedTuple):
    """The turning where a loop passes the torque of its start the same way later, and the other way; ``mirrored``: by those at the opposite torque."""

    same: float
    opposite: float
    mirrored: bool

    @property
    def apart(self) -> float:
        return abs(self.opposite - self.same)


def branches_at_start(torques: Floats, turning: Floats) -> Branches | None:
    """Both ways at the torque of the start; None where the loop does not pass it again.

    A bench that writes nothing about no torque has not passed it again at the end, and the play may lie between: they are those at the opposite
    torque, the other way round.
    """
    sense, start = first_sense(torques), torques[0]
    same, opposite = (passing(way * (torques - start), turning) for way in (sense, -sense))
    if same is None or opposite is None:
        return None
    if torques[-1] * start < 0.0:
        there, back = (passing(way * (torques + start), turning) for way in (sense, -sense))
        if there is not None and back is not None:
            return Branches(opposite + there - back, opposite, True)
    return Branches(same, opposite, False)


def scatter(turning: Floats) -> float:
    """Standard deviation of samples about a smooth curve, by the middle one of their second differences."""
    return float(np.median(np.abs(np.diff(turning, 2)))) / (0.6745 * 6.0**0.5) if len(turning) > 2 else 0.0


def first_sense(torques: Floats) -> float:
    """Whether the torque begins to rise (1) or to fall (-1); 0 if it does neither."""
    moved = torques[np.abs(torques - torques[0]) > SAME * np.ptp(torques)]
    return float(np.sign(moved[0] - torques[0])) if len(moved) else 0.0


def passing(beyond: Floats, turning: Floats) -> float | None:
    """The turning where ``beyond`` comes to 0 from below for the last time, or so near to it that its way there is plain; None if it does not."""
    near = -BEFORE * float(np.ptp(beyond))
    come = np.flatnonzero((beyond[:-1] < near) & (beyond[1:] >= near))
    if not len(come):
        return None
    there = np.flatnonzero(beyond[come[-1] :] >= 0.0)
    at = come[-1] + there[0] if len(there) else len(beyond) - 1
    step = beyond[at] - beyond[at - 1]
    return float(turning[at] - (beyond[at] / step * (turning[at] - turning[at - 1]) if step > 0.0 else 0.0))
