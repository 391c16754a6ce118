"""Torsional resonance of the rig: orders of the transmission error over their frequency, whatever way they are sampled."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from discrepancy.campaign.load import load_campaign
from discrepancy.catalogue.examples import Case
from discrepancy.catalogue.signature import amplitudes, changed, conditions, new_bench, turn
from discrepancy.effects.torsional_resonance import EFFECT, change, transfer_of
from discrepancy.model_file import load_model
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record

ORDERS = {1: (3.0, 0.3), 40: (1.0, 0.7), 78: (0.6, -1.1), 80: (2.0, 2.0), 121: (0.2, 0.4)}
# Output 0.25 turns a second, so that order 80 is at 20 Hz.
SPEED = 0.5 * math.pi
VALUES = {"resonance_share": 1.0, "resonance_frequency": 22.0, "resonance_damping": 0.06, "resonance_grounded": 0.0}


def waves(angle, transfer=None):
    """A mean and some orders, each as the transfer function leaves it."""
    factor = {k: 1.0 if transfer is None else transfer(np.array([float(k)]))[0] for k in ORDERS}
    return 0.5 + sum((factor[k] * a * np.exp(1j * (k * angle + p))).real for k, (a, p) in ORDERS.items())


def shown(angle, values=None, axis="angle", quantity="transmission_error", direction=1.0, speed=SPEED, **parameters):
    series = waves(angle) if values is None else values
    axes = {"angle": angle} if axis == "angle" else {"time": angle / (direction * speed)}
    record = Record("", quantity, "", "", 1, series, axes, {"direction": direction})
    at = {"output_speed": speed, **VALUES, **parameters}
    return change(series, record, at.__getitem__, 1.0)


def expected(angle, direction=1.0, speed=SPEED, **parameters):
    v = {**VALUES, **parameters}
    turns = direction * speed / (2.0 * math.pi)
    return waves(angle, transfer_of(v["resonance_share"], v["resonance_frequency"], v["resonance_damping"], v["resonance_grounded"], turns))


CAMPAIGN = """
[campaign]
name = "two speeds"
reducer = "RV20E-121-rigid"
""" + "".join(f"""
[conditions.{name}]
input_speed = "{rpm} rpm"
load_torque = "167 N.m"
temperature = "20 degC"

