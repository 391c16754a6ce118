"""Of several effects each gives way to what fits as well or better in its place; what numbers are told only together have wide intervals."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from page_model import model_of
from test_confusable import Rival, rival

from discrepancy.inference.base_fit.fit import Box, fit_of
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.refit.beside_base import Freed
from discrepancy.inference.refit.confusable import confusable_set, is_settled
from discrepancy.inference.refit.curvature import _along
from discrepancy.inference.refit.profile import profiles
from discrepancy.inference.refit.refit import estimates, is_untold
from discrepancy.inference.selection import Selection
from discrepancy.inference.telling import why_not, with_base
from discrepancy.inference.verdict import Settings
from discrepancy.problem import Candidate, Parameter
from discrepancy.words.as_told import parameters

BOTH = Candidate("both", "both", (Parameter("gap", "m", 0.0, 0.0, 1e-4, 1e-6, 1), Parameter("tilt", "m", 0.0, 0.0, 1e-4, 1e-6, 1)), signals=("transmission_error",))


def joint(*members: Rival, chi2: float) -> Rival:
    """A fit of effects together, the last the one that came in place of another."""
    fits = [m.fit for m in members]
    fit = replace(fits[0], chi2=chi2, values={k: v for f in fits for k, v in f.values.items()}, at_bounds=tuple(b for f in fits for b in f.at_bounds),
                  parameters=[p for f in fits for p in f.parameters])  # fmt: skip
    return Rival(" + ".join(m.name for m in members), fit, candidates=tuple(c for m in members for c in m.candidates), known=max(m.known for m in members))


FRICTION = rival("friction", 0.0, shape=1.0, known=5.0)
SPRING, OTHER, SLIPPING = rival("spring", 0.0), rival("other", 0.0), rival("slipping", 0.0, bounds=("slipping_size",))


def gives_way_of(final, candidate, other):
    return Selection.gives_way(SimpleNamespace(settings=Settings()), final, candidate, other)


def gives_way(final, member, other):
    return gives_way_of(final, member.candidates[0], other)


def test_a_member_at_a_bound_gives_way_to_a_simpler_one_that_fits_as_well():
    """A seat that never slips stood beside friction, at its bound, though a spring fitted as well: friction's own speed is unknown beside either."""
    seat = joint(FRICTION, SLIPPING, chi2=753.3)
    assert gives_way(seat, SLIPPING, joint(FRICTION, SPRING, chi2=755.0))
    assert not gives_way(seat, SLIPPING, joint(FRICTION, SPRING, chi2=770.0))
    assert not gives_way(joint(FRICTION, SPRING, chi2=755.0), SPRING, seat)


def test_an_effect_alone_that_stands_for_a_simpler_one_gives_way_to_it():
    """A soft housing under dense loops was told first as a seat with memory, the ratio of which went from bound to bound, that fitted better by 6 of 8,000."""
    seat, spring, rough = joint(FRICTION, chi2=7983.8), rival("spring", 7990.0), rival("other", 7989.0)
    refits = SimpleNamespace(fitted={r.key: r for r in (seat, spring, rough)}, final_fits=(seat.key, spring.key))
    selection = SimpleNamespace(settings=Settings(), refits=refits, gives_way=gives_way_of)
    assert Selection.settled(selection, seat) is spring and Selection.settled(selection, spring) is spring
    spring.fit.chi2 = 8000.0
    assert Selection.settled(selection, seat) is seat


def test_a_member_gives_way_to_one_that_is_plainly_better():
    """The wrong spring was kept beside a second effect, for what was 85 better in its place was no stand-in."""
    final = joint(FRICTION, SPRING, chi2=1999.7)
    assert gives_way(final, SPRING, joint(FRICTION, OTHER, chi2=1908.0))
    assert not gives_way(final, SPRING, joint(FRICTION, OTHER, chi2=1996.0))


