"""Which key figures a table shows: each kind, or it says which are left out."""

from dataclasses import replace

from cli.screen import WIDTH, console
from cli.show.comparison import show_figures
from discrepancy.figures.key_figures import LOST_MOTION, SPAN, STIFFNESS, KeyFigure
from discrepancy.figures.told_figures import MOST, drawn_text, others_text, told_figures
from discrepancy.model_file import load_model
from discrepancy.page import changed_figures, whys
from discrepancy.page.comparison import figures_section
from discrepancy.tables import figure_rows
from discrepancy.words import as_told

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


def test_a_kind_has_a_row_where_it_is_furthest_off_with_what_was_added(capsys):
    """18.0 -> 0.2 stood there of one position, and 3.1 times the noise of the other nowhere."""
    here, there, near = (replace(ANY, condition=place, measured=1.0 + 0.1 * off) for place, off in (("210deg", 18.0), ("90deg", 16.2), ("0deg", 5.0)))
    after = [replace(f, model=f.measured - 0.1 * off) for f, off in ((here, 0.2), (there, -3.1), (near, 1.9))]
    assert told_figures([here, there, near], after) == [here, there] and told_figures([here, there, near]) == [here]
    show_figures([here, there, near], console(WIDTH), load_model("RV20E-121"), True, after, "pins")
    shown = " ".join(capsys.readouterr().out.split())
    assert "18.0 -> 0.2" in shown and "16.2 -> 3.1" in shown and "5.0 -> 1.9" not in shown
    says = "and where it is furthest off with it if that is another condition and more than 2 times its noise"
    [section] = changed_figures.section(list(zip([here, there, near], after)), "")
    assert says in shown and says in section.lead and [row[1] for row in section.tables[0].rows] == ["210deg", "90deg"]
    # What is off by no more than that, or at the same condition, has no row of its own.
    assert told_figures([here, there], [after[0], replace(after[1], model=there.measured - 0.19)]) == [here]
    assert told_figures([here, there], [replace(after[0], model=here.measured - 0.9), after[1]]) == [here]


def test_a_models_peak_to_peak_says_that_noise_is_drawn_on_its_curve(capsys):
    """8.14 arcsec stood beside a curve of 6.00."""
    arcsec = 4.84813681e-6
    f = replace(ANY, name=SPAN, measured=10.06 * arcsec, model=8.14 * arcsec, noise=0.15 * arcsec, model_curve=6.0 * arcsec)
    show_figures([f], console(WIDTH), load_model("RV20E-121"), True)
    shown = " ".join(capsys.readouterr().out.split())
    how = "its curve with the noise of the samples drawn on it, mean of 25 draws"
    assert f"peak to peak, model: of {how}, for noise makes what is measured larger, too; peak to peak of the curve alone: 6.00 arcsec at 50N.m" in shown
    assert how in figures_section([f], load_model("RV20E-121"), True)[0].lead
    why = whys.of_key_figure(f).relation
    assert how in why and "of the curve alone it is 6.00 arcsec" in why
    [told] = as_told.figures([f])
    assert (round(told["model_curve"], 3), told["model_from"]) == (6.0, how)
    row = {column.name: column.values[0] for column in figure_rows([f], [replace(f, model_curve=7.9 * arcsec)]).columns}
    assert row["model_from"] == how and (round(row["model_curve"], 3), round(row["with_effect_curve"], 3)) == (6.0, 7.9)
    # Of a loop nothing is drawn.
    assert drawn_text([LOST]) == "" and "curve alone" not in whys.of_key_figure(LOST).relation and as_told.figures([LOST])[0]["model_from"] == "its curve"
