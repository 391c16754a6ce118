"""Screening statistics, splines, closed forms and the choice of the next experiment."""

import contextlib
from dataclasses import dataclass
from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.inference.base_fit.components import simulate
from discrepancy.inference.base_fit.predictions import Predictions
from discrepancy.inference.law.closed_forms import propose
from discrepancy.inference.law.splines import additive
from discrepancy.inference.misfit.features import features
from discrepancy.inference.next_experiment import Experiment, RivalLaw, next_experiment, separation
from discrepancy.inference.noise.correlation import autoregression_of, trend_of
from discrepancy.inference.noise.whiten import autoregress
from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.refit.refits import Refits, beside
from discrepancy.inference.screening.screen import Block, Columns, cone_statistic
from discrepancy.inference.screening.seen import only_seen
from discrepancy.problem import Candidate, Parameter, Record


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


def test_a_shape_counts_if_any_variant_that_has_it_is_on():
    """Variants of an effect share a phase: that of the one that is off must not erase the other's."""
    phase = Parameter("phase", "rad", 0.0, -7.0, 7.0, 0.3)
    variants = [Candidate(f"gear.{n}", n, (Parameter(n, "m", 0.0, -1.0, 1.0, 0.1),), (phase,)) for n in ("mesh", "planet")]
    predictions = Predictions(SimpleNamespace(nuisances=(), candidates=variants))
    for first, second in (("mesh", "planet"), ("planet", "mesh")):
        assert predictions.active({first: 0.2, second: 0.0, "phase": 1.0}) == {first: 0.2, "phase": 1.0}
    assert predictions.active({"mesh": 0.0, "phase": 1.0}) == {}


def test_simulated_scores_have_the_variance_of_their_columns_however_large_others_are():
    gram = np.diag([1e-6, 1.0, 1e20]) + 0.0
    gram[0, 1] = gram[1, 0] = 0.5e-3
    space = SimpleNamespace(noise=SimpleNamespace(dof=lambda component: 1e6))
    scores = simulate(space, {("te", "main"): gram}, 4000, np.random.default_rng(0), {("te", "main"): 1.0})
    found = np.cov(scores.T)
    assert np.allclose(np.diag(found), np.diag(gram), rtol=0.1)
    assert found[0, 1] == pytest.approx(gram[0, 1], rel=0.15)


def test_a_column_without_any_part_in_the_noise_has_no_score():
    gram = np.diag([-1e-18, 1.0])
    gram[0, 1] = gram[1, 0] = 1e-10
    space = SimpleNamespace(noise=SimpleNamespace(dof=lambda component: 1e6))
    scores = simulate(space, {("te", "main"): gram}, 100, np.random.default_rng(0), {})
    assert np.all(np.isfinite(scores)) and not np.any(scores[:, 0])


@pytest.mark.parametrize("shape", [(1, 1), (5, 2), (40, 1), (40, 7)])
def test_an_autoregression_is_taken_off_tap_by_tap(shape):
    """To the last bit what arrays of a tap each had, which took a quarter of a comparison of two million samples."""
    rng = np.random.default_rng(3)
    columns, taps = rng.standard_normal(shape), np.array([0.4, -0.2, 0.1, 0.05, 0.9])
    expected = columns.copy()
    if len(columns) > taps.size:
        for lag, tap in enumerate(taps[:-1], start=1):
            expected[lag:] -= tap * columns[:-lag]
        expected /= taps[-1]
    assert np.array_equal(autoregress(columns, taps), expected) and np.array_equal(autoregress(columns[:, ::-1], taps), expected[:, ::-1])


def test_autoregression_leaves_no_resonance():
    """ARMA(2, 1) with its peak at 0.07 cycles a sample: what is left has an even spectrum."""
    rng = np.random.default_rng(5)
    series = []
    for _ in range(4):
        white = rng.standard_normal(500)
        y = np.zeros(500)
        for i in range(2, 500):
            y[i] = 2 * 0.85 * np.cos(2 * np.pi * 0.07) * y[i - 1] - 0.85**2 * y[i - 2] + white[i] + 0.4 * white[i - 1]
        series.append(y / y.std())
    taps = autoregression_of(series, [np.ones((500, 1))] * 4, [1.0] * 4)
    left = []
    for y in series:
        e = y.copy()
        for lag, tap in enumerate(taps[:-1], 1):
            e[lag:] -= tap * y[:-lag]
        left.append(np.abs(np.fft.rfft(e[20:] / taps[-1])) ** 2 / 480)
    bands = np.mean(left, axis=0)[1:241].reshape(12, 20).mean(axis=1)
    assert np.all(np.abs(bands - 1.0) < 0.4)


def test_short_runs_without_their_trends_are_white():
    """Forty runs of white noise that lack level and slope: their neighbours go together less than not at all, and no tap is made of that."""
    rng = np.random.default_rng(2)
    trend = trend_of(np.arange(48.0))
    basis = np.linalg.qr(trend)[0]
    series = [e - basis @ (basis.T @ e) for e in rng.standard_normal((40, 48))]
    assert autoregression_of(series, [trend] * 40, [1.0] * 40).size == 0


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


