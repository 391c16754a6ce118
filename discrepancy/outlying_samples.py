"""Single samples that stand far off: a slip of an instrument or of a transmission of data, neither noise nor the reducer.

A sample is held against its neighbours, where repetitions stand at the same places in what a run differs from them by: what the
reducer does shows in all of them then.  Such samples count for nothing: not in the fit, not in what is said of a run (its error, its
peak to peak), not in the axis that it is drawn over.
"""

from collections import defaultdict
from collections.abc import Hashable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from discrepancy.inference.noise.series import fast_part, path_of, stream_of
from discrepancy.problem import ORDERS, Record
from discrepancy.repetitions import same_axes
from discrepancy.rounding import noise_of
from fmu_src.arrays import Floats, Mask

# So many times the noise, and so many times the steps beside it, which a cusp or a ringing has: a sample that stands alone.
FAR, ALONE = 20.0, 3.0
# Steps on either side that are looked at.
BESIDE = 4
# Of the whole range: noise that is taken at least, for measurements are no more exact than that (assumed).
EXACT = 1e-4
# More than this share of a run is another kind of noise; and fewer samples than this have no neighbours to speak of.
MOST, FEWEST = 0.02, 16
# Of two repetitions that one is to blame that leaves its own neighbours by so many times more than the other.
BLAMED = 2.0
# Their neighbours are other things: an impact is one sample of a vibration, an order one row of a table.
NO_SERIES = (ORDERS, "vibration_order", "vibration")


@dataclass(frozen=True)
class OutlyingSamples:
    """Samples of one run that stand far off: their ``rows``, by how much they are ``off`` (SI), the furthest first, and the ``noise`` (SI) of one sample."""

    run: str
    quantity: str
    unit: str
    samples: int
    rows: tuple[int, ...]
    off: tuple[float, ...]
    noise: float

    @property
    def times(self) -> tuple[float, ...]:
        """How far each is off, in times the noise."""
        return tuple(abs(off) / self.noise for off in self.off)


def outlying_samples(records: Sequence[Record]) -> list[OutlyingSamples]:
    """Of each run that has such samples."""
    groups: dict[Hashable, list[Record]] = defaultdict(list)
    for record in records:
        if record.quantity not in NO_SERIES and len(record.values) >= FEWEST and np.all(np.isfinite(record.values)):
            groups[stream_of(record), record.condition, record.mounting, record.factors.get("direction", 1.0), len(record.values)].append(record)
    found = []
    for members in groups.values():
        together = len(members) > 1 and same_axes(members)
        values = np.array([r.values for r in members], float)
        pair = together and len(members) == 2
        # Of two the other, of more what most of them say.
        middle = values[::-1] if pair else np.median(values, axis=0) if together else np.zeros_like(values[0])
        for k, record in enumerate(members):
            compared = values[k] - np.broadcast_to(middle, values.shape)[k]
            off, noise = standing_alone(path_of(record), compared, values[k], 1.0 if pair else 0.0)
            if pair:
                off[~blamed(path_of(record), values[k], values[1 - k])] = 0.0
            rows = np.flatnonzero(off)
            if 0 < len(rows) <= max(MOST * len(off), 1.0):
                rows = rows[np.argsort(-np.abs(off[rows]))]
                found.append(OutlyingSamples(record.name, record.quantity, record.unit, len(off), tuple(map(int, rows)), tuple(map(float, off[rows])), noise))
    return found


def standing_alone(path: Floats, values: Floats, measured: Floats, more: float) -> tuple[Floats, float]:
    """By how much each sample stands alone off the line between its neighbours, 0 for those that do not, and the noise of one.

    ``values`` (n,) are ``measured`` or what these differ from their repetitions by, whose variance is ``more`` beside that of one; along the ``path``.
    """
    inner, fast = fast_part(path, values)
    scatter = 1.4826 * float(np.median(np.abs(fast))) / float(np.sqrt(1.0 + more))
    noise = max(scatter, noise_of(measured), EXACT * float(np.ptp(np.quantile(measured, (0.01, 0.99)))), 1e-300)
    steps = np.diff(values)
    off = np.zeros(len(values))
    for i in inner[np.abs(fast) > 0.5 * FAR * noise]:
        before, after = steps[i - 1], -steps[i]
        rest = np.abs(np.concatenate([steps[max(i - 1 - BESIDE, 0) : i - 1], steps[i + 1 : i + 1 + BESIDE]]))
        least = min(abs(before), abs(after))
        if before * after > 0.0 and len(rest) and least > max(FAR * noise, ALONE * float(np.median(rest)), float(rest.max())):
            off[i] = 0.5 * (before + after)
    return off, noise


def blamed(path: Floats, own: Floats, other: Floats) -> Mask:
    """(n,) Where a run leaves its own neighbours and its repetition does not."""
    ways = []
    for values in (own, other):
        inner, fast = fast_part(path, values)
        way = np.zeros(len(values))
        way[inner] = np.abs(fast)
        ways.append(way)
    found: Mask = ways[0] > BLAMED * ways[1]
    return found


def bridged(record: Record) -> Record:
    """A record with its samples that stand far off on the line between their neighbours, for what needs all of them."""
    if not record.far_off:
        return record
    rows, counted = np.arange(len(record.values)), record.counted
    return replace(record, values=np.where(counted, record.values, np.interp(rows, rows[counted], record.values[counted])), far_off=())


def marked(records: Sequence[Record]) -> list[Record]:
    """The records, each with the rows of its samples that stand far off."""
    rows = {found.run: tuple(sorted(found.rows)) for found in outlying_samples(records)}
    return [replace(record, far_off=rows[record.name]) if record.name in rows else record for record in records]
