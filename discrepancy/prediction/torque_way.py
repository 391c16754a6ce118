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
# Torques on a way in.
LEAD = 9


def way(bench: Bench, values: Mapping[str, float], torques: Floats, longest: float = TORQUE_STEP,
        closed: bool = False) -> tuple[Floats, npt.NDArray[np.intp] | slice]:  # fmt: skip
    """The torques [N m] that are gone through, and where ``torques`` are among them: with what remembers in steps of ``longest`` of the rated one."""
    path, lead = entered(torques, bench.rated_load, closed)
    if not bench.remembers(values):
        return path, slice(lead, None)
    step, least = longest * bench.rated_load, NEAR_NOTHING * bench.rated_load
    fine, places = bench.kept(("way", path.tobytes(), step), lambda: finely(path, step, least))
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


def finely(path: Floats, longest: float, least: float) -> tuple[Floats, npt.NDArray[np.intp]]:
    """The way of a torque [N m] with steps no longer than ``longest``, and where its own places are: the output's place depends on the way, which
    the drive goes from sample to sample too.

    Below ``least`` nothing is put in: the output floats there.  It goes through from the same torque before to the same beyond, wherever samples lie:
    what friction keeps of the play depends on the step through it (2.5 arcsec at the sample after it, beside oval discs).
    """
    parts, places, count = [path[:1]], [0], 1
    for a, b in pairwise(path):
        stops = [stop for stop in (np.copysign(least, a), np.copysign(least, b)) if a * b < 0.0 and min(a, b) < stop < max(a, b)]
        for begin, end in pairwise((a, *stops, b)):
            between = np.linspace(begin, end, max(int(np.ceil(abs(end - begin) / longest)), 1) + 1)[1:-1]
            between = between[np.abs(between) >= least]
            parts += [between, np.array([end])]
            count += len(between) + 1
        places.append(count - 1)
    return np.concatenate(parts), np.array(places)
