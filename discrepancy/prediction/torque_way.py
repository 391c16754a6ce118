"""The way of a held output's torque: into a loop, through it, and between its samples."""

from collections.abc import Mapping
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from discrepancy.closed_loop import first_sense
from discrepancy.prediction.bench import TORQUE_STEP, Bench
from fmu_src.arrays import Floats
from studies.hysteresis import LOST_MOTION_SHARE

# Share of the rated torque below which a loop has no nodes: the output floats.
NEAR_NOTHING = 0.009
# Shares of the rated torque on either side of none at which the way stops: between the lesser ones it is passed in one step.
PASSED = (0.002, 0.006)
# Torques on a way in.
LEAD = 9


def way(bench: Bench, values: Mapping[str, float], torques: Floats, longest: float = TORQUE_STEP,
        closed: bool = False) -> tuple[Floats, npt.NDArray[np.intp] | slice]:  # fmt: skip
    """The torques [N m] that are gone through, and where ``torques`` are among them: with what remembers in steps of ``longest`` of the rated one."""
    path, lead = entered(torques, bench.rated_load, closed)
    if not bench.remembers(values):
        return path, slice(lead, None)
    step, stops = longest * bench.rated_load, np.array(PASSED) * bench.rated_load
    fine, places = bench.kept(("way", path.tobytes(), step), lambda: finely(path, step, stops))
    return fine, places[lead:]


def entered(torques: Floats, rated: float, closed: bool = False) -> tuple[Floats, int]:
    """The way into a loop and through it, and the length of the way in: from little torque, for with none the output floats; into one that is
    ``closed`` from where it turned back last."""
    start = torques[0]
    if closed:
        turned = torques.min() if first_sense(torques) > 0.0 else torques.max()
        lead = np.concatenate([inwards(turned, turned), np.linspace(turned, start, LEAD)[:-1]])
    else:
        lead = inwards(start if start != 0.0 else LOST_MOTION_SHARE * rated, start)
    return np.concatenate([lead, torques]), len(lead)


def inwards(first: float, last: float) -> Floats:
    """Torques from a tenth of ``first`` to before ``last``."""
    found: Floats = np.linspace(0.1 * first, last, LEAD)[:-1]
    return found


def finely(path: Floats, longest: float, passed: Floats) -> tuple[Floats, npt.NDArray[np.intp]]:
    """The way of a torque [N m] with steps no longer than ``longest``, and where its own places are: the output's place depends on the way, which
    the drive goes from sample to sample too.

    Through no torque it goes by the torques ``passed``, ascending, before and beyond, wherever samples lie, and between the least of them in one step, for the
    output floats there: what friction keeps of the play depends on the steps through it (docs/decisions.md).
    """
    parts, places, count = [path[:1]], [0], 1
    through = np.concatenate([-passed[::-1], passed])
    for a, b in pairwise(path):
        stops = through[(through > min(a, b)) & (through < max(a, b))] if a * b < 0.0 else through[:0]
        if b < a:
            stops = stops[::-1]
        for begin, end in pairwise((a, *stops, b)):
            between = np.linspace(begin, end, max(int(np.ceil(abs(end - begin) / longest)), 1) + 1)[1:-1]
            between = between[np.abs(between) >= passed[0]]
            parts += [between, np.array([end])]
            count += len(between) + 1
        places.append(count - 1)
    return np.concatenate(parts), np.array(places)
