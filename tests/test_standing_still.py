"""When a fit stands still: by gains far below its noise, or far below what it leaves."""

import pytest

from discrepancy.inference.refit.joint import LITTLE, STILL, stands_still


@pytest.mark.parametrize("left", [0.5, 1.0, 2.0])
def test_a_fit_that_leaves_noise_goes_on_to_the_last_thousandth(left):
    assert stands_still(0.9 * STILL, left * 20_000, 20_000) and not stands_still(1.1 * STILL, left * 20_000, 20_000)
    assert stands_still(-1.0, left * 20_000, 20_000)


def test_a_fit_that_leaves_hundreds_of_times_the_noise_stands_still_sooner():
    """Springs alone on rigid supports, with friction and a relieved profile missing: 9.1 million of 21,540 samples, polished by gains of 1e-4."""
    samples, left = 21_540, 9.1e6
    gain = 0.99 * LITTLE * (left - 2 * samples)
    assert stands_still(gain, left, samples) and not stands_still(2.0 * gain, left, samples)
    # Its intervals are as much wider as what is left is louder than noise: by these it moved by less than half a standard deviation.
    assert gain < 0.25 * left / samples
