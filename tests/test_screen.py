"""What the screen shows: texts of the user as they stand, units of the field, no praise that no unused run bears."""

import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from cli.bars import Bars
from cli.screen import console, figures, styled
from cli.show import comparison as shows
from discrepancy.experiment.next_run import Asked, NextRun
from discrepancy.extend import verdict_of
from discrepancy.inference.held_out.held_out import HeldOut
from discrepancy.inference.misfit.localise import Group, Localisation
from discrepancy.inference.next_experiment import NextExperiment, Proposal
from discrepancy.inference.verdict import INCOMPLETE, NONE, ONE, SET, STOPPED
from discrepancy.model_file import load_model
from discrepancy.page import evidence
from discrepancy.scales import of_axis, of_parameter, of_signal, parameter_texts
from discrepancy.verdict import added_of, instead_of, merged
from discrepancy.words.left_sizes import left_sizes
from discrepancy.words.wording import error_text, is_shown, left_text, share_text, shares_text, tone
from fmu_src.progress import Task

CLI = Path(__file__).resolve().parents[1] / "cli"
SIGNAL = "wear_depth[disc=1,surface=inner_race]"


def test_texts_are_no_markup(capsys):
    group = Group(SIGNAL, "place [bold]", "everywhere", 9.0, 1, 10.0, 1e-6, 1e-6, 0.5)
    shows.show_localisation(Localisation([group], {}, 0.01))
    shows.show_warnings(console(), [f"{SIGNAL}: [red]odd[/red]"])
    proposal = Proposal(f"{SIGNAL} at 20 degC", {}, 1.0, 9.0, 9.0, {})
    answer = SimpleNamespace(model=SimpleNamespace(campaign=SimpleNamespace(rig=None)))
    run = NextRun(answer, NextExperiment(True, f"{SIGNAL} separates", [proposal], {f"{SIGNAL} at 20 degC": 2e-6}), ["a[disc=1]", "b"], f"{SIGNAL} separates")
    shows.show_next(run)
    figures("title [disc=2]", {"figure[crank=1]": "[disc=3]"})
    shown = capsys.readouterr().out
    assert shown.count("[disc=1") >= 5 and "[bold]" in shown and "[red]odd[/red]" in shown
    assert all(text in shown for text in ("[disc=2]", "[crank=1]", "[disc=3]", "2 um", "cost [runs]"))


def test_of_several_signals_it_is_said_of_what_a_share_is(capsys):
    """A loop of 446 times its noise stood beside "1 %"."""
    loop, error = (Group(signal, "mean", "everywhere", size, 1, 10.0, 1e-6, 1e-6, share) for signal, size, share in (("hysteresis", 9.0, 0.01), ("error", 900.0, 0.99)))
    for groups, said in (([loop], False), ([loop, error], True)):
        shows.show_localisation(Localisation(groups, {}, 0.01))
        shown = " ".join(capsys.readouterr().out.split())
        assert "of all misfit" in shown and ("in times of the noise" in shown) == said


def test_what_separates_stands_before_what_shows_a_law(capsys):
    answer = SimpleNamespace(model=SimpleNamespace(campaign=SimpleNamespace(rig=None)), would_show=None)
    found = NextExperiment(True, "loops tell", [Proposal("loops at 20 degC", {}, 1.0, 9.0, 7.0, {})], {})
    shows.show_next(NextRun(answer, found, ["a", "b"], "loops tell", [Asked("hysteresis", "mount sensor and unit anew")]))
    shown = capsys.readouterr().out
    assert shown.index("loops at 20 degC") < shown.index("mount sensor and unit anew")
    assert "[chi-square]" in shown and ": 6 is enough" in shown


def test_texts_beside_a_bar_are_no_markup():
    bars = Bars()
    task = Task("adding a[disc=1]", 3)
    bars.begin(task)
    (column, *_) = bars.drawn.columns
    text = column.render(bars.drawn.tasks[0])
    bars.end(task)
    assert "[disc=1]" in text.plain


def test_every_screen_is_made_in_one_place():
    made = [path.name for path in CLI.rglob("*.py") if re.search(r"\bConsole\(", path.read_text())]
    assert sorted(made) == ["bars.py", "screen.py"]
    assert not [path.name for path in CLI.rglob("*.py") if re.search(r"\[/|\bescape\(|\[(bold|green|yellow|red)\b", path.read_text())]


