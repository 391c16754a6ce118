"""An effect that hardly changes the unused runs: what is said of them is what their numbers are, and what decides is named."""

from types import SimpleNamespace

import pytest

from discrepancy import extend as extension
from discrepancy.extend import DID_NOT_HELP, HELPED, NOT_PROVEN
from discrepancy.inference.held_out.held_out import HeldOut
from discrepancy.ladder_step import step_of
from discrepancy.page.extension import cards

RUNS = [SimpleNamespace(quantity="transmission_error", source={}, tags={})]


def reason(monkeypatch, before: float, after: float, left: tuple[float, float]) -> tuple[str, str]:
    space = SimpleNamespace(records=RUNS, touched=lambda candidate: [0], held_out=[0], base="before", size=1)
    monkeypatch.setattr(extension, "stream_of", lambda record: record.quantity)
    monkeypatch.setattr(extension, "leave_condition_out", lambda space, fit: {"all": left[0] if fit == "before" else left[1]})
    judged = HeldOut(before, after, 0.5, {}, "held-out runs", seen=False)
    return extension.unseen(SimpleNamespace(space=space), SimpleNamespace(candidates=[None], fit="after"), judged)


@pytest.mark.parametrize(("after", "words"), [(1.45, "grows from 0.20 to 1.45"), (0.1, "falls from 0.20 to 0.10"), (0.2, "stays at 0.20")])
def test_what_becomes_of_the_unused_runs_is_said_as_it_is(monkeypatch, after, words):
    """They "are as they were with it", beside a misfit of 0.195 -> 1.45."""
    verdict, text = reason(monkeypatch, 0.195, after, (1.0, 1.0))
    assert verdict == DID_NOT_HELP and "as they were with it" not in text
    assert f"by less than 2 times the noise in all (the misfit in the patterns there {words}; 1: what noise leaves there)" in text
    assert "does not fall (1 -> 1 of chi-square per value), which decides" in text


def test_conditions_left_out_speak_for_it(monkeypatch):
    verdict, text = reason(monkeypatch, 0.2, 0.3, (2.0, 1.0))
    assert verdict == NOT_PROVEN and "the misfit falls from 2.00 to 1.00 of chi-square per value" in text


@pytest.mark.parametrize(("unseen", "note", "tone"), [(True, "changed too little to decide", "plain"), (False, "what the verdict rests on", "bad")])
def test_the_card_says_whether_the_unused_runs_decide(unseen, note, tone):
    step = {"effects": ["drag"], "verdict": DID_NOT_HELP, "held_out_before": 0.195, "held_out_after": 1.45, "kept": False, "unseen": unseen}
    card = next(c for c in cards(step_of(step)) if c.label.endswith("unused runs"))
    assert (card.note, card.tone) == (note, tone)
    assert cards(step_of(step | {"verdict": HELPED, "held_out_after": 0.1}))[-1].tone == ("plain" if unseen else "good")
