"""Wear that grows with its own depth, beside a wear coefficient and errors of the base model: these go far from where the base fit had them."""

from dataclasses import dataclass

import numpy as np
import pytest

from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.refit.frozen import Frozen
from discrepancy.problem import Candidate, Parameter, Record

HOURS = np.linspace(0.25, 10.0, 24)
LOADS = (0.6, 1.0, 1.6)
RATE = Parameter("rate", "1", 1.0, 0.02, 50.0, 1.0, 0, 1.0)
ERRORS = tuple(Parameter(f"error_{load:g}", "1", 0.0, -0.2, 0.2, 0.01, 0, 0.01) for load in LOADS)
SOFT = Candidate("soft", "soft", (Parameter("softness", "1", 0.0, -2.0, 0.95, 0.3),), (Parameter("case", "1", 8.0, 0.04, 2000.0, 8.0),),
                 ({"case": 0.8}, {"case": 4.0}, {"case": 20.0}))


def grown(rate, factor, steps=12):
    """Depth (24,) over the hours; ``factor`` of the rate by depth."""
    depth, found = 0.0, []
    for hours in np.diff(HOURS, prepend=0.0):
        for _ in range(steps):
            depth += rate * factor(depth) * hours / steps
        found.append(depth)
    return np.array(found)


@dataclass
class Wearing:
    """Depths at three loads."""

    records: list
    nuisances: tuple = (RATE, *ERRORS)
    candidates: tuple = (SOFT,)

    def predict(self, values, which=None):
        b, case = values.get("softness", 0.0), values.get("case", 8.0)

        def one(r):
            load = r.factors["load"]
            wear = grown(values.get("rate", 1.0) * load, lambda z: 1.0 / (1.0 - b * (1.0 - np.exp(-((z / case) ** 2)))))
            return wear * (1.0 + values.get(f"error_{load:g}", 0.0))

        return [one(self.records[i]) for i in (range(len(self.records)) if which is None else which)]


def worn(softness, depth, noise):
    """Three runs at each load, of a hardness that falls in proportion to the depth."""
    rng = np.random.default_rng(1)
    return Wearing([
        Record(f"{load:g} {k}", "wear_depth", "um", f"{load:g}", k,
               grown(load, lambda z: 1.0 / (1.0 - softness * min(1.0, z / depth))) + noise * rng.standard_normal(HOURS.size),
               {"hours": HOURS}, {"load": load})
        for load in LOADS for k in range(3)
    ])  # fmt: skip


@pytest.mark.parametrize(("softness", "depth", "noise"), [(0.8, 10.0, 1.5), (0.9, 20.0, 2.0), (0.7, 12.0, 0.5)])
def test_wear_that_feeds_on_itself_is_found_from_where_it_does_not_run_away(softness, depth, noise):
    """A slope at the base model puts it where the last layer is nearly without hardness: the rate that goes with that is nowhere near."""
    doctor = Diagnostician(worn(softness, depth, noise))
    doctor.prepare()
    doctor.screened()
    found = doctor.fit(["soft"]).fit
    samples = len(found.residual)
    assert doctor.space.base.chi2 > 10.0 * samples and found.chi2 < 1.2 * samples
    assert np.isclose(found.values["softness"], softness, atol=0.1)


def test_what_nuisances_may_bring_beside_wear_that_feeds_on_itself_is_not_given_up():
    """With frozen sensitivities a fit stood at 134 where 81 was to be had, and what it had to reach was 90; grease that ages stood at 176 below the base
    fit where 292 was to be had, and was told to fit worse by 104."""
    doctor = Diagnostician(worn(0.5, 6.0, 1.0))
    doctor.prepare()
    frozen = Frozen(doctor.space, [SOFT], 0.0)
    base = doctor.space.base.chi2
    frozen.least = base - 1.7 * (base - 0.3 * base)
    flat = np.eye(2), np.zeros(2)
    assert not frozen.hopeless(0.3 * base, *flat)
    frozen.least = base - 2.1 * (base - 0.3 * base)
    assert frozen.hopeless(0.3 * base, *flat)
