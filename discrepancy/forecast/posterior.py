"""Samples of what readings leave possible: Gauss and Newton's optimum, Laplace's normal law there, and elliptical slices around it.

Source: Nishihara, Murray and Adams 2014 (generalised elliptical slice sampling): exact in the limit, nothing to be tuned.
"""

from collections.abc import Callable

import numpy as np

from discrepancy.forecast.growth import Growth
from fmu_src.arrays import Floats

# Of points (n, dim): logarithm of a density (n,), misfits of readings (n, k).
Density = Callable[[Floats], Floats]
Misfits = Callable[[Floats], Floats]
CHAINS, STEPS, KEPT = 500, 30, 4
ROUNDS = 40
DIFFERENCE = 1e-4


def samples(growth: Growth, hours: Floats, values: Floats, noise: Floats, seed: int = 0) -> Floats:
    """(CHAINS * KEPT, dim) of ``x`` given readings ``values`` (k,) at ``hours`` (k,) with standard deviations ``noise`` (k,)."""
    misfits, log_density = posterior(growth, hours, values, noise)
    centre, root = laplace(misfits, log_density, growth.dimensions)
    rng = np.random.default_rng(seed)

    def log_ratio(y: Floats) -> Floats:
        """Of the density to that of the normal law, at y = root^-1 (x - centre)."""
        found: Floats = log_density(centre + y @ root.T) + 0.5 * np.sum(y**2, axis=1)
        return found

    y = rng.standard_normal((CHAINS, growth.dimensions))
    at = log_ratio(y)
    kept = []
    for step in range(STEPS):
        y, at = slice_on(y, at, log_ratio, rng)
        if step >= STEPS - KEPT:
            kept.append(centre + y @ root.T)
    return np.concatenate(kept)


def best_misfits(growth: Growth, hours: Floats, values: Floats, noise: Floats) -> Floats:
    """(k,) what the most likely law says less the readings, over their noise."""
    misfits, log_density = posterior(growth, hours, values, noise)
    found: Floats = misfits(laplace(misfits, log_density, growth.dimensions)[0][None])[0]
    return found


def posterior(growth: Growth, hours: Floats, values: Floats, noise: Floats) -> tuple[Misfits, Density]:
    """(misfits of the readings, logarithm of the density) of points ``x`` (n, dim)."""

    def misfits(x: Floats) -> Floats:
        found: Floats = (growth.at(growth.levels(x), hours) - values) / noise
        return found

    def log_density(x: Floats) -> Floats:
        sums: Floats = -0.5 * np.sum(misfits(x) ** 2, axis=1) - 0.5 * np.sum(x**2, axis=1)
        found: Floats = np.where(np.isfinite(sums), sums, -np.inf)
        return found

    return misfits, log_density


def slice_on(y: Floats, at: Floats, log_ratio: Density, rng: np.random.Generator) -> tuple[Floats, Floats]:
    """One step of every chain along an ellipse through it."""
    along = rng.standard_normal(y.shape)
    height = at + np.log(rng.random(len(y)))
    angle = rng.uniform(0.0, 2.0 * np.pi, len(y))
    low, high = angle - 2.0 * np.pi, angle.copy()
    found, ratio = y.copy(), at.copy()
    left = np.arange(len(y))
    while len(left):
        tried = y[left] * np.cos(angle[left])[:, None] + along[left] * np.sin(angle[left])[:, None]
        new = log_ratio(tried)
        inside = new > height[left]
        found[left[inside]], ratio[left[inside]] = tried[inside], new[inside]
        left = left[~inside]
        low[left] = np.where(angle[left] < 0.0, angle[left], low[left])
        high[left] = np.where(angle[left] >= 0.0, angle[left], high[left])
        angle[left] = rng.uniform(low[left], high[left])
    return found, ratio


def laplace(misfits: Misfits, log_density: Density, dimensions: int) -> tuple[Floats, Floats]:
    """(optimum, root of the covariance there), by Levenberg and Marquardt."""
    x, damping = np.zeros(dimensions), 1e-2
    best = float(log_density(x[None])[0])
    for _ in range(ROUNDS):
        left, jacobian = linearised(misfits, x)
        normal = jacobian.T @ jacobian + np.eye(dimensions)
        step = np.linalg.solve(normal + damping * np.diag(np.diag(normal)), -(jacobian.T @ left + x))
        there = float(log_density((x + step)[None])[0])
        if there >= best:
            x, damping = x + step, damping / 5.0
            if there - best < 1e-6:
                break
            best = there
        else:
            damping *= 5.0
    jacobian = linearised(misfits, x)[1]
    return x, np.linalg.cholesky(np.linalg.inv(jacobian.T @ jacobian + np.eye(dimensions)))


def linearised(misfits: Misfits, x: Floats) -> tuple[Floats, Floats]:
    """Misfits (k,) at ``x`` (dim,) and their derivatives (k, dim)."""
    found = misfits(np.vstack([x, x + DIFFERENCE * np.eye(len(x))]))
    return found[0], (found[1:] - found[0]).T / DIFFERENCE
