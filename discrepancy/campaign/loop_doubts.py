"""Loops that no reducer runs through: against the torque, or the wrong way round, giving work where friction takes it."""

from collections.abc import Iterator

import numpy as np

from discrepancy.campaign.amount import readable
from discrepancy.campaign.design import Design
from discrepancy.campaign.findings import WARNING, Finding
from discrepancy.campaign.model import Source
from discrepancy.campaign.quantities import VALUE
from discrepancy.campaign.row_order import is_shuffled
from fmu_src.arrays import Floats

# Samples below which nothing is said; share of the largest torque within which the two ways are held against each other, in so many
# steps; degree of the curve between them.
FEW, INNER, STEPS, DEGREE = 16, 0.8, 20, 5
# Of the samples, over which the torque's jitter is smoothed; correlation from which a slope is clear; times its noise, and share of
# the whole turning, from which a gap is clear.
SMOOTHED, CLEAR_SLOPE, CLEARLY, LEAST = 0.02, -0.5, 5.0, 0.02
# Neighbouring samples share their noise (assumed: ten of them).
ALIKE = 10.0


def ways_round(design: Design) -> Iterator[Finding]:
    campaign = design.campaign
    for record in campaign.of("hysteresis"):
        torque, turning = np.asarray(record.axes.get("torque", np.zeros(0)), float), np.asarray(record.values, float)
        if len(torque) < FEW or is_shuffled(record, "torque") or not (np.ptp(torque) > 0.0 and np.ptp(turning) > 0.0):
            continue
        place = campaign.place(record.name, VALUE)
        if np.corrcoef(torque, turning)[0, 1] < CLEAR_SLOPE:
            yield Finding(
                WARNING, "loop against the torque",
                f"run {record.name}: the reducer turns{place} against the torque on it: the two columns count in opposite senses",
                "state scale = -1 in one of the two columns",
            )  # fmt: skip
            continue
        gap, noise = gap_between_ways(torque, turning)
        if gap < -max(CLEARLY * noise, LEAST * float(np.ptp(turning))):
            source = campaign.source(record.name, VALUE) or Source("", "", "rad", 1.0)
            yield Finding(
                WARNING, "loop the wrong way round",
                f"run {record.name}: at equal torque the turning{place} is {readable(-gap / abs(source.factor))} {source.unit} less on the way down"
                " than on the way up, so that the reducer gives work; friction takes it",
                "export the rows in the order of time; if torque and turning come from two recorders, correct the delay between them",
            )  # fmt: skip


def gap_between_ways(torque: Floats, turning: Floats) -> tuple[float, float]:
    """How much more a loop is turned on the way down than on the way up, on average, and the noise of that; (0, 0) of one way only."""
    width = max(1, round(SMOOTHED * len(torque)))
    smooth = np.convolve(np.pad(torque, width, mode="edge"), np.ones(2 * width + 1) / (2 * width + 1), mode="valid")
    rate = np.gradient(smooth)
    inner = (np.abs(torque) < INNER * np.abs(torque).max()) & (np.abs(rate) > 0.1 * np.median(np.abs(rate)))
    up, down = inner & (rate > 0.0), inner & (rate < 0.0)
    if min(up.sum(), down.sum()) < FEW // 2:
        return 0.0, 0.0
    # In steps of torque, less the curve through them: a loop dwells elsewhere on its way up than on its way down.
    curve = np.polynomial.Polynomial.fit(torque[inner], turning[inner], DEGREE)
    off = turning - curve(torque)
    step = np.floor(STEPS * (torque / (INNER * np.abs(torque).max()) + 1.0) / 2.0).clip(0, STEPS - 1).astype(int)
    ways = [np.bincount(step[way], off[way], STEPS) / np.maximum(1, np.bincount(step[way], minlength=STEPS)) for way in (up, down)]
    met = (np.bincount(step[up], minlength=STEPS) > 0) & (np.bincount(step[down], minlength=STEPS) > 0)
    if met.sum() < STEPS // 4:
        return 0.0, 0.0
    scatter = float(np.std(np.diff(off))) / np.sqrt(2.0)
    return float(np.mean((ways[1] - ways[0])[met])), scatter * float(np.sqrt(ALIKE * (1.0 / up.sum() + 1.0 / down.sum())))