def test_what_members_have_in_common_speaks_for_none_of_them():
    seat, spring, other = joint(FRICTION, SLIPPING, chi2=753.3), joint(FRICTION, SPRING, chi2=755.0), joint(FRICTION, OTHER, chi2=755.4)
    assert not is_settled(spring) and is_settled(spring, spring.candidates[-1:])

    def last(r):
        return r.candidates[-1:]

    assert confusable_set([spring, other], compared=last) == [spring, other]
    assert confusable_set([seat, spring, other], compared=last) == [spring, other]


def test_what_is_as_well_supported_but_for_a_bound_may_stand_in_a_members_place():
    """Grease that runs out beside wear that grows: where nothing was hidden besides they stood in one set, beside a second effect they did not."""
    final, seat, other = joint(FRICTION, SPRING, chi2=755.0), joint(FRICTION, SLIPPING, chi2=756.5), joint(FRICTION, OTHER, chi2=755.4)
    selection = SimpleNamespace(settings=Settings(), in_place_of=lambda *_: [other, seat])
    assert Selection.stand_ins(selection, final, SPRING.candidates[0], 1.0, 1e6) == [other, seat]
    selection.in_place_of = lambda *_: [joint(FRICTION, SLIPPING, chi2=757.5)]
    assert not Selection.stand_ins(selection, final, SPRING.candidates[0], 1.0, 1e6)


def test_what_was_close_to_the_first_alone_is_tried_beside_the_second(monkeypatch):
    first, close, far = rival("spring", 46700.0), rival("other", 49900.0), rival("friction", 54200.0)
    first.gain = 8.89e6
    scores = {name: SimpleNamespace(name=name) for name in ("spring", "other", "friction", "lobes")}
    refits = SimpleNamespace(fitted={frozenset([r.name]): r for r in (first, close, far)}, fit=lambda names, start=None: (names, start))
    selection = SimpleNamespace(refits=refits, scores=scores, settings=Settings(), screening=SimpleNamespace(scores=[]), columns=None, space=SimpleNamespace(base=None))
    for name in ("as_good", "little_behind", "where_alone", "close_alone"):
        setattr(selection, name, getattr(Selection, name).__get__(selection))
    monkeypatch.setattr("discrepancy.inference.selection.joint_gain", lambda *_: 9e6)
    tried = Selection.exchanged(selection, "spring", "lobes", 8.9e6, selection.close_alone("spring"))
    assert tried == [(["other", "lobes"], {"other_size": 1.0})]


def test_what_calibrates_as_well_with_other_effects_is_kept_for_the_next_to_tell():
    """On a rigid base a seat with memory does what a spring and friction do; with a hole of a disc besides they answered "incomplete"."""
    seat, both, play = rival("seat", 46700.0), joint(SPRING, FRICTION, chi2=46900.0), joint(rival("play", 0.0), SPRING, chi2=60000.0)
    wider, swapped = joint(*(rival(n, 0.0) for n in ("seat", "play", "gap")), chi2=46600.0), rival("other", 46750.0)
    for fit in (seat, both, play, wider, swapped):
        fit.gain = 8.9e6
    refits = SimpleNamespace(fitted={r.key: r for r in (seat, both, play, wider, swapped)})
    selection = SimpleNamespace(refits=refits, settings=Settings(), several=lambda best: best, is_on_the_way=lambda fit: False)
    for name in ("as_good", "little_behind"):
        setattr(selection, name, getattr(Selection, name).__get__(selection))
    assert Selection.calibrations(selection, seat) == [seat, both]
    both.fit.chi2 = 2e5
    assert Selection.calibrations(selection, seat) == [seat]


@pytest.fixture(scope="module")
def together():
    model = model_of({"gap": 6e-6, "tilt": 4e-6})
    model.candidates = (BOTH,)
    doctor = Diagnostician(model)
    return doctor, doctor.run()


