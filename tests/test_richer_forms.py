"""Forms of the best effect that can do more than it are gone on with only where it leaves something."""

from dataclasses import replace
from types import SimpleNamespace

from test_confusable import rival

from discrepancy.inference.alone import Alone, more_of
from discrepancy.inference.verdict import Settings


def form(name, chi2, parameters):
    found = rival(name, chi2)
    (candidate,) = found.candidates
    return replace(found, candidates=(replace(candidate, amplitudes=candidate.amplitudes * parameters),))


THREE, ALL, OTHER = form("ring.three_lobes", 100.0, 1), form("ring.harmonics", 300.0, 5), form("lobes.first", 400.0, 5)


def widened(fits):
    tried = []

    def told(what, function, items):
        tried.extend(items)
        return list(items)

    alone = SimpleNamespace(settings=Settings(), tried=told, refits=SimpleNamespace(widened=print), near=lambda best: 0.0)
    for fit in fits:
        fit.fit.residual = [0.0] * 10
    Alone.widely(alone, fits)
    return tried


def test_a_form_that_can_do_more_is_one_of_the_same_effect_with_more_numbers():
    assert more_of(ALL, THREE) and not more_of(THREE, ALL) and not more_of(OTHER, THREE)


def test_other_starts_are_left_to_other_effects_and_to_simpler_forms():
    assert widened([THREE, ALL]) == [THREE]
    assert widened([THREE, OTHER]) == [THREE, OTHER]
    assert widened([ALL, THREE]) == [ALL, THREE]
