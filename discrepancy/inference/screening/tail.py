"""Chances of a score statistic: counted among draws of the noise, and beyond these by the law of F."""

import math

import numpy as np
from scipy.special import fdtrc, fdtri

from fmu_src.arrays import Floats


def tail(value: float, sims: Floats, width: int, dof: float) -> float:
    """Probability under the null: counted, beyond the 99th percentile continued with the law of F."""
    draws = sims.size
    bend, reference = _bend(sims, width, dof)
    if value <= bend or bend <= 0:
        return float((draws - np.searchsorted(sims, value) + 1) / (draws + 1))
    return float(0.01 * fdtrc(width, dof, value / width) / reference)


def _bend(sims: Floats, width: int, dof: float) -> tuple[float, float]:
    """Where the law of F continues what was drawn, and its own probability from there on."""
    bend = float(sims[int(0.99 * sims.size)])
    return bend, max(float(fdtrc(width, dof, max(bend, 0.0) / width)), 1e-300)


def needed_for(p: float, sims: Floats, width: int, dof: float) -> float:
    """Value whose ``tail`` is ``p``; infinite where draws give none."""
    if p >= 0.01:
        return float(np.quantile(sims, 1.0 - min(p, 1.0)))
    bend, reference = _bend(sims, width, dof)
    if bend <= 0.0:
        return math.inf
    return float(width * fdtri(width, dof, 1.0 - p * reference / 0.01))