def test_numbers_that_are_told_only_together_may_each_be_all_of_it(together):
    """Of friction at rest the sum shows: 0.05 and 0.03 were told as 0.080 (0.075 to 0.085) and 0 (0 to 0.005)."""
    doctor, found = together
    (member,) = found.fits.members
    gap, tilt = estimates(doctor.space, member)
    whole = gap.value + tilt.value
    assert whole == pytest.approx(1e-5, rel=0.05)
    for one, other in ((gap, "tilt"), (tilt, "gap")):
        assert one.interval[0] == 0.0 and whole < one.interval[1] < 1.2 * whole and one.others == (other,)
        # What the base's numbers add is added at the ends, not to the valley's length.
        p = next(p for p in member.own if p.name == one.name)
        assert with_base(one, p, {one.name: Freed(2.0)})["interval_with_base"][1] == pytest.approx(whole + 2.0 * (one.interval[1] - whole))
    assert "both: the fitted runs tell gap and tilt only together" in " ".join(found.warnings)
    (effect,) = found.effects
    assert parameters(effect.parameters, ())["gap"]["told_with"] == ["tilt"]
    flat, *_ = profiles(doctor.space, member)
    assert flat.values.min() == pytest.approx(0.0, abs=1e-9) and flat.values.max() > 0.95 * whole and flat.chi2[np.argmin(flat.values)] < 4.0


def test_bounds_are_told_of_an_effect_as_of_its_numbers(together):
    """Of one that the data say nothing about the list said "at a bound", its entry that it was not."""
    for effect in together[1].effects:
        assert list(effect.at_bounds) == [name for name, entry in effect.parameters.items() if entry["at_bound"]]


def test_between_bounds_to_either_side_sensitivities_are_those_of_the_point():
    """Rounding, divided by what was left of a step, was a curvature: an interval of 8.7044 to 8.7051 N m for a torque known to 2."""
    a, b = Parameter("a", "1", 0.0, 0.0, 10.0, 1.0), Parameter("b", "1", 0.5, 0.0, 1.0, 1.0)
    jacobian = np.array([[1.0, 0.0], [0.5, 2.0]])
    fit = fit_of((a, b), {"a": 1e-14, "b": 1.0 - 1e-14}, np.zeros(2), jacobian)
    rng = np.random.default_rng(1)
    space = SimpleNamespace(residual=lambda values: -jacobian @ [values["a"], values["b"]] + 1e-9 * rng.normal(size=2))
    x = Box(fit.parameters).array(fit.values)
    # Up with both is barred by one, down with both by the other.
    step = np.array([0.3, 0.3])
    assert _along(space, fit, Box([a, b]), x, [0, 1], step) == pytest.approx(jacobian @ step)
    free = fit_of((a, b), {"a": 5.0, "b": 0.5}, np.zeros(2), jacobian)
    assert _along(space, free, Box([a, b]), np.array([5.0, 0.5]), [0, 1], step) == pytest.approx(jacobian @ step, abs=1e-6)


def test_rounding_tells_nothing_of_a_parameter():
    p = Parameter("speed", "m/s", 0.02, 1e-4, 1.0, 0.02)
    told, rounded = (fit_of((p,), {"speed": 1.0}, np.zeros(1), np.array([[size / p.scale]])) for size in (1.0, 1.8e-3))
    assert is_untold(rounded, 0) and not is_untold(told, 0)


def test_how_a_fit_compares_is_said_as_it_is():
    first, same = rival("a", 100.0), rival("b", 100.01)
    assert why_not(same, first, 0.01, "a") == "fits as well as a" and why_not(same, first, -0.01) == "fits as well"
    assert why_not(rival("b", 104.0), first, 4.0, "a") == "fits worse by 4.0 in chi-square than a"
    assert why_not(rival("b", 96.0), first, -4.0) == "fits better by 4.0 in chi-square"
    assert why_not(rival("b", 96.0, size=5e3), first, -4.0) == "fits better by 4.0 in chi-square, with values that are hardly likely"
