"""What commands say of campaign.toml is on the page what is done under In: its user writes no file."""

import re

import numpy as np
import pytest

from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.unplaced import unplaced
from discrepancy.campaign.zeros import unused_means
from discrepancy.doubts.calibrated_doubts import OF_INPUT, lag_doubts
from discrepancy.doubts.locked_zeros import zero_text
from discrepancy.problem import Record
from tests import zero_campaign
from workbench.page_words import on_page

# A line of a file: a key with its value, or the table that it stands in.
LINE = re.compile(r'\b[a-z_]+ = ["\w-]|\[(?:campaign|conditions|quantities)\b|\b(?:locked_at|held_out|angle_of|load_torque)\b')


def test_findings_of_a_campaign_say_what_is_done_in_fields(tmp_path):
    campaign = load_campaign(zero_campaign.written(tmp_path, loop=True))
    text = campaign.text.replace('locked_at = "0 deg"\n', "").replace(f'reducer = "{zero_campaign.REDUCER}"\n', "").replace('load_torque = "60 N.m"\n', "")
    (tmp_path / "campaign.toml").write_text(text, encoding="utf-8")
    campaign = load_campaign(tmp_path)
    check = check_campaign(campaign, unplaced(campaign))
    asked = {f.code: f.remedy for f in check.findings}
    assert asked.keys() >= {"position of loops", "no reducer", "no held-out condition", "condition incomplete", "one direction", "direction not stated"}
    told = {code: on_page(remedy) for code, remedy in asked.items()}
    assert not {code: text for code, text in told.items() if LINE.search(text) and not text.endswith("as In has no field for it")}
    assert told["position of loops"] == (
        "type the angle of the input, such as 90 deg, as 'locked at' of the condition under In;"
        " or measure at positions over a turn of the cranks and type mean there"
    )
    assert told["condition incomplete"] == "type load torque of condition at_60 under In, or choose a column for it"
    # A command's user has the file before him.
    assert 'state locked_at = "90 deg"' in asked["position of loops"]


@pytest.mark.parametrize("said", [
    *lag_doubts(0.1, 0.01), *lag_doubts(0.1, 0.01, as_input=lambda: 40.0), *lag_doubts(0.1, 3.0, [60.0]), *lag_doubts(0.1, 3.0, [60.0, 90.0]),
    zero_text("angle_zero[1]", 0.3, False, 100.0), f"state {OF_INPUT}", 'it was state locked_at = "40 deg" in the condition',
    'state scale = -1 in one of the two columns', '7 is the factor: state unit = "rad" or "deg" if that is what was written',
    "nobody says where the input was locked (locked_at of the condition)", 'state unit = "in.lbf" in its column if that is what it holds',
])  # fmt: skip
def test_other_texts_do_so_too(said):
    assert LINE.search(said) and not LINE.search(on_page(said))


def test_a_zero_that_is_known_is_chosen_in_its_field():
    run = Record("r", "transmission_error", "rad", "c", 1, 1e-4 + 1e-5 * np.arange(9.0), {}, {})
    [(_, remedy)] = unused_means([run])
    told = on_page(remedy)
    assert not LINE.search(told) and "choose 'known: its mean counts' as 'zero' of its files under In" in told


def test_what_in_has_no_field_for_keeps_its_line_and_says_so():
    told = on_page('state noise = "..." in its runs')
    assert 'write noise = "..." into campaign.toml' in told and "In has no field for it" in told
