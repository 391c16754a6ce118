"""A base that is too rigid, and an effect besides that leaves far more than noise: what calibrates is told by what one more effect leaves; and what unused runs
do not confirm ends the search before all rivals are fitted in earnest."""

from types import SimpleNamespace

import numpy as np
import pytest
from test_confusable import rival
from test_members_give_way import joint

from discrepancy.inference.alone import VERY_MUCH, Alone, Foremost
from discrepancy.inference.refit import refit as refitting
from discrepancy.inference.selection import Selection
from discrepancy.inference.verdict import Settings
from discrepancy.problem import Candidate, Parameter

COUNT = 1000
LITTLE, MUCH = 1.5 * COUNT, 20.0 * VERY_MUCH * COUNT
SEAT, SPRING, HOUSING, FRICTION, PLAY = (rival(name, 0.0) for name in ("seat.any", "spring.carrier", "spring.housing", "friction.mesh", "play"))


def fitted(*members, chi2):
    found = joint(*members, chi2=chi2)
    found.fit.residual = np.zeros(COUNT)
    return found


def selection_of(several, calibrating=True, pairs=()):
    """What ``several`` finds is what calibrates best; ``pairs`` are the fits of two."""
    by_key = {r.key: r for r in pairs}
    refits = SimpleNamespace(fitted={}, final_fits={}, seen=lambda r: r, fit=lambda names, start=None: by_key[frozenset(names)])
    scores = [SimpleNamespace(name=name) for name in ("seat.any", "spring.carrier", "spring.housing", "friction.mesh", "play")]
    selection = SimpleNamespace(refits=refits, several=lambda best: several, screening=SimpleNamespace(scores=scores), calibrating=calibrating,
                                where_alone=lambda name: None, as_good=lambda best: 0.0, singles=lambda: [SEAT])  # fmt: skip
    for name in ("is_on_the_way", "begun_without", "calibrations"):
        setattr(selection, name, getattr(Selection, name).__get__(selection))
    return selection


@pytest.fixture
def pairs():
    """Alone both springs do the same, beside friction they do not."""
    return [fitted(HOUSING, FRICTION, chi2=1.9 * MUCH), fitted(SPRING, FRICTION, chi2=2.0 * MUCH), fitted(SPRING, PLAY, chi2=3.0 * MUCH),
            fitted(FRICTION, PLAY, chi2=9.0 * MUCH)]  # fmt: skip


def test_only_calibrations_that_leave_very_much_are_on_the_way():
    much, little = fitted(SEAT, chi2=MUCH), fitted(SEAT, chi2=LITTLE)
    assert Alone.is_on_the_way(SimpleNamespace(calibrating=True), much)
    assert not Alone.is_on_the_way(SimpleNamespace(calibrating=True), little)
    assert not Alone.is_on_the_way(SimpleNamespace(calibrating=False), much)


def test_beside_what_calibrates_best_stands_what_does_without_it(pairs):
    seat = fitted(SEAT, SPRING, chi2=MUCH)
    assert selection_of(seat, pairs=pairs).calibrations(SEAT) == [seat, pairs[0]]
    # One that leaves little is told by itself.
    good = fitted(SEAT, SPRING, chi2=LITTLE)
    assert selection_of(good, pairs=pairs).calibrations(SEAT) == [good]


def test_the_calibration_is_taken_beside_which_one_more_effect_leaves_least(pairs):
    """Spring, friction and three lobes of the ring: a seat with memory took half of what the lobes do, and no effect beside it was the right one."""
    seat = fitted(SEAT, SPRING, chi2=MUCH)
    promised = {seat.key: 0.6 * MUCH, pairs[0].key: 1.8 * MUCH}

    def screened(fit):
        return SimpleNamespace(scores=[SimpleNamespace(statistic=0.1 * MUCH), SimpleNamespace(statistic=promised[fit.key])])

    assert Selection.calibrated(selection_of(seat, pairs=pairs), screened) == ([SEAT], [pairs[0], seat])
    promised[seat.key] = 0.95 * MUCH
    assert Selection.calibrated(selection_of(seat, pairs=pairs), screened) == ([SEAT], [seat, pairs[0]])
    # No screening where what calibrates leaves little.
    good = fitted(SEAT, SPRING, chi2=LITTLE)
    assert Selection.calibrated(selection_of(good, pairs=pairs), lambda fit: pytest.fail("screened")) == ([SEAT], [good])


