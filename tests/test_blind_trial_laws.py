"""Laws of the blind trial against the effects that they hide: other computations of the same physics."""

import math
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from benchmarks.blind_trial.generator.designs import Series, there_and_back  # noqa: E402
from benchmarks.blind_trial.generator.laws.rig import SoftCoupling  # noqa: E402
from benchmarks.blind_trial.generator.laws.shared import ARCSEC  # noqa: E402
from benchmarks.blind_trial.generator.laws.supports import AskewRing, HangingWeight, SlippingSeat, SoftSeat  # noqa: E402
from benchmarks.blind_trial.generator.laws.wearing import MildWear  # noqa: E402
from benchmarks.blind_trial.generator.noise import Noise  # noqa: E402
from benchmarks.blind_trial.generator.reducer import FLOATING, HOUR, SOFT, WHOLE, Plain, Setting  # noqa: E402
from benchmarks.blind_trial.generator.truth import TE, Bench  # noqa: E402
from discrepancy.effects.torsional_resonance import filtered, transfer_of  # noqa: E402
from discrepancy.model_file import load_model  # noqa: E402
from discrepancy.prediction.bench import Bench as ToolBench  # noqa: E402
from discrepancy.prediction.curves import signal  # noqa: E402
from discrepancy.prediction.over_torque import OverTorque  # noqa: E402
from discrepancy.problem import Record  # noqa: E402

ANGLES = np.linspace(0.0, 2.0 * np.pi, 240, endpoint=False)
SPEED = 121 * 8 * math.pi / 30.0
LOADS = ((167.0, 1), (100.0, 1), (167.0, -1))


@pytest.fixture(scope="module")
def bench():
    return Bench({})


def law_of(kind, **numbers):
    law = kind(np.random.default_rng(0))
    law.__dict__.update(numbers)
    return law


def by_law(bench, law, load, direction):
    series = Series("transmission_error", "a", Setting(SPEED, load, 293.15, 0.0, direction), Noise(1e-6), {"angle": ANGLES})
    return bench.values(series, [law]) - bench.values(series, [])


def by_effect(bench, load, direction, **values):
    def set_all(p):
        for name, value in values.items():
            p[name] = value

    at = Setting(SPEED, load, 293.15, 0.0, direction)
    change = bench.plain.sweep(at, ANGLES, 0.3, set_all)[:, TE] - bench.plain.sweep(at, ANGLES, 0.3)[:, TE]
    return change - change.mean()


def left(found, expected):
    """What of ``expected`` is not found, in proportion."""
    return np.linalg.norm(found - expected) / np.linalg.norm(expected)


@pytest.mark.parametrize("load, direction", LOADS)
def test_ring_that_discs_see_off_centre(bench, load, direction):
    """Gaps by Camus' theorem against pins that are moved."""
    law = law_of(AskewRing, a=1e-6, phase=0.7, oval=0.0)
    effect = by_effect(bench, load, direction, disc_offset_x=1e-6 * math.cos(0.7), disc_offset_y=1e-6 * math.sin(0.7))
    assert left(effect, by_law(bench, law, load, direction)) < 0.02


@pytest.mark.parametrize("load, direction", LOADS)
def test_weight_that_tilts_the_carrier(bench, load, direction):
    rigidity, half, size = 1.3e6, 5e-3, 1.5
    law = law_of(HangingWeight, a=size, phase=0.7, rigidity=rigidity, half=half)
    # The law's bearings stiffen by 5 % at rated load.
    share = size * (1.0 - 0.05 * load / 167.0)
    effect = by_effect(bench, load, direction, tilting_compliance=1.0 / rigidity, disc_spacing=2.0 * half,
                       tilting_share_x=share * math.cos(0.7), tilting_share_y=share * math.sin(0.7))
    assert left(effect, by_law(bench, law, load, direction)) < 0.02


def test_soft_seat_is_a_softer_contact(bench):
    """Linear springs behind the contacts against contacts of another stiffness, with one size for all loads."""
    law = law_of(SoftSeat, a=3e-10, phase=0.7, fourth=0.0)
    cosine, sine = (np.concatenate([by_effect(bench, *at, **{f"ring_stiffness_{part}": 0.02}) for at in LOADS]) for part in ("cos", "sin"))
    expected = np.concatenate([by_law(bench, law, *at) for at in LOADS])
    size = np.linalg.lstsq(np.stack([cosine, sine], axis=1), expected, rcond=None)[0]
    assert left(size[0] * cosine + size[1] * sine, expected) < 0.06
    # Softer where the stiffness is less: the same direction, and about a c F/depth.
    assert math.atan2(-size[1], -size[0]) == pytest.approx(0.7, abs=0.05)


