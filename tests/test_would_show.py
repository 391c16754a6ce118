"""What a clean answer is worth: sizes that would have been seen are seen, half of them seldom; what a design cannot show is said with it."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest

from cli.screen import WIDTH, console
from cli.show.would_show import show_would_show
from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.design import Design
from discrepancy.campaign.findings import WARNING, Finding, shows_less
from discrepancy.campaign.load import load_campaign
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.screening.visible import NINETY_FIVE, Visible
from discrepancy.inference.verdict import NONE
from discrepancy.page.would_show import section
from discrepancy.problem import Candidate, Parameter, Record
from discrepancy.words.would_show import WouldShow, rows
from fmu_src.effect_words import effects_words

ANGLE = np.linspace(0.0, 2.0 * math.pi, 400, endpoint=False)
SPEEDS = (100.0, 150.0, 200.0)
NOISE = 0.5
WAVES = {"small": 2.0 * np.cos(3.0 * ANGLE), "bent": np.cos(5.0 * ANGLE), "drowned": 1e-9 * np.cos(7.0 * ANGLE), "zero": np.cos(2.0 * ANGLE)}


@dataclass
class Waves:
    """A transmission error of waves: one that is a straight line in its amplitude, one that begins behind a gap of 0.3, one below everything, and one
    that is calibrated."""

    records: list
    nuisances = (Parameter("height", "rad", 0.0, -10.0, 10.0, 1.0),)
    candidates = tuple(
        Candidate(name, name, (Parameter(name, "rad", 0.0, -1.0 if sign == 0 else 0.0, 1.0, 1.0, sign),))
        for name, sign in (("small", 0), ("bent", 1), ("drowned", 0), ("zero", 0))
    )

    def predict(self, values, which=None):
        gap = max(values.get("bent", 0.0) - 0.3, 0.0)
        y = (values.get("height", 0.0) + values.get("zero", 0.0)) * WAVES["zero"] + values.get("small", 0.0) * WAVES["small"]
        y = y + gap * WAVES["bent"] + values.get("drowned", 0.0) * WAVES["drowned"]
        return [y + 0.0 for _ in (range(len(self.records)) if which is None else which)]


def measured(values, seed):
    """Two runs at each speed."""
    rng = np.random.default_rng(seed)
    [y] = Waves([None]).predict(values)
    return Waves([
        Record(f"{s:g} {k}", "transmission_error", "rad", f"{s:g}", k, y + NOISE * rng.standard_normal(ANGLE.size), {"angle": ANGLE}, {"speed": s, "load": 1.0})
        for s in SPEEDS for k in range(2)
    ])  # fmt: skip


@pytest.fixture(scope="module")
def clean():
    found = Diagnostician(measured({}, 1)).run()
    assert found.verdict == NONE
    return {v.candidate: v for v in found.visible}


def test_a_straight_effect_is_seen_from_where_its_score_passes_the_level(clean):
    per_unit = math.sqrt(len(SPEEDS) * 2 * np.sum(WAVES["small"] ** 2)) / NOISE
    assert 3.0 + NINETY_FIVE < clean["small"].size * per_unit < 6.0 + NINETY_FIVE
    # Behind a gap nothing shows before it is closed.
    assert 0.3 < clean["bent"].size < 0.4 and not clean["bent"].or_less
    # What is calibrated, or drowns within its bounds, is not there at any size.
    assert all(name not in clean or math.isinf(clean[name].size) for name in ("drowned", "zero"))


@pytest.mark.parametrize("name", ["small", "bent"])
def test_what_would_have_been_seen_is_seen_and_much_less_is_not(clean, name):
    off = {"small": 0.0, "bent": 0.3}[name]

    def times_seen(share):
        size = off + share * (clean[name].size - off)
        return sum(Diagnostician(measured({name: size}, seed)).run().verdict != NONE for seed in range(20, 28))

    assert times_seen(1.0) >= 7
    assert times_seen(0.3) <= 2


def test_a_sentence_counts_what_was_seen_and_names_what_was_not():
    seen = Visible("drag", "seal_torque", "N.m", 0.2, 0.01)
    waves = [Visible("pin_seats.two_waves", name, "m/N", 1e-9, 2e-9) for name in ("pin_seat_cos_2", "pin_seat_sin_2")]
    nowhere = Visible("race_spall.inner_race", "spall_depth", "m", 5e-6, math.inf, at_best=5e-7)
    found = WouldShow([nowhere, *waves, seen], ["thermal_expansion.heating"], [])
    assert found.sentence == (
        "of 3 effects that change something here, 1 would have been seen at its usual size; not, or only where they are larger: race spall (inner race),"
        " pin seats (two waves)"
    )
    assert rows(found.hard) == [
        ["race spall (inner race)", "spall_depth", "not everywhere; 0.5 um at best", "5 um"],
        ["pin seats (two waves)", "seat_cos_2, seat_sin_2", "2 nm/N", "1 nm/N"],
    ]
    assert found.easy == ["drag"]
    told = found.as_json()
    assert [entry["size"] for entry in told["seen_from"]] == [None, pytest.approx(2.0), pytest.approx(2.0), pytest.approx(0.01)]
    assert told["seen_from"][1]["unit"] == "nm/N" and told["seen_from"][1]["si"]["size"] == 2e-9 and told["changes_nothing"] == ["thermal_expansion.heating"]
    assert WouldShow([seen], [], []).sentence == "the one effect that changes something here would have been seen at its usual size"
    assert WouldShow([seen, replace(seen, candidate="unbalance")], [], []).sentence == "all 2 effects that change something here would have been seen at their usual size"
    assert "says nothing" in WouldShow([], [], []).sentence
    never = replace(seen, size=math.inf)
    assert WouldShow([never, *waves], [], []).sentence == "none of the 2 effects that change something here would have been seen at its usual size: this answer says little"
    assert WouldShow([never, *waves], [], []).never == ["drag"] and [v.candidate for v in WouldShow([never, *waves], [], []).hard] == ["pin_seats.two_waves"] * 2


def test_forms_stand_behind_their_effect():
    assert effects_words(["disc_tooth_errors.runout", "drag", "disc_tooth_errors.ovality"]) == "disc tooth errors (runout, ovality), drag"


def test_screen_and_page_say_what_the_runs_cannot_show(capsys):
    nowhere = Visible("race_spall.inner_race", "spall_depth", "m", 5e-6, math.inf, at_best=5e-7)
    lacking = Finding(WARNING, "one direction", "transmission_error: only one direction: one-sided wear does not show", 'measure with direction = "reverse" too')
    found = WouldShow([nowhere], ["thermal_expansion.heating"], [lacking])
    show_would_show(found, console(WIDTH))
    shown = " ".join(capsys.readouterr().out.split())
    assert "not everywhere; 0.5 um at best" in shown and "change nothing here, whatever their size: thermal expansion (heating)" in shown
    assert 'one-sided wear does not show: measure with direction = "reverse" too' in shown
    part = section(found)
    assert [t.rows for t in part.tables] == [
        [["race spall (inner race)", "spall_depth", "not everywhere; 0.5 um at best", "5 um"]],
        [["Transmission error: only one direction: one-sided wear does not show", 'Measure with direction = "reverse" too']],
    ]


def test_what_limits_a_design_is_told_and_what_does_not_is_not():
    campaign = load_campaign("examples/hidden_effect/campaign")
    told = {f.code for f in shows_less(Design(campaign))}
    assert told <= {f.code for f in check_campaign(campaign).findings}
    limiting = {"one direction", "one mounting", "coupled factors", "record too short", "sampling too coarse", "means not used"}
    assert all(code in limiting or code.startswith("few levels of") for code in told)
