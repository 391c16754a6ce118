"""The monotone cubic through the nodes of a loop, beside SciPy's."""

import numpy as np
import pytest
from scipy.interpolate import PchipInterpolator

from discrepancy.prediction.monotone import monotone_cubic


@pytest.mark.parametrize("count", [2, 3, 4, 7, 40])
def test_as_scipy_has_it(count):
    """Rising, falling, with flat parts and ends that would overshoot; at the nodes themselves, too."""
    rng = np.random.default_rng(count)
    for shape in (np.sort, np.asarray, np.round, lambda y: np.where(y > 0.0, y**3, 0.0)):
        x = np.cumsum(rng.uniform(1e-3, 2.0, count))
        y = np.asarray(shape(rng.normal(size=count)), float)
        at = np.concatenate([x, rng.uniform(x[0], x[-1], 200)])
        np.testing.assert_allclose(monotone_cubic(x, y, at), PchipInterpolator(x, y)(at), rtol=1e-12, atol=1e-14)


def test_nowhere_beyond_its_neighbours():
    x, y = np.arange(6.0), np.array([0.0, 0.0, 1.0, 1.0, 5.0, 4.0])
    at = np.linspace(0.0, 5.0, 501)
    found, k = monotone_cubic(x, y, at), np.minimum(at.astype(int), 4)
    low, high = np.minimum(y[k], y[k + 1]), np.maximum(y[k], y[k + 1])
    assert np.all((found >= low - 1e-12) & (found <= high + 1e-12))
