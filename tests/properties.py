"""What properties share: how many examples they get, and when numbers are the same."""

import numpy as np
from hypothesis import settings


def examples(share: float):
    """Decorator: ``share`` times the profile's number of examples (see conftest), at least one."""
    return settings(max_examples=max(1, round(share * settings().max_examples)))


def assert_near(found, expected, share, name="", scale=0.0):
    """To a share of the largest element; ``scale`` is what counts where the parts of a sum may balance."""
    largest = max(scale, float(np.abs(expected).max()))
    np.testing.assert_allclose(found, expected, rtol=share, atol=share * largest, err_msg=name)
