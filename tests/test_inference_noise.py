"""Whitening against dense linear algebra, noise recovered from replicates."""

import numpy as np
import pytest

from discrepancy.inference.noise.noise import estimate
from discrepancy.inference.noise.outliers import usable
from discrepancy.inference.noise.series import spacing_of
from discrepancy.inference.noise.whiten import SLOW, whitener
from discrepancy.problem import Record
from discrepancy.repetitions import outlying, with_left_out


def covariance(position, length, nugget, patterns, variances):
    distance = np.abs(np.subtract.outer(position, position))
    return (1 - nugget) * np.exp(-distance / length) + nugget * np.eye(position.size) + patterns @ np.diag(variances) @ patterns.T


@pytest.mark.parametrize("nugget", [0.0, 0.3])
def test_whitening_agrees_with_the_dense_inverse(nugget):
    rng = np.random.default_rng(0)
    position = np.sort(rng.uniform(0, 40, 60))
    patterns = np.column_stack([np.ones(60), position - position.mean()])
    variances = np.array([0.7, 0.01])
    w = whitener(np.ones(60, bool), np.full(60, 2.0), position, 3.0, nugget, np.zeros(0), np.ones(60), patterns, variances,
                 (("q", "offset"), ("q", "drift")), "q")
    columns = rng.standard_normal((60, 4))
    dense = 4.0 * covariance(position, 3.0, nugget, patterns, variances)
    assert np.allclose(w(columns).T @ w(columns), columns.T @ np.linalg.solve(dense, columns), rtol=1e-6)
    assert np.allclose(w.directions.T @ w.directions, np.eye(2), atol=1e-10)


def replicated(rng, phi, offset, conditions=12, n=400, runs=2, uneven=False):
    records, residuals = [], []
    for c in range(conditions):
        x = np.sort(rng.uniform(0, n, n)) if uneven else np.arange(n, dtype=float)
        misfit = 5 * np.sin(x / 20)
        for k in range(runs):
            step = np.concatenate([[1.0], np.diff(x)])
            e, state = np.empty(n), 0.0
            for i in range(n):
                rho = phi ** step[i]
                state = rho * state + np.sqrt(1 - rho**2) * rng.standard_normal()
                e[i] = state
            e = 0.5 * (e + offset * rng.standard_normal())
            records.append(Record(f"{c}{k}", "te", "1", str(c), k, misfit + e, {"angle": x}, {}))
            residuals.append(misfit + e)
    return records, residuals


@pytest.mark.parametrize("uneven", [False, True])
def test_noise_comes_from_replicates_whatever_the_misfit(uneven):
    rng = np.random.default_rng(1)
    records, residuals = replicated(rng, 0.8, 1.0, uneven=uneven)
    noise = estimate(records, residuals, [np.zeros(400)] * len(records))
    stream = noise.streams["te"]
    assert stream.source == "replicates"
    assert stream.scale * np.sqrt(1.0) == pytest.approx(0.5, rel=0.15)
    assert stream.length == pytest.approx(-1 / np.log(0.8), rel=0.3)
    assert 0.3 < stream.patterns["offset"] < 2.5
    assert stream.dof["offset"] == pytest.approx(12)
    deviation = noise.whiteners[0]((residuals[0] - residuals[1]) / np.sqrt(2))
    assert np.std(deviation) == pytest.approx(1.0, rel=0.15)


def test_samples_lie_as_far_apart_as_they_mostly_do_whichever_way_they_run():
    run = np.array([0.0, -1.0, -2.0, -3.0, -13.0])
    assert spacing_of(run) == 1.0 and spacing_of(run, 5.0 * run, 5.0 * run) == 5.0
    assert spacing_of(np.array([7.0])) == spacing_of(np.array([7.0]), np.array([8.0])) == 1.0


def test_spikes_lose_their_weight_and_dropouts_are_left_out():
    rng = np.random.default_rng(2)
    records, residuals = replicated(rng, 0.3, 0.2)
    residuals[0][50] += 40.0
    values = records[0].values.copy()
    values[100:140] = 0.0
    assert not usable(values)[100:140].any() and usable(values)[:95].all()
    noise = estimate(records, residuals, [np.zeros(400)] * len(records))
    assert noise.whiteners[0].weight[50] < 0.3
    assert np.mean(noise.whiteners[1].weight) > 0.95


def test_without_replicates_the_noise_is_flagged():
    rng = np.random.default_rng(3)
    records, residuals = replicated(rng, 0.0, 0.0, runs=1)
    noise = estimate(records, residuals, [np.zeros(400)] * len(records))
    assert noise.streams["te"].source == "fast residual"
    assert noise.streams["te"].scale > 0.5
    assert any("no replicates" in w for w in noise.warnings)


def test_numbers_with_proportional_noise_are_recognised():
    rng = np.random.default_rng(4)
    records, residuals, predictions = [], [], []
    for c, size in enumerate((0.1, 1.0, 10.0, 100.0, 300.0)):
        for k in range(3):
            y = np.array([size * (1 + 0.05 * rng.standard_normal())])
            records.append(Record(f"{c}{k}", "wear", "m", str(c), k, y, {}, {}))
            residuals.append(y - size)
            predictions.append(np.array([size]))
    stream = estimate(records, residuals, predictions).streams["wear"]
    assert stream.proportional and 0.02 < stream.scale < 0.1 and stream.dof["main"] == pytest.approx(10)


