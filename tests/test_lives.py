"""Lives on the bench: each lived once, rougher ones beside finer ones, and what a worn or new reducer shows of them."""

import numpy as np
import pytest

from discrepancy.model_file import load_model
from discrepancy.prediction import lives, model_error
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.candidates import candidates
from discrepancy.prediction.conditions import at_rest
from discrepancy.prediction.lives import ROUGH_CYCLE, SHORT_CYCLE
from discrepancy.prediction.observe import OBSERVED, surface_of
from discrepancy.prediction.standard_test import WAY
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from studies.hysteresis import LOST_MOTION_SHARE
from studies.meshing_cycle import HOUR
from studies.wear_figures import peak_of_circle

RATED = Condition(209.44, 167.0)
HOURS = [100.0 * HOUR, 400.0 * HOUR]
TIRED = {"wear_growth": 1.0}


@pytest.fixture
def bench():
    return Bench(load_model("RV20E-121-rigid").reducer, {})


def record(quantity, values=(0.0,), condition="1", hours=HOURS, surface="flank", **more):
    axes = {"hours": np.array(hours)} if hours else {}
    return Record(f"{quantity} {condition}", quantity, "m", condition, 1, np.array(values, float), axes,
                  {"speed": RATED.speed, "load": RATED.load}, tags={"surface": surface} if surface else {}, **more)


def depth(bench, values, hours, turns, surface="flank"):
    wear = bench.life(RATED, values, {hours}, turns)[hours]
    return peak_of_circle(surface_of(wear, {"surface": surface})[None])[0]


def test_a_life_is_lived_once_for_all_its_hours(bench, monkeypatch):
    lived = []
    real = lives.coupled.run_pair_beside
    monkeypatch.setattr(lives.coupled, "run_pair_beside", lambda *given: lived.append(given) or real(*given))
    bench.plan(Condition(RATED.speed, RATED.load, hours=h) for h in HOURS)
    later = depth(bench, TIRED, HOURS[1], SHORT_CYCLE)
    steps = len(lived)
    assert 0.0 < depth(bench, TIRED, HOURS[0], SHORT_CYCLE) < later
    assert len(lived) == steps


@pytest.mark.parametrize("turns, off", [(SHORT_CYCLE, 0.04), (ROUGH_CYCLE, 0.08)])
@pytest.mark.parametrize("surface", ["flank", "inner_race"])
def test_short_cycles_change_as_full_ones_do(bench, turns, off, surface):
    """By a law of wear and in proportion: full meshing cycles are forty turns of the cranks."""
    def growth(turns):
        return depth(bench, TIRED, HOURS[1], turns, surface) / depth(bench, {}, HOURS[1], turns, surface) - 1.0

    assert growth(turns) == pytest.approx(growth(bench.reducer.topology.lobes), rel=off)


@pytest.mark.parametrize("turns", [SHORT_CYCLE, ROUGH_CYCLE])
def test_the_print_of_a_standing_pin_is_that_of_full_cycles(bench, turns):
    def standing(turns):
        new = bench.wear_to(RATED, {}, HOURS[1:], turns)[HOURS[1]], bench.wear_to(RATED, {"pin_standing_share": 0.03}, HOURS[1:], turns)[HOURS[1]]
        before, after = (surface_of(w, {"surface": "pin"}) for w in new)
        return after - before

    full = standing(bench.reducer.topology.lobes)
    assert np.linalg.norm(standing(turns) - full) < 0.05 * np.linalg.norm(full)


@pytest.mark.parametrize("hours", [0.0, HOURS[0]])
def test_lost_motion_without_friction_is_that_of_the_whole_loop(bench, hours):
    values = {"needle_clearance_added": 1e-6}
    at = Condition(bench.rated_speed, bench.rated_load, hours=hours)
    torques = bench.rated_load * WAY
    turning = bench.held(at_rest(bench, at), values, torques)
    middle = [np.mean(turning[np.isclose(torques, side * LOST_MOTION_SHARE * bench.rated_load)]) for side in (1.0, -1.0)]
    found = OBSERVED["lost_motion"](bench, record("lost_motion", hours=[hours], surface=""), values)[0]
    # Worn surfaces are looked at where the first torque has brought the cranks.
    assert found == pytest.approx(middle[0] - middle[1], rel=2e-5)


def test_a_seat_that_slips_remembers(bench):
    assert bench.remembers({"support_slip_compliance": 1e-7}) and bench.remembers({"friction_coefficient": 0.01})
    assert not bench.remembers({"needle_clearance_added": 1e-6})


def of_grease(quantities):
    found = candidates([record(q) for q in quantities], {}, set(), [])
    return next(([p.name for p in c.amplitudes], [p.name for p in c.shapes]) for c in found if c.name == "grease_ageing")


def test_of_ageing_grease_only_what_shows_is_fitted():
    """In wear its life has a place to be seen from, in torques it goes with the viscosity's change."""
    assert of_grease(["wear_depth"]) == (["grease_starvation"], ["grease_life"])
    assert of_grease(["input_torque"]) == (["grease_ageing"], [])
    assert of_grease(["input_torque", "wear_depth"]) == (["grease_ageing", "grease_starvation"], ["grease_life"])


def test_conditions_have_errors_of_their_own_where_there_are_several():
    runs = [record("wear_depth", (1.0, 2.0), c) for c in ("1", "2")]
    assert len(model_error.parameters(runs)) == 3 and len(model_error.parameters(runs[:1])) == 1
    values = {model_error.apart_name(runs[1]): 0.01, "model_error[wear_depth:flank]": 0.02}
    assert model_error.with_error(np.ones(2), runs[0], values) == pytest.approx(1.02)
    assert model_error.with_error(np.ones(2), runs[1], values) == pytest.approx(1.03)
