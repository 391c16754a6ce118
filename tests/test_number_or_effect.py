"""A number of the base model that is a little off, alone or beside an effect: what it takes away, and what of two conditions may be named."""

from dataclasses import replace
from types import SimpleNamespace

from test_confusable import Rival, rival

from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.judgement import Judgement
from discrepancy.inference.refit.refits import OF_GAIN, Refits
from discrepancy.inference.selection import Selection, ranked
from discrepancy.inference.verdict import Settings
from discrepancy.problem import BASE, Candidate, Parameter

EFFECT, NUMBER, FAR = rival("spring", 100.0), rival("base.stiffness", 102.0, part=BASE), rival("base.radius", 120.0, part=BASE)


def beside(first: Rival, second: Rival, bounds: tuple = ()) -> Rival:
    """A fit of an effect with a second, newer one, as good as the second alone."""
    fit = replace(second.fit, at_bounds=bounds, values=first.fit.values | second.fit.values, parameters=[*first.fit.parameters, *second.fit.parameters])
    return Rival(f"{first.name} + {second.name}", fit, candidates=first.candidates + second.candidates)


def test_a_number_of_the_base_stands_before_an_effect_that_is_hardly_better():
    first = rival("clearance", 0.0)
    spring, number, far = (beside(first, other) for other in (EFFECT, NUMBER, FAR))
    assert [t.name for t in ranked([far, spring, number], 6.0, 300.0)] == [number.name, spring.name, far.name]
    assert ranked([far, spring], 6.0, 300.0)[0] is spring
    assert ranked([spring, beside(first, NUMBER, ("base.stiffness_size",))], 6.0, 300.0)[0] is spring


def test_what_ends_at_a_bound_stands_behind_others_that_are_not_plainly_worse():
    """A friction that took 5,400 of chi-square away, its speed at a bound for nothing moves in a loop, stood behind a play that took 240."""
    first = rival("clearance", 0.0)
    play = beside(first, rival("play", 5000.0))
    near, far = (beside(first, rival("friction", chi2), ("friction_size",)) for chi2 in (4950.0, 1000.0))
    assert ranked([near, play], 6.0, 5400.0)[0] is play
    assert ranked([play, far], 6.0, 5400.0)[0] is far


def explains(rivals, chance=True, left=False) -> bool:
    doctor = SimpleNamespace(settings=Settings(), beyond_chance=lambda best: chance, judgement=SimpleNamespace(leftover=lambda best: (left,)))
    return Diagnostician.base_explains(doctor, rivals)


def test_a_misfit_beyond_doubt_is_the_base_where_a_number_of_it_leaves_nothing():
    """Of a mesh 1 % stiffer than the file's a loop of few degrees of freedom showed too little for a name, and "unknown" was said."""
    assert explains([EFFECT, NUMBER]) and explains([NUMBER])
    assert not explains([EFFECT, FAR]) and not explains([]) and not explains([NUMBER], chance=False) and not explains([NUMBER], left=True)


def judge(conditions: str, held_out=(), left=False) -> Judgement:
    found = object.__new__(Judgement)
    found.space = SimpleNamespace(held_out=held_out, conditions=sorted(set(conditions)))
    found.leftover = lambda joint: (left,)
    return found


def test_of_two_conditions_neither_can_be_left_out():
    """A needle clearance with a crank seat 1.7 % softer than the file's stayed "named but incomplete": 8,000 of chi-square more, and nothing left."""
    assert judge("aabb").is_whole(EFFECT) and not judge("aabb", left=True).is_whole(EFFECT)
    assert not judge("abc").is_whole(EFFECT) and not judge("aabb", held_out=(4,)).is_whole(EFFECT)


def test_what_may_stand_in_a_members_place_counts_by_what_that_gained():
    alone = SimpleNamespace(settings=Settings(), little_behind=lambda gain: Selection.little_behind(SimpleNamespace(settings=Settings()), gain))
    best = rival("a", 100.0)
    # Beside an effect that gained two millions a rival 18,000 behind was fitted in earnest.
    assert Selection.as_good(alone, best) == 124.0 and 1100.0 < Selection.as_good(alone, best, 2e6) < 1200.0


SAMPLES = 300


def told(gain: float, off: float = 0.0, counts: bool = False, left: float = 1.0) -> bool:
    pin = Parameter("pin", "1", 1.0, 1.0, 40.0, 1.0, counts=counts)
    more = Candidate("more", "more", (Parameter("size", "1", 0.0, -1.0, 1.0, 1.0),), (pin,))
    known = SimpleNamespace(gain=1000.0, candidates=EFFECT.candidates, key=frozenset(["spring"]),
                            fit=SimpleNamespace(values={"zero": 0.1}, chi2=left * SAMPLES, residual=range(SAMPLES)))  # fmt: skip
    refits = SimpleNamespace(final_fits={known.key: known})
    result = SimpleNamespace(gain=gain, candidates=(*EFFECT.candidates, more), key=frozenset(["spring", "more"]), fit=SimpleNamespace(values={"zero": 0.1 + off}))
    return Refits.zeros_are_told(refits, result, [{"zero": 0.9}])


def test_zeros_that_an_effect_has_told_are_not_tried_again_beside_one_that_adds_little():
    assert told(1000.0 + 0.5 * OF_GAIN * 1000.0)
    assert not told(1500.0) and not told(1050.0, off=0.7) and not told(1050.0, counts=True)
    # What leaves ten times the noise may stand at a wrong one (three lobes without the worn race beside them).
    assert not told(1050.0, left=10.0)
