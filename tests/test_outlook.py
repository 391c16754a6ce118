"""How long a first diagnosis still takes: foretold by its own first steps, told once and at each step anew."""

from types import SimpleNamespace

import pytest
from test_inference_toy import campaign

from discrepancy.inference.diagnose import diagnose
from discrepancy.inference.outlook import AFTER, FITS_FOLLOW, SCREENED, WHOLE, Outlook
from fmu_src.progress import Task, between, task, told_to


@pytest.mark.parametrize("low, high, text", [
    (78.0, 290.0, "1 to 5 min"), (101.0, 304.0, "2 to 5 min"), (13.0, 41.0, "15 to 40 s"), (2.0, 41.0, "up to 40 s"), (20.0, 400.0, "up to 7 min"),
    (0.0, 0.0, "up to 5 s"), (85.0, 85.0, "about 85 s"), (100.0, 110.0, "about 2 min"),
])  # fmt: skip
def test_a_range_is_told_as_roughly_as_it_is_known(low, high, text):
    assert between(low, high) == text


@pytest.mark.parametrize("passed, before, text", [
    (0.0, None, "2 to 6 min left"), (60.0, None, "1 to 5 min left"), (150.0, None, "up to 3 min left"), (400.0, None, "for 7 min now, longer than foretold"),
    # The last one of this kind says it closer, unless this one is another kind of case.
    (60.0, 200.0, "about 2 min left"), (60.0, 90.0, "1 to 5 min left"), (220.0, 200.0, "longer than the last time, up to 2 min left"),
])  # fmt: skip
def test_what_was_foretold_goes_on_with_the_clock(passed, before, text):
    known = Task(WHOLE, before=before)
    known.foretell(130.0, 350.0)
    known.begun -= passed
    assert known.sentence() == f"{WHOLE}, {text}"


def test_a_first_diagnosis_foretells_its_rest():
    """Minutes went by of which nothing was foretold but the end of the step."""
    begun, foretold, then, said = [], {}, {}, []

    def begin(one):
        begun.append(one)
        foretold[one.what], then[one.what] = begun[0].foretold, begun[0].then

    model, _ = campaign(12, "effect", 20, "stribeck")
    with told_to(SimpleNamespace(begin=begin, end=lambda _: None, say=said.append)), task(WHOLE) as whole:
        whole.begun -= 100.0
        diagnose(model)
    # A range before that was raised time and again.
    assert foretold["screening"] is None and then["screening"] == FITS_FOLLOW and not whole.then
    [line] = [text for text in said if text.startswith("the rest takes")]
    low, high = AFTER[SCREENED][False]
    assert between(100.0 * low, 100.0 * high) in line
    # Each step narrows it.
    ends = [foretold[what][1] - 100.0 for what in ("fitting alone", "fitting in earnest")]
    assert ends[0] > ends[1] > whole.foretold[1] - 100.0 > 0.0


def test_only_a_further_effect_that_was_found_puts_the_end_off():
    """"In all up to 35 s left" became 2 minutes when anything was looked for beside the first effect."""
    said = []
    with told_to(SimpleNamespace(begin=lambda _: None, end=lambda _: None, say=said.append)), task(WHOLE) as whole:
        whole.begun -= 100.0
        outlook = Outlook()
        outlook.screened()
        whole.begun -= 150.0
        first = whole.foretold
        outlook.found(1)
        assert whole.foretold[1] == first[1] and len(said) == 1
        outlook.found(2)
        assert whole.foretold[1] > first[1] and said[1:] == ["2 effects so far, and a further one is looked for: up to 3 min more"]


def test_nothing_is_said_where_nobody_waits_for_the_whole():
    said = []
    model, _ = campaign(12, "effect", 20, "stribeck")
    with told_to(SimpleNamespace(begin=lambda _: None, end=lambda _: None, say=said.append)):
        diagnose(model)
    assert not any(text.startswith("the rest takes") for text in said)
