"""What is told of a fit: estimates beyond all that was measured are bounds."""

from dataclasses import replace
from types import SimpleNamespace

from discrepancy.extend import judgement
from discrepancy.inference.chi_square import chi_text
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.telling import beyond, by_weight, meaning
from discrepancy.inference.verdict import SET
from discrepancy.problem import Candidate, Parameter
from discrepancy.words.wording import told_apart_by
from tests.test_base_off import CANDIDATES, amplitude, bench


def test_amounts_of_chi_square_have_the_digits_that_mean_something():
    """Rivals fitted "worse by 1462303.2"."""
    assert [chi_text(x) for x in (3.24, 99.94, 8009.0, 999499.0, 1462303.2, -1462303.2, 2.5e9)] == [
        "3.2", "99.9", "8,010", "999,000", "1.46 million", "-1.46 million", "2,500 million",
    ]  # fmt: skip


def test_effect_that_changes_more_than_was_measured_is_a_bound():
    doctor = Diagnostician(bench({"play": 4.0}))
    found = doctor.run()
    assert found.effects[0].parameters["play"]["bound"] is False
    # The measured turning goes from 23 to 190 arcsec and its zero is known; a play of 500 is beyond all of it, whatever makes up for it.
    (member,) = found.fits.members
    play = member.candidates[0]
    far = replace(member, fit=replace(member.fit, values={**member.fit.values, "play": 500.0}))
    assert beyond(doctor.space, far, play) and not beyond(doctor.space, member, play)
    near = replace(member, fit=replace(member.fit, values={**member.fit.values, "play": 150.0}))
    assert not beyond(doctor.space, near, play)


def test_what_carries_an_effect_is_told_first():
    both = Candidate("both", "both", (amplitude("gain", 0.01), amplitude("play", 1.0, 1)))
    model = bench({"play": 4.0})
    model.candidates = (both,)
    doctor = Diagnostician(model)
    doctor.prepare()
    doctor.screened()
    member = doctor.fit(["both"])
    assert [p.name for p in by_weight(doctor.space, member, both)] == ["play", "gain"]
    assert list(doctor.run().effects[0].parameters) == ["play", "gain"]


def test_a_parameter_is_told_in_words_without_where_it_is_off():
    runout = Parameter("planet_runout", "m", 0.0, -2e-4, 2e-4, 1e-5, description="run-out of planet 1, along the line of action (0: off)")
    assert meaning(runout) == "run-out of planet 1, along the line of action"
    assert meaning(replace(runout, description="share (of the whole)")) == "share (of the whole)"


def test_alternatives_say_by_how_much_they_fit_worse():
    model = bench({"gain": 0.03})
    model.candidates = CANDIDATES[:2]
    found = Diagnostician(model).run()
    first, second = found.effects
    members = {m.name: m.fit.chi2 for m in found.fits.members}
    assert found.verdict == SET and first.chi2_difference == 0.0 and first.reason == ""
    worse = members[second.name] - members[first.name]
    assert second.chi2_difference == worse and second.reason == f"fits worse by {chi_text(worse)} in chi-square than {first.name}"
    answer = SimpleNamespace(effects=[e.to_dict() for e in found.effects], confusable=found.confusable)
    assert told_apart_by(answer) == [first.name, f"{second.name} ({second.reason})"]


def test_an_alternative_is_judged_as_it_will_be_when_it_is_added():
    model = bench({"gain": 0.03})
    model.candidates = CANDIDATES[:2]
    model.records = [replace(r, held_out=r.factors["load"] == 140.0) for r in model.records]
    doctor = Diagnostician(model)
    found = doctor.run()
    assert found.verdict == SET and len(found.effects) == 2
    for effect, member in zip(found.effects, found.fits.members):
        added = judgement(doctor, member, None)
        assert (effect.held_out_error_before, effect.held_out_error_after) == (added.before, added.after)
