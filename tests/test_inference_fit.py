"""Refits: never worse than the base, degenerate or not; rivals a little behind; leaving out what only one condition determines."""

from dataclasses import dataclass

import numpy as np
import pytest

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.diagnose import Diagnostician, diagnose
from discrepancy.inference.refit.refit import leave_condition_out
from discrepancy.inference.verdict import Settings
from discrepancy.problem import Candidate, Parameter, Record

ORDERS = np.arange(20.0, 220.0)
SPEEDS = (100.0, 150.0, 200.0, 250.0)


def line(order):
    return 1.0 * (order == ORDERS)


REST = 1e-10 * np.cos(ORDERS)
LINES = {"unbalance": line(39.0), "teeth": line(39.0) + 0.3 * line(78.0), "pit": np.exp(-ORDERS / 60.0)}


@dataclass
class Shaker:
    """Accelerations of a housing of unknown mass that the base model leaves next to at rest: only force over mass can be seen."""

    records: list
    shapes: dict
    mass: Parameter = Parameter("mass", "kg", 10.0, 1.0, 1e3, 1.0, 0, 10.0)

    def __post_init__(self):
        self.nuisances = (self.mass,)
        self.candidates = tuple(Candidate(n, n, (Parameter(n, "N", 0.0, -1e3, 1e3, 1.0),)) for n in self.shapes)

    def predict(self, values, which=None):
        def one(r):
            force = sum(values.get(n, 0.0) * pattern for n, pattern in self.shapes.items()) * (r.factors["speed"] / 200.0) ** 2
            return np.abs(force + REST) / values.get("mass", 10.0)

        return [one(self.records[i]) for i in (range(len(self.records)) if which is None else which)]


def shaken(force, shapes, seed=1, noise=0.05):
    """Two runs at every speed, the last speed held out; ``force`` [N] (200,) at 200 rad/s."""
    rng = np.random.default_rng(seed)
    records = [
        Record(f"{s:g} {k}", "vibration_order", "m/s^2", f"{s:g}", k,
               np.abs(force) / 10.0 * (s / 200.0) ** 2 + noise * rng.standard_normal(ORDERS.size), {"order": ORDERS}, {"speed": s, "load": 1.0},
               held_out=s == SPEEDS[-1])
        for s in SPEEDS for k in range(2)
    ]  # fmt: skip
    return Shaker(records, shapes)


@pytest.mark.parametrize("prior", [10.0, None])
def test_a_nuisance_that_only_the_effect_shows_does_not_run_away(prior):
    """Force and mass: any mass fits a housing at rest, and the force that goes with it."""
    model = shaken(20.0 * LINES["unbalance"], LINES)
    model.mass = Parameter("mass", "kg", 10.0, 0.01, 1e4, 1.0, 0, prior)
    model.nuisances = (model.mass,)
    doctor = Diagnostician(model)
    doctor.prepare()
    doctor.screened()
    found = doctor.fit(["unbalance"])
    assert found.fit.values["unbalance"] / found.fit.values["mass"] == pytest.approx(2.0, rel=0.02)
    # Speeds of 1/2, 3/4 and 1, two runs each, noise 0.05.
    assert found.gain == pytest.approx(2.0 * (2.0 / 0.05) ** 2 * (0.25**2 + 0.5625**2 + 1.0), rel=0.1)
    assert doctor.fit(["teeth"]).gain > doctor.fit(["pit"]).gain > 0.0


def test_a_rival_a_little_behind_that_leaves_nothing_stays_in_the_set():
    """The rival has a line that nobody measured: 8 of chi-square too much."""

    model = shaken(6.0 * LINES["unbalance"], {"unbalance": LINES["unbalance"], "other": line(39.0) + 0.075 * line(117.0)})
    strict, mild = (diagnose(model, Settings(margin=0.5, adequate_margin=m)) for m in (0.5, 12.0))
    rivals = {r.name: r.fit.chi2 for r in strict.fits.rivals}
    assert 6.0 < rivals["other"] - rivals["unbalance"] < 12.0
    assert strict.verdict == "one effect" and strict.effects[0].name == "unbalance"
    assert mild.verdict == "set" and mild.confusable == ["unbalance", "other"]


