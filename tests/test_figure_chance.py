"""Key figures far off in times their noise, beside "nothing is significant": what chance makes of that is said."""

from dataclasses import replace

import pytest

from cli.screen import WIDTH, console
from cli.show.comparison import show_figures
from discrepancy.figures.figure_chance import chance_text, rarest
from discrepancy.figures.key_figures import KeyFigure, repetitions_beyond
from discrepancy.model_file import load_model
from discrepancy.page.comparison import figures_section

NEAR = KeyFigure("hysteresis", "50N.m", "lost motion", "rad", 1.0, 1.0, 0.1, 2, True, 6)
OFF = replace(NEAR, name="mean width of the loop", measured=1.395)


def test_few_repetitions_leave_a_figure_to_chance():
    """3.95 times the noise stood amber, without a word that 62 figures with six degrees of freedom make that."""
    figures = [NEAR] * 61 + [OFF]
    assert rarest(figures)[1] == pytest.approx(0.37, abs=0.02)
    assert chance_text(figures) == (
        "the least likely of 62 figures is mean width of the loop of hysteresis at 50N.m, 4.0 times its noise, its noise known from 6 degrees of freedom;"
        " that chance makes one so rare among 62 is p = 0.37"
    )


def test_a_noise_that_is_known_makes_the_same_figure_rare():
    figures = [NEAR] * 61 + [replace(OFF, dof=0)]
    assert chance_text(figures).startswith("mean width of the loop of hysteresis at 50N.m is off: 4.0 times its noise; that chance")
    assert rarest(figures)[1] == pytest.approx(62 * 7.8e-5, rel=0.02)


def test_the_rarest_is_not_the_one_with_most_times_of_a_noise_that_hardly_anything_tells():
    assert rarest([replace(OFF, measured=1.45, dof=1), OFF])[0] is OFF and chance_text([]) == ""
    assert rarest([NEAR])[1] == 1.0


def test_degrees_of_freedom_are_repetitions_beyond_the_first():
    assert repetitions_beyond({("te", "a"): [{"x": 1.0}, {"x": 2.0}], ("te", "b"): [{"x": 1.0}] * 3, ("te", "c"): [{"x": 1.0}]})["te", "x"] == 3


def test_it_stands_below_the_table_on_screen_and_page(capsys):
    figures, file = [NEAR, OFF], load_model("RV20E-121")
    show_figures(figures, console(WIDTH), file, True, of_chance=chance_text(figures))
    assert "that chance makes one so rare among 2 is" in " ".join(capsys.readouterr().out.split())
    assert "The least likely of 2 figures is mean width" in figures_section(figures, file, True, chance_text(figures))[0].lead
    show_figures(figures, console(WIDTH), file, True)
    assert "chance" not in capsys.readouterr().out
