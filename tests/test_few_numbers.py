"""Campaigns of a few numbers: who is tried, fits along bent valleys, and what an uncertain fit may foretell."""

from dataclasses import dataclass

import numpy as np
import pytest

from discrepancy.inference.base_fit.fit import fit_of
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.held_out.held_out import HeldOutJudge
from discrepancy.inference.misfit.localise import Localiser
from discrepancy.inference.refit.effect_fit import fit_effects
from discrepancy.inference.refit.in_earnest import in_earnest, renew
from discrepancy.inference.refit.refit import finished, refit
from discrepancy.inference.screening.screen import Block, Columns, Score, bounded_gain
from discrepancy.inference.selection import Selection
from discrepancy.inference.verdict import Settings
from discrepancy.problem import Candidate, Parameter, Record


@dataclass
class Numbers:
    """Single numbers that a law foretells from the record and the values."""

    records: list
    law: object
    nuisances: tuple = ()
    candidates: tuple = ()

    def predict(self, values, which=None):
        return [self.law(self.records[i], values) for i in (range(len(self.records)) if which is None else which)]


def number(name, values, hours=None, replicate=1, noise=None, **factors):
    values = np.asarray(values, float)
    axes = {"hours": np.asarray(hours, float)} if hours is not None else {"angle": np.arange(values.size, dtype=float)}
    held_out = factors.pop("held_out", False)
    return Record(f"{name} {replicate}", "wear_depth", "m", name, replicate, values, axes, factors, held_out=held_out, stated_noise=noise)


def run_in():
    """Workspace, effect and a rough fit of wear that runs in: a coefficient over four decades, and an excess that goes with its inverse."""
    def worn(record, values):
        t, level, tau = record.axes["hours"], values.get("level", 5.0), values.get("tau", 200.0)
        return 0.01 * level * (t + values.get("excess", 0.0) * tau * -np.expm1(-t / tau))

    truth = {"level": 0.1, "excess": 40.0, "tau": 90.0}
    hours = [0.0, 300.0, 600.0, 800.0, 1000.0]
    new = number("life", np.zeros(5), hours, noise=0.02)
    run = number("life", worn(new, truth), hours, noise=0.02)
    excess = Candidate("run in", "run in", (Parameter("excess", "1", 0.0, -0.95, 50.0, 2.0, 1),), (Parameter("tau", "h", 200.0, 1.0, 5000.0, 200.0),))
    space = Workspace(Numbers([run], worn, (Parameter("level", "1", 5.0, 0.02, 1e3, 5.0),), (excess,)))
    space.fit_base()
    assert space.base.chi2 > 100.0
    return space, excess, fit_effects(space, [excess], [{"excess": 2.0, "tau": 200.0}])


def test_a_reported_fit_has_come_to_the_end_of_a_bent_valley():
    space, excess, rough = run_in()
    assert renew(space, rough, [excess]).chi2 < 0.5


def test_a_fit_in_earnest_that_will_not_be_as_good_as_another_is_left(monkeypatch):
    """Of three effects on a base that is too rigid the second best took longer than the best, and stood still at twice its chi-square."""

    def asked(least):
        space, excess, _ = run_in()
        halfway = space.base.values | {"excess": 4.0, "tau": 200.0}
        parameters = (*space.model.nuisances, *excess.parameters)
        begun = fit_of(parameters, halfway, space.residual(halfway), space.columns(parameters, halfway), ("run in",), False)
        predicted, predict = [], Numbers.predict
        with monkeypatch.context() as patch:
            patch.setattr(Numbers, "predict", lambda model, values, which=None: predicted.append(values) or predict(model, values, which))
            found, covariance = in_earnest(space, begun, [excess], least)
        assert found.chi2 <= begun.chi2 and (covariance is None) is (least < 0.0)
        return len(predicted), found.chi2

    dear, left = asked(np.inf)
    assert left < 0.5 and asked(1.0) == (dear, left)
    assert asked(-1e6)[0] < 0.7 * dear


def scores_of(statistics):
    return [Score(name, statistic, 1e-6, 1e-4, {}, None, 0) for name, statistic in statistics.items()]


def test_all_that_few_numbers_leave_alike_are_tried(monkeypatch):
    """Ten effects do as well to first order, three of them only with impossible sizes."""
    selection = object.__new__(Selection)
    selection.settings = Settings()
    alike = scores_of({f"effect {k}": 165.7 - 0.1 * k for k in range(10)})
    monkeypatch.setattr(selection, "promise", lambda s: 40.0 if s.name in ("effect 0", "effect 1", "effect 2") else 160.0, raising=False)
    assert {s.name for s in selection.first_tried(alike, 165.7)} == {f"effect {k}" for k in range(3, 10)}
    apart = scores_of({f"effect {k}": 165.7 - 12.0 * k for k in range(8)})
    assert [s.name for s in selection.first_tried(apart, 165.7)] == [f"effect {k}" for k in range(7)]


def straight(record, values):
    return np.full(len(record.values), 100.0 + values.get("slope", 0.0) * record.factors["load"])


def extrapolated(slope, seed):
    """Judgement of a slope that was fitted at small loads, at a load forty times as large."""
    rng = np.random.default_rng(seed)
    runs = [
        number(f"load {load:g}", 100.0 + slope * load + rng.standard_normal(3), None, k, load=load, held_out=load == 40.0)
        for load in (1.0, 2.0, 40.0) for k in (1, 2)
    ]  # fmt: skip
    effect = Candidate("slope", "slope", (Parameter("slope", "m", 0.0, -100.0, 100.0, 1.0),))
    space = Workspace(Numbers(runs, straight, (), (effect,)))
    space.fit_base()
    local = Localiser(space, {}).test(space.base, 0.01)
    fit = finished(space, [effect], refit(space, [effect], [], {"slope": slope}).fit)
    return HeldOutJudge(space, local, [fit], {}).judge(fit)


def test_what_a_fit_does_not_know_is_no_failure_on_unused_runs():
    judged = [extrapolated(5.0, seed) for seed in range(8)]
    assert max(j.after for j in judged) > 4.0
    assert min(j.p_after for j in judged) > 0.0005


@pytest.mark.parametrize("upper, gain", [(10.0, 100.0), (4.0, 64.0)])
def test_a_gain_ends_at_the_bounds(upper, gain):
    """Chi-square of 100 at amplitude 10: an effect that may reach 4 gains 2 * 40 - 16."""
    amplitude = Parameter("a", "1", 0.0, 0.0, upper, 1.0, 1)
    space = Workspace(Numbers([number("one", [10.0], noise=1.0, load=1.0)], lambda record, values: np.array([values.get("a", 0.0)]), (), ()))
    fit = space.fit_base()
    weight = fit.residual[0] / 10.0
    columns = Columns(np.array([[weight]]), (Block(0, {}, slice(0, 1), (1,)),))
    found, sizes = bounded_gain(columns, fit, Score("a", 0.0, 0.0, 0.0, {}, None, 0), (amplitude,))
    assert found == pytest.approx(gain * weight**2) and sizes[0] == pytest.approx(10.0)
