"""Runs that repeat each other: how they deviate, whatever the model says."""

import itertools
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from discrepancy.inference.noise.series import position_of, spacing_of, stream_of
from discrepancy.problem import Record
from fmu_src.arrays import Floats, Mask


@dataclass(frozen=True)
class Deviation:
    """Of a run from those that repeat it, at ``rows`` of its record, scaled to the variance of one run: divided by ``factor``, by which the noise of its
    samples differs, where that is known."""

    index: int
    position: Floats
    values: Floats
    rows: npt.NDArray[np.intp]
    share: float
    condition: str
    pair: bool
    factor: Floats | float = 1.0


def _groups(records: Sequence[Record], indices: Sequence[int]) -> list[list[int]]:
    """Sets of runs that repeat each other, within one mounting where that leaves any."""
    for with_mounting in (True, False):
        groups: dict[tuple[str, str, str], list[int]] = defaultdict(list)
        for i in indices:
            r = records[i]
            groups[(stream_of(r), r.condition, r.mounting if with_mounting else "")].append(i)
        repeated = [g for g in groups.values() if len(g) > 1]
        if repeated:
            return repeated
    return []


def beside(position: Floats, other: Floats, spacing: float) -> bool:
    """Whether two runs have sample beside sample: as many, none far from the other's, and no jump where one of them lacks a sample that the other has."""
    if position.size != other.size:
        return False
    apart = position - other
    return bool(np.all(np.abs(apart) <= 1.5 * spacing + 1e-12) and np.all(np.abs(np.diff(apart)) <= 0.5 * spacing + 1e-12))


def deviations_of(records: Sequence[Record], residuals: Sequence[Floats], masks: Sequence[Mask], indices: Sequence[int]) -> list[Deviation]:
    """Deviations of repeated runs from each other, scaled to the variance of one run."""
    result = []
    for group in _groups(records, indices):
        positions = [position_of(records[i]) for i in group]
        spacing = spacing_of(positions[0])
        # sample by sample even if the samples wander a little: pairing with neighbours twice would feign slow noise
        matched = all(beside(p, positions[0], spacing) for p in positions)
        condition = records[group[0]].condition
        if matched:
            rows = np.flatnonzero(np.all([masks[i] for i in group], axis=0))
            if rows.size == 0:
                continue
            stack = np.array([residuals[i][rows] for i in group])
            count = len(group)
            spread = (stack - (stack.mean(0) if count == 2 else np.median(stack, axis=0))) * np.sqrt(count / (count - 1))
            if count > 2:
                spread = (stack - stack.mean(0)) * np.sqrt(count / (count - 1))
            for i, position, values in zip(group, positions, spread):
                result.append(Deviation(i, position[rows], values, rows, (count - 1) / count, condition, count == 2))
            continue
        for a, b in itertools.pairwise(group):
            pa, pb = position_of(records[a]), position_of(records[b])
            ra, rb = np.flatnonzero(masks[a]), np.flatnonzero(masks[b])
            if ra.size < 2 or rb.size < 2 or np.any(np.diff(pb[rb]) <= 0):
                continue
            at = np.clip(np.searchsorted(pb[rb], pa[ra]), 1, rb.size - 1)
            at -= np.abs(pb[rb][at - 1] - pa[ra]) < np.abs(pb[rb][at] - pa[ra])
            close = np.abs(pb[rb][at] - pa[ra]) <= 0.75 * spacing
            if close.sum() < max(4, 0.3 * ra.size):
                continue
            once = np.zeros(close.size, dtype=bool)
            once[np.unique(at, return_index=True)[1]] = True
            close &= once
            rows = ra[close]
            result.append(Deviation(a, pa[rows], (residuals[a][rows] - residuals[b][rb][at][close]) / np.sqrt(2), rows, 1.0, condition, False))
    return result
