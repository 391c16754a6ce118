"""Which key figures a table shows: each kind, or it says which are left out."""

from dataclasses import replace

from cli.screen import WIDTH, console
from cli.show.comparison import show_figures
from discrepancy.figures.key_figures import LOST_MOTION, STIFFNESS, KeyFigure
from discrepancy.figures.told_figures import MOST, others_text, told_figures
from discrepancy.model_file import load_model
from discrepancy.page.comparison import figures_section

ANY = KeyFigure("transmission_error", "50N.m", "order 1", "rad", 2.0, 1.0, 0.1, 2, True)
# Nearest of all, and what one asks for.
LOST = replace(ANY, signal="hysteresis", name=LOST_MOTION, measured=1.01)


def orders(count: int) -> list[KeyFigure]:
    return [replace(ANY, name=f"order {k}", measured=2.0 + k, condition=place) for k in range(1, count + 1) for place in ("50N.m", "150N.m")]


def test_each_kind_has_its_row_and_the_nearest_is_not_dropped_without_a_word(capsys):
    figures = [*orders(12), LOST]
    assert len(told_figures(figures)) == 13 and LOST in told_figures(figures)
    show_figures(figures, console(WIDTH), load_model("RV20E-121"), True)
    shown = " ".join(capsys.readouterr().out.split())
    assert "lost motion" in shown and shown.endswith("all 13 kinds of figure, each where it is furthest off; 25 figures in all: --json lists all")
    lead = figures_section(figures, load_model("RV20E-121"), True)[0].lead
    assert lead.endswith("Shown are all 13 kinds of figure, each where it is furthest off; 25 figures in all.")


def test_of_very_many_kinds_those_of_a_catalogue_stay_and_the_others_are_named():
    figures = [*orders(MOST + 2), LOST, replace(LOST, name=STIFFNESS, unit="N.m/rad")]
    told = told_figures(figures)
    assert len(told) == MOST + 2 and {LOST_MOTION, STIFFNESS} <= {f.name for f in told}
    assert "left out are nearer ones: order 2; order 1)" in others_text(figures)


def test_where_all_are_shown_nothing_is_said_of_others():
    assert others_text([LOST]) == "" and others_text([]) == ""


def test_screen_page_and_workbench_have_one_number_of_digits(capsys):
    """Look had 45.439 +- 0.0091, the diagnosis 45.4 and 0.00912."""
    from workbench.look import figures as in_look

    f = replace(ANY, signal="hysteresis", name=STIFFNESS, unit="N.m/rad", measured=45.4394 * 3437.747, model=50.0 * 3437.747, noise=0.00912 * 3437.747)
    [look] = in_look([f])
    assert [look[key] for key in ("measured", "noise", "model")] == ["45.4394", "0.0091", "50.0000"]
    show_figures([f], console(WIDTH), load_model("RV20E-121"), True)
    shown = capsys.readouterr().out.split()
    assert all(text in shown for text in ("45.4394", "0.0091", "50.0000"))