@pytest.mark.parametrize(("speeds", "waves"), [((1.0, 2.0, 4.0, 8.0, 9.0), 4), ((1.0, 1.0, 2.0), 1), ((3.0, 3.0, 3.0), 0)])
def test_a_table_over_a_few_speeds_is_looked_at_along_the_speed(speeds, waves):
    """With as many cosines as there are further levels nothing in it can hide."""
    record = Record("torque", "input_torque", "N.m", "a", 1, np.zeros(len(speeds)), {"speed": np.array(speeds)}, {})
    found = {f.name: f.columns for f in features(record)}
    assert list(found) == ["mean", "along speed"][: 1 + (waves > 0)]
    assert np.linalg.matrix_rank(np.hstack(list(found.values()))) == 1 + waves


def test_what_is_left_without_an_effect_starts_where_it_stands(monkeypatch):
    """From its own start the rest does not find the optimum at which it stands beside the other."""
    parameters = [Parameter(n, "1", 0.0, -9.0, 9.0, 1.0) for n in "ab"]
    candidates = [Candidate(p.name, p.name, (p,)) for p in parameters]

    def refit(space, chosen, scores, start=None, *more, **options):
        chi2 = 10.0 if start and start.get("b") == 5.0 else 400.0
        return Refit(tuple(chosen), SimpleNamespace(chi2=chi2, values={"b": 5.0}), 0.0, np.zeros(0), np.zeros((1, 1)))

    monkeypatch.setattr("discrepancy.inference.refit.refits.refit", refit)
    refits = Refits(SimpleNamespace(predictions=SimpleNamespace(roughly=contextlib.nullcontext)), candidates)
    monkeypatch.setattr(refits, "renewed", lambda result: result)
    joint = Refit(tuple(candidates), SimpleNamespace(chi2=9.5, values={"a": 0.1, "b": 5.0}), 0.0, np.zeros(0), np.zeros((2, 2)))
    assert refits.fit(["b"]).fit.chi2 == 400.0
    assert refits.without(joint, "a").fit.chi2 == 10.0 == refits.fit(["b"]).fit.chi2


def test_the_effect_that_came_last_stands_last_however_the_fit_was_first_asked_for(monkeypatch):
    """What could stand in place of another is read off there."""
    candidates = [Candidate(n, n, (Parameter(n, "1", 0.0, -9.0, 9.0, 1.0),)) for n in "ab"]

    def refit(space, chosen, *more, **options):
        return Refit(tuple(chosen), SimpleNamespace(chi2=1.0, values={}), 0.0, np.zeros(3), np.zeros((2, 2)))

    monkeypatch.setattr("discrepancy.inference.refit.refits.refit", refit)
    refits = Refits(SimpleNamespace(predictions=SimpleNamespace(roughly=contextlib.nullcontext)), candidates)
    first, later = refits.fit(["a", "b"]), refits.fit(["b", "a"])
    assert [c.name for c in first.candidates] == ["a", "b"]
    assert [c.name for c in later.candidates] == ["b", "a"]
    assert later.fit is first.fit


def test_each_line_of_a_spectrum_is_looked_at_by_itself():
    order = np.arange(20.0, 420.0)
    record = Record("vib", "vibration_order", "m/s^2", "a", 1, np.zeros(400), {"order": order}, {})
    found = {f.name: f.columns for f in features(record)}
    assert np.flatnonzero(found["order 36"][:, 0]) == [16] and "order 39" not in found
    assert np.flatnonzero(found["orders: crank, absolute"][:, 0]) == [19]
    assert found["orders: sun"].sum() == 2.0
    seen = np.hstack([columns for name, columns in found.items() if name.startswith("order")])
    assert np.count_nonzero(seen.sum(axis=1)) == 381, "every whole order up to 400"


def test_amplitudes_that_a_campaign_cannot_see_are_left_off():
    """An order that no table has would else be sent to its bounds; what has a fit already keeps what it had."""
    cos1, cos2 = (Parameter(name, "rad", 0.0, -1e-2, 1e-2, 2e-5) for name in ("cos1", "cos2"))
    play = Parameter("play", "m", 0.0, 0.0, 1e-4, 1e-6, sign=1)
    wave, none = np.full(50, 3.0), np.full(50, 1e-12)
    candidates = [Candidate("eccentricity", "", (cos1, cos2)), Candidate("play", "", (play,))]
    columns = Columns(np.column_stack([wave, none, none]), (Block(0, {}, slice(0, 2), (0, 0)), Block(1, {}, slice(2, 3), (1,))))
    reduced, seen = only_seen(candidates, columns, {})
    assert [c.amplitudes for c in reduced] == [(cos1,), (play,)]
    assert seen.values.shape == (50, 2) and [(b.columns, b.signs) for b in seen.blocks] == [(slice(0, 1), (0,)), (slice(1, 2), (1,))]
    again, whole = only_seen(candidates, columns, {"eccentricity": candidates[0]})
    assert again == candidates and whole.values.shape == (50, 3)