[[runs]]
id = "{name}"
quantity = "transmission_error"
condition = "{name}"
file = "{name}.csv"
noise = "1 arcsec"
columns.value = {{ column = "te", unit = "arcsec" }}
columns.angle = {{ column = "angle", unit = "deg" }}
""" for name, rpm in (("slow", 600), ("fast", 2000)))
EVEN = np.linspace(0.0, 2.0 * np.pi, 450, endpoint=False)


@pytest.mark.parametrize("share", [0.3, 1.0])
@pytest.mark.parametrize("angle", [EVEN, EVEN + 0.4, np.linspace(0.0, 6.0 * np.pi, 1350, endpoint=False)], ids=["a turn", "from elsewhere", "three turns"])
def test_whole_turns_are_exact(angle, share):
    assert shown(angle, resonance_share=share) == pytest.approx(expected(angle, resonance_share=share), abs=1e-9)


def test_uneven_samples_are_as_good():
    random = np.random.default_rng(1)
    angle = EVEN + random.uniform(-0.35, 0.35, len(EVEN)) * EVEN[1]
    assert shown(angle) == pytest.approx(expected(angle), abs=1e-3)
    mixed = random.permutation(len(angle))
    assert shown(angle[mixed]) == pytest.approx(expected(angle[mixed]), abs=1e-3)


def test_dense_uneven_samples():
    random = np.random.default_rng(1)
    angle = np.sort(random.uniform(0.0, 2.0 * np.pi, 9000))
    # Gaps of a tenth of order 80's wave come by chance.
    assert shown(angle) == pytest.approx(expected(angle), abs=0.02)


def test_less_than_a_turn_is_right_once_its_beginning_has_rung_off():
    """Nobody knows what came before the first sample: what that leaves dies with the resonance, at order 88 here."""
    angle = EVEN[:300]
    error = np.abs(shown(angle) - expected(angle))
    assert np.all(error[:-30] < 12.0 * np.exp(-VALUES["resonance_damping"] * 88.0 * angle[:-30]) + 1e-3)


def test_series_over_time_is_the_one_over_angle():
    assert shown(EVEN, axis="time") == pytest.approx(shown(EVEN), abs=1e-9)
    back = -EVEN
    assert shown(back, axis="time", direction=-1.0) == pytest.approx(expected(back, -1.0), abs=1e-9)


@pytest.mark.parametrize("grounded", [0.0, 0.6, 1.0])
def test_load_on_its_spring_moves_as_the_equation_of_motion_says(grounded):
    """J y'' + d (y' - (1 - s) x') + k (y - x) = 0, integrated until it has settled."""
    frequency, damping = 2.0 * math.pi * VALUES["resonance_frequency"], VALUES["resonance_damping"]

    def motion(t, state):
        x, rate = waves(SPEED * t), (waves(SPEED * (t + 1e-6)) - waves(SPEED * (t - 1e-6))) / 2e-6
        return [state[1], -frequency**2 * (state[0] - x) - 2.0 * damping * frequency * (state[1] - (1.0 - grounded) * rate)]

    # Settled after 1.5 s: exp(-0.06 138 1.5) = 4e-6; what repeats then is compared.
    settled = 1.5
    time = settled + np.linspace(0.0, 0.3, 40)
    found = solve_ivp(motion, (0.0, time[-1]), [0.5, 0.0], t_eval=time, rtol=1e-8, atol=1e-9).y[0]
    assert expected(SPEED * time, resonance_grounded=grounded) == pytest.approx(found, abs=2e-4)


def test_speed_says_which_order_is_lifted():
    """The order whose frequency is that of the resonance, up to 1/(2 z) times; those far above are gone."""
    bench, case = new_bench(), Case("", {"resonance_share": 1.0, "resonance_frequency": 22.0, "resonance_damping": 0.05})
    lifted = {}
    for c in ("rated", "speed 20 %", "speed 200 %"):
        at = conditions(bench)[c]
        series = turn(bench, at, {})
        with_it, without = (amplitudes(s) for s in (changed(bench, "torsional_resonance", case, "transmission_error", at, series), series))
        lifted[c] = with_it[80] / without[80]
        r = 80 * at.speed / abs(bench.ratio) / (2.0 * math.pi) / 22.0
        assert lifted[c] == pytest.approx(math.hypot(1.0, 0.1 * r) / math.hypot(1.0 - r * r, 0.1 * r), rel=1e-6)
    assert lifted["rated"] == pytest.approx(10.0, rel=0.02) and lifted["speed 20 %"] < 1.06 and lifted["speed 200 %"] < 0.4


def test_it_touches_the_transmission_error_alone():
    series = np.sin(40.0 * EVEN)
    assert np.array_equal(shown(EVEN, series, quantity="input_torque"), series)
    assert np.array_equal(shown(EVEN, series, resonance_share=0.0), series)
    assert np.array_equal(shown(EVEN[:2], series[:2]), series[:2])
    assert {p.kind for p in EFFECT.parameters} == {"amplitude", "shape"}


def test_model_of_a_campaign_looks_for_it_at_several_frequencies(tmp_path):
    """As a candidate with its grid; the model knows the speed of each run."""
    (tmp_path / "campaign.toml").write_text(CAMPAIGN, encoding="utf-8")
    rows = "\n".join(f"{math.degrees(a):.6f},{0.0:.4f}" for a in EVEN)
    for name in ("slow", "fast"):
        (tmp_path / f"{name}.csv").write_text("angle,te\n" + rows + "\n", encoding="utf-8")
    model = PhysicalModel(load_model("RV20E-121-rigid"), load_campaign(tmp_path))
    candidate = next(c for c in model.candidates if c.name == "torsional_resonance")
    assert [p.name for p in candidate.parameters] == ["resonance_share", "resonance_frequency", "resonance_damping", "resonance_grounded"]
    assert len(candidate.shape_grid) == 8 and set(candidate.shape_grid[0]) == {"resonance_frequency", "resonance_damping", "resonance_grounded"}
    plain, found = (model.predict(v) for v in ({}, {"resonance_share": 1.0, "resonance_frequency": 14.0}))
    for record, a, b in zip(model.records, plain, found):
        r = 80 * record.factors["speed"] / 121.0 / (2.0 * math.pi) / 14.0
        lift = math.hypot(1.0, 0.1 * r) / math.hypot(1.0 - r * r, 0.1 * r)
        # The rollers' ripple is a correction of its own, which comes last.
        ripple = model.cages.ripple(record, {})
        assert amplitudes(b - ripple)[80] == pytest.approx(lift * amplitudes(a - ripple)[80], rel=1e-6)
