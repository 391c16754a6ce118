"""A ring of pins that is found out of round: the headline says the shape, and what the campaign leaves open of it."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np

from discrepancy.inference.verdict import ONE
from discrepancy.page.answer import headline
from discrepancy.problem import Record
from discrepancy.words.pin_shapes import shape_text
from tests.test_next_run import CAMPAIGN

OVAL = {"name": "pin_position_errors", "variant": "ovality", "parameters": {"pin_ring_ovality": {}, "pin_ring_ovality_angle": {}}}


def campaign(*interventions: str):
    error = Record("te", "transmission_error", "rad", "c", 1, np.zeros(5), {"angle": np.linspace(0.0, 7.0, 5)}, {"direction": 1.0})
    return replace(CAMPAIGN, records=(error,), conditions={"c": SimpleNamespace(interventions=interventions)})


def test_the_headline_says_the_shape_and_its_reserve():
    """"The model lacks pin position errors (ovality)" answered what the note below it left open."""
    answer = SimpleNamespace(effects=[OVAL], verdict=ONE, reason="", left_over="", confusable=[], model=SimpleNamespace(campaign=campaign()),
                             diagnosis=SimpleNamespace(base_off=[]))  # fmt: skip
    said = "an oval on which the pins of the ring stand (of their own places, or of a ring that is oval or clamped so: not told here)"
    assert headline(answer) == f"The model lacks {said}."


def test_other_effects_and_a_single_pin_keep_their_names():
    model = SimpleNamespace(campaign=campaign())
    assert shape_text({"name": "ring_stiffness", "parameters": {}}, model) == ""
    assert shape_text({"name": "pin_position_errors", "variant": "proud", "parameters": {"proud_pin": {}}}, model) == ""


def test_an_oval_says_of_what_its_amplitude_is():
    """"pin ring oval, amplitude 4.001 um" may have been of the radius or the diameter, peak to valley or half of it."""
    from rv_plant.effects.pin_position_errors import EFFECT

    said = {p.variable.name: p.variable.description for p in EFFECT.parameters}
    assert all("amplitude of the radius: half of peak to valley" in said[name] for name in ("pin_ring_ovality", "pin_ring_trilobe"))
