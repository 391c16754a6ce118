"""Loops of which nobody says where the input was locked: where the best effect alone stands for the position, and leaves something, all is looked for anew with
the input locked where loops are as measured without any effect."""

import math
from dataclasses import dataclass, field, replace

import numpy as np
import pytest
from test_unstated_places import PERIOD, TORQUE
from zero_campaign import REDUCER, written

from discrepancy.campaign.load import load_campaign
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.observe import OBSERVED
from discrepancy.prediction.over_torque import OverTorque
from discrepancy.prediction.physical_model import IMPOSSIBLE, PhysicalModel
from discrepancy.prediction.unstated_places import UnstatedPlaces, locked
from discrepancy.problem import Candidate, Parameter, Record
from fmu_src.faults import RunFault

ANGLE = np.linspace(0.0, 2.0 * np.pi, 300, endpoint=False)
# What the place does to a run, and what stands for it, which is most of it; what friction does.
PLACE, STANDS_FOR, FRICTION = np.sin(ANGLE) + 0.4 * np.sin(2.0 * ANGLE), np.sin(ANGLE), np.sign(np.cos(3.0 * ANGLE))


def candidate(name):
    return Candidate(name, "", (Parameter(f"{name}_size", "1", 0.0, -50.0, 50.0, 1.0),))


@dataclass
class Loops:
    """Runs whose place is known once it was looked for, if there is one to be found."""

    hidden: float
    is_found: bool = True
    at: bool = False
    asked: list = field(default_factory=list)
    nuisances: tuple = ()
    candidates: tuple = (candidate("position"), candidate("friction"))

    def __post_init__(self):
        noise = np.random.default_rng(2).standard_normal((4, ANGLE.size))
        self.records = [Record(f"r{k}", "hysteresis", "rad", "a", k, 9.0 * PLACE + self.hidden * FRICTION + e, {"angle": ANGLE}, {}) for k, e in enumerate(noise)]

    def predict(self, values, which=None):
        y = values.get("position_size", 0.0) * STANDS_FOR + values.get("friction_size", 0.0) * FRICTION + 9.0 * self.at * PLACE
        return [y for _ in (range(4) if which is None else which)]

    def place_alone(self, instead_of, values):
        self.asked.append(instead_of)
        self.at = self.is_found and instead_of == "position"
        return self.at


def test_the_place_is_taken_before_further_effects_are_looked_for():
    model = Loops(3.0)
    doctor = Diagnostician(model)
    found = doctor.run()
    assert model.asked == ["position"] and doctor.anew
    assert [e.name for e in found.effects] == ["friction"] and found.verdict == "one effect"
    assert found.effects[0].parameters["friction_size"]["value"] == pytest.approx(3.0, abs=0.2)


def test_beside_a_larger_effect_the_place_is_looked_for_with_it():
    model = Loops(25.0)
    doctor = Diagnostician(model)
    found = doctor.run()
    assert model.asked[-1] == "position" and doctor.anew
    assert [e.name for e in found.effects] == ["friction"] and found.effects[0].parameters["friction_size"]["value"] == pytest.approx(25.0, abs=0.2)


def test_where_there_is_no_such_place_the_diagnosis_goes_on():
    model = Loops(3.0, is_found=False)
    doctor = Diagnostician(model)
    found = doctor.run()
    assert set(model.asked) == {"position", "friction"} and not doctor.anew
    assert {e.name for e in found.effects} == {"position", "friction"}


def loop_of(place, transmission_error=True):
    bench = Bench(load_model("RV20E-121-rigid").reducer, {})
    record = Record("loop", "hysteresis", "rad", "c", 1, np.zeros(len(TORQUE)), {"torque": TORQUE}, {})
    loop = replace(record, values=OverTorque(bench, record if place is None else locked(record, place)).directly({}))
    errors = [Record("te", "transmission_error", "rad", "d", 1, np.ones(4), {"angle": np.arange(4.0)}, {})] * transmission_error
    places = UnstatedPlaces([loop, *errors], 121.0 * 2.0 * math.pi, PERIOD)
    return places, lambda record, place: OverTorque(bench, record if place is None else locked(record, place)).directly({})


def test_a_loop_without_any_effect_tells_its_place_and_a_mean_has_none():
    places, predicted = loop_of(math.radians(300.0))
    assert places.place_alone(predicted) and not places.place_alone(predicted)
    [found] = places.taken(frozenset({"friction_coefficient"}), {}).values()
    there, here = (predicted(next(iter(places.loops.values())), place) for place in (found, math.radians(300.0)))
    assert np.std(there - here) < 0.05 * np.std(predicted(next(iter(places.loops.values())), None) - here)
    for nothing, predicted in (loop_of(None), loop_of(math.radians(300.0), transmission_error=False)):
        assert not nothing.place_alone(predicted) and not nothing.found


def without_place(folder, hidden):
    """A campaign with a loop of which nobody says where its input was locked."""
    file = written(folder, hidden=hidden, loop=True) / "campaign.toml"
    file.write_text(file.read_text().replace('locked_at = "0 deg"', ""))
    return folder


def test_only_the_effect_that_stands_for_a_position_gives_way_to_one(tmp_path):
    folder = without_place(tmp_path, {})
    model = PhysicalModel(load_model(REDUCER), load_campaign(folder))
    assert not model.place_alone("needle_clearance", model.standing()) and not model.unstated_places.found
    model.place_alone("locked_position", model.standing())
    assert set(model.unstated_places.found) <= {frozenset()}


def test_where_the_reducer_finds_no_equilibrium_no_input_was_locked(tmp_path, monkeypatch):
    folder = written(tmp_path, loop=True)
    model = PhysicalModel(load_model(REDUCER), load_campaign(folder))
    loop = next(record for record in model.records if record.quantity == "hysteresis")

    def fails(*_):
        raise RunFault("no equilibrium")

    monkeypatch.setitem(OBSERVED, "hysteresis", fails)
    found = model.loop_at(model.standing(), loop, 1.0)
    assert np.ptp(found - loop.values) == pytest.approx(2.0 * IMPOSSIBLE * model.sizes["hysteresis"])


def test_a_model_that_was_fitted_to_a_campaign_finds_the_place_again(tmp_path):
    """``extend`` had friction beside a place, and ``compare`` held the loops against their mean: 0.99 times the noise, and 4.64."""
    folder = without_place(tmp_path, {"friction_coefficient": 0.05})
    friction = f'[model]\nname = "better"\nreducer = "{REDUCER}"\n\n[effects.stribeck_friction]\nfriction_coefficient = "0.05 1"\n'
    step = '\n[[steps]]\ncampaign = "zeros"\neffects = ["stribeck_friction.mesh"]\nkept = true\n\n[steps.nuisances]\n"angle_zero[1]" = 0.0\n'
    found = []
    for name, text in (("elsewhere", friction), ("fitted", friction + step)):
        (tmp_path / f"{name}.toml").write_text(text)
        found.append(PhysicalModel(load_model(tmp_path / f"{name}.toml"), load_campaign(folder)).unstated_places.taken(frozenset(), {}))
    assert found[0] == {} and set(found[1]) == {"held"}
