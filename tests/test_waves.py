"""Cosine and sine of a wave are told as amplitude and phase."""

import numpy as np
import pytest

from discrepancy.words.waves import waves_of


def estimate(value, deviation, unit="rad"):
    return {"value": value, "interval": [value - 2.0 * deviation, value + 2.0 * deviation], "unit": unit}


def test_amplitude_and_phase_of_a_pair():
    found = {"encoder_cos1": estimate(3.0, 0.1), "encoder_sin1": estimate(-4.0, 0.2), "encoder_cos2": estimate(1.0, 0.1), "gain": estimate(9.0, 1.0)}
    (wave,) = waves_of(found)
    assert (wave.cosine, wave.sine, wave.amplitude) == ("encoder_cos1", "encoder_sin1", 5.0)
    assert wave.phase == pytest.approx(360.0 - np.degrees(np.arctan2(4.0, 3.0)))
    x = np.linspace(0.0, 7.0, 50)
    assert 5.0 * np.cos(x - np.radians(wave.phase)) == pytest.approx(3.0 * np.cos(x) - 4.0 * np.sin(x))


def test_the_interval_holds_its_share():
    random, deviations = np.random.default_rng(3), (0.1, 0.3)
    held = 0
    for cosine, sine in random.normal((3.0, -4.0), deviations, (2000, 2)):
        (wave,) = waves_of({"a_cos_2": estimate(cosine, deviations[0]), "a_sin_2": estimate(sine, deviations[1])})
        held += wave.interval[0] <= 5.0 <= wave.interval[1]
    assert held / 2000 == pytest.approx(0.954, abs=0.015)


def test_words_with_cos_in_them_and_waves_of_no_size_are_none():
    assert waves_of({"cost": estimate(1.0, 0.1), "sint": estimate(1.0, 0.1), "a_cos": estimate(0.0, 0.0), "a_sin": estimate(0.0, 0.0)}) == []
