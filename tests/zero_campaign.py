"""A campaign of a reducer with discs off centre whose encoder was set to 0 elsewhere than where the model's angle is."""

import math

import numpy as np

from discrepancy.held_names import LOCKED_AT
from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.observe import OBSERVED
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record

ARCSEC, REDUCER, RATIO = math.pi / 648000.0, "RV20E-121", 121.0
NAME, HIDDEN = "disc_tooth_errors.runout", {"disc_runout": 6e-6, "disc_runout_angle": 0.4}
# Where the encoder's 0 is [rad of the output].
ZERO, TURNED = "angle_zero[1]", 0.01
CONDITION = """
[conditions.at_{load}]
input_speed = "1500 rpm"
load_torque = "{load} N.m"
"""
REPETITION = """
[[runs]]
id = "at_{load}_{k}"
quantity = "transmission_error"
condition = "at_{load}"
replicate = {k}
file = "{load}_{k}.csv"
columns.angle = {{ column = "angle", unit = "deg" }}
columns.value = {{ column = "error", unit = "arcsec" }}
"""
LOOP = """
[conditions.held]
locked_at = "0 deg"

[[runs]]
id = "loop"
quantity = "hysteresis"
tags.locked = "input"
condition = "held"
file = "loop.csv"
columns.torque = { column = "torque", unit = "N.m" }
columns.value = { column = "turning", unit = "arcsec" }
"""


def written(place, hidden=HIDDEN, loop=False):
    """The campaign's folder: transmission errors at two loads, and a loop whose place counts from the encoder's 0."""
    bench, rng = Bench(load_model(REDUCER).reducer, {}), np.random.default_rng(3)
    angle = np.linspace(0.0, 2.0 * math.pi / 3.0, 360, endpoint=False)
    text = f'[campaign]\nname = "zeros"\nreducer = "{REDUCER}"\n[quantities.transmission_error]\nangle_of = "input"\n'
    text += '[nuisances.encoder_phase]\nunit = "deg"\nlower = -180\nupper = 180\nper = "mounting"\n'
    for load in (60, 160):
        error = bench.column("transmission_error", Condition(1500.0 * math.pi / 30.0, float(load)), hidden, angle + TURNED)
        text += CONDITION.format(load=load)
        for k in (1, 2):
            saved(place / f"{load}_{k}.csv", "angle,error", np.degrees(angle), error / ARCSEC + rng.normal(0.0, 0.05, len(angle)))
            text += REPETITION.format(load=load, k=k)
    if loop:
        torque = np.concatenate([np.arange(-150.0, 150.0, 12.5), np.arange(150.0, -151.0, -12.5)])
        held = Record("loop", "hysteresis", "rad", "held", 1, np.zeros(len(torque)), {"torque": torque}, {LOCKED_AT: TURNED * RATIO}, tags={"locked": "input"})
        turning = OBSERVED["hysteresis"](bench, held, hidden)
        saved(place / "loop.csv", "torque,turning", torque, turning / ARCSEC + rng.normal(0.0, 0.5, len(torque)))
        text += LOOP
    (place / "campaign.toml").write_text(text)
    return place


def saved(path, header, *columns):
    np.savetxt(path, np.column_stack(columns), delimiter=",", header=header, comments="", fmt="%.6f")
