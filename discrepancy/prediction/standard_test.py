"""The standard test of lost motion: which torques it goes through, and what each turning of the output there adds to it."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from fmu_src.arrays import Floats
from studies.hysteresis import LOST_MOTION_SHARE


def both_ways(falling: Sequence[float]) -> Floats:
    """Torques [rated torque] of a closed loop: at once to the largest, along ``falling`` to the other side, and back by the same."""
    return np.array([0.0, 1.0, *falling, *(-share for share in falling)])


# Lost motion, and what values change in it, are within 0.15 % (0.4 % where friction is twice as large) of those of sixty even steps a quarter.  Small steps at
# large torques would do harm: what friction can hold is known from the step before.
WAY = both_ways((0.5, 0.25, 0.12, 0.06, LOST_MOTION_SHARE, 0.015, 0.0, -0.015, -LOST_MOTION_SHARE, -1.0))
# What values change, roughly, is seen within a tenth from these.  Not at no torque, where equilibria take four times as long.
FEW = both_ways((0.25, 0.06, LOST_MOTION_SHARE, -LOST_MOTION_SHARE, -1.0))


@lru_cache
def weights_of(way: bytes) -> Floats:
    """What each turning along a way adds to the difference of the loop's middle lines at +3 % and -3 %."""
    torques = np.frombuffer(way)
    rising = np.concatenate([[False], np.diff(torques) > 0.0])
    weights = np.zeros(len(torques))
    for sign in (1.0, -1.0):
        for branch in (np.flatnonzero(rising), np.flatnonzero(~rising)):
            order = branch[np.argsort(torques[branch], kind="stable")]
            weights[order] += 0.5 * sign * np.array([np.interp(sign * LOST_MOTION_SHARE, torques[order], one) for one in np.eye(len(order))])
    return weights
