"""Additive penalised splines of small samples: y = f1(x1) + f2(x2) + ..., smoothing chosen by generalised cross-validation."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import BSpline

from fmu_src.arrays import Floats


@dataclass(frozen=True)
class Curve:
    """One component on a grid, centred, with its 95 % band and the share of variance it explains."""

    name: str
    x: Floats
    y: Floats
    deviation: Floats
    share: float
    effective_dof: float

    def to_dict(self) -> dict[str, Any]:
        return {"name": self.name, "x": self.x.tolist(), "y": self.y.tolist(), "low": (self.y - 1.96 * self.deviation).tolist(),
                "high": (self.y + 1.96 * self.deviation).tolist(), "share": self.share, "effective_dof": self.effective_dof}


def basis(x: Floats, low: float, high: float, pieces: int) -> Floats:
    """Cubic B-splines on equal pieces between ``low`` and ``high``."""
    step = (high - low) / pieces
    knots = low + step * np.arange(-3, pieces + 4)
    return BSpline.design_matrix(np.clip(x, low, high - 1e-9 * (high - low)), knots, 3, extrapolate=True).toarray()


def additive(y: Floats, weights: Floats, axes: Mapping[str, Floats], rounds: int = 3) -> tuple[list[Curve], Floats]:
    """Curves of each axis and the fitted values; ``weights`` are inverse variances."""
    y, weights = np.asarray(y, float), np.asarray(weights, float)
    blocks, penalties, grids, start = [np.ones((y.size, 1))], [], {}, 1
    for name, x in axes.items():
        levels = np.unique(x).size
        pieces = int(np.clip(levels - 2, 1, 12))
        low, high = float(np.min(x)), float(np.max(x))
        b = basis(x, low, high, pieces)
        grid = np.linspace(low, high, 61)
        g = basis(grid, low, high, pieces)
        mean = b.mean(0)
        difference = np.diff(np.eye(b.shape[1]), 2, axis=0)
        blocks.append(b - mean)
        penalties.append((slice(start, start + b.shape[1]), difference.T @ difference))
        grids[name] = (grid, g - mean, slice(start, start + b.shape[1]))
        start += b.shape[1]
    design = np.hstack(blocks)
    gram = design.T @ (weights[:, None] * design)
    right = design.T @ (weights * y)
    scale = np.trace(gram) / gram.shape[0]
    smoothing = np.full(len(penalties), 1.0)

    def solve(lam: Floats) -> tuple[float, Floats, Floats, float, float]:
        matrix = gram + 1e-8 * scale * np.eye(start)
        for value, (rows, penalty) in zip(lam, penalties):
            matrix[rows, rows] += value * scale * penalty
        inverse = np.linalg.inv(matrix)
        coefficients = inverse @ right
        dof = np.trace(inverse @ gram)
        misfit = np.sum(weights * (y - design @ coefficients) ** 2)
        return y.size * misfit / max(y.size - 1.3 * dof, 0.5) ** 2, coefficients, inverse, misfit, dof

    for _ in range(rounds):
        for k in range(len(smoothing)):
            trials = []
            for value in 10.0 ** np.arange(-4.0, 5.0):
                lam = smoothing.copy()
                lam[k] = value
                trials.append((solve(lam)[0], value))
            smoothing[k] = min(trials)[1]
    _, coefficients, inverse, misfit, dof = solve(smoothing)
    noise = max(misfit / max(y.size - dof, 1.0), 1e-300)
    total = np.sum(weights * (y - np.average(y, weights=weights)) ** 2)
    curves = []
    for name, (grid, g, rows) in grids.items():
        part = design[:, rows] @ coefficients[rows]
        deviation = np.sqrt(np.maximum(np.sum((g @ (inverse[rows, rows])) * g, axis=1), 0.0) * noise)
        curves.append(Curve(name, grid, g @ coefficients[rows], deviation, float(np.sum(weights * (part - part.mean()) ** 2) / max(total, 1e-300)),
                            float(np.trace((inverse @ gram)[rows, rows]))))
    return sorted(curves, key=lambda c: -c.share), design @ coefficients
