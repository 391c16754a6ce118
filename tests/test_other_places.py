"""Which part an effect was looked for at, and which other part would look like it."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.alike.other_places import look_alikes, place_of, placed
from discrepancy.campaign.model import Campaign
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.verdict import ONE, STOPPED
from discrepancy.model_file import ModelFile
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from discrepancy.words.wording import turned_down, variant_text
from reducers.reducer import load_reducer

FACTORS = {"speed": 209.44, "load": 167.0, "temperature": 293.15, "direction": 1.0}
ANGLES = np.linspace(0.0, 2.0 * np.pi / 39.0, 24, endpoint=False)


@pytest.fixture(scope="module")
def space():
    return fitted(zeros={})


def fitted(zeros):
    """Transmission errors over a crank's turn, twice, in which nothing is missing: of a reducer with two cranks and two discs."""
    reducer = load_reducer("RV20E-121-rigid")
    rng = np.random.default_rng(1)
    records = tuple(Record(f"r{k}", "transmission_error", "rad", "a", k, 1e-7 * rng.standard_normal(len(ANGLES)), {"angle": ANGLES}, FACTORS, stated_noise=1e-7)
                    for k in (1, 2))  # fmt: skip
    model = PhysicalModel(ModelFile(reducer.name, reducer), replace(campaign(), reducer=reducer, records=records), zeros=zeros)
    found = Workspace(model)
    found.fit_base()
    return found


def campaign():
    from tests.test_next_run import CAMPAIGN

    assert isinstance(CAMPAIGN, Campaign)
    return CAMPAIGN


def told(space, candidate, values, verdict=ONE):
    member = SimpleNamespace(candidates=[c for c in space.model.candidates if c.name == candidate], fit=SimpleNamespace(values=values))
    found = SimpleNamespace(verdict=verdict, fits=SimpleNamespace(members=[member], space=space))
    (effect,) = placed([{"name": "e", "variant": candidate.partition(".")[2], "candidates": [candidate]}], space.model, found)
    return variant_text(effect)


def test_with_two_cranks_the_other_lobe_at_the_other_disc_looks_the_same(space):
    values = {"lobe_throw_error_1": 4e-6, "lobe_phase_error_1": 1e-4}
    assert told(space, "crank_lobe_errors.crank_1", values) == "crank 1 at disc 1 or crank 2 at disc 2, which look alike"
    # Who stopped a diagnosis waits for nothing more.
    assert told(space, "crank_lobe_errors.crank_1", values, STOPPED) == "crank 1 at disc 1"


def test_a_zero_that_was_found_by_the_pattern_leaves_open_at_which_disc():
    """A wave of the pattern further on the cranks have made half a turn, with which the discs change places."""
    known_to_a_wave = fitted(zeros={"angle_zero[1]": 0.0})
    values = {"lobe_throw_error_1": 4e-6, "lobe_phase_error_1": 1e-4, "angle_zero[1]": 0.0}
    assert told(known_to_a_wave, "crank_lobe_errors.crank_1", values) == (
        "crank 1 at disc 1 or crank 2 at disc 2, which look alike; crank 1 at disc 2 or crank 2 at disc 1 if the zero of the output's angle is"
        " 4.5 deg further on than it was found, which the signals leave open"
    )
    member = SimpleNamespace(candidates=[c for c in known_to_a_wave.model.candidates if c.name == "crank_lobe_errors.crank_1"], fit=SimpleNamespace(values=values))
    found = SimpleNamespace(verdict=ONE, fits=SimpleNamespace(members=[member], space=known_to_a_wave))
    alike = look_alikes("crank_lobe_errors.crank_1", known_to_a_wave.model, found)
    # The other crank was fitted at this disc: it is no rival.
    assert [other.candidate for other in alike if other.candidate] == ["crank_lobe_errors.crank_2"]


def test_a_place_that_shows_otherwise_is_not_named(space):
    other = told(space, "crank_lobe_errors.crank_2", {"lobe_throw_error_2": 4e-6, "lobe_phase_error_2": 0.0})
    assert other == "crank 2 at disc 1 or crank 1 at disc 2, which look alike" and "crank 2 at disc 2" not in other


def test_what_a_campaign_cannot_show_of_an_effect_is_off(space):
    """Input torques at few loads do not show a lobe's phase: that was not fitted, and asking for it was a KeyError."""
    assert told(space, "crank_lobe_errors.crank_1", {"lobe_throw_error_1": 4e-6}) == "crank 1 at disc 1 or crank 2 at disc 2, which look alike"


def test_what_has_no_choice_of_parts_has_no_place(space):
    assert place_of("drag", space.model) == place_of("sensor_gain.input_torque", None) == "" and told(space, "pin_position_errors.runout", {}) == "runout"
    assert place_of("hole_position_errors.carrier", None) == "carrier at crank 1" and place_of("race_spall", None) == "crank 1 at disc 1"


def test_of_a_rival_its_place_is_said():
    rejected = [{"name": "crank_lobe_errors.crank_2", "reason": "fits worse by 31804.0 in chi-square", "chi2_difference": 31804.0}]
    answer = SimpleNamespace(model=None, diagnosis=SimpleNamespace(rejected=rejected, fits=SimpleNamespace(members=[])))
    assert [r["reason"] for r in turned_down(answer)] == ["crank 2 at disc 1, fits worse by 31804.0 in chi-square"]
