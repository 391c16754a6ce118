"""Beside the verdict that nothing is missing a key figure that stands far off is named, with why it names nothing."""

from dataclasses import replace

from discrepancy import verdict
from discrepancy.figures.beside_none import beside_none
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.page.answer import sentence
from tests.test_discrepancy_page import diagnosed, model_of

FIGURE = KeyFigure("transmission_error", "load_20", "sun, orders 120, 121", "rad", 4e-6, 2.36e-6, 2e-7, 2, True)


def test_what_stands_far_off_is_explained(monkeypatch):
    """A verdict "none" stood beside 8.2 times the noise, without a word."""
    found = diagnosed(model_of())
    space = found.doctor.space
    record = space.records[space.training[0]]
    figure = replace(FIGURE, signal=record.quantity, condition=record.condition)
    # What is said of files and places needs a campaign of files.
    for name in ("beforehand", "warnings_of", "placed", "zero_texts", "origins_untold", "parts_untold_before", "zeros_told", "would_show"):
        monkeypatch.setattr(verdict, name, lambda *given: [])
    answer = verdict.answer_of(found.model, found.doctor, found.diagnosis, [figure])
    assert "8.2 times what its repetitions differ by" in answer.reason and "tests over all samples" in answer.reason and "(the least of " in answer.reason
    assert "The figure furthest off, of 1, is sun" in sentence(answer)
    held = replace(figure, condition=space.records[space.held_out[0]].condition)
    assert beside_none([held], space, found.doctor.localisation.groups).endswith("its runs are held out, and only fitted ones are tested")


def test_nothing_is_said_of_figures_within_their_noise():
    found = diagnosed(model_of())
    assert beside_none([replace(FIGURE, model=3.8e-6)], found.doctor.space, found.doctor.localisation.groups) == ""
    assert ";" not in found.reason


def test_a_figure_that_is_rarer_than_chance_is_named_though_less_far_off():
    found = diagnosed(model_of())
    space = found.doctor.space
    record = space.records[space.training[0]]
    four = replace(FIGURE, signal=record.quantity, condition=record.condition, model=3.2e-6)
    groups = found.doctor.localisation.groups
    # Of a noise that is known, four times are rare; of one that two repetitions tell they are not.
    assert beside_none([four], space, groups).startswith("the figure that chance makes least often (p = 6e-5 among all), of 1, is sun")
    assert beside_none([replace(four, dof=2)], space, groups) == ""
