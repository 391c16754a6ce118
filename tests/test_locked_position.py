"""Loops of one position that nobody stated: what positions change in them is a candidate of its own, beside the play that looks like it."""

import re
import tomllib
from types import SimpleNamespace

import numpy as np
import pytest

from benchmarks.blind_trial.generator.designs import Design, loops, te
from benchmarks.blind_trial.generator.folder import write_campaign
from benchmarks.unplaced_loops import ARCSEC, Case, measured, there_and_back
from cli.main import main
from discrepancy.campaign.load import load_campaign
from discrepancy.compare import compare
from discrepancy.doubts.locked_doubts import locked_doubts
from discrepancy.experiment.rig_runs import Measurement, at_a_position
from discrepancy.held_names import LOCKED_AT, LOCKED_POSITION
from discrepancy.inference.next_experiment import Experiment
from discrepancy.inference.refit.confusable import PER_PARAMETER, penalised
from discrepancy.inference.verdict import ONE, SEVERAL
from discrepancy.model_file import load_model
from discrepancy.prediction.candidates import candidates
from discrepancy.prediction.held import HELD_ANGLES
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.positions import departures, position_scores
from discrepancy.problem import Candidate, Parameter, Record, is_loop, is_unplaced
from discrepancy.verdict import diagnose
from fmu_src.faults import InputFault
from studies import coupled

RATIO = 121.0
AMOUNTS = [f"position_{k}" for k in range(1, 6)]
# Rivals that move in a loop as a position does, and some that do not.
FEW = {"needle_clearance", "profile_modification", "raceway_wear.inner", "raceway_wear.outer", "first_stage_error.backlash", "first_stage_error.mesh",
       "support_compliance", "thermal_expansion", "sensor_gain.hysteresis", "base.tooth_backlash", LOCKED_POSITION, f"{LOCKED_POSITION}.each"}  # fmt: skip


def campaign_of(folder, degrees, shares=(0.5, 0.75, 1.0), locked="", noise=0.5, reducer="RV20E-121-rigid", **values):
    """Two loops to each share of the rated torque, input at so many ``degrees`` (None: the mean), with noise [arcsec]."""
    return measured(Case("", (degrees,) * len(shares), locked, noise, values), folder, reducer, shares)


def answered(campaign):
    file = load_model(campaign.reducer.name)
    model = PhysicalModel(file, campaign)
    model.candidates = tuple(c for c in model.candidates if c.name in FEW or c.name.startswith("stribeck_friction"))
    return diagnose(file, campaign, model=model)


def loop_record(condition="a", **more):
    torque = there_and_back(100.0)
    return Record(f"loop_{condition}", "hysteresis", "rad", condition, 1, np.zeros(len(torque)), {"torque": torque}, more.pop("factors", {}),
                  tags={"locked": "input"}, **more)  # fmt: skip


def offered(records):
    return {c.name: c for c in candidates(records, {}, set(), ["1"]) if c.name.startswith(LOCKED_POSITION)}


def test_offered_where_a_loop_is_and_nobody_says_which():
    one = offered([loop_record()])
    assert list(one) == [LOCKED_POSITION]
    assert [p.name for p in one[LOCKED_POSITION].amplitudes] == AMOUNTS
    assert {(p.prior, p.lower, p.upper) for p in one[LOCKED_POSITION].amplitudes} == {(1.0, -4.0, 4.0)}
    # A rig that was turned between conditions; what is held out is fitted to nothing.
    several = offered([loop_record("a"), loop_record("b"), loop_record("c", held_out=True)])
    assert [p.name for p in several[f"{LOCKED_POSITION}.each"].amplitudes] == [f"{name}[{c}]" for c in "ab" for name in AMOUNTS]
    assert offered([loop_record(factors={LOCKED_AT: 0.3})]) == {}
    assert offered([loop_record(of_positions=True)]) == {}


def test_a_stated_mean_is_predicted_as_before_and_doubted_by_nobody(tmp_path):
    mean = campaign_of(tmp_path / "mean", None, (1.0,), 'locked_at = "mean"', 0.1)
    unstated = campaign_of(tmp_path / "unstated", None, (1.0,), "", 0.1)
    assert is_loop(mean.records[0]) and not is_unplaced(mean.records[0]) and is_unplaced(unstated.records[0])
    models = [PhysicalModel(load_model("RV20E-121-rigid"), campaign) for campaign in (mean, unstated)]
    assert np.array_equal(models[0].predict({})[0], models[1].predict({})[0])
    assert [p.name for p in models[0].nuisances] == [p.name for p in models[1].nuisances]
    # Not even with amounts that a model file brings along.
    assert np.array_equal(models[0].predict({"position_1": 1.0})[0], models[0].predict({})[0])
    assert locked_doubts(mean) == []
    [doubt] = locked_doubts(unstated)
    assert 'locked_at = "mean"' in doubt.remedy
    # And beside what is compared, where a browser meets it.
    told = [compare(model.file, campaign, model=model).warnings for model, campaign in zip(models, (mean, unstated))]
    assert [sum("where the input was locked" in text for text in warnings) for warnings in told] == [0, 1]


