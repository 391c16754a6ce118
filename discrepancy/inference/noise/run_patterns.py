"""Patterns by which whole runs differ: offset, drift and gain."""

from collections.abc import Sequence

import numpy as np
from scipy.special import chdtrc

from discrepancy.inference.noise.outliers import CUT, huber_weights
from discrepancy.inference.noise.replicates import Deviation
from discrepancy.inference.noise.stream_noise import StreamNoise
from discrepancy.inference.noise.whiten import autoregress, correlations, gains, innovations
from fmu_src.arrays import Floats


def pattern_columns(record_position: Floats, prediction: Floats, names: Sequence[str]) -> Floats:
    x = record_position - record_position.mean()
    x = x / (np.sqrt(np.mean(x**2)) or 1.0)
    columns = {"offset": np.ones_like(x), "drift": x}
    if "gain" in names:
        h = prediction - prediction.mean()
        columns["gain"] = h / (np.sqrt(np.mean(prediction**2)) or 1.0)
    return np.column_stack([columns[n] for n in names])


def pattern_variances(
    stream: StreamNoise, deviations: Sequence[Deviation], predictions: Sequence[Floats]
) -> tuple[dict[str, float], dict[str, float]]:
    """Variance of the run-wide patterns in units of scale^2: what their amounts scatter by beyond the noise of the samples.

    The gain is only taken in when it is significant: it may look much like a drift.
    """
    names = ["offset", "drift"] if np.median([d.values.size for d in deviations]) >= 32 else ["offset"]
    dof = sum(d.share for d in deviations)
    squares, expected = _amounts(stream, deviations, predictions, names)
    shape = [predictions[d.index][d.rows] for d in deviations]
    if all(np.std(h) > 1e-6 * (np.sqrt(np.mean(h**2)) + 1e-300) for h in shape):
        with_gain = _amounts(stream, deviations, predictions, [*names, "gain"])
        if chdtrc(dof, with_gain[0]["gain"] / (with_gain[1]["gain"] / dof + 1e-300)) < 0.003:
            (squares, expected), names = with_gain, [*names, "gain"]
    patterns = {n: float(max(squares[n] - expected[n], 0.0) / dof) for n in names}
    return patterns, {n: max(dof, 1.0) for n in patterns}


def _amounts(
    stream: StreamNoise, deviations: Sequence[Deviation], predictions: Sequence[Floats], names: Sequence[str]
) -> tuple[dict[str, float], dict[str, float]]:
    """Sum of squared amounts of each pattern, and what the noise of the samples alone gives."""
    squares, expected = dict.fromkeys(names, 0.0), dict.fromkeys(names, 0.0)
    for d in deviations:
        rho = correlations(d.position, stream.length)
        g = gains(rho, stream.nugget)
        shape = predictions[d.index][d.rows]
        columns = pattern_columns(d.position, shape, names) / np.reshape(d.factor, (-1, 1))
        basis = autoregress(innovations(np.ascontiguousarray(columns), rho, *g), stream.taps)
        e = autoregress(innovations((d.values / stream.scales[d.condition])[:, None], rho, *g), stream.taps)[:, 0]
        e = e * huber_weights(e - np.median(e), 2 * CUT)
        amount, *_ = np.linalg.lstsq(basis, e, rcond=None)
        covariance = np.linalg.pinv(basis.T @ basis)
        for k, n in enumerate(names):
            squares[n] += d.share * amount[k] ** 2
            expected[n] += d.share * covariance[k, k]
    return squares, expected