@pytest.mark.parametrize(("value", "unit", "said"), [
    (2e-7, "rad/(N.m)", "0.0006875 arcmin/(N.m)"), (3e-6, "m", "3 um"), (4e-5, "rad", "8.251 arcsec"), (2e-3, "rad", "6.875 arcmin"), (1.0, "rad", "57.3 deg"),
    (313.15, "K", "40 degC"), (5.0, "K", "5 K"), (7200.0, "s", "2 h"), (0.3, "N.m", "0.3 N.m"), (1e-5, "kg.m", "10 g.mm"), (20.0, "rad/s", "191 rpm"),
    (3e-9, "m/(N.m)", "0.003 um/(N.m)"), (3e-9, "N.m/m", "3e-09 N.m/m"), (3e-9, "1/Pa", "3e-09 1/Pa"), (5.9e-9, "m/N", "5.9 nm/N"),
])  # fmt: skip
def test_parameters_have_the_units_of_the_field(value, unit, said):
    text, _, name = parameter_texts(value, (value, value), unit)
    assert f"{text} {name}" == said


def test_signals_and_axes_have_the_units_of_the_field():
    assert of_signal("hysteresis[locked=output]", "rad").unit == "arcmin" and of_signal("transmission_error", "rad").unit == "arcsec"
    assert of_signal("torsional_stiffness", "N.m/rad").unit == "N.m/arcmin" and of_signal(SIGNAL, "m").text(2e-6) == "2 um"
    assert of_signal("temperature", "K").text(2.0) == "2 K" and of_axis("hours").text(3.6e6) == "1000 h"
    assert of_parameter(0.0, "rad").text(0.0) == "0 arcsec"
    assert of_parameter(0.028, "m").text(0.027933, 4) == "27.93 mm" and of_parameter(5e-6, "m").text(5e-6) == "5 um"


def answer_of(verdict, held_out, rms=None, before=28.0, after=1.2, leftover=None, kind=None):
    """As much of an answer as its words need; one signal, of which the last run is held out."""
    records = [SimpleNamespace(name=n, quantity="hysteresis", unit="rad", values=np.array([1e-3, -1e-3]), held_out=n == "b", unused=n == "b", left_out=False) for n in ("a", "b")]
    whitener = SimpleNamespace(quantity="hysteresis", kept=np.array([True, True]), scale=np.full(2, 1e-3))
    space = SimpleNamespace(records=records, held_out=[1] if held_out else [], base=SimpleNamespace(values={}),
                            predictions=lambda values, which: [np.zeros(2) for _ in which],
                            noise=SimpleNamespace(whiteners=[whitener, whitener], streams={"hysteresis": SimpleNamespace(patterns={})}))
    entry = {"before": before, "after": after, "rms": rms} | ({"kind": kind} if kind else {})
    diagnosis = SimpleNamespace(fits=SimpleNamespace(space=space, members=[]), held_out={"play": entry}, leftover=leftover or {}, captured=1.0, reason="r",
                                alternatives={}, stand_ins={}, rejected=[], base_off=[], nuisances={})
    effect = {"name": "play", "variant": "", "candidates": ["play"], "forms": {}, "parameters": {"gap": {"value": 2e-7, "interval": (1e-7, 3e-7), "unit": "rad/(N.m)"}},
              "share_explained": 1.0, "held_out_error_before": before, "held_out_error_after": after}
    return SimpleNamespace(verdict=verdict, reason=diagnosis.reason, diagnosis=diagnosis, effects=[effect], confusable=[], laws=[], warnings=[], figures=[], figures_after=[], added="", of_chance="", would_show=None,
                           model=SimpleNamespace(file=load_model("RV20E-121")))


def test_what_leaves_something_does_not_explain_all():
    left = {"findings": [{"signal": SIGNAL, "feature": "value", "dependence": "hours", "p": 1e-9}]}
    answer = answer_of(INCOMPLETE, True, leftover=left)
    assert share_text(answer, 1.0) == "explains over 99.99 % of the misfit" and share_text(answer, 0.6) == "explains 60 % of the misfit"
    assert share_text(answer, 0.99984) == "explains 99.98 % of the misfit"
    alone = answer.effects[0] | {"share_alone": 0.99984, "share_explained": 0.3}
    assert shares_text(answer, alone) == "alone it takes away 99.98 % of the misfit; added to what of the base model is off, 30 % more of it"
    assert left_text(answer) == f"{SIGNAL}, value, changing with hours"
    assert share_text(answer_of(ONE, True), 1.0) == "explains 100 % of the misfit"


def test_what_is_left_is_sized_signal_by_signal(capsys):
    answer = answer_of(INCOMPLETE, True, leftover={"findings": [{"signal": "hysteresis", "feature": "value", "dependence": "everywhere", "p": 1e-9}]})
    answer.diagnosis.fits.members = [SimpleNamespace(fit=SimpleNamespace(values={}), candidates=[1])]
    space = answer.diagnosis.fits.space
    space.noise.whiteners = [SimpleNamespace(kept=np.array([True, True]), floor=floor) for floor in (1e-3 / 1.1, 0.5e-3)]
    for record in space.records:
        record.tags, record.condition, record.replicate = {}, "c", 1
    shows.show_answer(answer)
    shown = " ".join(capsys.readouterr().out.split())
    assert "error over noise, all samples, with what is named: hysteresis: 1.1 times its noise (unused runs: 2); the verdict counts the misfit in the patterns, not this" in shown
    assert "misfit in the patterns 28.00 -> 1.20 (what the verdict counts; 1: what noise leaves there)" in shown
    assert left_sizes(answer_of(ONE, True)) == ""