def test_beside_the_newest_what_calibrated_alone_begins_with_its_other_shapes(monkeypatch):
    """A seat with memory that slips at 10 N m, beside a hole off its place: alone it had taken what the hole does and slipped at 759, where it stayed."""
    slips = Parameter("slips", "N.m", 20.0, 0.01, 5000.0, 20.0)
    seat = Candidate("seat", "seat", (SEAT.own[0],), (slips,), shape_grid=({"slips": 8.0}, {"slips": 40.0}))
    begun = []

    def jointly(space, parameters, start, names):
        begun.append(start)
        return SimpleNamespace(chi2=100.0 if start["slips"] < 20.0 else 900.0, values=start, parameters=parameters, candidates=names)

    monkeypatch.setattr(refitting, "jointly", jointly)
    monkeypatch.setattr(refitting, "finished", lambda space, candidates, fit: SimpleNamespace(candidates=candidates, fit=fit))
    fit = SimpleNamespace(chi2=500.0, values={"slips": 759.0, "hole": 4e-6}, parameters=(), candidates=())
    found = refitting.reshaped(None, SimpleNamespace(candidates=(seat,), fit=fit))
    assert begun == [{"slips": 8.0, "hole": 4e-6}, {"slips": 40.0, "hole": 4e-6}]
    assert found.fit.values["slips"] == 8.0
    # One that is no better leaves it as it was.
    fit.chi2 = 50.0
    same = SimpleNamespace(candidates=(seat,), fit=fit)
    assert refitting.reshaped(None, same) is same


@pytest.mark.parametrize(("p", "gains", "stands"), [(1e-4, {}, True), (0.01, {"best": 5.0}, False), (0.01, {"best": 7.0}, True), (0.01, {"other": 7.0}, True),
                                                    (0.003, {"best": 1.0}, True), (0.003, {"best": -1.0}, False)])  # fmt: skip
def test_what_unused_runs_do_not_confirm_is_known_before_rivals_are_fitted_in_earnest(p, gains, stands):
    best, other, far = rival("best", 1000.0), rival("other", 1003.0), rival("far", 1200.0)
    judged = {r.key: SimpleNamespace(seen=True, gain=gains.get(r.name, -1.0), before=1.0, after=1.0) for r in (best, other, far)}
    judged[far.key].gain = 1e3
    judgement = SimpleNamespace(held_out=lambda fits: SimpleNamespace(judge=lambda r: judged[r.key]))
    alone = SimpleNamespace(settings=Settings(), judgement=judgement, near=lambda best: best.fit.chi2 + 20.0)
    assert Alone.may_stand(alone, Foremost([best, other, far], [best], False), p) is stands
    # What leaves something is looked at in any case.
    assert Alone.may_stand(alone, Foremost([best, other, far], [best], True), p)


def test_the_newest_is_fitted_beside_each_spring_that_looked_alike_without_it():
    """A profile beside a housing was taken for a warm disc beside the crank supports, which calibrated a little better before either was there."""
    crank, profile, warm, race = (rival(name, 0.0) for name in ("spring.cranks", "profile", "warm", "race"))
    calibration = fitted(crank, FRICTION, chi2=MUCH)
    trials = [fitted(crank, FRICTION, race, chi2=0.9 * MUCH), fitted(crank, FRICTION, warm, chi2=0.1 * MUCH), fitted(crank, FRICTION, profile, chi2=0.2 * MUCH)]
    alone = [fitted(r, chi2=2.0 * MUCH) for r in (crank, SPRING, HOUSING, SEAT)]
    asked = []

    def fit(names, start, scores=()):
        asked.append(([*names, *scores], start))
        return fitted(*(rival(name, 0.0, size=9.0) for name in names), chi2=MUCH)

    selection = SimpleNamespace(refits=SimpleNamespace(fitted={r.key: r for r in alone}, fit=fit), scores={name: f"score of {name}" for name in ("warm", "profile")})
    Selection.of_other_forms(selection, trials, calibration)
    springs = ("spring.carrier", "spring.housing")
    assert asked[:2] == [([spring, "friction.mesh"], {**calibration.at, f"{spring}_size": 1.0}) for spring in springs]
    assert asked[2:] == [([spring, "friction.mesh", newest, f"score of {newest}"], {f"{spring}_size": 9.0, "friction.mesh_size": 9.0})
                         for newest in ("warm", "profile") for spring in springs]  # fmt: skip
    # A spring that is the newest itself is not fitted beside itself.
    asked.clear()
    selection.scores = {"spring.housing": "score"}
    Selection.of_other_forms(selection, [fitted(crank, FRICTION, HOUSING, chi2=MUCH)], calibration)
    assert [names for names, _ in asked[2:]] == [["spring.carrier", "friction.mesh", "spring.housing", "score"]]
