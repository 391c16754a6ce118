"""One p in one way of printing, wherever it stands; and what chance makes of dozens of effects is no list of dozens."""

from dataclasses import asdict, replace

import pytest
from test_discrepancy_page import diagnosed, model_of

from cli.screen import console
from cli.show.comparison import show_localisation
from discrepancy.inference.chance import chance, chance_number
from discrepancy.inference.misfit.localise import Group, Localisation
from discrepancy.inference.verdict import NONE
from discrepancy.page.answer import cards
from discrepancy.page.evidence import rivals
from discrepancy.page.maps import place_table
from discrepancy.page.whys import of_screening

REJECTED = [
    {"name": f"effect_{k}", "chi2_difference": None, "reason": f"score test: {chance(min(1.0, 0.26 + 0.2 * k))} over all effects, explains 3 of chi-square alone"}
    for k in range(61)
]


@pytest.mark.parametrize(
    ("p", "text"),
    [(0.257, "0.26"), (0.8992, "0.90"), (0.1, "0.10"), (0.004, "0.004"), (0.8375, "0.84"), (1.0, "1"), (0.9999, "1"), (0.0353, "0.035"), (0.001, "0.001"), (1.4e-4, "1e-4"), (8e-48, "8e-48"), (0.0, "< 1e-300")],
)
def test_a_p_has_one_form(p, text):
    assert chance_number(p) == text and chance(p) in (f"p = {text}", f"p {text}")


def test_one_diagnosis_prints_its_p_in_one_way():
    """0.8 stood on the card of the page, 0.84 in its list; 1e-09 on the page, 1e-9 in the workbench."""
    answer = diagnosed(model_of())
    answer = replace(answer, diagnosis=replace(answer.diagnosis, p_screen=0.257, rejected=REJECTED))
    card = next(c for c in cards(answer) if c.label == "Screening of the effects")
    assert card.value == "p = 0.26" and of_screening(answer).margin.startswith("p = 0.26;")
    assert rivals(answer).tables[0].rows[0][1].startswith("score test: p = 0.26 over")


def test_where_the_model_fails_p_stands_as_on_the_page(capsys):
    group = Group("hysteresis", "branch of torque", "everywhere", 80.0, 3, 40.0, 1e-9, 1e-9, 1.0, 80.0)
    show_localisation(Localisation([group], {}, 0.001), console(100))
    on_page = place_table([asdict(group)], 0.001)
    assert on_page.rows[0][3] == "p = 1e-9" and on_page.head[-1] == "significant at 0.001"
    assert " 1e-9 " in capsys.readouterr().out


def test_effects_that_chance_explains_are_folded():
    """A page listed 61 of them, dozens with p = 1."""
    answer = diagnosed(model_of())
    answer = replace(answer, verdict=NONE, diagnosis=replace(answer.diagnosis, rejected=REJECTED))
    section = rivals(answer)
    nearest, others = section.tables
    assert section.lead == "61 effects: none improves more than chance would."
    assert [len(table.rows) for table in section.tables] == [6, 55] == [len(table.whys) for table in section.tables]
    assert not nearest.folded and others.folded == "The other 55 effects"
    # All of them stay in the JSON, and few are not folded.
    assert len(answer.diagnosis.to_dict()["rejected"]) == 61
    assert len(rivals(replace(answer, diagnosis=replace(answer.diagnosis, rejected=REJECTED[:7]))).tables) == 1
