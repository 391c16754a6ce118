"""An effect that shows only beside a number that is assumed, as forces do over the mass that vibrates, and a direction that nothing tells."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from discrepancy.inference.diagnose import Diagnostician
from discrepancy.problem import Candidate, Parameter, Record
from discrepancy.scales import estimate_texts

ORDERS = np.arange(200.0)
SIZE, MASS = 5.0, 10.0
UNBALANCE = Candidate(
    "unbalance", "", (Parameter("unbalance", "kg.m", 0.0, 0.0, 1e3, 1.0, 1),),
    (Parameter("unbalance_angle", "rad", 0.3, -20.0, 20.0, 1.0),),
    ({"unbalance_angle": -1.0}, {"unbalance_angle": 1.0}),
)  # fmt: skip


@dataclass
class Shaken:
    """Lines of a force over a mass, each with its own noise, whatever its direction."""

    deviation: float
    candidates: tuple = (UNBALANCE,)

    def __post_init__(self):
        self.nuisances = (Parameter("housing_mass", "kg", MASS, 1.0, 1e3, 1.0, 0, self.deviation, "mass that vibrates"),)
        noise = 0.02 * np.random.default_rng(3).standard_normal((4, ORDERS.size))
        shown = self.predict({"unbalance": SIZE, "housing_mass": MASS}, [0])[0]
        self.records = [Record(f"r{k}", "vibration_order", "m/s^2", "a", k, shown + e, {"order": ORDERS}, {}) for k, e in enumerate(noise)]

    def predict(self, values, which=None):
        y = values.get("unbalance", 0.0) / values.get("housing_mass", MASS) * np.exp(-((ORDERS - 40.0) ** 2))
        return [y for _ in (range(4) if which is None else which)]


def answer(deviation):
    return Diagnostician(Shaken(deviation)).run()


def test_what_is_seen_plainly_is_as_small_as_the_assumed_number_can_be_and_never_none():
    found = answer(10.0)
    (effect,) = found.effects
    low, high = effect.parameters["unbalance"]["interval"]
    # The mass is 1 kg at least, and hardly over 10 + 1.96 * 10.
    assert 0.05 * SIZE < low < 0.2 * SIZE
    assert 2.5 * SIZE < high < 3.5 * SIZE
    (said,) = [text for text in found.warnings if "housing_mass" in text]
    assert "told only beside housing_mass (mass that vibrates), which is taken as 10 kg give or take 10" in said
    assert '[nuisances.housing_mass] with unit = "kg"' in said


def test_with_that_number_known_the_interval_is_that_of_the_noise():
    found = answer(0.1)
    (effect,) = found.effects
    low, high = effect.parameters["unbalance"]["interval"]
    assert 0.9 * SIZE < low < SIZE < high < 1.1 * SIZE
    assert not [text for text in found.warnings if "housing_mass" in text]


def test_a_direction_of_which_nothing_tells_may_be_any():
    entry = answer(0.1).effects[0].parameters["unbalance_angle"]
    assert entry["direction"]
    assert estimate_texts(entry) == ("any", "not determined", "")


@pytest.mark.parametrize("width, told", [(math.tau, "any"), (0.9 * math.tau, "17.19")])
def test_an_interval_of_a_turn_is_no_direction(width, told):
    entry = {"value": 0.3, "interval": [0.3 - 0.5 * width, 0.3 + 0.5 * width], "unit": "rad", "direction": True}
    assert estimate_texts(entry)[0] == told
