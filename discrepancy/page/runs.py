"""Runs side by side with what the model says of them, ready to be drawn."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.noise.noise import SHORT
from discrepancy.inference.noise.series import stream_of
from discrepancy.problem import Record
from discrepancy.scales import AXES, Scale
from fmu_src.arrays import Floats, Mask


@dataclass(frozen=True)
class Run:
    """SI values over the kept samples.  ``noise``: standard deviation of each, run-to-run parts included; ``outlying``: whether it stands far off.

    Where a quantity's zero is free, both curves count from ``zero`` of what was written: repetitions lie over each other then.
    """

    record: Record
    kept: Mask
    measured: Floats
    predicted: Floats
    noise: Floats
    outlying: Mask
    # How the campaign tells a speed.
    speed: Scale = AXES["speed"]
    zero: float = 0.0
    # So many repetitions are one in it; ``noise`` is that of their mean.
    mean_of: int = 1

    @property
    def inside(self) -> Floats:
        """What was measured, without samples that stand far off (NaN)."""
        return np.where(self.outlying, np.nan, self.measured)

    @property
    def series(self) -> bool:
        return self.record.values.size >= SHORT and axis_name(self.record) is not None


def axis_name(record: Record) -> str | None:
    """The axis that a series is drawn over."""
    moving = [n for n, v in record.axes.items() if np.size(v) == np.size(record.values) and np.ptp(v) > 0]
    for name in ("angle", "torque", "order", "depth_angle", *moving):
        if name in moving:
            return name
    return None


def axis_of(run: Run) -> str:
    """The axis that a series is drawn over; only series have one."""
    name = axis_name(run.record)
    if name is None:
        raise ValueError(f"{run.record.name}: no axis to draw it over")
    return name


def runs_of(space: Workspace, predicted: list[Floats], speed: Scale, minus: list[Floats] | None = None, left_out: bool = False) -> list[Run]:
    """All runs but those that are left out, or these alone; ``speed`` is how their campaign tells one, ``minus`` is taken off the measured values."""
    found = []
    for i, (record, y, whitener) in enumerate(zip(space.records, predicted, space.noise.whiteners)):
        if record.left_out != left_out:
            continue
        # What stands far off is drawn with the noise of the others.
        kept = whitener.kept | ~record.counted
        noise = np.full(kept.size, float(np.median(whitener.scale)) if whitener.scale.size else 0.0)
        noise[whitener.kept] = whitener.scale
        measured, y = np.asarray(record.values, float) - (minus[i] if minus is not None else 0.0), np.asarray(y, float)
        # The mean of a prediction with a free zero is fitted: it is that of the run.
        zero = float(y.mean()) if record.free_zero and axis_name(record) else 0.0
        noise *= np.sqrt(1.0 + whitener.between)
        found.append(Run(record, kept, measured[kept] - zero, y[kept] - zero, noise[kept], ~record.counted[kept], speed, zero))
    return found


def by_signal(runs: list[Run]) -> Mapping[str, list[Run]]:
    """Runs of each signal that have any samples; signals in alphabetical order."""
    found: dict[str, list[Run]] = {}
    for run in runs:
        if run.measured.size:
            found.setdefault(stream_of(run.record), []).append(run)
    return dict(sorted(found.items()))


def slug(text: str) -> str:
    """A name that may stand in an id."""
    return "".join(c if c.isalnum() else "_" for c in text)
