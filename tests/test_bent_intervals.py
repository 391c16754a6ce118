"""Intervals of two numbers that do nearly the same end where their valley ends, whatever its form, and a fit goes on to a lower place in it."""

from dataclasses import dataclass

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar

from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.refit.in_earnest import in_earnest
from discrepancy.inference.refit.joint import jointly
from discrepancy.inference.refit.profile import profiles
from discrepancy.inference.refit.reach import HALF, reach
from discrepancy.inference.refit.refit import estimates, finished
from discrepancy.problem import Candidate, Parameter, Record

COUNT = 400
ANGLE = np.linspace(0.0, 2.0 * np.pi, COUNT, endpoint=False)
# What the sum of the two numbers does, and what little their difference does [noise].
SUM, DIFFERENCE = 20.0 * np.cos(3.0 * ANGLE), np.cos(5.0 * ANGLE)
TWO = Candidate("two", "", (Parameter("a", "m", 0.0, -40.0, 40.0, 1.0), Parameter("b", "m", 0.0, -40.0, 40.0, 1.0)))


def bent(at):
    """One contact bears less where the other does."""
    return np.where(at < 0.0, at, 0.25 * at)


def humped(at):
    """Between two places where much is explained lies one where less is."""
    return np.interp(at, [-30.0, 0.0, 1.0, 2.0, 10.0], [-30.0, 0.0, 0.8, 0.7, 1.5])


def straight(at):
    return at


@dataclass
class Pair:
    """Two repeated runs whose noise cancels, so that the fit that is best is the truth."""

    form: object
    there: float
    nuisances: tuple = ()
    candidates: tuple = (TWO,)

    def __post_init__(self):
        noise = np.random.default_rng(4).standard_normal(COUNT)
        self.records = [Record(str(k), "te", "rad", "1", k, self.there * DIFFERENCE + sign * noise, {"angle": ANGLE}, {}) for k, sign in ((1, 1.0), (2, -1.0))]

    def predict(self, values, which=None):
        a, b = values.get("a", 0.0), values.get("b", 0.0)
        y = (a + b) * SUM + self.form(0.5 * (a - b)) * DIFFERENCE
        return [y for _ in (range(2) if which is None else which)]


def fitted(form, there, start):
    """A diagnosis and the fit as it is reported, from that difference of the two."""
    doctor = Diagnostician(Pair(form, there))
    doctor.prepare()
    fit = jointly(doctor.space, TWO.amplitudes, {"a": start, "b": -start}, ("two",))
    return doctor, finished(doctor.space, [TWO], *in_earnest(doctor.space, fit, [TWO]))


def end_of(doctor, result, name, sense):
    """Where the chi-square has risen by what an interval allows with the other at its best, looked for by brute force."""
    other, fit = "ba"["ab".index(name)], result.fit

    def rise(value):
        def chi2(beside):
            return float(np.sum(doctor.space.residual({name: value, other: beside}) ** 2))

        return minimize_scalar(chi2, bounds=(-value - 0.3, -value + 0.3), method="bounded", options={"xatol": 1e-7}).fun - fit.chi2 - HALF**2

    return brentq(rise, fit.values[name], fit.values[name] + sense * 10.0)


@pytest.mark.parametrize("there", [0.0, -0.05, 0.05])
def test_each_side_of_an_interval_ends_where_the_chi_square_says(there):
    doctor, result = fitted(bent, there, 4.0 * max(there, 0.0) + min(there, 0.0))
    named = doctor.refits.reaching(result)
    plain = {e.name: e for e in estimates(doctor.space, result)}
    for e in estimates(doctor.space, named):
        half = 0.5 * (plain[e.name].interval[1] - plain[e.name].interval[0])
        # Few repetitions widen the whole alike.
        factor = half / (HALF * e.deviation)
        for end, sense in zip(e.interval, (-1.0, 1.0)):
            assert (end - e.value) / factor == pytest.approx(end_of(doctor, result, e.name, sense) - e.value, rel=0.06)
        low, high = e.value - e.interval[0], e.interval[1] - e.value
        # It was the same to both sides.
        assert high > 1.4 * low if e.name == "a" else low > 1.4 * high
    shown = {p.name: p for p in profiles(doctor.space, named)}
    assert all(shown[e.name].values[0] < e.interval[0] < e.interval[1] < shown[e.name].values[-1] for e in estimates(doctor.space, named))


def test_straight_ones_keep_the_interval_that_they_had():
    doctor, result = fitted(straight, 0.3, 0.3)
    before, after = ({e.name: e.interval for e in estimates(doctor.space, r)} for r in (result, doctor.refits.reaching(result)))
    assert all(after[name] == pytest.approx(before[name], rel=1e-3) for name in ("a", "b"))


def test_a_lower_place_beyond_a_hump_is_where_the_fit_goes_on():
    """The interval of the place where a descent ended held nothing of the truth."""
    doctor, result = fitted(humped, 1.2, 1.0)
    assert result.fit.values["a"] == pytest.approx(1.0, abs=0.1)
    before = next(e.interval for e in estimates(doctor.space, result) if e.name == "a")
    named = doctor.refits.reaching(result)
    interval = next(e.interval for e in estimates(doctor.space, named) if e.name == "a")
    assert named.fit.values["a"] == pytest.approx(7.0, abs=0.2) and named.fit.chi2 < result.fit.chi2 - 5.0
    assert not before[0] < 7.0 < before[1] and interval[0] < 7.0 < interval[1]
    # Asked again, the same is told, and nothing is walked.
    calls = doctor.space.predictions.calls
    assert doctor.refits.final(["two"]) is named and doctor.refits.reaching(named) is named and doctor.space.predictions.calls == calls


def test_amplitudes_that_do_different_things_are_not_walked():
    doctor = Diagnostician(Pair(straight, 0.3))
    doctor.prepare()
    alone = Candidate("one", "", TWO.amplitudes[:1])
    fit = jointly(doctor.space, alone.amplitudes, {"a": 0.0}, ("one",))
    calls = doctor.space.predictions.calls
    assert reach(doctor.space, finished(doctor.space, [alone], fit)).stretch == {} and doctor.space.predictions.calls <= calls + 2
