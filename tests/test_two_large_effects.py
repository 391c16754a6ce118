"""Two large effects, of which the best fit alone is neither: where all pairs with it leave much, others are begun with, and cages and zeros placed anew."""

from types import SimpleNamespace

import pytest
from test_confusable import rival

from discrepancy.inference.alone import close_behind
from discrepancy.inference.selection import MOST_FIRSTS, Selection, leaves_much
from discrepancy.inference.verdict import Settings
from discrepancy.problem import BASE

SAMPLES = 1000


def fit(name, chi2, gain=0.0, part="plant"):
    found = rival(name, chi2, part=part)
    found.gain, found.fit.residual = gain, range(SAMPLES)
    return found


def selection(**members):
    return SimpleNamespace(settings=Settings(), tried=lambda what, function, items: [function(r) for r in items], **{"is_on_the_way": lambda fit: False, **members})


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

    def race(what, promising, other):
        beside.append((other.name, [s.name for s in promising]))
        return [fit(f"{other.name} + {s.name}", 1000.0) for s in promising]

    monkeypatch.setattr("discrepancy.inference.selection.screen", screened)
    candidates = [c for r in known for c in r.candidates]
    # This pair was fitted before.
    fitted = {r.key: r for r in known} | {frozenset(["other0", "second"]): None}
    chosen = selection(refits=SimpleNamespace(fitted=fitted), candidates=candidates, space=None, columns=None, race=race)
    found = Selection.begun_otherwise(chosen, first)
    assert beside == [("other0", ["other1"]), ("other1", ["second"]), ("other2", ["second", "other1"])]
    assert [r.name for r in found] == ["other0 + other1", "other1 + second", "other2 + second", "other2 + other1"]


@pytest.mark.parametrize(("leaves", "expected"), [(True, ["near", "second"]), (False, ["near"])], ids=["something is left", "nothing is left"])
def test_the_foremost_are_looked_at_in_earnest_where_the_best_leaves_something(leaves, expected):
    """The pitch of one disc beside that of the other, which shows where the output goes through its play: roughly 580 of chi-square behind a ring off its
    centre, whose gain is 10,000, in earnest 84 before it."""
    fits = [fit(name, 33000.0 - gain, gain) for name, gain in (("best", 10000.0), ("near", 9990.0), ("second", 9400.0), ("third", 9390.0), ("far", 5000.0))]
    close, behind = close_behind(fits, 23100.0, leaves)
    assert ([f.name for f in close], [f.name for f in behind]) == (expected, [f.name for f in fits[1:] if f.name not in expected])