def test_what_a_row_or_a_run_says_is_nearer_than_its_condition(tmp_path):
    value = 'quantity = "lost_motion"\ntable.value = { values = [0.9], unit = "arcmin" }\n'
    (tmp_path / "campaign.toml").write_text(
        '[campaign]\nname = "said"\nreducer = "RV20E-121"\n[conditions.mean]\nlocked_at = "mean"\n[conditions.one]\nlocked_at = "90 deg"\n'
        f'[[runs]]\nid = "a"\ncondition = "mean"\n{value}'
        f'[[runs]]\nid = "b"\ncondition = "mean"\nreplicate = 2\n{value}table.locked_at = {{ values = [30], unit = "deg" }}\n'
        f'[[runs]]\nid = "c"\ncondition = "mean"\nreplicate = 3\n{value}actual = {{ locked_at = "60 deg" }}\n'
        f'[[runs]]\nid = "d"\ncondition = "one"\n{value}actual = {{ locked_at = "mean" }}\n'
        '[[runs]]\nid = "e"\ncondition = "mean"\nquantity = "no_load_torque"\ntable.value = { values = [1], unit = "N.m" }\n'
        'table.output_speed = { values = [15], unit = "rpm" }\n'
    )  # fmt: skip
    found = {r.name: (r.of_positions, r.factors.get(LOCKED_AT, np.ravel(r.axes.get(LOCKED_AT, [np.nan]))[0])) for r in load_campaign(tmp_path).records}
    assert {name: stated for name, (stated, _) in found.items()} == {"a": True, "b": False, "c": False, "d": True, "e": False}
    assert np.degrees([found["b"][1], found["c"][1]]) == pytest.approx([30.0, 60.0])
    assert np.isnan([found["a"][1], found["d"][1], found["e"][1]]).all()
    text = (tmp_path / "campaign.toml").read_text()
    (tmp_path / "campaign.toml").write_text(text.replace('"mean"\n[conditions.one]', '"anywhere"\n[conditions.one]'))
    with pytest.raises(InputFault, match=r"conditions\.mean\.locked_at = 'anywhere'"):
        load_campaign(tmp_path)


def test_campaign_from_takes_the_word(tmp_path, capsys):
    torque = there_and_back(150.0)
    rows = "\n".join(f"{t:.6g},{t / 50.0:.6g}" for t in torque)
    (tmp_path / "loop_20degC.csv").write_text(f"torque [N.m],twist [arcmin]\n{rows}\n")
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--tag", "locked=input", "--condition", "locked_at=mean"]) == 0
    capsys.readouterr()
    assert [r.of_positions for r in load_campaign(tmp_path).records] == [True]


def test_generated_campaigns_say_that_their_loops_are_means(tmp_path):
    design = Design("small")
    for block in (loops, te):
        block(design, np.random.default_rng(1), "small")
    write_campaign(tmp_path, "generated", design, [], "0")
    text = (tmp_path / "campaign.toml").read_text()
    conditions = tomllib.loads(text)["conditions"]
    stated = {name for name, entry in conditions.items() if entry.get("locked_at") == "mean"}
    assert stated == {s.condition for s in design.series if s.quantity == "hysteresis"} < conditions.keys()


@pytest.mark.parametrize("share", [1.0, 0.5])
def test_components_make_the_loop_of_every_position(tmp_path, monkeypatch, share):
    """With the amounts of that position in any loop; for an addition, whatever effects are on."""
    campaign = campaign_of(tmp_path / "c", 0.0, (share,), noise=0.1)
    model = PhysicalModel(load_model("RV20E-121-rigid"), campaign)
    scores = position_scores(model.bench)
    assert scores.shape == (len(AMOUNTS), HELD_ANGLES)
    assert np.mean(scores**2, axis=1) == pytest.approx(np.ones(len(AMOUNTS)))
    apart = departures(model.bench, model.records[0])
    mean = model.predict({})[0]
    model.predict({"position_1": 1.0})

    def never(*_):
        raise AssertionError("computed anew")

    monkeypatch.setattr(coupled, "torque_sweep", never)
    left = [model.predict(dict(zip(AMOUNTS, amounts)))[0] - mean - off for amounts, off in zip(scores.T, apart)]
    assert np.std(apart) > 1.0 * ARCSEC
    assert np.std(left) < 0.1 * ARCSEC
    # One position for all, or one of each condition.
    every, each = (model.predict({name: 0.7})[0] for name in ("position_2", "position_2[c0]"))
    assert np.array_equal(every, each)
    assert np.array_equal(model.predict({"position_2[other]": 0.7})[0], mean)


