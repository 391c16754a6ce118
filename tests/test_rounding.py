"""Rounded values: their step, and the noise that it stands for."""

import numpy as np
import pytest

from discrepancy.rounding import noise_of, step_of


def test_a_step_is_found_where_values_repeat():
    ramp = np.round(np.linspace(0.0, 1.0, 300), 2)
    assert step_of(ramp) == pytest.approx(0.01)
    assert step_of(np.random.default_rng(1).normal(size=200)) == 0.0
    assert step_of(np.array([1.0])) == 0.0


@pytest.mark.parametrize("stay", [1, 4, 10])
def test_neighbours_on_one_step_count_as_one(stay):
    """The mean of so many samples is off by as much as one: the noise is that times the root of their number."""
    values = np.repeat(np.arange(60.0), 2 * stay)
    assert noise_of(values) == pytest.approx(np.sqrt(2 * stay / 12.0), rel=0.02)


def test_a_value_that_is_lost_has_no_step():
    values = np.round(np.linspace(0.0, 1.0, 300), 2)
    values[3] = np.nan
    assert step_of(values) == pytest.approx(0.01)