def test_unused_runs_say_of_which_signals_they_are_where_others_have_none():
    """"Error on unused conditions" stood there of loops, beside transmission errors of which none was held out."""
    answer = answer_of(ONE, True)
    [effect] = answer.effects
    assert "say nothing of" not in error_text(answer, effect)
    for quantity in ("transmission_error", "transmission_order"):
        answer.diagnosis.fits.space.records.append(SimpleNamespace(name=quantity, quantity=quantity, unit="rad", held_out=False, unused=False, left_out=False))
    told = "; these runs are of hysteresis alone and say nothing of transmission error"
    assert error_text(answer, effect).endswith(told)
    drowned = answer_of(ONE, True, rms={"hysteresis": {"before": 1e-6, "after": 1e-6, "floor": 1e-3}})
    drowned.diagnosis.fits.space.records = answer.diagnosis.fits.space.records
    assert "prove little" in error_text(drowned, effect) and error_text(drowned, effect).endswith(told)
    # Orders are made of transmission errors: those that are held out are of both.
    answer.diagnosis.fits.space.records[-1].unused = True
    assert "say nothing of" not in error_text(answer, effect)


def test_forms_that_are_added_together_stand_each_with_its_values(capsys):
    """An oval and a scatter were one effect: their values stood under one name, or those of the scatter nowhere."""
    forms = {"disc_tooth_errors.oval_form": {"oval": 4e-6}, "disc_tooth_errors.scatter": {"scatter": 1e-6}, "play": {"gap": 1e-6}}
    parts = [{"name": name, "parameters": {p: {"value": v, "interval": (0.9 * v, 1.1 * v), "unit": "m"} for p, v in values.items()}, "share_explained": 0.5,
              "at_bounds": [], "held_out_error_before": None, "held_out_error_after": None} for name, values in forms.items()]  # fmt: skip
    # Alternatives are one fit each; the first speaks.
    alike, _ = merged(parts, {"disc_tooth_errors.oval_form"})
    assert not alike["forms"] and set(alike["parameters"]) == {"oval"} and len(alike["candidates"]) == 2
    assert [form["candidates"] for form in alike["other_forms"]] == [["disc_tooth_errors.scatter"]]
    assert added_of(alike) == ["disc_tooth_errors.oval_form"]
    assert instead_of(alike | {"look_alike": ["disc_tooth_errors.crank_2"]}) == ["disc_tooth_errors.scatter", "disc_tooth_errors.crank_2"]
    effect, _ = merged(parts, set(forms))
    assert effect["other_forms"] == []
    assert added_of(effect) == effect["candidates"] and instead_of(effect) == []
    assert effect["forms"] == {"oval_form": ["oval"], "scatter": ["scatter"]} and effect["share_explained"] == 1.0
    answer = answer_of(INCOMPLETE, True)
    answer.effects = [effect]
    answer.model = SimpleNamespace(campaign=SimpleNamespace(), file=SimpleNamespace(reducer=load_model("RV20E-121").reducer, effects={}, values=dict))
    answer.diagnosis.fits.members = []
    shows.show_answer(answer)
    shown = capsys.readouterr().out
    found = [shown.index(text) for text in ("disc_tooth_errors (oval form + scatter)", "\n  oval form:\n", "4 um", "\n  scatter:\n", "1 um")]
    assert found == sorted(found)


def test_every_form_that_fits_as_well_is_named_with_its_values(capsys):
    """Four springs fitted alike; screen and page named one."""
    springs = {"first_stage": "first_stage_compliance", "carrier": "carrier_compliance", "housing": "housing_compliance"}
    parts = [{"name": f"support_compliance.{form}", "parameters": {name: {"value": k * 1e-8, "interval": (k * 9e-9, k * 1.1e-8), "unit": "rad/(N.m)"}}, "part": "plant",
              "share_explained": 1.0, "at_bounds": [], "held_out_error_before": None, "held_out_error_after": None,
              "reason": "fits as well as support_compliance.first_stage" if k > 1 else ""} for k, (form, name) in enumerate(springs.items(), 1)]  # fmt: skip
    (effect,) = merged(parts, {"support_compliance.first_stage"})
    answer = answer_of(SET, True)
    answer.effects, answer.confusable = [effect], ["support_compliance", "support_hysteresis"]
    answer.model = SimpleNamespace(campaign=SimpleNamespace(), file=load_model("RV20E-121"))
    answer.diagnosis.fits.members = []
    shows.show_answer(answer)
    shown = " ".join(capsys.readouterr().out.split())
    assert "support_compliance (first stage, carrier or housing) explains" in shown
    assert shown.count("or carrier (fits as well as support_compliance.first_stage): carrier_compliance = 6.875e-05") == 1
    assert shown.count("housing_compliance = 0.0001031") == 1
    assert "cannot tell apart: support_compliance (first stage, carrier or housing), support_hysteresis;" in shown
    answer.diagnosis.fits.space.training = []
    rows = evidence.effects(answer).tables[0].rows
    assert [row[0] for row in rows] == ["support compliance (first stage, carrier or housing)", "or carrier", "or housing"]
    assert rows[1][-1] == "fits as well as support compliance (first stage)" and rows[0][-1] == ""