def test_what_was_known_before_has_no_price():
    def rival(variance, prior):
        p = Parameter("a", "1", 0.0, -4.0, 4.0, 1.0, prior=prior)
        c = Candidate("a", "a", (p,))
        fit = SimpleNamespace(values={"a": 0.5}, chi2=10.0, parameters=[p])
        return SimpleNamespace(fit=fit, candidates=(c,), own=[p], covariance=np.array([[variance]]))

    assert penalised(rival(1e-6, None)) == penalised(rival(0.3, None)) == pytest.approx(10.0 + PER_PARAMETER)
    assert penalised(rival(1e-6, 1.0)) == pytest.approx(10.0 + PER_PARAMETER, abs=1e-5)
    assert penalised(rival(0.25, 1.0)) == pytest.approx(10.0 + 0.75 * PER_PARAMETER)
    assert penalised(rival(1.0, 1.0)) == penalised(rival(2.0, 1.0)) == pytest.approx(10.0)


def test_a_loop_where_the_input_is_known_to_stand_is_an_experiment():
    plain = Measurement("hysteresis at 20 degC", 1.0, 1e-6, settings={"temperature": 293.15}, record=loop_record(), kind="hysteresis")
    campaign = SimpleNamespace(ratio=RATIO, rated_torque=167.0, speed_at="input", records=())
    there = at_a_position(plain, campaign)
    assert isinstance(there, Experiment) and not is_unplaced(there.record) and there.record.factors[LOCKED_AT] == 0.0
    assert there.name == "hysteresis at 20 degC, input locked at 0 deg"
    assert is_unplaced(plain.record)


@pytest.mark.parametrize("degrees", [140.0, 600.0])
def test_loops_of_one_position_are_named_as_that(tmp_path, degrees):
    answer = answered(campaign_of(tmp_path / "c", degrees))
    assert answer.verdict == ONE and [e["name"] for e in answer.effects] == [LOCKED_POSITION]
    [hides] = [w for w in answer.warnings if "where the input was locked hides" in w]
    assert "needle_clearance" in hides and "locked_at" in hides


def test_what_a_position_hides_covers_what_is_there(tmp_path):
    answer = answered(campaign_of(tmp_path / "c", 140.0, needle_clearance_added=2e-7))
    assert LOCKED_POSITION in {e["name"] for e in answer.effects}
    assert "needle_clearance" not in {e["name"] for e in answer.effects} or answer.confusable
    [hides] = [w for w in answer.warnings if "where the input was locked hides" in w]
    low, high = map(float, re.search(r"needle_clearance\.added of (\S+) um to (\S+) um", hides).groups())
    assert low < 0.2 < high < 1.0


def test_nothing_is_named_where_the_position_is_stated(tmp_path):
    assert answered(campaign_of(tmp_path / "c", 0.0, locked='locked_at = "0 deg"')).effects == []


def test_a_rig_that_was_turned_between_conditions(tmp_path):
    answer = answered(measured(Case("", (0.0, 272.0, 600.0)), tmp_path / "c", "RV20E-121-rigid"))
    assert [e["name"] for e in answer.effects] == [LOCKED_POSITION] and answer.effects[0]["variant"] == "each"


def test_a_large_clearance_at_a_stated_position_is_named(tmp_path):
    answer = answered(campaign_of(tmp_path / "c", 140.0, locked='locked_at = "140 deg"', needle_clearance_added=2e-6))
    assert answer.verdict == ONE
    low, high = answer.effects[0]["parameters"]["needle_clearance_added"]["interval"]
    assert low < 2e-6 < high < low + 0.03e-6


@pytest.mark.campaign
def test_friction_is_named_beside_an_unknown_position(tmp_path):
    answer = answered(campaign_of(tmp_path / "c", 140.0, friction_coefficient=0.05))
    assert {e["name"] for e in answer.effects} == {"stribeck_friction", LOCKED_POSITION}


@pytest.mark.campaign
def test_play_and_position_in_one_set(tmp_path):
    answer = answered(campaign_of(tmp_path / "c", 0.0, noise=2.0, reducer="RV20E-121"))
    assert {"needle_clearance", LOCKED_POSITION} <= set(answer.confusable)


@pytest.mark.campaign
def test_a_large_clearance_is_named_at_an_unknown_position_but_is_less_well_known(tmp_path):
    answer = answered(campaign_of(tmp_path / "c", 140.0, reducer="RV20E-121", needle_clearance_added=2e-6))
    assert answer.verdict == SEVERAL and {e["name"] for e in answer.effects} == {"needle_clearance", LOCKED_POSITION}
    low, high = answer.effects[0]["parameters"]["needle_clearance_added"]["interval"]
    assert low < 2e-6 < high and high - low > 0.2e-6