class Braked(Shaker):
    """The shaker with its drive's torque, which is measured at speeds of the training alone and which a drag raises."""

    def predict(self, values, which=None):
        found = super().predict(values, which)
        indices = range(len(self.records)) if which is None else which
        return [np.full(24, values.get("drag", 0.0)) if self.records[i].quantity == "input_torque" else y for i, y in zip(indices, found)]


def test_a_further_effect_that_unused_runs_do_not_show_is_named_all_the_same():
    rng = np.random.default_rng(4)
    model = shaken(60.0 * LINES["unbalance"], {"unbalance": LINES["unbalance"]})
    torque = [Record(f"torque {s:g} {k}", "input_torque", "N.m", f"{s:g}", k, 0.05 + 0.02 * rng.standard_normal(24), {"angle": np.linspace(0.0, 6.0, 24)}, {"speed": s, "load": 1.0})
              for s in SPEEDS[:-1] for k in range(5)]
    model = Braked([*model.records, *torque], model.shapes)
    model.candidates += (Candidate("drag", "drag", (Parameter("drag", "N.m", 0.0, 0.0, 5.0, 0.05, 1),), signals=("input_torque",)),)
    answer = diagnose(model)
    assert answer.verdict == "several effects" and {e.name for e in answer.effects} == {"unbalance", "drag"}


def test_what_one_condition_alone_determines_stays_within_its_range_without_it():
    """A pattern that hardly shows at the other speed: without this one its size is anything, but not beyond its bounds."""
    model = shaken(20.0 * LINES["unbalance"], {"unbalance": LINES["unbalance"]})
    records = [r for r in model.records if r.condition in ("100", "200")]
    alone = Parameter("alone", "N", 0.0, 0.0, 30.0, 1.0, 1)

    class Alone(Shaker):
        def predict(self, values, which=None):
            found = super().predict(values, which)
            indices = range(len(self.records)) if which is None else which
            return [y + values.get("alone", 0.0) / 10.0 * line(150.0) * (1.0 if self.records[i].condition == "200" else 1e-3) for i, y in zip(indices, found)]

    model = Alone(records, {"unbalance": LINES["unbalance"]})
    model.candidates += (Candidate("alone", "alone", (alone,)),)
    doctor = Diagnostician(model)
    doctor.prepare()
    doctor.screened()
    errors = leave_condition_out(doctor.space, doctor.fit(["unbalance", "alone"]).fit)
    # Both runs of 200 rad/s off by less than the whole range of the parameter.
    largest = 2.0 * (30.0 / 10.0 / 0.05) ** 2
    assert errors["200"] < 1.5 * (largest + 400.0)


def test_what_a_model_corrects_for_itself_is_found_anew_once_the_nuisances_are_known():
    """A correction that was found where a zero starts would stay there, and look like an effect."""

    class Ripple:
        """A wave about an unknown zero, with a ripple whose place the model finds for itself: from the zero that it believes in."""

        candidates = ()
        nuisances = (Parameter("zero", "rad", 0.0, -1.0, 1.0, 1e-2, 0, None),)
        angle = np.linspace(0.0, 2.0 * np.pi, 300, endpoint=False)

        def __init__(self):
            self.believed = 0.0
            random = np.random.default_rng(1)
            noisy = [self.at(0.05, 0.05) + 1e-3 * random.standard_normal(300) for _ in range(2)]
            self.records = [Record(f"te/{k}", "transmission_error", "rad", "a", k, y, {"angle": self.angle}, {}) for k, y in enumerate(noisy, 1)]

        def at(self, zero, believed):
            return np.cos(3.0 * (self.angle - zero)) + 0.02 * np.cos(40.0 * (self.angle - believed))

        def predict(self, values, which=None):
            return [self.at(values.get("zero", 0.0), self.believed) for _ in (range(2) if which is None else which)]

        def settle(self, values, which=None):
            self.believed = values.get("zero", 0.0)
            return True

        def stands_elsewhere(self, values):
            return values.get("zero", 0.0) != self.believed

    space = Workspace(Ripple())
    base = space.fit_base()
    assert base.values["zero"] == pytest.approx(0.05, abs=1e-3)
    assert base.chi2 < 1.3 * 600
