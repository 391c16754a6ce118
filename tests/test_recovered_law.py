"""A law that was recovered stands in the campaign's units, and a constant is none."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.campaign.model import Campaign
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.law.closed_forms import Form, propose
from discrepancy.inference.law.recover import recover, tells_nothing
from discrepancy.problem import Record
from discrepancy.scales import AXES
from discrepancy.verdict import told_in

RPM = np.pi / 30.0


class Model:
    """Predicts a torque of 2 N m, whatever the speed."""

    nuisances = candidates = ()

    def __init__(self, misfit):
        rng = np.random.default_rng(1)
        self.records = []
        for speed in np.linspace(200.0, 2000.0, 8):
            for load in (80.0, 160.0):
                for replicate in (1, 2):
                    factors = {"speed": speed * RPM, "load": load, "direction": 1.0}
                    value = 2.0 + misfit(speed, load) + 0.003 * rng.standard_normal()
                    name = f"{speed:.0f} rpm, {load:g} N m"
                    self.records.append(Record(f"{name} {replicate}", "input_torque", "N.m", name, replicate, np.array([value]), {}, factors))
        self.campaign = Campaign(None, "", "", None, 100.0, 160.0, {}, (), {}, {}, (), None, "", speed_at="output")

    def predict(self, values, which=None):
        return [np.full(1, 2.0) for _ in (range(len(self.records)) if which is None else which)]


def laws(misfit):
    model = Model(misfit)
    doctor = Diagnostician(model)
    doctor.prepare()
    return recover(doctor.space, doctor.space.base, None, told_in(model))


def test_constant_is_no_law():
    assert laws(lambda speed, load: 0.3) == []


def test_law_over_speed_has_the_speed_of_the_campaign():
    (law,) = laws(lambda speed, load: 0.3 * (speed / 2000.0) ** 2)
    assert law.leading == "speed" and "[rpm at the output]" in law.text and "[N.m" in law.text
    assert law.x_told[:2] == (pytest.approx(1.0 / RPM / 100.0), 0.0)
    # Points stay in SI, the form is over 2 to 20 rpm: the torque at 20 rpm is 0.3 N m more than at rest.
    assert max(law.points["x"]) == pytest.approx(2000.0 * RPM)
    form, factor = law.forms[0], 120.0 if law.factor == "load" else 1.0
    if form.name == "quadratic":
        assert factor * form.parameters["c"] == pytest.approx(0.3 / 400.0, rel=0.2)


def test_two_levels_make_no_form():
    (law,) = laws(lambda speed, load: 0.002 * load)
    assert law.leading == "load" and law.forms == [] and law.text.endswith("over load [N.m]: too few levels for a form")


def test_draft_and_page_take_the_law():
    from discrepancy.page import laws as page

    (law,) = laws(lambda speed, load: 0.3 * (speed / 2000.0) ** 2)
    assert page.figures(law, AXES["speed"]) and "SI unit" not in str(page.table(law)) and SimpleNamespace(**law.to_dict())


def test_rows_of_a_table_are_points_of_their_own():
    """Five torques over the speed in a run: not one mean torque, but a law."""
    model, rng = Model(lambda speed, load: 0.0), np.random.default_rng(2)
    speeds = np.array([200.0, 500.0, 1000.0, 1500.0, 2000.0])
    model.records = [
        Record(f"{load:g} {k}", "input_torque", "N.m", f"{load:g} N m", k, 2.0 + 0.3 * (speeds / 2000.0) ** 2 + 0.003 * rng.standard_normal(5),
               {"speed": speeds * RPM}, {"load": load, "direction": 1.0})
        for load in (80.0, 160.0) for k in (1, 2)
    ]  # fmt: skip
    model.predict = lambda values, which=None: [np.full(5, 2.0) for _ in (range(len(model.records)) if which is None else which)]
    doctor = Diagnostician(model)
    doctor.prepare()
    (law,) = recover(doctor.space, doctor.space.base, None, told_in(model))
    assert law.leading == "speed" and len(law.points["x"]) == 20 and sorted(set(law.points["x"])) == pytest.approx(speeds * RPM)
    assert law.forms[0].name in ("quadratic", "power", "exponential")


def test_factors_that_never_change_apart_are_one():
    """Two conditions that differ in load, speed and temperature: nothing is told between these, and the law over the hours is."""
    model, rng = Model(lambda speed, load: 0.0), np.random.default_rng(4)
    hours = np.array([100.0, 400.0, 1200.0, 3000.0]) * 3600.0
    share = 0.3 * hours / hours[-1]
    model.records = [
        Record(f"{load:g} {k}", "wear_depth", "m", f"{load:g}", k, 1e-6 * load * (hours / hours[-1]) * (1.0 + share + 0.003 * rng.standard_normal(4)),
               {"hours": hours}, {"load": load, "speed": load, "temperature": 300.0 + load, "direction": 1.0})
        for load in (1.0, 2.0) for k in (1, 2, 3)
    ]  # fmt: skip
    model.predict = lambda values, which=None: [1e-6 * model.records[i].factors["load"] * hours / hours[-1] for i in (range(6) if which is None else which)]
    doctor = Diagnostician(model)
    doctor.prepare()
    (law,) = recover(doctor.space, doctor.space.base, None, told_in(model))
    assert law.leading == "hours" and law.factor == "prediction" and law.forms[0].name == "linear"
    assert law.forms[0].parameters["b"] * 3000.0 == pytest.approx(0.3, rel=0.1) and all(c.share < 1.5 for c in law.curves)


def test_intervals_hold_whatever_the_unit_of_x():
    """y = a + b x + c x^2 over thousands of hours: the constant is known as well as over thousandths."""
    rng = np.random.default_rng(5)
    x = np.linspace(100.0, 6000.0, 12)
    y = -0.9 + 1.4e-3 * x - 3.7e-7 * x**2 + 0.05 * rng.standard_normal(12)
    widths = [np.ptp(next(f for f in propose(x * scale, y, np.full(12, 0.05)) if f.name == "quadratic").intervals["a"]) for scale in (1.0, 1e-3)]
    assert widths[0] == pytest.approx(widths[1], rel=1e-3) and widths[0] > 0.05


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("seed", range(5))
def test_forms_are_proposed_without_a_warning_where_their_constants_show_nothing(seed):
    """One point that stands out, or the last: a step beyond the data has a place that changes nothing."""
    random = np.random.default_rng(seed)
    for count in (6, 13, 60):
        x = np.sort(random.uniform(0.0, 6.0, count))
        for y in (np.eye(count)[0], np.eye(count)[count // 2], np.where(x > x[-2], 1e-6, 0.0)):
            assert all(np.isfinite([v for interval in form.intervals.values() for v in interval]).all() for form in propose(x, y, np.full(count, 1e-3)))


def test_a_share_that_may_be_none_is_no_law():
    """`share a = 2.515e-06 (-0.000102 to 0.000107)` was offered as the law without a name."""
    share = Form("constant", "y = a", {"a": 2.5e-6}, {"a": (-1.02e-4, 1.07e-4)}, 1.0, 1.0)
    assert tells_nothing([share], "prediction") and not tells_nothing([], "prediction")
    assert not tells_nothing([replace(share, intervals={"a": (2.6e-4, 1.3e-3)})], "prediction")
    assert tells_nothing([replace(share, intervals={"a": (2.6e-4, 1.3e-3)})], "none")
    assert not tells_nothing([replace(share, name="linear")], "prediction")
