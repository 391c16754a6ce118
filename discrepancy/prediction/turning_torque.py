"""Where the torque of a loop turned back, of which a noisy meter shows the largest of its readings.

The way after a turn begins at its torque: read 1 N m too large by the noisiest of many samples, all of the way until friction has turned round lies
0.3 arcsec off (RV20E-121).  Before and after a turn a bench's torque goes along straight lines, or along a parabola; where either is all that many
samples about a turn show besides noise, it tells the torque better than any of them.
"""

import numpy as np
import numpy.typing as npt

from discrepancy.closed_loop import scatter
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.support import reversals
from discrepancy.problem import Record
from fmu_src.arrays import Floats

# A line on either side of a turn or a parabola is fitted to so many times the noise of torque, and so many samples, on either side at least, and to up to so
# many times as much as long as no more than noise is left.
REACH, SAMPLES, WIDER = 10.0, 8, (1, 2, 4, 8, 16, 32)
# Fewer samples tell no noise.
FEW = 4 * SAMPLES
# Of the way to the turn before and after: so much is looked at at most.
MOST = 0.5
# By how much what a fit leaves may be more than noise.
MORE = 1.15
# In samples about the one that is read farthest, in units of the noise over the way between two samples: where the turn may be.
WITHIN, PLACES = 6.0, 61
# Where no shape is seen: the highest mean of samples over so many times the noise of a usual way.
LEVEL = 1.5
# A sample stands at the turn if it is no further from it than so many times the noise.
AT = 1.0


def applied(bench: Bench, record: Record) -> Floats:
    """The torques [N m] of a loop, sample by sample, that turn back where they did."""
    read = np.ascontiguousarray(record.axes["torque"], np.float64)
    # Every prediction asks again.
    return bench.kept(("applied", read.tobytes()), lambda: as_applied(read, reversals(read)))


def as_applied(torques: Floats, turns: npt.NDArray[np.intp]) -> Floats:
    """(n,) ``torques`` [N m] as read, with those about the inner ``turns`` (places of samples, the first and the last sample among them) no farther than
    where the torque turned back; as they are where their noise or their way there is not known."""
    found = np.array(torques, np.float64)
    noise = scatter(found)
    if noise == 0.0 or len(found) < FEW:
        return found
    for before, k, after in zip(turns[:-2], turns[1:-1], turns[2:]):
        sense = 1.0 if torques[k] >= torques[before] else -1.0
        rising = sense * torques[before: after + 1]
        pace = pace_of(rising, k - before)
        turn = turn_of(rising, k - before, noise, pace) if pace > 0.0 else None
        if turn is None:
            continue
        place, most = turn
        part = slice(before + 1, after)
        found[part] = sense * np.minimum(sense * found[part], most)
        nearest = before + round(place)
        if before < nearest < after and abs(before + place - nearest) * pace <= AT * noise:
            found[nearest] = sense * most
    return found


def pace_of(way: Floats, k: int) -> float:
    """How far it is from sample to sample of a ``way`` (n,) that rises to its ``k``-th and falls."""
    return 0.5 * float((way[k] - way[0]) / k + (way[k] - way[-1]) / (len(way) - 1 - k))


def turn_of(way: Floats, k: int, noise: float, pace: float) -> tuple[float, float] | None:
    """(place, torque) of the turn of a ``way`` (n,) that rises and falls, near its sample ``k``; None where no shape is seen."""
    best = None
    for wider in WIDER:
        half = max(int(np.ceil(REACH * wider * noise / pace)), SAMPLES * wider)
        if half > MOST * min(k, len(way) - 1 - k):
            break
        found = fitted(way[k - half: k + half + 1], half, noise, pace)
        if found is not None:
            best = (k + found[0], found[1])
        elif best is not None:
            break
    return best or levelled(way, int(LEVEL * noise / pace))


def levelled(way: Floats, samples: int) -> tuple[float, float] | None:
    """(place, torque) of the highest mean of so many ``samples``; None of few."""
    if samples < SAMPLES:
        return None
    sums = np.cumsum(np.append(0.0, way))
    means = (sums[samples:] - sums[:-samples]) / samples
    highest = int(np.argmax(means))
    return highest + 0.5 * (samples - 1), float(means[highest])


def fitted(way: Floats, k: int, noise: float, pace: float) -> tuple[float, float] | None:
    """(place from the middle, torque) of the turn of samples that rise to about their middle, the ``k``-th, and fall."""
    x = np.arange(len(way)) - float(k)
    shapes = []
    for place in max(0.5, WITHIN * noise / pace) * np.linspace(-1.0, 1.0, PLACES)[1:-1]:
        left, amounts = fit_of(way, np.column_stack([np.ones_like(x), x - place, np.abs(x - place)]))
        shapes.append((left, place, float(amounts[0]), 4))
    left, amounts = fit_of(way, np.column_stack([np.ones_like(x), x, x**2]))
    place = -0.5 * amounts[1] / min(amounts[2], -1e-300)
    if abs(place) < MOST * k:
        shapes.append((left, float(place), float(amounts[0] + 0.5 * amounts[1] * place), 3))
    left, place, torque, numbers = min(shapes)
    return (place, torque) if np.sqrt(left / (len(way) - numbers)) <= MORE * noise else None


def fit_of(way: Floats, columns: Floats) -> tuple[float, Floats]:
    """(sum of squares that is left, amounts) of a ``way`` (n,) fitted by ``columns`` (n, m)."""
    amounts = np.asarray(np.linalg.lstsq(columns, way, rcond=None)[0], np.float64)
    return float(np.sum((way - columns @ amounts) ** 2)), amounts
