"""Whitening against dense linear algebra, for any noise; orders of any reducer."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from properties import assert_near, examples

from discrepancy.inference.noise.whiten import whitener


@st.composite
def noises(draw):
    """(whitener, dense covariance, random numbers) of one record."""
    rng = np.random.default_rng(draw(st.integers(0, 2**20)))
    size = draw(st.integers(2, 60))
    position = np.cumsum(rng.uniform(0.1, 2.0, size))
    length, nugget = draw(st.floats(0.1, 30.0)), draw(st.floats(0.0, 0.95))
    scale = draw(st.floats(1e-6, 1e6)) * rng.uniform(0.5, 2.0, size)
    patterns = np.column_stack([np.ones(size), position - position.mean()])[:, : draw(st.integers(0, 2))]
    variances = np.array([draw(st.floats(0.01, 10.0)) for _ in range(patterns.shape[1])])
    kinds = (("q", "offset"), ("q", "drift"))[: patterns.shape[1]]
    white = whitener(np.ones(size, bool), scale, position, length, nugget, np.zeros(0), np.ones(size), patterns, variances, kinds, "q")
    distance = np.abs(np.subtract.outer(position, position))
    dense = (1 - nugget) * np.exp(-distance / length) + nugget * np.eye(size) + patterns @ np.diag(variances) @ patterns.T
    return white, scale[:, None] * dense * scale, rng


@examples(4)
@given(noises())
def test_whitened_columns_have_the_products_that_the_covariance_gives(noise):
    white, dense, rng = noise
    columns = rng.standard_normal((white.size, 3)) * white.scale[:, None]
    inside = white(columns)
    assert_near(inside.T @ inside, columns.T @ np.linalg.solve(dense, columns), 1e-6)
    assert_near(white(columns[:, 0]), inside[:, 0], 1e-12)


@examples(4)
@given(noises(), st.floats(-3.0, 3.0))
def test_whitening_is_linear(noise, factor):
    white, _, rng = noise
    first, second = rng.standard_normal((2, white.size))
    assert_near(white(first + factor * second), white(first) + factor * white(second), 1e-9)


@examples(4)
@given(noises())
def test_noise_of_its_covariance_becomes_independent(noise):
    """The whitened covariance is the unit matrix."""
    white, dense, _ = noise
    root = np.linalg.cholesky(dense)
    inside = white(root)
    assert_near(inside @ inside.T, np.eye(white.size), 1e-6)
