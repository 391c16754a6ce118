"""Which effects stand beside the best: by likelihood, plausible size, and not from a bound."""

from dataclasses import dataclass, field

import numpy as np
import pytest

from discrepancy.inference.held_out.held_out import HeldOut
from discrepancy.inference.judgement import CONFIRMING, against, borne_out
from discrepancy.inference.refit.confusable import DECADE, PLAUSIBLE, confusable_set, ends_at_a_bound, implausible, unsettled
from discrepancy.inference.refit.starts import halved
from discrepancy.inference.verdict import INCOMPLETE, SEVERAL, Settings, decide
from discrepancy.problem import Candidate, Parameter


@dataclass
class Fit:
    chi2: float
    values: dict
    at_bounds: tuple = ()
    parameters: list = field(default_factory=list)

    @property
    def normal(self):
        return np.eye(len(self.parameters))



@dataclass
class Rival:
    """As much of a refit as membership looks at."""

    name: str
    fit: Fit
    gain: float = 1000.0
    candidates: tuple = field(default=())
    known: float = 0.1

    @property
    def covariance(self):
        return np.diag([self.known**2] * len(self.own))

    @property
    def own(self):
        return [p for c in self.candidates for p in c.parameters]

    @property
    def at(self):
        return {p.name: self.fit.values[p.name] for p in self.own}

    @property
    def key(self):
        return frozenset(c.name for c in self.candidates)


def rival(name, chi2, size=1.0, scale=1.0, bounds=(), shape=None, known=0.1, part="plant"):
    amplitude = Parameter(f"{name}_size", "1", 0.0, -1e3, 1e3, scale)
    shapes = () if shape is None else (Parameter(f"{name}_shape", "1", 1.0, 0.1, 100.0, 1.0),)
    values = {f"{name}_size": size} | ({} if shape is None else {f"{name}_shape": shape})
    return Rival(name, Fit(chi2, values, bounds, [amplitude, *shapes]), candidates=(Candidate(name, name, (amplitude,), shapes, part=part),), known=known)


def names(rivals):
    return [r.name for r in confusable_set(rivals)]


def test_membership_follows_the_likelihood():
    assert names([rival("a", 100.0), rival("b", 104.0), rival("c", 120.0)]) == ["a", "b"]


def test_a_gain_of_500_percent_stands_beside_nothing():
    """Fits as well, but its size is 500 times what is usual."""
    assert implausible(np.array([500.0])) == pytest.approx((np.log10(500.0 / PLAUSIBLE) / DECADE) ** 2)
    assert names([rival("gain", 80.0, 5.0, 0.01), rival("stiffness", 100.0)]) == ["stiffness"]


def test_nothing_at_a_bound_is_a_plain_member():
    assert names([rival("a", 100.0), rival("b", 101.0, bounds=("b_size",))]) == ["a"]
    # A shape that ran to its end makes of the effect another, simpler one.
    assert ends_at_a_bound(rival("c", 100.0, shape=99.9)) and not ends_at_a_bound(rival("c", 100.0, shape=50.0))
    assert names([rival("c", 100.0, shape=99.9), rival("a", 100.5)]) == ["a"]
    # What is better by far is named all the same, with its warning.
    assert names([rival("b", 50.0, bounds=("b_size",)), rival("a", 100.0)]) == ["b"]


def share(name, chi2, value, upper=1.0):
    part = Parameter(f"{name}_share", "1", 0.0, 0.0, upper, 0.5, 1)
    at = (part.name,) if value in (0.0, upper) else ()
    return Rival(name, Fit(chi2, {part.name: value}, at, [part]), candidates=(Candidate(name, name, (part,)),))


def test_a_share_that_is_all_is_a_value_like_another():
    """No wear at all below a pressure: 33 better in chi-square than another exponent of the load, it was never named beside a second effect."""
    assert not ends_at_a_bound(share("threshold", 100.0, 1.0))
    assert names([share("threshold", 100.0, 1.0), rival("exponent", 104.0)]) == ["threshold", "exponent"]
    # None of it is none, and a limit of the search is no share of anything.
    assert ends_at_a_bound(share("threshold", 100.0, 0.0)) and ends_at_a_bound(share("skidding", 100.0, 0.9, upper=0.9))


def test_an_effect_whose_shape_nothing_tells_is_a_simpler_one_in_disguise():
    """A seat that slips at any small torque is a spring."""
    assert names([rival("slip", 99.0, shape=5.0, known=30.0), rival("spring", 100.0)]) == ["spring"]
    assert names([rival("slip", 99.0, shape=5.0, known=1.0), rival("spring", 100.0)]) == ["spring", "slip"]


def test_effects_with_unknown_shapes_that_fit_equally_well_are_told_together():
    """Two depths: neither when grease aged nor by which power wear grew is known, and nothing simpler comes near."""
    aged, grown, gain = rival("aged", 99.0, shape=5.0, known=30.0), rival("grown", 99.2, shape=5.0, known=30.0), rival("gain", 125.0)
    assert names([aged, grown, gain]) == ["aged", "grown"]


