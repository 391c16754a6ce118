"""Two large effects, of which the best fit alone is neither: where all pairs with it leave much, others are begun with, and cages and zeros placed anew."""

from types import SimpleNamespace

import pytest
from test_confusable import rival

from discrepancy.inference.selection import MOST_FIRSTS, Selection, leaves_much
from discrepancy.inference.verdict import Settings
from discrepancy.problem import BASE

SAMPLES = 1000


def fit(name, chi2, gain=0.0, part="plant"):
    found = rival(name, chi2, part=part)
    found.gain, found.key, found.fit.residual = gain, frozenset([name]), range(SAMPLES)
    return found


def selection(**members):
    return SimpleNamespace(settings=Settings(), tried=lambda what, function, items: [function(r) for r in items], **members)


@pytest.mark.parametrize("least", [1200.0, 1600.0], ids=["one leaves little", "all leave much"])
def test_pairs_that_all_leave_much_are_fitted_from_other_starts(least):
    near, better, far = fit("near", 4000.0), fit("better", least), fit("far", 60000.0)
    widened = {"near": 1100.0, "better": 1550.0}
    chosen = selection(refits=SimpleNamespace(widened=lambda r, least: fit(r.name, widened[r.name])))
    chosen.widely = Selection.widely.__get__(chosen)
    found = {r.name: r.fit.chi2 for r in Selection.widely_beside(chosen, [near, better, far], 90000.0)}
    assert found == ({"near": 1100.0, "better": 1550.0, "far": 60000.0} if least > 1500.0 else {"near": 4000.0, "better": least, "far": 60000.0})
    assert not leaves_much([fit("one", chi2) for chi2 in found.values()])


def test_pairs_begin_with_others_that_explain_nearly_as_much(monkeypatch):
    first = fit("first", 7000.0, 1000.0)
    others = [fit(f"other{k}", 7050.0 + k, 990.0 - k) for k in range(MOST_FIRSTS + 1)]
    known = [first, *others, fit("less", 7300.0, 700.0), fit("base.stiffness", 7001.0, 999.0, BASE)]
    scores = [SimpleNamespace(name=name, statistic=statistic) for name, statistic in (("second", 900.0), ("other1", 800.0), ("hopeless", 10.0))]
    beside = []

    def screened(space, candidates, columns, fit, seed, draws, exclude):
        return SimpleNamespace(scores=[s for s in scores if s.name not in exclude])

    def race(what, promising, names, own):
        beside.append((names[0], [s.name for s in promising]))
        return [fit(f"{names[0]} + {s.name}", 1000.0) for s in promising]

    monkeypatch.setattr("discrepancy.inference.selection.screen", screened)
    candidates = [c for r in known for c in r.candidates]
    # This pair was fitted before.
    fitted = {r.key: r for r in known} | {frozenset(["other0", "second"]): None}
    chosen = selection(refits=SimpleNamespace(fitted=fitted), candidates=candidates, space=None, columns=None, race=race, where_alone=lambda name: None)
    found = Selection.begun_otherwise(chosen, first)
    assert beside == [("other0", ["other1"]), ("other1", ["second"]), ("other2", ["second", "other1"])]
    assert [r.name for r in found] == ["other0 + other1", "other1 + second", "other2 + second", "other2 + other1"]
