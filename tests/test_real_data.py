"""Examples on real measurements; skipped where the data are not: $RVWEAR_DATA or ../shared/data beside the checkout."""

import importlib.util
import os
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from discrepancy.campaign.load import load_campaign
from discrepancy.compare import compare
from discrepancy.extend import DID_NOT_HELP, HELPED, extend
from discrepancy.model_file import load_model
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.verdict import diagnose
from fmu_src.source_hash import ROOT

pytestmark = pytest.mark.usefixtures("shared_runs")
DATA = Path(os.environ.get("RVWEAR_DATA", ROOT.parent / "shared" / "data"))
ACTUATOR, MILLING = DATA / "cycloidal_actuator", DATA / "milling_tool_wear"
EXAMPLES = ROOT / "examples"
RAMPS = EXAMPLES / "cycloidal_actuator"

needs_actuator = pytest.mark.skipif(not ACTUATOR.is_dir(), reason=f"no measurements at {ACTUATOR}; set RVWEAR_DATA")
needs_milling = pytest.mark.skipif(not MILLING.is_dir(), reason=f"no measurements at {MILLING}; set RVWEAR_DATA")


def names(answer):
    return [effect["name"] for effect in answer.effects]


def held_out_arcmin(step, when):
    return next(np.degrees(s[when]) * 60 for s in step["signals"] if s["held_out"])


# All 50 candidates, most of them springs, take seven times as long as what a motor's side can have.
@needs_actuator
@pytest.mark.parametrize("candidates", [{"drive_friction", "output_play", "sensor_drift.hysteresis"}, pytest.param(None, marks=pytest.mark.campaign)], ids=["few", "all"])
def test_plain_drive_has_friction_and_then_play(candidates):
    campaign, file = load_campaign(RAMPS / "base", ACTUATOR), load_model("cycloidal-actuator")
    model = PhysicalModel(file, campaign)
    model.candidates = tuple(c for c in model.candidates if candidates is None or c.name in candidates)
    first = diagnose(file, campaign, model=model)
    # In which order play and a spring are found is the fit's affair.
    assert names(first)[0] == "drive_friction" and "output_play" in names(first)
    # Both go on from the diagnosis: the same model, screened already.
    friction = extend(file, campaign, ["drive_friction"], answer=first)
    assert friction.verdict == HELPED
    assert held_out_arcmin(friction.step, "before") > 55 > 50 > held_out_arcmin(friction.step, "after")
    both = extend(file, campaign, ["drive_friction", "output_play"], answer=first)
    assert both.verdict == HELPED and held_out_arcmin(both.step, "after") < 20
    assert 0.2e-3 < both.file.values()["output_play"] < 0.32e-3


@needs_actuator
@pytest.mark.parametrize("variant", [*(pytest.param(v, marks=pytest.mark.campaign) for v in ("conic_runin", "conic_3pre")), "conic_5pre", "split"])
def test_preloaded_drives_have_friction_and_hardly_any_play(variant):
    campaign, model = load_campaign(RAMPS / variant, ACTUATOR), load_model(RAMPS / "preloaded.toml")
    friction = extend(model, campaign, ["drive_friction"])
    assert friction.verdict == HELPED
    assert held_out_arcmin(friction.step, "after") < 0.6 * held_out_arcmin(friction.step, "before")
    play = extend(friction.file, campaign, ["output_play"], anyway=True)
    # 13 arcmin at most, where the plain drive has 117.
    assert play.verdict == DID_NOT_HELP or play.file.values()["output_play"] < 0.04e-3


@needs_actuator
def test_orders_of_the_run_in_torque_are_named_and_decoys_refused():
    campaign = load_campaign(RAMPS / "run_in", ACTUATOR)
    found = {g.feature: g for g in compare(load_model("cycloidal-actuator"), campaign).diagnostician.localisation.groups}
    assert found["orders: crank, absolute, and ring"].share > 0.6
    assert found["orders: crank against carrier, and ring pins per disc turn"].share > 0.1
    assert found["orders: motor"].p < 1e-10
    for decoy in "abcd":
        assert found[f"orders: decoy {decoy}"].p > 0.004


@needs_milling
def test_nothing_is_added_to_the_milling_cutter():
    path = EXAMPLES / "milling_wear" / "milling.py"
    spec = importlib.util.spec_from_file_location("milling", path)
    milling = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(milling)
    found = milling.outcome(MILLING)
    assert found["verdict"] not in ("one effect", "several effects", "named but incomplete")
    fitted, held = found["errors"]["none"]
    for name in ("running_in", "quadratic"):
        better, worse = found["errors"][name]
        assert better < fitted and worse > 1.3 * held


@pytest.mark.parametrize("reducer", ["RV20E-121", pytest.param("BX-40E", marks=pytest.mark.campaign)])
def test_the_compliance_missing_from_the_catalogue_stiffness_is_named(reducer):
    campaign = load_campaign(EXAMPLES / "catalogue_stiffness" / reducer)
    answer = diagnose(load_model(f"{reducer}-rigid"), replace(campaign))
    assert answer.verdict == "one effect" and names(answer) == ["support_compliance"]
