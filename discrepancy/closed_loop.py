"""Whether a loop was gone round before: then it begins where it ends, not where a reducer that was at rest would.

A bench that cycles the torque and writes a whole cycle from no torque on begins at the side of the play, and of what friction holds back,
from which the cycle before had come.
"""

import numpy as np

from fmu_src.arrays import Floats

# Of the range of the torque: what is nearer has the torque of the start.
SAME = 0.02
# A loop that ends this much before the torque of its start is followed on along its last step: benches leave out samples about no torque.
BEFORE = 0.04
# Of how far the branches stand apart at that torque: a loop from rest begins half-way between them.
NEARER = 0.25
# Of the range of the turning: branches that are nearer show neither play nor friction, and where they begin does not matter.
OPEN = 0.05


def is_closed(torques: Floats, turning: Floats) -> bool:
    """Whether the start of a loop (``torques`` [N m] in the order in which they were applied, ``turning`` of the output) lies on the branch that passes
    its torque the same way later; False where none does, as of a loop that begins at its largest torque, and where no play shows."""
    sense = first_sense(torques)
    same, opposite = (passing(way * (torques - torques[0]), turning) for way in (sense, -sense))
    if same is None or opposite is None:
        return False
    apart = abs(opposite - same)
    return bool(apart > OPEN * np.ptp(turning) and abs(turning[0] - same) < NEARER * apart)


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
