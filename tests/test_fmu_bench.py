"""The bench with the FMUs on it says what the bench with their kernels says, up to a whole diagnosis."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from test_loop import CLEARANCE, campaign_of

from discrepancy.model_file import ModelFile, load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.fmu_bench import FmuBench
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.units import KEPT_RUNS, Condition
from discrepancy.verdict import diagnose
from fmu_src.faults import InputFault, RunFault
from fmu_src.threads import Once
from orchestrator.fmu import Fmu
from studies.coupled import COLUMNS
from studies.meshing_cycle import HOUR

ARCSEC = np.pi / 180.0 / 3600.0
SHORT = Condition(209.0, 167.0)
WORN = Condition(209.0, 110.0, 300.0, 300.0 * HOUR, -1)
VALUES = {CLEARANCE: 0.6e-6, "friction_coefficient": 0.02}
FEW = {"needle_clearance", "pin_position_errors.scatter", "drag"}


@pytest.fixture(scope="module")
def model():
    return load_model("RV20E-121-rigid")


@pytest.fixture(scope="module", params=["editable", "fmi2", "fmi3"])
def benches(model, request):
    """Kernels in process with the surfaces of the FMUs, and the FMUs."""
    if request.param == "editable":
        folder = request.getfixturevalue("fmus")
    else:
        folder = request.getfixturevalue("native_fmus") / request.param
    return Bench(model.reducer, {}, model.reducer.resolution), FmuBench(model, {}, folder)


@pytest.mark.parametrize("condition", [SHORT, WORN])
@pytest.mark.parametrize("first", [0.0, 0.02, 3.5])
def test_running_bench_shows_the_same(benches, condition, first):
    angles = condition.direction * np.linspace(0.0, 0.5, 40) + first
    here, there = (dict(zip(COLUMNS, bench.running(condition, VALUES, angles).T)) for bench in benches)
    assert np.ptp(here["transmission_error"]) > 0.01 * ARCSEC
    for name in ("transmission_error", "output_angle"):
        assert np.abs(there[name] - here[name]).max() < 1e-5 * ARCSEC
    for name in ("drive_torque", "power_loss", "reducer_temperature", "cage_speed"):
        assert there[name] == pytest.approx(here[name], rel=1e-6)
    # Forces that cancel but for the discs' differences: in N, of some kN.
    for name in ("housing_force_x", "housing_force_y"):
        assert there[name] == pytest.approx(here[name], abs=1e-3)


@pytest.mark.parametrize("condition", [SHORT, WORN, replace(SHORT, locked_at=0.03), replace(WORN, locked_at=-3.5)])
def test_held_output_turns_the_same(benches, condition):
    torques = np.array([5.0, 100.0, 5.0, -5.0, -100.0, -5.0, 5.0])
    here, there = (bench.held(condition, VALUES, torques) for bench in benches)
    assert np.abs(there - here).max() < 1e-5 * ARCSEC < np.ptp(here)


def test_wear_is_the_same_on_every_surface(benches):
    hours = [100.0 * HOUR, 400.0 * HOUR]
    here, there = (bench.wear_to(SHORT, VALUES, hours, 3) for bench in benches)
    for h in hours:
        for name in ("disc_wear", "pin_even_wear", "inner_race_wear", "outer_race_wear", "flank_volume", "operating_time"):
            assert here[h][name].max() > 0.0
            assert np.abs(there[h][name] - here[h][name]).max() < 1e-6 * here[h][name].max(), name


def test_values_that_the_plant_refuses_end_a_run_and_not_the_bench(benches):
    bench = benches[1]
    before = bench.average("drive_torque", SHORT, {})
    with pytest.raises(RunFault, match="loops"):
        bench.average("drive_torque", SHORT, {"eccentricity": 2e-3})
    bench.runs = Once(KEPT_RUNS)
    assert bench.average("drive_torque", SHORT, {}) == before


def test_units_of_another_reducer_are_refused(fmus):
    with pytest.raises(InputFault, match="BX-40E"):
        FmuBench(load_model("BX-40E-rigid"), {}, fmus)


def test_units_of_the_extended_model_are_taken(model, fmus, monkeypatch):
    from discrepancy.model_file import extended_reducer
    from discrepancy.named_reducer import reducer_of_model

    better = ModelFile("better", model.reducer, {}, {"needle_clearance": {CLEARANCE: {"value": 0.6e-6, "unit": "m"}}})
    built_from = {"plant": "rv_plant", "wear": "wear_fmu"}
    monkeypatch.setattr(Fmu, "specification", lambda unit: extended_reducer(better).specification(built_from[unit.name]))
    FmuBench(better, better.values(), fmus)
    # As ``build`` and ``extend --fmus`` name them, after model and file.
    named = reducer_of_model(replace(better, path=Path("worn.toml")))
    assert named.name == "better-worn"
    monkeypatch.setattr(Fmu, "specification", lambda unit: named.specification(built_from[unit.name]))
    FmuBench(better, better.values(), fmus)
    with pytest.raises(InputFault, match="another reducer file"):
        FmuBench(model, {}, fmus)


# The search over a curve of friction takes seven times as long as all others.
@pytest.mark.parametrize("candidates", [FEW, pytest.param(FEW | {"stribeck_friction.mesh"}, marks=pytest.mark.campaign)], ids=["few", "more"])
def test_diagnosis_by_the_fmus_is_that_of_their_kernels(model, native_fmus, candidates):
    campaign = campaign_of(model, {CLEARANCE: 0.6e-6}, 1)
    answers = []
    for folder in (None, native_fmus / "fmi2"):
        # Angles are counted from the model's own 0, and few candidates: it is the predictions that are compared.
        by = PhysicalModel(model, campaign, zeros={}, fmus=folder)
        by.candidates = tuple(c for c in by.candidates if c.name in candidates)
        assert len(by.candidates) == len(candidates)
        answers.append(diagnose(model, campaign, model=by))
    here, there = answers
    assert here.verdict == there.verdict == "one effect"
    assert [e["name"] for e in here.effects] == [e["name"] for e in there.effects] == ["needle_clearance"]
    ours, theirs = (a.effects[0]["parameters"][CLEARANCE] for a in answers)
    width = ours["interval"][1] - ours["interval"][0]
    # Searches differ where FMUs have no predictions to first order; a fit goes on until its chi-square stands still by 0.002, 0.011 of the width.
    assert theirs["value"] == pytest.approx(ours["value"], abs=1e-2 * width)
    assert theirs["interval"] == pytest.approx(ours["interval"], abs=1e-2 * width)
