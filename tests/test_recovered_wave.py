"""A wave over the angle is recovered at any order that the samples resolve, and none from noise."""

import math

import numpy as np
import pytest

from discrepancy.campaign.model import Campaign
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.law.recover import recover
from discrepancy.inference.law.waves import wave_of
from discrepancy.page import laws as page
from discrepancy.problem import Record
from discrepancy.scales import AXES
from discrepancy.verdict import told_in

ARCSEC = math.pi / 180.0 / 3600.0
ANGLES = np.linspace(0.0, 2.0 * math.pi, 400, endpoint=False)


class Model:
    """Predicts no error; measured is a pattern over angle and load with noise of 1 arcsec."""

    nuisances = candidates = ()

    def __init__(self, pattern):
        rng = np.random.default_rng(3)
        self.records = [
            Record(f"{load:g} {way} {k}", "transmission_error", "rad", f"{load:g} {way}", k, self.centred(pattern(load, way) + ARCSEC * rng.standard_normal(400)),
                   {"angle": ANGLES}, {"load": load, "direction": way, "speed": 200.0})
            for load in (50.0, 100.0, 160.0) for way in (1.0, -1.0) for k in (1, 2)
        ]  # fmt: skip
        self.campaign = Campaign(None, "", "", None, 121.0, 167.0, {}, (), {}, {}, (), None, "")

    def centred(self, values):
        return values - values.mean()

    def predict(self, values, which=None):
        return [np.zeros(400) for _ in (range(len(self.records)) if which is None else which)]


def prepared(pattern):
    model = Model(pattern)
    doctor = Diagnostician(model)
    doctor.prepare()
    return model, doctor.space


@pytest.mark.parametrize(("way", "factor"), [
    ("none", lambda load, way: 1.0), ("load", lambda load, way: load / 100.0), ("direction", lambda load, way: way),
    ("load and direction", lambda load, way: way * load / 100.0),
])  # fmt: skip
def test_order_size_and_what_it_goes_with(way, factor):
    model, space = prepared(lambda load, sense: 0.6 * ARCSEC * factor(load, sense) * np.cos(47.3 * ANGLES + 0.7))
    wave = wave_of(space, space.base, range(len(space.records)))
    width = math.sqrt(wave.covariance[2, 2])
    # Of 4,800 samples of a wave of 0.6 times the noise over one turn: sqrt(24/4800)/(0.6 2 pi).
    assert wave.way == way and wave.order == pytest.approx(47.3, abs=3.0 * width) and width == pytest.approx(0.019, rel=0.3)
    scale = 0.01 if "load" in way else 1.0
    found, width = math.hypot(wave.b, wave.c), math.sqrt(np.diag(wave.covariance)[:2].max())
    assert found == pytest.approx(0.6 * scale * ARCSEC, abs=4.0 * width) and width < 0.1 * found
    # Counted from another angle it is the same wave, known no less and no better where it is 0.
    b, c, covariance = wave.about(2.0)
    at = ANGLES - 2.0
    again = b * np.cos(wave.order * at) + c * np.sin(wave.order * at)
    assert again == pytest.approx(wave.b * np.cos(wave.order * ANGLES) + wave.c * np.sin(wave.order * ANGLES), abs=1e-12)
    assert covariance[2, 2] == pytest.approx(wave.covariance[2, 2])


def test_it_becomes_a_law_in_the_units_of_the_campaign():
    model, space = prepared(lambda load, sense: 0.6 * ARCSEC * np.cos(47.3 * ANGLES + 0.7))
    (law,) = recover(space, space.base, None, told_in(model))
    form = law.forms[0]
    assert law.leading == "angle" and law.factor is None and form.name == "periodic" and "order 47.3" in law.text and "[arcsec]" in law.text
    assert form.parameters["k"] == pytest.approx(47.3 * math.pi / 180.0, rel=1e-3) and math.hypot(form.parameters["b"], form.parameters["c"]) == pytest.approx(0.6, abs=0.1)
    assert page.figures(law, AXES["speed"]) and "a =" not in law.text


def test_noise_has_no_wave_and_what_is_beyond_the_samples_neither():
    model, space = prepared(lambda load, sense: 0.0 * ANGLES)
    assert wave_of(space, space.base, range(len(space.records))) is None
    assert wave_of(space, space.base, []) is None


@pytest.mark.parametrize(("name", "levels", "power"), [("temperature", (293.15, 323.15, 338.15), 2.0), ("speed", (50.0, 100.0, 200.0), -1.0), ("load", (50.0, 100.0, 160.0), 3.0)])
def test_a_size_goes_with_a_power_of_what_varies(name, levels, power):
    """One that grows with the square of the temperature was taken for the same everywhere."""
    zero = 273.15 if name == "temperature" else 0.0

    class Varied(Model):
        def __init__(self):
            rng = np.random.default_rng(3)
            self.records = [
                Record(f"{level:g} {k}", "transmission_error", "rad", f"{level:g}", k,
                       self.centred(2.0 * ARCSEC * ((level - zero) / (levels[-1] - zero)) ** power * np.cos(52.0 * ANGLES + 0.7) + ARCSEC * rng.standard_normal(400)),
                       {"angle": ANGLES}, {"load": 100.0, "direction": 1.0, "speed": 200.0, "temperature": 293.15, name: level})
                for level in levels for k in (1, 2)
            ]  # fmt: skip
            self.campaign = Campaign(None, "", "", None, 121.0, 167.0, {}, (), {}, {}, (), None, "")

    model = Varied()
    doctor = Diagnostician(model)
    doctor.prepare()
    (law,) = recover(doctor.space, doctor.space.base, None, told_in(model))
    growth = law.growth
    assert (growth.factor, growth.zero, growth.top) == (name, pytest.approx(zero), pytest.approx(levels[-1] - zero))
    assert growth.exponent == pytest.approx(power, abs=3.0 * growth.deviation) and growth.deviation < 0.3
    assert math.hypot(*(law.forms[0].parameters[k] for k in "bc")) == pytest.approx(2.0, rel=0.15)
    assert f"its size with ({name}/" in law.text and law.to_dict()["growth"]["factor"] == name and "at the largest" in page.figures(law, AXES["speed"])[0].layout["yaxis"]["title"]["text"]


def test_what_is_the_same_everywhere_or_in_proportion_gets_no_power():
    for factor in (lambda load, way: 1.0, lambda load, way: load / 100.0):
        model, space = prepared(lambda load, sense, factor=factor: 0.6 * ARCSEC * factor(load, sense) * np.cos(47.3 * ANGLES + 0.7))
        assert wave_of(space, space.base, range(len(space.records))).growth is None
