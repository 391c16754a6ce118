"""An encoder on the output lags under load: its angles are counted back by the model's lag, in either sense, under any load."""

import math

import numpy as np
import pytest

from discrepancy.campaign.load import load_campaign
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.joint import jointly
from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.conditions import LAG_SHARE, condition_of
from discrepancy.prediction.curves import signal
from discrepancy.prediction.fineness import Fineness
from discrepancy.prediction.over_angle import OverAngle
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from fmu_src.faults import InputFault

ARCSEC = math.pi / 648000.0
REDUCER, SPEED = "RV20E-121", 1452.0
CONDITIONS = (("forward", 60.0), ("forward", 160.0), ("reverse", 160.0))
RUN = """
[conditions.{name}]
input_speed = "{speed} rpm"
load_torque = "{load} N.m"
direction = "{direction}"
[[runs]]
id = "{name}"
quantity = "transmission_error"
condition = "{name}"
noise = "0.05 arcsec"
file = "{name}.csv"
columns.angle = {{ column = "angle", unit = "deg" }}
columns.value = {{ column = "error", unit = "arcsec" }}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Curves of the reducer's own over the angle of its output, as an encoder there shows it."""
    place = tmp_path_factory.mktemp("output_angle")
    bench = Bench(load_model(REDUCER).reducer, {})
    ideal = np.linspace(0.0, 2.0 * math.pi / 3.0, 480, endpoint=False)
    text = f'[campaign]\nname = "output"\nreducer = "{REDUCER}"\n'
    for direction, load in CONDITIONS:
        sense, name = (1 if direction == "forward" else -1), f"{direction}{load:.0f}"
        error = bench.column("transmission_error", Condition(SPEED * math.pi / 30.0, load, 293.15, 0.0, sense), {}, sense * ideal)
        rows = np.column_stack([np.degrees(sense * ideal + error), error / ARCSEC])
        np.savetxt(place / f"{name}.csv", rows, delimiter=",", header="angle,error", comments="", fmt="%.9f")
        text += RUN.format(name=name, speed=SPEED, load=load, direction=direction)
    (place / "campaign.toml").write_text(text)
    return place


def model_of(folder, more=""):
    path = folder / "campaign.toml"
    plain = path.read_text()
    path.write_text(plain + more)
    try:
        return PhysicalModel(load_model(REDUCER), load_campaign(folder))
    finally:
        path.write_text(plain)


def misfit(model, values):
    """Root mean square [arcsec] of what the model does not explain in any run."""
    return max(float(np.std(r.values - y)) for r, y in zip(model.records, model.predict(values))) / ARCSEC


OF_OUTPUT = '[quantities.transmission_error]\nangle_of = "output"\n'


def test_the_reducer_explains_its_own_curves_over_the_output(folder):
    model = model_of(folder, OF_OUTPUT)
    assert all(r.of_output for r in model.records) and [p.name for p in model.nuisances][-1:] == [LAG_SHARE]
    assert misfit(model, {}) < 0.02
    # Taken for angles of the input over the ratio, orders of the cranks are missed both ways.
    plain = model_of(folder)
    assert LAG_SHARE not in {p.name for p in plain.nuisances} and misfit(plain, {}) > 0.15


def test_share_of_the_lag_moves_the_places(folder):
    """Half the lag leaves half of the misfit, and its derivative is that of the curve along the angle."""
    model = model_of(folder, OF_OUTPUT)
    assert 0.3 < misfit(model, {LAG_SHARE: 0.5}) / misfit(model_of(folder), {}) < 0.7
    which = range(len(model.records))
    beside = model.predict_beside({LAG_SHARE: 1.05}, {LAG_SHARE: 1.0}, which)
    base = model.predict_beside({LAG_SHARE: 1.0}, {LAG_SHARE: 1.0}, which)
    for a, b, c, d in zip(beside, base, model.predict({LAG_SHARE: 1.05}), model.predict({LAG_SHARE: 1.0})):
        assert np.std((a - b) - (c - d)) < 0.1 * np.std(c - d)


def test_one_load_leaves_the_lag_where_it_is(folder):
    """It tells lag and zero of the angles together: they went anywhere, and inputs locked at places that count from there with them."""
    anywhere = '[nuisances.encoder_phase]\nunit = "deg"\nlower = -180\nupper = 180\nper = "mounting"\n'
    space = Workspace(model_of(folder, OF_OUTPUT + anywhere))
    space.training = [1]
    space.fit_base()
    record, base = space.records[1], space.base.values
    further = 4.0 * space.model.bench.lag(condition_of(space.model.bench, record))
    fit = jointly(space, space.base.parameters, {**base, LAG_SHARE: base[LAG_SHARE] + 4.0, "angle_zero[1]": base["angle_zero[1]"] + further}, ())
    assert base[LAG_SHARE] == pytest.approx(1.0, abs=0.3) and fit.values[LAG_SHARE] == pytest.approx(1.0, abs=0.3)


def test_an_angle_of_the_input_that_is_stated_as_the_output_s_has_no_lag(folder):
    model = model_of(folder, OF_OUTPUT)
    for record in model.records:
        # Over the input's angle: the output's less the error.
        record.axes["angle"][:] -= record.values
    assert misfit(model, {LAG_SHARE: 0.0}) < 0.02 < 0.15 < misfit(model, {LAG_SHARE: 1.0})


def test_a_run_without_an_angle_has_none_to_state(folder, tmp_path):
    text = '[campaign]\nname = "x"\nreducer = "RV20E-121"\n[conditions.a]\n[[runs]]\nid = "a"\nquantity = "lost_motion"\ncondition = "a"\nvalue = "1 arcmin"\nangle_of = "output"\n'
    (tmp_path / "campaign.toml").write_text(text)
    with pytest.raises(InputFault, match=r"runs\[1\] \(a\)\.angle_of = 'output': lost_motion of this run has no angle; leave it out"):
        load_campaign(tmp_path)


def test_an_encoder_on_the_output_turns_with_the_error_itself():
    """A sample is the error at the input's angle: an order that is high bends its own curve, and shows at twice itself."""
    file, ideal = load_model(REDUCER), np.linspace(0.0, 2.0 * math.pi, 1800, endpoint=False)
    lobe, condition = {"lobe_throw_error_1": 2e-5}, Condition(SPEED * math.pi / 30.0, 60.0)
    bench = Bench(file.reducer, {})
    error = bench.column("transmission_error", condition, lobe, ideal)
    lag = float(error.mean())
    factors = {"speed": condition.speed, "load": 60.0, "temperature": condition.temperature, "direction": 1.0}

    def left(of_output):
        # Angles are counted from where the output stands on average.
        angle = ideal + (error - lag) * of_output
        record = Record("r", "transmission_error", "rad", "a", 1, error, {"angle": angle}, factors, of_output=of_output)
        values = {**lobe, LAG_SHARE: 0.0}
        return float(np.std(signal(OverAngle(bench, record, "transmission_error"), values) - error)) / ARCSEC

    bench.fineness = Fineness([Record("r", "transmission_error", "rad", "a", 1, error, {"angle": ideal}, factors, stated_noise=1e-9)])
    assert left(False) < 1e-6
    straight = float(np.std(np.gradient(error, ideal) * (error - lag))) / ARCSEC
    # What is left are kinks, where a contact comes or goes.
    assert straight > 0.05 and left(True) < 0.15 * straight
