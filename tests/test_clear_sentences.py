"""Sentences of the loop's commands that a reader stumbled over."""

from types import SimpleNamespace

import numpy as np
import pytest

from cli.columns import in_lines
from discrepancy.campaign.findings import angles
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.telling import grown
from discrepancy.inference.verdict import ONE, SEVERAL, Settings, decide
from discrepancy.page.next_experiment import sentences
from discrepancy.problem import Record
from discrepancy.verdict import reason_of


def test_a_verdict_does_not_say_itself_twice():
    """"one effect: one effect explains the misfit" stood there."""
    effect = {"candidates": ["play.a", "play.b"]}
    for reason in (decide(True, True, 1, 1, 1.0, False, Settings())[1], reason_of(effect, ONE), reason_of(effect, SEVERAL)):
        assert not reason.startswith(ONE) and reason.startswith(("it explains the misfit", "in several forms"))


def test_what_grew_shows_it():
    """"grew from 0.49 to 0.49"."""
    assert grown("play", 0.488855, 0.491955) == []
    assert grown("play", 0.49, 0.62) == ["play: the misfit in the patterns of runs not used for fitting grew from 0.49 to 0.62"]


@pytest.mark.parametrize(("turns", "remedy"), [(1.0, "three turns are better"), (0.5, "record at least one turn of the output, better three")])
def test_how_long_to_record_is_said_once(turns, remedy):
    """"three turns are better; record at least one output turn, better three" was said of a record of one turn."""
    angle = np.linspace(0.0, 2.0 * np.pi * turns, 8000)
    record = Record("r", "transmission_error", "rad", "c", 1, 0.0 * angle, {"angle": angle}, {})
    design = SimpleNamespace(of=lambda quantity: [record], campaign=SimpleNamespace(reducer=None))
    (short,) = (found for found in angles(design) if found.code == "record too short")
    assert short.remedy == remedy and "turns" in short.text and "better" not in short.text


@pytest.mark.parametrize(("idle", "text"), [(1, "the other one changes nothing here"), (2, "the other 2 change nothing here")])
def test_one_effect_changes_and_two_change(monkeypatch, idle, text):
    told = []
    monkeypatch.setattr("discrepancy.inference.diagnose.say", told.append)
    scores = [SimpleNamespace(name="play", statistic=9.0)]
    doctor = SimpleNamespace(screening=SimpleNamespace(scores=scores), candidates=[0] * (1 + idle), refits=SimpleNamespace(scores={"play": 0}),
                             tested="1 of 2 effects tested", explained=lambda score: "9 % of the misfit")  # fmt: skip
    Diagnostician.say_scores(doctor)
    assert text in told[0]


def test_a_page_leaves_what_is_typed_into_a_file_as_it_is_typed():
    """`interventions = ["ring turned"]` and "Effects.pin position errors.ring trilobe angle" stood on the page of `next`."""
    said = sentences([
        'the runs after it are a condition of their own, with interventions = ["ring_turned"]',
        "effects.pin_position_errors.ring_trilobe_angle: it is in one of 2 places",
        'the runs in 900rpm_100N.m and locked_90deg tell pin_position_errors.trilobe; state locked_at = "90 deg"',
    ])  # fmt: skip
    assert said.startswith('The runs after it are a condition of their own, with interventions = ["ring_turned"]. ')
    assert " effects.pin_position_errors.ring_trilobe_angle: it is in one of 2 places. " in said
    assert 'locked 90deg tell pin position errors (trilobe); state locked_at = "90 deg".' in said


def test_a_signal_at_the_head_of_a_group_is_not_cut_within_its_words():
    """"transmissi on_error:" stood above the key figures of a narrow table."""
    assert in_lines("transmission_error:", 18).splitlines() == ["transmission_", "error:"]
    # Where not even a piece has room it is cut.
    assert len(in_lines("transmission_error:", 8).splitlines()) == 3
