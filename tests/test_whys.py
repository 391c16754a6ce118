"""Every number of a result answers "why?": by which relation, from which data, with which margin; on the page and in the workbench."""

from dataclasses import replace

import pytest

from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.next_experiment import Proposal
from discrepancy.page import whys
from discrepancy.page.maps import localisation
from pages.content import Card, Page, Section, Table, Why
from pages.render import rendered_sections

FIGURE = KeyFigure("hysteresis[locked=input]", "20 degC", "torsional stiffness", "N.m/rad", 1.7e5, 1.5e5, 4e3, 3, True)
PLACE = {"signal": "hysteresis", "feature": "branch of torque", "dependence": "everywhere", "statistic": 80.0, "width": 3, "dof": 40.0, "p": 1e-9, "share": 1.0,
         "chi_square": 80.0}  # fmt: skip


def test_a_page_asks_beside_cards_and_rows_without_script():
    """``details`` opens by click, Enter and blank; a reader's name for it says of what."""
    why = Why("least squares", "3 runs", "95 %")
    page = Page("k", "t", "c", "f", [Card("Error", "2", why=why), Card("Plain", "1")], [Section("s", "S", "", [], [Table("", ["a"], [["x"]], whys=[why])])], [])
    html = rendered_sections(page)
    assert html.count('<details class="why">') == 2 and 'aria-label="why Error?"' in html and 'aria-label="why x?"' in html
    assert "<dt>margin</dt><dd>95 %</dd>" in html


def test_a_key_figure_says_its_noise_and_how_far_it_is_off():
    why = whys.of_key_figure(FIGURE)
    assert "3 repetitions" in why.data and "20 degC" in why.data
    assert "5.82 N m/arcmin apart, 5.00 times 1.16 N m/arcmin" in why.margin
    assert "draws" in whys.of_key_figure(replace(FIGURE, repeated=False)).data


@pytest.mark.parametrize("difference, text", [(6.0, "20 to 1"), (None, "nearest"), (100.0, "more than a million to 1")])
def test_a_rival_says_by_how_much_it_lost(difference, text):
    assert text in whys.of_rival({"name": "a", "reason": "score test: p = 0.4", "chi2_difference": difference}).margin


def test_a_separation_is_told_as_d_prime():
    why = whys.of_proposal(Proposal("run", {}, 1.0, 20.0, 16.0, {"a ~ b": 16.0}), ["a", "b"])
    assert "d' = 4" in why.margin and "1 pair of 2 rivals" in why.data


def test_a_step_of_the_ladder_says_what_it_was_judged_on():
    assert "no parameter was fitted" in whys.of_step("held_out", 5.0, 2.0, 2).data and "40 %" in whys.of_step("held_out", 5.0, 2.0, 2).margin


def test_what_is_significant_stands_in_a_table_beside_the_map():
    varied = [PLACE, PLACE | {"dependence": "load", "p": 0.5}]
    (table,) = localisation("place", varied, 0.004)[1]
    assert table.rows == [["hysteresis", "branch of torque", "100 %", "p = 1e-9", "yes"]] and "80.0 of chi-square, in 3 dimensions" in table.whys[0].data
