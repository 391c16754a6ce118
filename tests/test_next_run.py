"""What is proposed as next experiment: noise, speeds and rows as the campaign has them, and never nothing where something is left."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from cli.screen import console
from cli.show.comparison import show_asked, show_next
from discrepancy.alike.ring_directions import either_texts
from discrepancy.alike.untold import parts_untold
from discrepancy.campaign.model import Campaign, Rig
from discrepancy.experiment import weighed_runs
from discrepancy.experiment.next_run import NextRun, proposal_for
from discrepancy.experiment.rig_runs import at_rated, conditions, describe, possible
from discrepancy.experiment.weighed_runs import measured_in
from discrepancy.inference.next_experiment import Experiment, NextExperiment, Proposal, RivalLaw, next_experiment
from discrepancy.inference.noise.noise import estimate
from discrepancy.inference.verdict import INCOMPLETE, NONE, ONE, UNKNOWN, Settings
from discrepancy.model_file import ModelFile
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from discrepancy.verdict import Answer
from reducers.reducer import load_reducer

RV = load_reducer("RV20E-121")
RIG = Rig({"speed": (52.36, 314.2), "load": (0.0, 167.0), "temperature": (293.15, 333.15), "hours": (3.6e5, 3.6e7)}, (1,), (), (), 100.0, 1.0, 0.0, "EUR")
CAMPAIGN = Campaign(None, "bench", "", None, 121.0, 167.0, {}, (), {}, {}, (), RIG, "", speed_at="output")


def weighed(part, replicate, value):
    factors = {"speed": 190.0, "load": 167.0, "temperature": 293.15, "hours": 3.6e6, "direction": 1.0}
    return Record(f"{part}{replicate}", "mass_loss", "kg", "test", replicate, np.array([value]), {}, factors, tags={"part": part})


def model_of(records):
    bench = SimpleNamespace(rated_speed=190.0, rated_load=167.0)
    unstated = SimpleNamespace(taken=lambda effects, values: {})
    one = lambda record, values: np.full(len(record.values), 2e-6)
    return SimpleNamespace(records=records, bench=bench, campaign=CAMPAIGN, standing=dict, one=one, unstated_places=unstated, file=SimpleNamespace(effects={}, values=dict, steps=()))


def space_of(records):
    blank = [np.zeros(1)] * len(records)
    return SimpleNamespace(noise=estimate(records, [r.values - 2e-6 for r in records], [b + 2e-6 for b in blank]))


def test_noise_of_a_tagged_number_is_that_of_its_quantity():
    records = [weighed(part, k, 2e-6 + 1e-8 * (-1) ** k) for part in ("disc", "pin") for k in (1, 2)]
    space = space_of(records)
    found = possible(model_of(records), CAMPAIGN, space)
    assert {e.kind for e in found} == {"mass_loss[part=disc]", "mass_loss[part=pin]"}
    assert all(e.deviation == pytest.approx(space.noise.streams["mass_loss"].scale / np.sqrt(2.0)) for e in found)


def test_noise_in_proportion_follows_the_prediction():
    records = [weighed("disc", k, 2e-6) for k in (1, 2)]
    space = space_of(records)
    stream = replace(space.noise.streams["mass_loss"], proportional=True, scale=0.05, floor=0.0)
    space.noise.streams["mass_loss"] = stream
    found = possible(model_of(records), CAMPAIGN, space)
    assert found[0].deviation == pytest.approx(0.05 * 2e-6 / np.sqrt(2.0))


def test_speeds_stand_where_the_campaign_states_them():
    rpm = np.pi / 30.0
    assert describe({"speed": 1815.0 * rpm, "load": 167.0, "temperature": 313.15}, CAMPAIGN) == "15 rpm at the output, 167 N.m, 40 degC"
    # Of runs of which nobody says how warm they were.
    unstated = replace(CAMPAIGN, records=(replace(weighed("disc", 1, 2e-6), factors={"load": 20.0}),))
    assert describe({"load": 167.0, "temperature": 293.15}, unstated) == "167 N.m, 20 degC (assumed)"
    assert describe({"speed": 1815.0 * rpm}, replace(CAMPAIGN, speed_at="input")) == "1815 rpm at the input"


def law(rival, values, experiment):
    # Only the load tells the rivals apart.
    return np.array([values["a"] * experiment.settings["load"] ** (1 if rival.name == "line" else 2)])


def test_experiments_that_differ_by_nothing_useful_are_one_row():
    rivals = [RivalLaw(name, {"a": 1.0}, ["a"], np.array([[1e-4]]), np.array([1.0])) for name in ("line", "square")]
    choices = [Experiment(f"x{load}{t}", 1.0, settings={"load": load, "temperature": t}, kind="x") for load in (1.0, 4.0, 9.0) for t in (293.0, 313.0, 333.0)]
    result = next_experiment(law, choices, rivals, naming=lambda p: f"{p.kind} {p.settings['load']:g} {p.spans}")
    assert result.proposals[0].experiment.startswith("x 9") and len(result.proposals) == 3 and len(result.every) == 9
    assert all(p.spans == {"temperature": (293.0, 333.0)} for p in result.proposals) and result.proposals[0].experiment in result.verdict
    dearer = [replace(c, cost=2.0 if c.settings["temperature"] > 320.0 else 1.0) for c in choices]
    assert len(next_experiment(law, dearer, rivals).proposals) == 6


def test_span_is_said_in_words():
    said = describe({"load": 50.0, "temperature": 300.0}, CAMPAIGN, {"temperature": (293.15, 333.15)})
    assert said == "50 N.m, any temperature from 20 to 60 degC"


def answer_of(verdict, members=(), findings=(), rivals=()):
    fits = SimpleNamespace(members=[SimpleNamespace(name=m) for m in members], rivals=[SimpleNamespace(name=r) for r in rivals], space=None)
    local = {"findings": list(findings)}
    records = [weighed("disc", 1, 2e-6), replace(weighed("disc", 2, 2e-6), factors={"speed": 200.0, "load": 20.0})]
    diagnosis = SimpleNamespace(fits=fits, leftover={"findings": list(findings)} if members else {}, localisation=local, nuisances={}, alternatives={})
    said = "that no effect of the catalogue explains"
    return SimpleNamespace(verdict=verdict, diagnosis=diagnosis, laws=[], model=model_of(records), left_over=said, effects=[], untold=[], would_show=None)


@pytest.mark.parametrize(("verdict", "members"), [(INCOMPLETE, ["drag"]), (UNKNOWN, [])])
def test_after_incomplete_or_unknown_something_is_left(verdict, members, capsys):
    finding = {"signal": "mass_loss[part=disc]", "feature": "value", "dependence": "load", "p": 1e-6}
    run = proposal_for(answer_of(verdict, members, [finding]), CAMPAIGN)
    assert "nothing is left" not in run.verdict and "something is left" in run.verdict
    # The widest gap between the loads that were measured, 20 and 167 N m.
    assert run.open == ["mass_loss[part=disc] at 94 N.m: what is left changes with load, measured at 20 N.m, 167 N.m"]
    assert run.as_json()["open"] == run.open
    # With the columns of a proposal: the condition that has all else, the price of two runs, and what they would show.
    (asked,) = run.asked
    assert asked.like == "all else as test" and asked.cost == 200.0 and asked.expected is None
    known = proposal_for(answer_of(verdict, members, [finding | {"statistic": 30.0}]), CAMPAIGN)
    assert known.asked[0].expected == pytest.approx(30.0) and known.as_json()["asked"][0]["cost"] == 200.0
    show_asked(known, console(100))
    told = " ".join(capsys.readouterr().out.split())
    assert all(text in told for text in ("mass_loss[part=disc] at 94 N m", "all else as test; cost 200 EUR; expected misfit 30 in chi-square"))
    assert proposal_for(answer_of(verdict, members), CAMPAIGN).open


def test_a_misfit_that_is_the_same_everywhere_is_asked_for_with_what_the_answer_decides():
    """"Mount sensor and unit anew" stood there without a word of what that tells apart."""
    run = proposal_for(answer_of(UNKNOWN, [], [{"signal": "mass_loss[part=disc]", "feature": "value", "dependence": "everywhere", "p": 1e-6}]), CAMPAIGN)
    assert "mount sensor and unit anew and repeat: a misfit that changes with the mounting comes from the bench" in run.open[0]
    assert "one that stays from the reducer" in run.open[0]
    assert "what comes again is the reducer's or the bench's" in proposal_for(answer_of(UNKNOWN), CAMPAIGN).open[0]


@pytest.mark.parametrize(("place", "says"), [({}, "missing"), ({"locked_at": 0.0}, "mount sensor and unit anew")])
def test_a_loop_that_lacks_its_position_is_asked_for_it_and_not_for_a_mounting(place, says):
    """Another mounting has another position, of which nobody knows either."""
    answer = answer_of(UNKNOWN, [], [{"signal": "hysteresis[locked=input]", "feature": "value", "dependence": "everywhere", "p": 1e-6}])
    factors = {"load": 167.0, "temperature": 293.15} | place
    answer.model.records.append(Record("l", "hysteresis", "rad", "warm", 1, np.zeros(5), {"torque": np.zeros(5)}, factors, tags={"locked": "input"}))
    (asked,) = proposal_for(answer, CAMPAIGN).asked
    assert says in asked.text and ("mount sensor" in asked.text) == bool(place)
    assert bool(place) or ('state locked_at = "90 deg"' in asked.text and asked.like == "loops in warm" and asked.cost is None)


@pytest.mark.parametrize(("names", "said"), [
    ([], "that no effect of the catalogue explains"), (["drag"], "that none of the effects tried beside it explains"),
    (["drag", "play"], "that none of the effects tried beside them explains"),
    (["drag", "play", "gain"], "beyond the 3 effects that are looked for at once: add what is named and diagnose again"),
])  # fmt: skip
def test_of_what_is_left_only_what_was_tried_is_said(names, said):
    members = [SimpleNamespace(candidates=names)] if names else []
    answer = SimpleNamespace(doctor=SimpleNamespace(settings=Settings()), diagnosis=SimpleNamespace(fits=SimpleNamespace(members=members)))
    assert Answer.left_over.fget(answer) == said


def test_what_one_effect_may_come_from_is_said():
    """An oval ring may have been ground so or be clamped so: `campaign check` asked for the ring to be turned, and nothing was left to ask here."""
    error = Record("te", "transmission_error", "rad", "c", 1, np.zeros(5), {"angle": np.linspace(0.0, 7.0, 5)}, {"direction": 1.0})
    campaign = replace(CAMPAIGN, records=(error,), conditions={"c": SimpleNamespace(interventions=())})
    asked = "whether it is the pins' own places, or a ring that is oval or clamped so, this campaign does not tell"
    # First, for it is what is open.
    answer = answer_of(ONE, ["pin_position_errors"])
    answer.effects.append({"name": "pin_position_errors", "parameters": {"pin_ring_ovality": {}}})
    said = proposal_for(answer, campaign).verdict
    assert said.startswith(asked) and "turn the ring" in said
    # How the change is stated stood in `campaign check` alone.
    assert 'the runs after it are a condition of their own, with interventions = ["ring_turned"]' in said
    answer.effects[:] = [{"name": "pin_position_errors", "parameters": {"pin_ring_trilobe": {}}}]
    assert "or a ring that is three-lobed or clamped so, this campaign" in proposal_for(answer, campaign).verdict
    # A single pin is clamped by nobody.
    answer.effects[:] = [{"name": "pin_position_errors", "parameters": {"proud_pin": {}}}]
    assert asked not in proposal_for(answer, campaign).verdict
    # Once it stands in the model file nothing is missing, and the question is as open.
    answer = answer_of(NONE)
    answer.model.file.values = lambda: {"pin_ring_ovality": 5e-6}
    said = proposal_for(answer, campaign).verdict
    assert said.startswith(asked)
    # "nothing is left to separate" stood behind the question: what it costs does.
    assert "nothing is left" not in said
    assert "this can still be asked: it costs the change itself and 200 EUR after it: 2 repetitions of a condition of transmission_error over a whole turn, such as c;" in said
    assert said.endswith("apart from that nothing is missing that this campaign shows")
    assert "and 2 runs after it" in proposal_for(answer, replace(campaign, rig=None)).verdict


def test_of_a_model_with_its_effect_in_it_next_says_of_which_model_to_ask():
    """Nothing is left to separate then, and the loop that would confirm it was found by asking the model before, which nobody said."""
    answer = answer_of(NONE)
    assert "is asked of the model" not in proposal_for(answer, CAMPAIGN).verdict
    answer.model.file.effects = {"disc_tooth_errors": {}}
    assert "which run tells disc tooth errors, which its file has, from what came nearest to it is asked of the model that it was added to" in proposal_for(answer, CAMPAIGN).verdict


def test_what_next_says_is_parted_in_short_lines(capsys):
    """It was one sentence of a hundred words; brackets stay whole."""
    run = NextRun(SimpleNamespace(), None, [], "at which part it is (lobe at crank 1; crank 2 if turned) stays open; measure these parts; nothing is left to separate")
    assert run.lines == ["at which part it is (lobe at crank 1; crank 2 if turned) stays open", "measure these parts", "nothing is left to separate"]
    show_next(run)
    assert capsys.readouterr().out.splitlines() == run.lines


def test_a_position_beyond_a_turn_says_what_to_do():
    """"input locked at 198 deg after 1 whole turn (558 deg)" did not say which of both to set."""
    says = {at: describe({"locked_at": np.radians(at)}, CAMPAIGN) for at in (0.0, 90.0, 360.0, 558.4, 837.0)}
    assert list(says.values()) == [
        "input locked at 0 deg", "input locked at 90 deg", "input locked at 360 deg (from the encoder's zero turn the input on by 1 whole turn)",
        "input locked at 558 deg (from the encoder's zero turn the input on by 1 whole turn and 198 deg)",
        "input locked at 837 deg (from the encoder's zero turn the input on by 2 whole turns and 117 deg)",
    ]  # fmt: skip


def test_nothing_is_left_after_one_effect_or_none():
    assert proposal_for(answer_of(ONE, ["thermal_expansion"]), CAMPAIGN).verdict == "nothing is left to separate: thermal expansion stands alone"
    # What came nearest to nothing is no suspect.
    run = proposal_for(answer_of(NONE, rivals=["drag", "first_stage_error"]), CAMPAIGN)
    assert "nothing is missing" in run.verdict and not run.rivals and run.result is None


@pytest.mark.parametrize("verdict", [ONE, INCOMPLETE])
def test_parts_that_look_alike_are_no_end_of_the_matter(verdict):
    """"Nothing is left to separate" stood there while four lobes came into question."""
    answer = answer_of(verdict, ["crank_lobe_errors.crank_1"])
    four = "crank 1 at disc 1 or crank 2 at disc 2, which look alike"
    answer.effects = [{"name": "crank_lobe_errors", "parameters": {}, "place": four, "other_places": ["crank 2 at disc 2"]}]
    said = proposal_for(answer, CAMPAIGN).verdict
    assert f"at which part it is (crank eccentric errors at {four}) stays open; no other run of these signals tells, for they are the same with each" in said
    assert proposal_for(answer, CAMPAIGN).untold == parts_untold(answer.effects)
    assert "exchange one of them for that of another unit" in said
    # Once it stands in the model file it is as open as before.
    kept = {"untold": parts_untold(answer.effects), "kept": True}
    answer.effects = []
    answer.model.file.steps = (kept, {"untold": ["what was tried in vain"], "kept": False})
    said = proposal_for(answer, CAMPAIGN).verdict
    assert f"at which part it is (crank eccentric errors at {four})" in said and "in vain" not in said
    answer.model.file.steps = ()
    answer.effects = [{"name": "crank_lobe_errors", "parameters": {}, "place": "crank 1 at disc 1", "other_places": []}]
    assert "no other run" not in proposal_for(answer, CAMPAIGN).verdict


def test_what_no_run_tells_is_said_and_costs_no_run():
    """The other angle was forgotten once the effect was in the model file, and 2 runs were said to answer it."""
    (other,) = either_texts([{"parameters": {"pin_ring_trilobe_angle": {"value": 0.3, "alike": 1.3, "direction": True}}}], {}, ModelFile(RV.name, RV), more=False)
    answer = answer_of(NONE)
    answer.model.file.steps = ({"untold": [other], "kept": True},)
    said = proposal_for(answer, CAMPAIGN).verdict
    assert said == f"{other}; apart from that nothing is left to separate: nothing is missing that this campaign shows"
    assert "no run of the reducer as a whole tells" in said and "2 repetitions" not in said


def test_a_place_that_makes_no_difference_is_no_place():
    """"The runs of hysteresis[locked=input] at input locked at 0 deg" were never made: those at 90 and 210 deg were."""
    loops = tuple(Record(f"l{at}", "hysteresis", "rad", f"locked_{at}deg", 1, np.zeros(5), {"torque": np.zeros(5)}, {"locked_at": np.radians(at)},
                         tags={"locked": "input"}) for at in (90, 210))  # fmt: skip
    span = (0.0, np.radians(837.0))
    assert describe({"locked_at": 0.0}, CAMPAIGN, {"locked_at": span}) == "input locked anywhere"
    proposal = Proposal("x", {"locked_at": 0.0, "temperature": 293.15}, 2.0, 9.0, 9.0, {}, "hysteresis[locked=input]", {"locked_at": span})
    assert measured_in(proposal, replace(CAMPAIGN, records=loops)) == ["locked_90deg", "locked_210deg"]
    assert not measured_in(replace(proposal, spans={}), replace(CAMPAIGN, records=loops))


def test_what_it_costs_not_to_know_has_the_unit_of_its_signal():
    stake = {"torsional_stiffness at 20 degC": 2e5, "hysteresis[locked=input] at 20 degC": 1e-3, "wear_depth[surface=pin] at 20 degC": 2e-6}
    texts = NextRun(None, SimpleNamespace(at_stake=stake), [], "").stakes()
    assert list(texts.values()) == ["58.2 N.m/arcmin", "3.44 arcmin", "2 um"]


def test_a_rival_of_the_measuring_chain_predicts_what_was_not_measured_yet():
    """A clock that slips is a rival in transmission error; the experiment may be a loop."""
    reducer = load_reducer("RV20E-121-rigid")
    factors = {"speed": 101.4, "load": 100.0, "temperature": 293.15, "hours": 0.0, "direction": 1.0}
    torque = Record("t1", "input_torque", "N.m", "c", 1, np.array([0.8]), {}, factors)
    model = PhysicalModel(ModelFile(reducer.name, reducer), replace(CAMPAIGN, reducer=reducer, records=(torque,)))
    proposed = Record("proposed", "hysteresis", "rad", "c", 1, np.zeros(6), {"torque": np.array([50.0, 100.0, 50.0, -50.0, -100.0, -50.0])}, factors,
                      tags={"locked": "input"})  # fmt: skip
    assert np.ptp(model.one(proposed, {"clock_slip": 1e-3})) > 1e-4


def test_loops_are_proposed_where_the_input_may_be_locked_and_at_no_speed():
    """What was proposed had been measured three times, and "at 2000 rpm" with the input held."""
    torque = np.linspace(-167.0, 167.0, 5)
    factors = {"load": 167.0, "temperature": 293.15, "locked_at": 0.0}
    loop = Record("l", "hysteresis", "rad", "0deg", 1, np.zeros(5), {"torque": torque}, factors, tags={"locked": "input"})
    model = model_of([loop])
    model.bench.ratio, model.bench.reducer = 121.0, SimpleNamespace(topology=SimpleNamespace(lobes=39))
    settings = conditions(loop, model, None, CAMPAIGN)
    assert [s["locked_at"] for s in settings] == pytest.approx(2.0 * np.pi * 121.0 / 39.0 * np.arange(4) / 4.0)
    assert all(set(s) == {"locked_at", "temperature"} for s in settings)
    (rated,) = at_rated(model)
    assert "rpm" not in rated.name and rated.record.factors["locked_at"] == 0.0
    assert conditions(replace(loop, factors={"temperature": 293.15}), model, None, CAMPAIGN) == [{"temperature": 293.15}]


@pytest.mark.parametrize("rig", [CAMPAIGN.rig, None])
def test_what_was_weighed_is_said_with_the_verdict(rig, monkeypatch):
    """"On this rig" stood there where the campaign states none."""
    for name in ("possible", "at_rated"):
        monkeypatch.setattr(weighed_runs, name, lambda *_: [])
    answer = SimpleNamespace(model=None, diagnosis=SimpleNamespace(fits=SimpleNamespace(space=None)))
    said = weighed_runs.weighed(answer, replace(CAMPAIGN, rig=rig), []).verdict
    assert ("on this rig" in said) == (rig is not None) and ("it states no [rig]" in said) == (rig is None)


@pytest.mark.parametrize("tells", [True, False])
def test_forms_that_look_alike_are_asked_for(tells, monkeypatch):
    """Of four springs one was named, and nothing was left to separate."""
    fits = [SimpleNamespace(name=f"support_compliance.{form}", fit=SimpleNamespace(chi2=9.0)) for form in ("carrier", "crank_supports")]
    answer = answer_of(ONE)
    answer.diagnosis.fits.members = fits
    answer.effects = [{"name": "support_compliance", "candidates": [f.name for f in fits], "parameters": {}, "other_forms": [{"candidates": [fits[1].name]}]}]
    proposal = Proposal("transmission_error at 100 N.m", {}, 1.0, 9.0 if tells else 1.0, 9.0 if tells else 1.0, {})
    monkeypatch.setattr(weighed_runs, "rival_of", lambda member, *_: member)
    monkeypatch.setattr(weighed_runs, "weighed", lambda *_: NextExperiment(tells, f"{proposal.experiment} separates all rivals", [proposal], {}))
    said = proposal_for(answer, CAMPAIGN).verdict
    start = "which form of support compliance it is, carrier or crank supports: "
    assert start + ("transmission_error at 100 N.m separates" if tells else "no run of what was measured tells") in said
    assert "apart from that nothing is left to separate" in said


def test_what_could_stand_in_place_of_a_named_one_is_no_end_of_the_matter():
    answer = answer_of(ONE, ["support_compliance.carrier"])
    answer.diagnosis.alternatives = {"support_compliance.carrier": ["support_compliance.housing"]}
    said = proposal_for(answer, CAMPAIGN).verdict
    assert "support_compliance.carrier could as well be support_compliance.housing, which this campaign does not tell" in said and "stands alone" not in said
