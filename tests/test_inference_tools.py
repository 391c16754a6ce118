"""Screening statistics, splines, closed forms and the choice of the next experiment."""

import numpy as np
import pytest

from discrepancy.inference.closed_forms import propose
from discrepancy.inference.next_experiment import Experiment, RivalLaw, next_experiment, separation
from discrepancy.inference.screen import cone_statistic
from discrepancy.inference.splines import additive


def test_cone_statistic_is_the_best_admissible_projection():
    rng = np.random.default_rng(0)
    u = rng.standard_normal((30, 2))
    scores = rng.standard_normal((50, 30)) @ u
    gain, amplitude = cone_statistic(scores, u.T @ u, (1, 1))
    from scipy.optimize import nnls
    for k in range(50):
        r = u @ np.linalg.solve(u.T @ u, scores[k])
        a, _ = nnls(u, r)
        assert gain[k] == pytest.approx(2 * a @ scores[k] - a @ u.T @ u @ a, abs=1e-8)
        assert np.allclose(a, amplitude[k], atol=1e-8)


def test_additive_splines_find_each_component():
    rng = np.random.default_rng(1)
    a, b = rng.uniform(0, 1, 300), rng.uniform(0, 1, 300)
    y = np.sin(2 * np.pi * a) + 0.2 * b + 0.1 * rng.standard_normal(300)
    curves, fitted = additive(y, np.full(300, 100.0), {"a": a, "b": b})
    assert curves[0].name == "a" and curves[0].share > 0.8
    assert np.sqrt(np.mean((curves[0].y - np.sin(2 * np.pi * curves[0].x)) ** 2)) < 0.12
    assert np.std(y - fitted) == pytest.approx(0.1, rel=0.2)


@pytest.mark.parametrize("name, law", [("power", lambda x: 2 * x**2.5), ("exponential", lambda x: 1 + 3 * np.exp(-4 * x)),
                                       ("linear", lambda x: 1 - 2 * x), ("threshold", lambda x: 3 * np.maximum(x - 0.6, 0)),
                                       ("periodic", lambda x: np.cos(25 * x)), ("bump", lambda x: np.exp(-((x - 0.5) / 0.07) ** 2)),
                                       ("constant", lambda x: 0 * x + 2)])
def test_closed_form_is_recognised(name, law):
    rng = np.random.default_rng(2)
    x = np.linspace(0.1, 1.0, 80)
    deviation = 0.02 * (np.ptp(law(x)) or 1.0)
    forms = propose(x, law(x) + deviation * rng.standard_normal(80), np.full(80, deviation))
    assert forms[0].name == name
    assert forms[0].confidence > 0.4 and forms[0].error < 1.5


def law(rival, values, experiment):
    x = np.array([experiment.settings["load"]])
    return values["a"] * x ** (1.0 if rival.name == "linear" else 2.0)


def rivals(variance):
    return [RivalLaw(n, {"a": 1.0}, ["a"], np.array([[variance]]), np.array([1.0])) for n in ("linear", "square")]


def test_separation_counts_what_parameters_would_swallow():
    experiment = Experiment("x", 1.0, 0.1, settings={"load": 2.0})
    sure = separation(law, experiment, rivals(0.0))[("linear", "square")]
    vague = separation(law, experiment, rivals(1.0))[("linear", "square")]
    assert sure == pytest.approx((2.0 / 0.1) ** 2)
    assert vague == pytest.approx(4.0 / (0.01 + 4.0 + 16.0), rel=1e-3)


def test_the_cheapest_sufficient_experiment_comes_first():
    choices = [Experiment(f"load {x}", cost, 0.1, settings={"load": x}) for x, cost in ((1.0, 1.0), (1.5, 2.0), (3.0, 9.0))]
    result = next_experiment(law, choices, rivals(1e-4), [Experiment("service", 0.0, settings={"load": 4.0})])
    assert result.separable and result.proposals[0].experiment == "load 1.5"
    assert result.at_stake["service"] == pytest.approx(12.0)
    hopeless = next_experiment(law, choices[:1], rivals(1e-4))
    assert not hopeless.separable and "cannot be separated" in hopeless.verdict
