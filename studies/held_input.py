"""Lost motion of a pair as worn as it is, with the input held: that of the stiffness test, at the present wear."""

import math

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import RunFault
from rv_plant.faults import DYNAMIC, QUASI_STATIC
from studies.hysteresis import LOST_MOTION_SHARE, torque_way
from studies.pair import Pair
from studies.solve import ARCMIN

# Places of a crank turn, and torques a quarter of the loop beyond the small ones: the stiffness test, with more of both, reads within 0.1 % the same.
PLACES, STEPS = 12, 4


def lost_motion(pair: Pair) -> float:
    """Turning of the output between +3 % and -3 % of the present torque [arcmin], mean over a crank turn; the pair's state is put back.

    Read on the way back from the torque: of a loop that is alike both ways as much as on its middle line.  NaN without torque, in motion, and where
    there is no equilibrium.
    """
    torque = abs(pair.plant.number("load_torque"))
    if torque == 0.0 or pair.plant.get("fidelity") == DYNAMIC:
        return math.nan
    way = way_back(torque)
    saved = pair.master.save()
    try:
        pair.wear.set("acceleration", 0.0)
        lost = []
        for _ in range(PLACES):
            pair.master.run(max(1, pair.positions // PLACES))
            lost.append(lost_here(pair, way))
        return float(np.mean(lost)) * ARCMIN
    except RunFault:
        return math.nan
    finally:
        pair.master.restore(saved)


def way_back(torque: float) -> Floats:
    """From the torque [N m] through none to as much of the other sense as lost motion is read at."""
    loop = torque_way(torque, STEPS)
    quarter = len(loop) // 4
    back = loop[quarter : 3 * quarter + 1]
    return back[back >= -(1.0 + 1e-9) * LOST_MOTION_SHARE * torque]


def lost_here(pair: Pair, way: Floats) -> float:
    """Turning [rad] along a ``way_back`` at the present place, to which the pair is put back."""
    here = pair.master.save()
    pair.plant.set("input_speed", 0.0)
    if pair.plant.get("fidelity") == DYNAMIC:
        # With the input held nothing moves.
        pair.plant.set("fidelity", QUASI_STATIC)
    turning = np.zeros(len(way))
    for i, value in enumerate(way):
        pair.plant.set("load_torque", float(value))
        pair.master.step()
        turning[i] = pair.plant.number("transmission_error")
    pair.master.restore(here)
    return float(abs(turning[-1] - turning[int(np.argmin(abs(way + way[-1])))]))
