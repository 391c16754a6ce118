"""A reducer has two transmission errors: people are told the whole one, and of the other that it is the second stage's alone."""

import numpy as np
import pytest

from cli.main import main
from cli.show.life import LIFE_COLUMNS
from orchestrator.settings import parse_setting
from reducers.reducer import load_reducer
from studies.report.turn import turn_figures
from studies.turn import crank_turn
from workbench.life_step import PANES

WHOLE, ALONE = "transmission_error_at_input_pp_arcsec", "transmission_error_pp_arcsec"


@pytest.fixture(scope="module")
def reducer():
    return load_reducer("RV20E-121")


def turned(reducer, *texts):
    return crank_turn(reducer, [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts], 24)


def test_a_first_stage_that_errs_shows_in_what_is_told(reducer):
    plain, erring = turned(reducer), turned(reducer, "effects.first_stage_error.planet_runout=20um")
    assert erring.figures[ALONE] == pytest.approx(plain.figures[ALONE], rel=0.01)
    assert erring.figures[WHOLE] > 1.2 * plain.figures[WHOLE]
    error = turn_figures(erring.dataset())[0].data[0]
    assert error["name"] == "transmission error" and np.ptp(error["y"]) == pytest.approx(erring.figures[WHOLE], rel=1e-3)


def test_lives_show_the_whole_error():
    told = [name for _, _, lines in PANES for name, _ in lines] + [name for name, _, _ in LIFE_COLUMNS]
    assert told.count(WHOLE) == 2 and ALONE not in told


def test_a_screen_with_both_says_which_is_which(capsys):
    assert main(["solve", "--positions", "8"]) == 0
    rows = [[cell.strip() for cell in line.split("│")[1:-1]] for line in capsys.readouterr().out.splitlines()]
    names = [row[0] for row in rows if row]
    assert names[names.index(ALONE) + 1] == "second stage alone, against the cranks"
    assert names[names.index(WHOLE) + 1] == "whole, against the input"
