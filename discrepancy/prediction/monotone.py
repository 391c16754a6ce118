"""Cubic interpolation that overshoots nowhere, after Fritsch and Butland 1984 (``scipy.interpolate.PchipInterpolator``), of thousands of short curves."""

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.kernel import kernel


def monotone_cubic(x: Floats, y: Floats, at: Floats) -> Floats:
    """The curve through ``y`` (n,) at rising ``x`` (n >= 2,), at the places ``at`` (m,) within them."""
    found, slopes = np.empty(len(at)), np.empty(len(x))
    interpolate(np.ascontiguousarray(x), np.ascontiguousarray(y), slopes, np.ascontiguousarray(at), found)
    return found


@kernel
def end_slope(near: float, far: float, rise_near: float, rise_far: float) -> float:
    """Slope at an end of three points, of widths and rises the nearer first, that overshoots nowhere."""
    slope = ((2.0 * near + far) * rise_near - near * rise_far) / (near + far)
    if slope * rise_near <= 0.0:
        return 0.0
    if rise_near * rise_far <= 0.0 and abs(slope) > 3.0 * abs(rise_near):
        return 3.0 * rise_near
    return slope


@kernel
def interpolate(x: Floats, y: Floats, slopes: Floats, at: Floats, found: Floats) -> None:
    """``monotone_cubic`` into ``found`` (m,), with room for ``slopes`` (n,)."""
    n = x.shape[0]
    if n == 2:
        slopes[0] = (y[1] - y[0]) / (x[1] - x[0])
        slopes[1] = slopes[0]
    else:
        for k in range(1, n - 1):
            before, after = x[k] - x[k - 1], x[k + 1] - x[k]
            rise, further = (y[k] - y[k - 1]) / before, (y[k + 1] - y[k]) / after
            slopes[k] = 0.0
            if rise * further > 0.0:
                # Weighed harmonic mean.
                w, v = 2.0 * after + before, after + 2.0 * before
                slopes[k] = (w + v) / (w / rise + v / further)
        first, second = x[1] - x[0], x[2] - x[1]
        slopes[0] = end_slope(first, second, (y[1] - y[0]) / first, (y[2] - y[1]) / second)
        last, other = x[n - 1] - x[n - 2], x[n - 2] - x[n - 3]
        slopes[n - 1] = end_slope(last, other, (y[n - 1] - y[n - 2]) / last, (y[n - 2] - y[n - 3]) / other)
    for i in range(at.shape[0]):
        low, high = 0, n - 1
        while high - low > 1:
            middle = (low + high) // 2
            if x[middle] <= at[i]:
                low = middle
            else:
                high = middle
        width = x[low + 1] - x[low]
        t = (at[i] - x[low]) / width
        s = 1.0 - t
        found[i] = s * s * ((1.0 + 2.0 * t) * y[low] + t * width * slopes[low]) + t * t * ((3.0 - 2.0 * t) * y[low + 1] - s * width * slopes[low + 1])
