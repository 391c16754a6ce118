"""A reducer has two transmission errors: people are told the whole one, of a life over a turn of the output, and of the other that it is the second stage's alone."""

import numpy as np
import pytest

from cli.main import main
from cli.show.life import LIFE_COLUMNS, life_table
from orchestrator.master import Master
from orchestrator.settings import parse_setting
from pages.words import number
from reducers.reducer import load_reducer
from studies.coupled_master import CoupledMaster
from studies.figure_units import OVER_TURN, WHAT_IS_OVER_TURN, WINDOW
from studies.kept_life import WantedLife, whole_life
from studies.life import LifeSettings
from studies.meshing_cycle import drift_of, run_cycle, swing_over_turn
from studies.pair import make_pair
from studies.report.findings import cards, sentences
from studies.report.result import Result
from studies.report.turn import turn_figures
from studies.solve import ARCSEC
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
    assert told.count(OVER_TURN) == 2 and ALONE not in told and WHOLE not in told


@pytest.fixture(scope="module")
def oval(reducer):
    """Life of a gear whose ring is oval: what one crank turn shows goes with where the output then stands."""
    texts = ("effects.pin_position_errors.ring_ovality=5um", "effects.pin_position_errors.ring_ovality_angle=132deg")
    settings = [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts]
    return whole_life(WantedLife(reducer, settings, LifeSettings(1000.0, 0.05), 24), lambda _: None)


def test_a_life_tells_the_error_over_a_turn_of_the_output(oval):
    swing, ends = oval[OVER_TURN].values, np.ptp(oval["transmission_error_over_turn"].values, axis=1)
    assert swing[[0, -1]] == pytest.approx(ends, abs=0.0)
    # No step of it is one of the place: what a jump shows lies between.
    assert (np.diff(swing) < 0.0).all() and oval[WHOLE].values[0] < 0.8 * swing[0]
    assert WINDOW in oval[WHOLE].attrs["long_name"] and WINDOW in oval[ALONE].attrs["long_name"]
    assert "turn of the output" in oval[OVER_TURN].attrs["long_name"]


def test_report_and_table_say_what_the_result_says(oval, capsys):
    result = Result.of(oval)
    new, worn = (number(oval[OVER_TURN].values[i]) for i in (0, -1))
    assert f"the transmission error over one turn of the output falls from {new} to {worn} arcsec" in " ".join(sentences(result))
    card = next(c for c in cards(result) if c.label.startswith("Transmission error"))
    assert (card.name, card.start_text, card.end_text) == (OVER_TURN, new, worn) and card.note.startswith("−")
    life_table(oval)
    shown = " ".join(capsys.readouterr().out.split())
    assert f"{oval[OVER_TURN].values[-1]:.2f}" in shown and WHAT_IS_OVER_TURN in shown
    kept = Result.of(oval.drop_vars(OVER_TURN))
    assert kept[OVER_TURN][[0, -1]].tolist() == oval[OVER_TURN].values[[0, -1]].tolist()


def test_hours_between_have_what_a_turn_without_wear_shows_there(oval, reducer):
    """Of a life that ends there."""
    texts = ("effects.pin_position_errors.ring_ovality=5um", "effects.pin_position_errors.ring_ovality_angle=132deg")
    settings = [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts]
    middle = len(oval["hour"]) // 2
    shorter = whole_life(WantedLife(reducer, settings, LifeSettings(float(oval["hour"][middle]), 0.05), 24), lambda _: None)
    assert oval[OVER_TURN].values[middle] == pytest.approx(shorter[OVER_TURN].values[-1], rel=0.03)


def test_both_masters_read_the_same_error(reducer):
    one, other = (run_cycle(make_pair(reducer, [], positions=8, master_kind=kind), 20.0) for kind in (Master, CoupledMaster))
    assert one[0] == other[0] == 20.0 and (one[1] == other[1]).all() and np.ptp(one[1]) > 0.0


def test_what_a_jump_wears_is_no_error():
    positions, turn = 10, 4000
    error = np.sin(4.0 * np.pi * np.arange(turn + positions) / turn)

    def lag(start, end):
        hours = np.linspace(start, end, turn + 1)
        return -3.0 * np.sqrt(hours) - 0.1 * hours

    def drift(start, end):
        return [start, end, float(np.diff(lag(start, end)[[0, -1]])[0])]

    record = error + np.append(lag(100.0, 400.0), np.full(positions - 1, lag(100.0, 400.0)[-1]))
    assert swing_over_turn(record, positions, drift(0.0, 100.0), drift(100.0, 400.0)) == pytest.approx(2.0 * ARCSEC, rel=0.02)
    assert drift_of(record, positions) == pytest.approx(drift(100.0, 400.0)[2], rel=0.02)


def test_a_screen_with_both_says_which_is_which(capsys):
    assert main(["solve", "--positions", "8"]) == 0
    rows = [[cell.strip() for cell in line.split("│")[1:-1]] for line in capsys.readouterr().out.splitlines()]
    names = [row[0] for row in rows if row]
    assert names[names.index(ALONE) + 1] == "second stage alone, against the cranks"
    assert names[names.index(WHOLE) + 1] == "whole, against the input"
