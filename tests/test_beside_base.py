"""Intervals take the base model's numbers as they stand; where these are less sure, the answer says what they would be with them free."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from test_inference_toy import CANDIDATES, Toy, campaign

from discrepancy.extend import intervals_of
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.refit.beside_base import WIDER, Freed, widened
from discrepancy.problem import BASE, Candidate
from discrepancy.words import as_told
from discrepancy.words.wording import with_base_text

KNOWN_TO = 1.0


def with_a_base_number() -> Toy:
    """The housing yields, and the backlash of the base model is known to 1 arcsec only."""
    model, _ = campaign(16, "effect", 25, "housing_compliance")
    gap = next(c for c in CANDIDATES if c.name == "backlash").amplitudes[0]
    number = replace(gap, lower=-50.0, sign=0, prior=KNOWN_TO)
    others = tuple(c for c in CANDIDATES if c.name != "backlash")
    return replace(model, candidates=(*others, Candidate(f"{BASE}.gap", "backlash of the reducer file", (number,), part=BASE)))


def test_the_interval_is_that_of_a_fit_with_the_number_free():
    doctor = Diagnostician(with_a_base_number())
    doctor.prepare()
    doctor.screened()
    alone, both = doctor.fit(["housing_compliance"]), doctor.fit(["housing_compliance", f"{BASE}.gap"])
    deviations = [np.sqrt(r.covariance[r.fit.names.index("housing"), r.fit.names.index("housing")]) for r in (alone, both)]
    factor, shift = doctor.beside_base(alone)["housing"]
    assert factor == pytest.approx(deviations[1] / deviations[0], rel=0.02) and factor > WIDER
    # It lies where it is fitted with the number, too.
    assert shift == pytest.approx(both.fit.values["housing"] - alone.fit.values["housing"], abs=0.05 * deviations[1]) and abs(shift) > deviations[0]
    # Fitted, it is in the interval already.
    assert doctor.beside_base(both) == {}


def test_the_answer_says_so_in_its_units_where_it_matters():
    result = Diagnostician(with_a_base_number()).run()
    (entry,) = (e.parameters["housing"] for e in result.effects if e.name == "housing_compliance")
    low, high = entry["interval_with_base"]
    assert low <= entry["interval"][0] < entry["interval"][1] <= high
    text = with_base_text(entry)
    assert text.startswith("with each of the base model's numbers free within its range; ") and text.endswith("with them as its file has them")
    # The wider one is told first, wherever: the narrow one was taken for what one may rely on.
    told, narrow = as_told.parameter(entry), "interval_with_base_as_it_is"
    assert told["interval"][1] == pytest.approx(high * told["value"] / entry["value"]) and told["si"]["interval"] == [low, high]
    assert told[narrow][1] == pytest.approx(told["si"][narrow][1] * told["value"] / told["si"]["value"]) and told["si"][narrow] == entry["interval"]
    assert with_base_text({key: value for key, value in entry.items() if key != "interval_with_base"}) == ""


def test_what_extend_writes_is_the_interval_that_the_answer_tells_first():
    doctor = Diagnostician(with_a_base_number())
    found = doctor.run()
    (entry,) = (e.parameters["housing"] for e in found.effects if e.name == "housing_compliance")
    fit = doctor.final(["housing_compliance"])
    # From a diagnosis, and without one.
    for answer in (SimpleNamespace(diagnosis=found), None):
        assert intervals_of(doctor, fit, doctor.settings.coverage, answer)["housing"] == pytest.approx(entry["interval_with_base"])


def test_where_the_base_has_no_such_number_nothing_is_said():
    model, _ = campaign(16, "effect", 25, "housing_compliance")
    result = Diagnostician(model).run()
    assert all("interval_with_base" not in p for e in result.effects for p in e.parameters.values())


def test_a_wider_interval_stays_within_the_bounds():
    assert widened((0.9, 1.3), (1.0, 1.0), Freed(2.0), (0.0, 1.4)) == pytest.approx((0.8, 1.4))


def test_an_interval_that_lies_further_on_holds_the_one_where_it_is():
    assert widened((0.9, 1.1), (1.0, 1.0), Freed(2.0, -0.5), (0.0, 2.0)) == pytest.approx((0.3, 1.2))
    assert widened((0.9, 1.1), (1.0, 1.0), Freed(2.0, 0.5), (0.0, 1.5)) == pytest.approx((0.8, 1.5))