def test_stepped_flywheel_is_the_transfer_function():
    series = Series("transmission_error", "a", Setting(SPEED, 100.0), Noise(1e-6), {"angle": ANGLES})
    y = 1e-5 * (np.cos(40.0 * ANGLES + 0.3) + np.cos(78.0 * ANGLES) + 2.0 * np.cos(80.0 * ANGLES + 1.0))
    law = law_of(SoftCoupling, a=1.0, frequency=9.0, damping=0.05)
    expected = filtered(y, ANGLES, transfer_of(1.0, 9.0, 0.05, 0.5, SPEED / 121.0 / (2.0 * math.pi)))
    found = law.post(series, y, [series.setting])
    assert left(found, expected) < 0.005
    backwards = Series("transmission_error", "a", Setting(SPEED, 100.0, direction=-1), Noise(1e-6), {"angle": ANGLES})
    expected = filtered(y, ANGLES, transfer_of(1.0, 9.0, 0.05, 0.5, -SPEED / 121.0 / (2.0 * math.pi)))
    assert left(law.post(backwards, y, [backwards.setting]), expected) < 0.08


def test_seat_after_bouc_and_wen_with_power_one_is_dahls(bench):
    torque = np.concatenate([np.linspace(8.0, 160.0, 20), np.linspace(152.0, -160.0, 40), np.linspace(-152.0, 160.0, 40)])
    series = Series("hysteresis", "a", Setting(SPEED, 167.0), Noise(1e-6), {"torque": torque})
    law = law_of(SlippingSeat, a=1e-7, most=20.0, stuck=4.0, power=1.0)

    def set_seat(p):
        p["support_slip_compliance"], p["support_slip_torque"], p["support_stick_ratio"] = 1e-7, 20.0, 4.0

    at = series.setting
    effect = bench.plain.held(at, torque, set_seat) - bench.plain.held(at, torque)
    assert left(effect - effect.mean(), law.post(series, np.zeros(len(torque)), [at])) < 0.03


def test_mild_wear_spares_what_is_loaded_little(bench):
    at = Setting(209.4, 80.0)
    whole = bench.plain.live(at, [50.0 * HOUR])[0]
    law = law_of(MildWear, a=0.9, force=150.0)
    mild = bench.plain.live(at, [50.0 * HOUR], mild=law.mild())[0]
    flank = float(mild["flank_volume"][0] / whole["flank_volume"][0])
    race = float(mild["inner_race_volume"][0] / whole["inner_race_volume"][0])
    assert 0.1 < flank < 0.8 and race > flank


def test_a_soft_reducer_goes_from_torque_to_torque_in_short_steps():
    plain = Plain(cycle=WHOLE, name=SOFT)
    torques = there_and_back(200.0, 10)
    way, places = plain.way_of(torques)
    assert way[places] == pytest.approx(torques, rel=1e-12, abs=0)
    assert np.abs(way).min() >= 0.99 * FLOATING * plain.rated_load and abs(way[0]) < 1.1 * FLOATING * plain.rated_load
    across = np.sign(way[1:]) != np.sign(way[:-1])
    assert np.abs(np.diff(way))[~across].max() <= plain.torque_step * plain.rated_load * (1.0 + 1e-9)


def test_the_loop_of_a_soft_reducer_is_what_the_tool_predicts():
    """Two ways to one loop: 250 steps a quarter and 12 places of the cranks here, 80 and 16 there."""
    torques = there_and_back(200.0, 10)
    here = Plain(cycle=WHOLE, name=SOFT).held(Setting(200.0, 167.0), torques)
    record = Record("loop", "hysteresis", "rad", "cold", 1, here, axes={"torque": torques},
                    factors={"speed": 200.0, "load": 167.0, "temperature": 293.15}, tags={"locked": "input"})  # fmt: skip
    bench = ToolBench(load_model(SOFT).reducer, {})
    there = signal(OverTorque(bench, record), {})
    off = (here - here.mean()) - (there - there.mean())
    assert np.abs(off).max() < 0.15 * ARCSEC and np.ptp(here) > 400.0 * ARCSEC