def test_error_below_the_noise_is_not_many_times_the_noise(capsys):
    rms = {"hysteresis": {"before": 2e-3, "after": 1e-3, "floor": 80e-3}}
    answer = answer_of(ONE, True, rms)
    said = error_text(answer, answer.effects[0])
    assert "times the noise" not in said and "6.88 arcmin, noise 275 arcmin" in said
    assert not is_shown(answer, answer.effects[0]) and tone(answer) == "fair"
    shows.show_answer(answer)
    assert "0.0006875 arcmin/(N m)" in capsys.readouterr().out


def test_every_view_begins_with_the_number_of_the_comparison_by_its_name(capsys):
    """15.65 -> 1.00 stood in a comparison, 419 -> 1.33 in the diagnosis of the same, both as error over noise."""
    rms = {"transmission_error": {"before": 47e-6, "after": 3e-6, "floor": 3e-6}}
    answer = answer_of(ONE, True, rms)
    assert error_text(answer, answer.effects[0]) == (
        "error over noise, all samples, on unused runs: transmission error 15.67 -> 1.00;"
        " misfit in the patterns 28.00 -> 1.20 (what the verdict counts; 1: what noise leaves there)"
    )
    _, reason = verdict_of(HeldOut(419.0, 1.2, 0.5, rms, "held-out runs"))
    assert reason.startswith("error over noise, all samples, on unused runs: transmission error 15.67 -> 1.00; misfit in the patterns 419.00 -> 1.20 (")
    rows = [{"signal": "transmission_error", "held_out": held, "unit": "rad", "before": 47e-6, "after": 3e-6, "noise_floor": 3e-6} for held in (False, True)]
    step = {"campaign": "c", "effects": ["play"], "signals": rows, "held_out_before": 419.0, "held_out_after": 1.2}
    shows.show_ladder(replace(load_model("RV20E-121"), steps=(step,)))
    shown = " ".join(capsys.readouterr().out.split())
    assert "15.67 -> 1.00" in shown and "error over noise, all samples: of the signal that was furthest off, of unused runs where there are, 1: noise alone" in shown


@pytest.mark.parametrize(("verdict", "head"), [(NONE, "what came nearest, none of it significant"), (ONE, "closest rivals")])
def test_of_nothing_there_are_no_rivals(capsys, verdict, head):
    answer = answer_of(verdict, True)
    answer.diagnosis.rejected = [{"name": "drag", "chi2_difference": None, "reason": "score test: p = 1"}]
    answer.model.bench = SimpleNamespace(tables=())
    answer.effects = []
    shows.show_answer(answer)
    assert f"\n{head}\n  drag: " in capsys.readouterr().out


def test_only_what_unused_runs_show_is_good():
    rms = {"hysteresis": {"before": 80e-3, "after": 3e-3, "floor": 3e-3}}
    assert tone(answer_of(ONE, True, rms)) == "good"
    # Without held-out runs, with conditions left out in turn, and where nothing fell.
    alone = answer_of(ONE, False, kind="leave one condition out")
    assert tone(alone) == "fair" and "no run is held out" in error_text(alone, alone.effects[0])
    assert tone(answer_of(ONE, True, rms, after=27.9)) == "fair"


def test_a_stopped_diagnosis_does_not_deny_that_runs_are_held_out():
    stopped = answer_of(STOPPED, True, kind="leave one condition out")
    assert error_text(stopped, stopped.effects[0]) == (
        "the runs that are held out are not judged yet; leaving out one condition at a time: misfit of a condition 28.00 -> 1.20 (1: noise alone)"
    )
    assert tone(answer_of(NONE, True)) == "good" and tone(answer_of(NONE, False)) == "plain"


def test_green_is_kept_for_held_out_runs():
    assert shows.ratio_colour(1.0, True) == "green" and shows.ratio_colour(1.0, False) == "" and shows.ratio_colour(3.0, True) == "red"
    assert styled(("x", "bold")).plain == "x"