def left_open(final, *rivals):
    return [r.name for r in unsettled(rivals, [final], final)]


def test_what_is_as_well_supported_but_for_a_bound_stays_in_the_set():
    wear = rival("wear grows", 100.0)
    assert left_open(wear, rival("starved", 99.0, shape=99.9)) == ["starved"]
    assert left_open(wear, rival("starved", 100.5, shape=99.9)) == []
    assert left_open(wear, rival("starved", 99.0, shape=5.0, known=30.0)) == ["starved"]


def test_what_puts_the_cause_elsewhere_stays_in_the_set_over_the_whole_margin():
    """Drag that knows no temperature is a constant, as a wrong zero is: no measurement of that campaign tells instrument from seal."""
    offset = rival("offset", 100.0, part="chain")
    assert left_open(offset, rival("drag", 100.0, shape=99.9)) == ["drag"]
    assert left_open(offset, rival("gain", 101.0, shape=99.9, part="chain")) == []
    assert left_open(offset, rival("drag", 105.0, shape=99.9)) == []
    assert left_open(offset, rival("base.stiffness", 99.0, part="base")) == []


def test_a_number_of_the_base_model_leaves_out_no_effect_that_is_as_well_supported():
    """A seat that hardly slips shows how far it yields and not when it slips: it fits better than a softer roller, and was no alternative to it."""
    number = rival("base.roller_stiffness", 100.0, part="base")
    assert left_open(number, rival("slip", 96.0, shape=5.0, known=30.0)) == ["slip"]
    assert left_open(number, rival("slip", 101.0, shape=5.0, known=30.0)) == []
    # Of instruments alike, and not over the whole margin: something is always off a little in the base model.
    assert left_open(number, rival("gain", 104.0, shape=99.9, part="chain")) == []
    assert left_open(number, rival("base.mesh_stiffness", 96.0, part="base", bounds=("base.mesh_stiffness_size",))) == []


def judged(before, after, p=0.5, **more):
    return HeldOut(before, after, p, {}, "held-out runs", **more)


def test_effects_that_make_unused_runs_worse_are_not_several_effects():
    reason = against(judged(3.0, 4.2))
    assert "grew from 3.00 to 4.20" in reason
    assert decide(True, True, 2, 1, 1.0, True, Settings(), unproved=reason) == (INCOMPLETE, reason)
    assert decide(True, True, 2, 1, 1.0, False, Settings())[0] == SEVERAL


def test_unused_runs_within_the_noise_say_nothing_against_it():
    assert against(judged(0.9, 1.1)) == against(judged(5.0, 1.0)) == against(None) == ""
    assert "not explained" in against(judged(9.0, 3.0, 1e-6))


def test_unused_runs_that_show_nothing_of_it_say_nothing_against_it():
    assert against(judged(3.0, 4.2, seen=False)) == ""
    assert "not explained" in against(judged(9.0, 9.1, 1e-6, seen=False))


@pytest.mark.parametrize(("p", "gain", "named"), [
    (5e-4, -9.0, True), (3e-3, 0.5, True), (3e-3, -0.5, False), (1e-2, CONFIRMING + 1.0, True), (1e-2, CONFIRMING - 1.0, False),
])  # fmt: skip
def test_what_is_not_beyond_doubt_is_named_as_far_as_unused_runs_agree(p, gain, named):
    levels = Settings().sure_level, Settings().screen_level
    assert borne_out(p, judged(2.0, 1.0, gain=gain), *levels) == named
    # Runs that do not show it, or none, leave it to the level of the test.
    for silent in (None, judged(2.0, 1.0, gain=gain, seen=False)):
        assert borne_out(p, silent, *levels) == (p < levels[1])


def test_what_unused_runs_refute_is_named_only_far_below_the_level():
    """Of a sound reducer five names at p = 0.0006 stood as "named but incomplete", their misfit on unused runs grown from 0.94 to 1.73."""
    worse, better = judged(0.94, 1.73, gain=-5.0), judged(1.73, 0.94, gain=5.0)
    assert not borne_out(0.0006, worse, 0.001, 0.004) and borne_out(0.0006, better, 0.001, 0.004)
    assert borne_out(0.00005, worse, 0.001, 0.004) and borne_out(0.0006, None, 0.001, 0.004)


def test_a_start_that_is_worse_than_no_effect_is_halved():
    """Debris makes debris: the slope at none promises 6, at which races are worn away; 2 is right."""
    size = Parameter("size", "1", 0.0, 0.0, 100.0, 1.0, 1)

    def cost(values):
        return (np.exp(values["size"]) - np.exp(2.0)) ** 2

    assert cost({"size": 6.0}) > cost({"size": 0.0})
    assert halved([size], {"size": 6.0}, cost, cost({"size": 0.0})) == [{"size": 1.5}]
    assert halved([size], {"size": 6.0}, cost, 0.0) == []
