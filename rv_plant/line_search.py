"""How far to go along a direction: until the slope vanishes, between a place where it falls and one where it rises.

Source: Illinois rule, Dowell and Jarratt 1971.
"""

from fmu_src.kernel import kernel


@kernel
def narrowed(low, low_slope, high, high_slope, step, slope):
    """(low, its slope, high, its slope) with ``step`` as an end; the slope of the end that stays counts half."""
    if slope > 0.0:
        return low, 0.5 * low_slope, step, slope
    return step, slope, high, 0.5 * high_slope


@kernel
def between(low, low_slope, high, high_slope):
    """The next step to try, off both ends."""
    step = low - low_slope * (high - low) / (high_slope - low_slope)
    return min(max(step, low + 0.02 * (high - low)), high - 0.02 * (high - low))