def test_numbers_on_a_coarse_display_keep_its_step_as_noise():
    """Repetitions shown by a coarse display are the same number: that is no sign of its being exact."""
    rng = np.random.default_rng(12)
    records, residuals, predictions = [], [], []
    step = 0.25
    for c in range(12):
        truth = np.array([0.4, 0.9, 1.5]) * (1.0 + 0.2 * c)
        for k in range(3):
            shown = step * np.round((truth * (1.0 + 0.01 * rng.standard_normal(3))) / step)
            records.append(Record(f"r{c}_{k}", "wear_depth", "um", f"c{c}", k, shown, {"duration": np.arange(3.0)}, {}))
            residuals.append(shown - truth)
            predictions.append(truth)
    noise = estimate(records, residuals, predictions)
    scales = np.concatenate([w.scale for w in noise.whiteners])
    # What repeats itself says as little as one of the three.
    assert np.all(scales >= step * np.sqrt(3.0 / 12.0))
    weighed = np.concatenate([w(e) for w, e in zip(noise.whiteners, residuals)])
    assert np.mean(weighed**2) < 1.0


def test_repetition_that_is_left_out_makes_no_noise():
    rng = np.random.default_rng(5)
    torque = np.concatenate([np.linspace(-1.0, 1.0, 60), np.linspace(1.0, -1.0, 60)])
    records, residuals = [], []
    for condition in ("a", "b"):
        for k in range(5):
            off = 4.0 if (condition, k) == ("b", 3) else 0.0
            e = 0.05 * rng.standard_normal(120) + off * torque
            records.append(Record(f"{condition}{k}", "hysteresis", "rad", condition, k, torque + e, {"torque": torque, "time": np.arange(120.0)}, {}))
            residuals.append(e)
    marked = with_left_out(records, outlying(records))
    assert [r.name for r in marked if r.left_out] == ["b3"]
    noise = estimate(marked, residuals, [torque] * len(records))
    stream = noise.streams["hysteresis"]
    assert stream.scale == pytest.approx(0.05, rel=0.15) and sum(stream.patterns.values()) < 1.0
    assert all(np.median(w.weight) > 0.95 for r, w in zip(marked, noise.whiteners) if not r.left_out)


def test_a_zero_that_jumps_from_run_to_run_counts_for_what_it_says():
    """A constant over a run weighs 1/zero_noise^2 whatever its samples; in a table of orders the mean has a noise of its own."""
    x, left = np.linspace(0.0, 2.0 * np.pi, 200), 0.1 * np.random.default_rng(2).standard_normal(200)
    plain, jumping = (
        estimate([Record("r", "transmission_error", "rad", "c", 1, left, {"angle": x}, {}, stated_noise=0.1, zero_known=True, zero_noise=zero)],
                 [left], [np.zeros(200)]).whiteners[0]
        for zero in (0.0, 5.0)
    )  # fmt: skip
    constant, wave = np.ones(200), np.sin(7 * x)
    assert np.sum(jumping(constant) ** 2) == pytest.approx(1.0 / 5.0**2, rel=0.1) and np.sum(plain(constant) ** 2) > 100.0 * np.sum(jumping(constant) ** 2)
    assert np.sum(jumping(wave) ** 2) == pytest.approx(np.sum(plain(wave) ** 2), rel=0.02)
    assert jumping.floor == pytest.approx(5.0, rel=0.01)
    order, part = np.array([0.0, 1.0, 1.0, 39.0, 39.0]), np.array([0.0, 0.0, 1.0, 0.0, 1.0])
    records = [Record(f"r{k}", "transmission_order", "rad", str(k), 1, np.zeros(5), {"order": order, "part": part}, {}, stated_noise=0.3,
                      zero_known=True, zero_noise=0.4) for k in range(3)]  # fmt: skip
    table = estimate(records, [np.zeros(5)] * 3, [np.zeros(5)] * 3).whiteners[0]
    assert np.allclose(table.scale, [0.5, 0.3, 0.3, 0.3, 0.3])


def test_slow_noise_of_few_short_runs_is_known_little():
    """Two pairs of 48 samples that forget over ten: their slow waves are known far less than quick ones."""
    rng = np.random.default_rng(4)
    x = np.arange(48.0)
    records, residuals = [], []
    for c in range(2):
        for k in range(2):
            state, e = rng.standard_normal(), np.zeros(48)
            for i in range(48):
                state = 0.9 * state + np.sqrt(0.19) * rng.standard_normal()
                e[i] = state
            records.append(Record(f"{c}{k}", "te", "1", str(c), k, e, {"angle": x}, {}))
            residuals.append(e)
    noise = estimate(records, residuals, [np.zeros(48)] * 4)
    stream, mapped = noise.streams["te"], noise.whiteners[0]
    assert stream.dof[SLOW] == pytest.approx(96 / 2 * np.tanh(0.5 / stream.length)) and stream.dof[SLOW] < 10.0 < stream.dof["main"]
    slow = [k for k, component in enumerate(mapped.components) if component == ("te", SLOW)]
    basis = mapped.directions
    assert np.allclose(basis.T @ basis, np.eye(basis.shape[1]), atol=1e-9)
    # They are only booked apart: the map is what it was.
    assert np.all(mapped.shrink[slow] == 0.0)
    wave = mapped(np.cos(2 * np.pi * x / 48))
    assert np.sum((basis.T @ wave) ** 2) > 0.8 * np.sum(wave**2)


def test_many_samples_leave_slow_noise_as_well_known_as_any():
    rng = np.random.default_rng(1)
    records, residuals = replicated(rng, 0.8, 1.0)
    assert SLOW not in estimate(records, residuals, [np.zeros(400)] * len(records)).streams["te"].dof