def test_what_is_placed_beside_an_effect_is_placed_anew_when_its_fit_has_moved_on(monkeypatch):
    """Cages that were placed where a search had left an effect hold its fit back."""
    candidate = Candidate("a", "a", (Parameter("a", "1", 0.0, -9.0, 9.0, 1.0),))
    placed = []

    class Settled:
        def settle(self, values):
            placed.append(values["a"])
            return True

        def unsettled(self, values):
            return False

    # Each fit goes half of what is left of the way from where the cages were placed to 1; known to 0.2.
    def fitted(space, fit, candidates, least):
        return SimpleNamespace(chi2=1.0, values={"a": 0.5 * (placed[-1] + 1.0)}, parameters=candidate.parameters), np.array([[0.04]])

    monkeypatch.setattr("discrepancy.inference.refit.refits.in_earnest", fitted)
    monkeypatch.setattr("discrepancy.inference.refit.refits.followed", lambda space, fit, candidates, covariance, least: fitted(space, fit, candidates, least))
    monkeypatch.setattr("discrepancy.inference.refit.refits.finished", lambda space, chosen, fit, covariance: Refit(chosen, fit, 0.0, np.zeros(0), covariance))
    refits = Refits(SimpleNamespace(predictions=Settled(), model=None), [candidate])
    monkeypatch.setattr(refits, "otherwise", lambda result, least: result)
    rough = SimpleNamespace(chi2=2.0, values={"a": 0.0}, parameters=candidate.parameters)
    refits.renewed(Refit((candidate,), rough, 0.0, np.zeros(0), np.zeros((1, 1))))
    # The third was fitted from nearer than it is known.
    assert placed == [0.0, 0.5, 0.75]


@pytest.mark.parametrize(("gained_by", "kept"), [("place", "there"), ("effect", "here")])
def test_a_further_effect_that_gains_by_other_places_alone_is_none(monkeypatch, gained_by, kept):
    """Where an input was locked has several optima: beside a further effect a search may find the better one, which is as good without it."""
    candidates = [Candidate(name, name, (Parameter(name, "1", 0.0, -9.0, 9.0, 1.0),)) for name in "ab"]
    places = {"a": "here"}

    class Placed:
        predictions = property(lambda self: self)

        def active(self, values):
            return {name: value for name, value in values.items() if value}

        def places(self, values):
            return "there" if "b" in values else places["a"]

        def put(self, values, there):
            places["a"] = there

        def unplaced(self):
            return [0]

        placed_anew = unseen = otherwise = elsewhere = waves_on = unplaced

    def fitted(space, fit, chosen):
        return SimpleNamespace(chi2=1.0 if (gained_by, places["a"]) == ("place", "there") else 50.0, values=fit.values, residual=[]), np.zeros((1, 1))

    def found(chosen, chi2, **values):
        return Refit(chosen, FitStandIn(chi2, values), 0.0, np.zeros(0), np.zeros((1, 1)))

    monkeypatch.setattr("discrepancy.inference.refit.refits.in_earnest", fitted)
    monkeypatch.setattr("discrepancy.inference.refit.refits.finished", lambda space, chosen, fit, covariance: Refit(chosen, fit, 0.0, np.zeros(0), covariance))
    refits = Refits(SimpleNamespace(predictions=Placed(), model=Placed()), candidates)
    alone, joint = found((candidates[0],), 50.0, a=2.0), found(tuple(candidates), 1.0, a=2.1, b=1e-9)
    refits.final_fits[frozenset("a")] = alone
    better = refits.placed_as(alone, joint)
    assert places["a"] == kept
    assert (better.fit.chi2, better.fit.values) == ((1.0, {"a": 2.1}) if kept == "there" else (50.0, {"a": 2.0}))
    assert refits.final_fits[frozenset("a")] is better


def test_of_places_that_look_alike_those_are_fitted_that_promise_more():
    """After one linear step of what is fitted: at the second place all of the misfit goes, at the third nothing."""
    column, rest = np.eye(4)[:, :1], np.eye(4)[:, 1]
    residual = {"now": 3.0 * rest, "near": 2.0 * column[:, 0] + rest, "far": 9.0 * rest}

    class Placed:
        def put(self, values, there):
            self.there = there

    placed = Placed()
    refits = Refits(SimpleNamespace(predictions=placed, residual=lambda values: residual[placed.there], model=None), [])
    fit = SimpleNamespace(chi2=9.0, values={"a": 1.0}, jacobian=column)
    assert refits.promising(fit, ["far", "near", "now"]) == ["near"]


def test_a_part_that_is_counted_is_tried_where_it_is_one():
    """Between two pins a fit has optima of its own: 11.24 beside a wrong zero, where it is the twelfth."""
    assert beside({"pin": 11.24, "play": 0.3}, ["pin"]) == [{"pin": 11.0}, {"pin": 12.0}]
    assert beside({"play": 0.3}, []) == []


@dataclass(frozen=True)
class FitStandIn:
    chi2: float
    values: dict
