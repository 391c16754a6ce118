"""Forms of the best effect that can do more than it are gone on with only where it leaves something."""

from dataclasses import replace
from functools import partial
from types import SimpleNamespace

from test_confusable import rival

from discrepancy.inference.alone import Alone, more_of
from discrepancy.inference.verdict import Settings


def form(name, chi2, parameters):
    found = rival(name, chi2)
    (candidate,) = found.candidates
    return replace(found, candidates=(replace(candidate, amplitudes=candidate.amplitudes * parameters),))


THREE, ALL, OTHER = form("ring.three_lobes", 100.0, 1), form("ring.harmonics", 300.0, 5), form("lobes.first", 400.0, 5)


def rivals(fits):
    for fit in fits:
        fit.fit.residual = [0.0] * 10
    return Alone.rivals(SimpleNamespace(settings=Settings()), fits)


def test_a_form_that_can_do_more_is_one_of_the_same_effect_with_more_numbers():
    assert more_of(ALL, THREE) and not more_of(THREE, ALL) and not more_of(OTHER, THREE)


def test_other_starts_are_left_to_other_effects_and_to_simpler_forms():
    assert rivals([THREE, ALL]) == []
    assert rivals([THREE, OTHER]) == [OTHER]
    assert rivals([ALL, THREE]) == [THREE]
    assert rivals([]) == []


def test_far_behind_a_fit_that_leaves_nothing_no_other_start_is_tried():
    close = partial(Alone.is_close, SimpleNamespace())
    assert close(form("lobes.first", 190.0, 5), THREE) and not close(OTHER, THREE)
    # Of a misfit a thousand times as large, rough predictions are off by more.
    assert close(OTHER, replace(THREE, gain=1e6))
