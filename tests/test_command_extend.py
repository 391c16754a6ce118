"""A refusal of ``rvwear extend`` ends with the command line that works."""

import argparse
import json
import shlex
from dataclasses import replace
from types import SimpleNamespace

import pytest

from cli.commands import comparison as commands
from cli.main import main, parser
from discrepancy import extend as extension
from discrepancy.alike.already_there import AlreadyThere
from discrepancy.alike.untold import forms_untold, other_forms
from discrepancy.extend import DID_NOT_HELP, HELPED, Extension, UnknownEffect, variants_of, verdict_of
from discrepancy.inference.held_out.held_out import HeldOut
from discrepancy.inference.verdict import BASE_OFF, INCOMPLETE, NONE, ONE, SET, UNKNOWN
from discrepancy.model_file import load_model
from discrepancy.problem import Candidate
from fmu_src.faults import InputFault
from tests.test_discrepancy_page import diagnosed, model_of


def options(*arguments: str) -> argparse.Namespace:
    return parser().parse_args(["extend", "RV20E-121", "my bench", *arguments])


def answer_of(verdict, names, rejected=(), laws=(), off=()):
    effects = [{"name": n.partition(".")[0], "candidates": [n], "forms": {}} for n in names]
    diagnosis = SimpleNamespace(reason="so it is", rejected=[{"name": n} for n in rejected], base_off=[SimpleNamespace(name=n, explains=e) for n, e in off])
    model = SimpleNamespace(campaign=SimpleNamespace(reducer=None))
    return SimpleNamespace(verdict=verdict, model=model, effects=effects, confusable=list(names) if verdict == SET else [], diagnosis=diagnosis, laws=laws, untold=[])


def lines(text: str) -> list[str]:
    return [line.strip() for line in text.splitlines()[1:]]


def test_each_member_of_a_set_has_its_line():
    given = options("--output", "better model.toml", "--data", "d")
    found = lines(commands.refusal(given, answer_of(SET, ["drag", "pin_ring.oval"])))
    assert found == [f"rvwear extend RV20E-121 'my bench' --effect {name} --data d --output 'better model.toml'" for name in ("drag", "pin_ring.oval")]
    # What is printed is understood, and asks for the same.
    again = parser().parse_args(shlex.split(found[1])[1:])
    assert again.effect == ["pin_ring.oval"] and (again.output, again.data, again.campaign) == (given.output, given.data, given.campaign)


@pytest.mark.parametrize(("verdict", "names", "rejected", "asked"), [
    (INCOMPLETE, ["drag", "backlash"], ["gain"], ["drag", "backlash"]), (NONE, [], ["gain", "drag"], ["gain"]),
])  # fmt: skip
def test_what_is_incomplete_or_nearest_has_its_line(verdict, names, rejected, asked):
    (line,) = lines(commands.refusal(options("--json"), answer_of(verdict, names, rejected)))
    again = parser().parse_args(shlex.split(line)[1:])
    assert again.effect == asked and again.json
    assert "no effect of the catalogue shows" in commands.refusal(options(), answer_of(NONE, []))


@pytest.mark.parametrize(("forms", "asked"), [({"oval": ["a"], "scatter": ["b"]}, ["tooth.oval", "tooth.scatter"]), ({}, ["tooth.oval"])])
def test_all_forms_are_added_that_were_fitted_together_and_one_of_those_that_look_alike(forms, asked):
    answer = answer_of(INCOMPLETE, ["tooth.oval"])
    answer.effects[0] |= {"candidates": ["tooth.oval", "tooth.scatter"], "forms": forms}
    (line,) = lines(commands.refusal(options(), answer))
    assert parser().parse_args(shlex.split(line)[1:]).effect == asked


def test_a_recovered_law_has_the_line_that_drafts_it():
    law = SimpleNamespace(forms=["linear"])
    *_, line = lines(commands.refusal(options("--output", "better.toml"), answer_of(INCOMPLETE, ["drag"], laws=[law])))
    again = parser().parse_args(shlex.split(line)[1:])
    assert (again.draft, again.output, again.effect) == ("effects", "better.toml", None)


@pytest.mark.parametrize(("verdict", "names", "off", "asked"), [
    (INCOMPLETE, ["drag", "backlash"], [("mesh_friction", 9.0)], ["drag", "backlash", "base.mesh_friction"]),
    (BASE_OFF, [], [("mesh_friction", 9.0), ("declared", None)], ["base.mesh_friction"]), (ONE, ["drag"], [], None),
])  # fmt: skip
def test_the_line_after_a_diagnosis_is_not_refused(verdict, names, off, asked):
    given = parser().parse_args(["diagnose", "RV20E-121", "my bench", "--data", "d"])
    line = commands.line_after(given, answer_of(verdict, names, off=off)).partition(" #")[0]
    again = parser().parse_args(shlex.split(line)[1:])
    # Without names ``extend`` adds what is sure, and nothing else.
    assert (again.effect, again.output, again.data, again.campaign) == (asked, "better.toml", "d", "my bench")


def test_a_position_is_said_to_belong_to_the_bench():
    given = parser().parse_args(["diagnose", "RV20E-121", "my bench"])
    assert "state locked_at in the campaign's condition instead" in commands.line_after(given, answer_of(INCOMPLETE, ["locked_position"]))
    assert "locked_at" not in commands.line_after(given, answer_of(INCOMPLETE, ["drag"]))


def test_where_nothing_can_be_added_no_line_says_so():
    given = parser().parse_args(["diagnose", "RV20E-121", "my bench"])
    assert commands.line_after(given, answer_of(BASE_OFF, [], off=[("declared", None)])) == ""
    assert commands.line_after(given, answer_of(UNKNOWN, [])).startswith("rvwear next RV20E-121 'my bench'")
    # An adequate model is there to be used: "none" ended without a word of how one goes on.
    line = commands.line_after(given, answer_of(NONE, [])).partition("    #")[0]
    assert parser().parse_args(shlex.split(line)[1:]).reducer == "RV20E-121"
    assert "--draft effects" in commands.line_after(given, answer_of(UNKNOWN, [], laws=[SimpleNamespace(forms=["linear"])]))


def test_misspelt_effect_has_the_line_with_the_right_name(monkeypatch, capsys):
    candidates = [Candidate("needle_clearance", "", ()), Candidate("pin_position_errors.scatter", "", ())]
    with pytest.raises(UnknownEffect, match="did you mean needle_clearance"):
        variants_of("needle_clearence", candidates, load_model("RV20E-121"))
    with pytest.raises(InputFault) as fault:
        variants_of("phlogiston", candidates, load_model("RV20E-121"))
    assert "did you mean" not in str(fault.value)
    monkeypatch.setattr(commands, "inputs", lambda given: (load_model("RV20E-121"), None))
    monkeypatch.setattr("discrepancy.remembered.remembered", lambda *given, **more: None)
    monkeypatch.setattr("discrepancy.remembered.interrupted", lambda *given, **more: SimpleNamespace())
    monkeypatch.setattr(extension, "extend", lambda file, campaign, names, **more: variants_of(names[1], candidates, file))
    assert main(["extend", "RV20E-121", "c", "--effect", "drag", "--effect", "needle_clearence"]) == 2
    assert capsys.readouterr().err.splitlines()[-1].strip() == "rvwear extend RV20E-121 c --effect drag --effect needle_clearance"


def test_by_the_name_of_an_effect_that_is_there_no_other_form_of_it_is_added():
    """thermal_expansion, given again, added thermal_expansion.heating."""
    file = replace(load_model("RV20E-121"), effects={"thermal_expansion": {"thermal_expansion": {"value": 2e-5, "unit": "1/K"}}})
    heating = Candidate("thermal_expansion.heating", "", ())
    with pytest.raises(AlreadyThere, match=r"twice \(other forms have names of their own: thermal_expansion.heating\)"):
        variants_of("thermal_expansion", [heating], file)
    assert variants_of("thermal_expansion.heating", [heating], file) == [heating]
    assert variants_of("thermal_expansion", [heating], load_model("RV20E-121")) == [heating]


@pytest.mark.parametrize(("settings", "base"), [("", "RV20E-121"), ('[settings]\nbearing.clearance = "3 um"\n', "base.toml")])
def test_effect_that_is_in_the_model_is_said_with_what_fits_it_anew(monkeypatch, capsys, tmp_path, settings, base):
    """Another effect, of a name that looks alike, was proposed."""
    path = tmp_path / "better.toml"
    path.write_text(f"""[model]
name = "better"
reducer = "RV20E-121"
{settings}[effects.hole_position_errors]
carrier_seat_radial = "-6.98 um"
[effects.needle_clearance]
added = "2 um"
[[steps]]
effects = ["hole_position_errors.carrier"]
[[steps]]
effects = ["thermal_expansion"]
kept = false
""")
    candidates = [Candidate("hole_position_errors.disc", "", ()), Candidate("pin_position_errors.runout", "", ())]
    monkeypatch.setattr(commands, "inputs", lambda given: (load_model(path), None))
    monkeypatch.setattr("discrepancy.remembered.remembered", lambda *given, **more: None)
    monkeypatch.setattr("discrepancy.remembered.interrupted", lambda *given, **more: SimpleNamespace())
    monkeypatch.setattr(extension, "extend", lambda file, campaign, names, **more: variants_of(names[0], candidates, file))
    assert main(["extend", str(path), "c", "--effect", "hole_position_errors.carrier"]) == 2
    said, line = capsys.readouterr().err.splitlines()
    assert f"{path} has it already (effects.hole_position_errors.carrier_seat_radial = -6.98 um), and nothing is added twice" in said
    assert "did you mean" not in said and (f"a copy of {path} without" in said) == (base == "base.toml")
    again = parser().parse_args(shlex.split(line)[1:])
    assert (again.model, again.output, again.effect) == (base, "refitted.toml", ["hole_position_errors.carrier", "needle_clearance"])


def test_effect_that_did_not_help_has_the_line_that_keeps_it(monkeypatch, capsys, tmp_path):
    file = load_model("RV20E-121")
    step = {"effects": ["drag"], "reason": "no", "signals": [], "kept": False, "verdict": DID_NOT_HELP, "campaign": "c", "training_before": 2.0, "training_after": 1.0}
    monkeypatch.setattr(commands, "inputs", lambda given: (file, None))
    monkeypatch.setattr("discrepancy.remembered.remembered", lambda *given, **more: None)
    monkeypatch.setattr("discrepancy.remembered.interrupted", lambda *given, **more: SimpleNamespace())
    monkeypatch.setattr(extension, "extend", lambda *given, **more: Extension(file, step, DID_NOT_HELP))
    target = str(tmp_path / "m.toml")
    assert main(["extend", "RV20E-121", "c", "--effect", "drag", "--output", target]) == 3
    said = capsys.readouterr().out
    assert said.splitlines()[-1].strip() == f"rvwear extend RV20E-121 c --effect drag --output {target} --overwrite --anyway" and "next  " not in said
    # The file alone looked like a success.
    assert f"model  {target}    # written without it: the model as it was" in said


def test_what_one_does_with_the_extended_model_stands_below_it(monkeypatch, capsys, tmp_path):
    """It ended with the file."""
    step = {"nuisances": {}, "effects": ["drag"], "reason": "so", "signals": [], "kept": True, "verdict": HELPED, "campaign": "c", "training_before": 2.0, "training_after": 1.0}
    monkeypatch.setattr(commands, "inputs", lambda given: (load_model("RV20E-121"), None))
    monkeypatch.setattr("discrepancy.remembered.extended", lambda file, *given, **more: Extension(replace(file, steps=(step,)), step, HELPED))
    words, target = ["extend", "RV20E-121", "my bench", "--data", "d", "--effect", "drag", "--overwrite"], tmp_path / "better model.toml"
    assert main([*words, "--output", str(target)]) == 0
    *_, compared, diagnosed = capsys.readouterr().out.splitlines()
    for line, head, command in ((compared, "next  ", "compare"), (diagnosed, "then  ", "diagnose")):
        again = parser().parse_args(shlex.split(line.removeprefix(head).partition(" #")[0])[1:])
        assert line.startswith(head) and (again.command, again.model, again.campaign, again.data) == (command, str(target), "my bench", "d")
    # Of a draft the command says it that drafted, with the folder of the effect; beside JSON nothing stands.
    for more in (["--drafted"], ["--json"]):
        assert main([*words, "--output", str(target), *more]) == 0 and "next  " not in capsys.readouterr().out


def test_a_file_that_is_there_is_written_over_only_where_it_is_asked_for(monkeypatch, capsys, tmp_path):
    """Another model, or a reducer's own file, went without a word; the file that the model came from gets its next step as ever."""
    model = tmp_path / "model.toml"
    model.write_text('[model]\nname = "better"\nreducer = "RV20E-121"\n')
    step = {"effects": ["drag"], "reason": "so", "signals": [], "kept": True, "verdict": HELPED, "campaign": "c", "training_before": 2.0, "training_after": 1.0}
    monkeypatch.setattr(commands, "inputs", lambda given: (load_model(given.model), None))
    monkeypatch.setattr("discrepancy.remembered.remembered", lambda *given, **more: None)
    monkeypatch.setattr("discrepancy.remembered.interrupted", lambda *given, **more: SimpleNamespace())
    monkeypatch.setattr(extension, "extend", lambda file, *given, **more: Extension(replace(file, steps=(*file.steps, step)), step, HELPED))
    monkeypatch.chdir(tmp_path)
    other, words = tmp_path / "other.toml", ["extend", str(model), "c", "--effect", "drag"]
    for target, more in ((other, ["--output", str(other)]), (other, ["--output", "other.toml", "--draft", "mine"])):
        target.write_text("mine", encoding="utf-8")
        assert main([*words[: -2 if "--draft" in more else None], *more]) == 2
        said = capsys.readouterr().err
        assert "other.toml exists already and is not overwritten; give another name by --output, or --overwrite" in said
        assert target.read_text(encoding="utf-8") == "mine"
    # A library's reducer has a file of its name by default.
    (tmp_path / "RV20E-121.toml").write_text("mine", encoding="utf-8")
    assert main(["extend", "RV20E-121", "c", "--effect", "drag"]) == 2 and "RV20E-121.toml exists already" in capsys.readouterr().err
    assert main([*words, "--output", str(other), "--overwrite"]) == 0 and len(load_model(other).steps) == 1
    assert main(words) == 0 and main([*words, "--output", "model.toml"]) == 0 and len(load_model(model).steps) == 2


def test_units_of_the_extended_model_are_named_as_those_that_build_makes(monkeypatch, tmp_path, capsys):
    """They were called after the base reducer, although the effect is in them."""
    from studies import building

    file = load_model("RV20E-121")
    step = {"effects": ["drag"], "reason": "so", "signals": [], "kept": True, "verdict": HELPED, "campaign": "c", "training_before": 2.0, "training_after": 1.0}
    effects = {"needle_clearance": {"needle_clearance_added": {"value": 2.0000123e-6, "unit": "m"}}}
    monkeypatch.setattr(commands, "inputs", lambda given: (file, None))
    monkeypatch.setattr("discrepancy.remembered.remembered", lambda *given, **more: None)
    monkeypatch.setattr("discrepancy.remembered.interrupted", lambda *given, **more: SimpleNamespace())
    monkeypatch.setattr(extension, "extend", lambda *given, **more: Extension(replace(file, effects=effects, steps=(step,)), step, HELPED))
    built = []
    monkeypatch.setattr(building, "build_units", lambda reducer, folder, *wanted: built.append(reducer) or ([], []))
    target = str(tmp_path / "better.toml")
    assert main(["extend", "RV20E-121", "c", "--effect", "drag", "--output", target, "--fmus", str(tmp_path / "fmus")]) == 0
    assert main(["build", "--reducer", target, "--output", str(tmp_path / "fmus")]) == 0
    by_extend, by_build = built
    assert by_extend.name == "RV20E-121-better" and by_extend == by_build


@pytest.mark.parametrize(("floor", "said"), [(3.0, False), (300.0, True)])
def test_error_below_the_noise_of_samples_is_not_many_times_the_noise(floor, said):
    judged = HeldOut(28.0, 2.0, 1e-3, {"hysteresis": {"before": 10.0, "after": 1.0, "floor": floor}}, "held-out runs")
    verdict, reason = verdict_of(judged)
    assert verdict == HELPED and "misfit in the patterns 28.00 -> 2.00 (" in reason
    assert "2.0 times what noise leaves in the patterns is still left" in reason
    assert "still left" not in verdict_of(HeldOut(28.0, 1.1, 0.4, judged.rms, "held-out runs"))[1]
    # What chance leaves often enough is nothing to explain.
    assert "still left" not in verdict_of(HeldOut(28.0, 1.6, 0.1, judged.rms, "held-out runs"))[1]
    assert "times the noise" not in reason and ("less than their noise" in reason) == said


def test_of_what_cannot_be_told_apart_and_leaves_something_the_likeliest_is_added_alone():
    """A command that added both was refused."""
    answer = answer_of(INCOMPLETE, ["pin_position_errors.runout", "hole_position_errors.carrier"])
    for effect, after in zip(answer.effects, (10.8, 0.5)):
        effect["held_out_error_after"] = after
    answer.confusable = [e["name"] for e in answer.effects]
    given = parser().parse_args(["diagnose", "RV20E-121", "my bench"])
    line, _, why = commands.line_after(given, answer).partition("    # ")
    again = parser().parse_args(shlex.split(line)[1:])
    assert again.effect == ["hole_position_errors.carrier"] and why == "adds the likeliest of these, and judges it on runs that were not used"


@pytest.mark.parametrize("more", [[], ["--draft", "mine"]])
def test_a_diagnosis_that_names_nothing_to_add_is_no_bad_input(monkeypatch, capsys, tmp_path, more):
    """It ended with 2, that of bad input; 3 says that nothing was added, and JSON has what the diagnosis found."""
    found = diagnosed(model_of())
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(commands, "inputs", lambda given: (load_model(given.model), None))
    monkeypatch.setattr("discrepancy.remembered.diagnosed", lambda *given, **more: found)
    assert found.verdict == NONE and main(["extend", "RV20E-121", "c", *more]) == 3
    out, err = capsys.readouterr()
    assert out == "" and err.startswith("rvwear extend: ") and f"the diagnosis says {NONE!r}" in err
    assert main(["extend", "RV20E-121", "c", "--json", *more]) == 3
    again = capsys.readouterr()
    told = json.loads(again.out)
    assert told["verdict"] == NONE and again.err.strip() == f"rvwear extend: {told['nothing_added']}" and f"says {NONE!r}" in told["nothing_added"]


FORMS = ["support_compliance.carrier", "support_compliance.housing", "support_compliance.first_stage"]


def test_which_other_forms_fit_as_well_is_said_of_what_is_added():
    """The first of several springs was added without a word."""
    others = [{"candidates": [FORMS[1]], "reason": "fits as well as " + FORMS[0]}, {"candidates": [FORMS[2]], "reason": "fits worse by 0.3 in chi-square"}]
    named = {"name": "support_compliance", "candidates": FORMS, "forms": {}, "other_forms": others}
    (text,) = forms_untold({FORMS[0]: other_forms([named], FORMS[0], {FORMS[0]})})
    assert f"{FORMS[0]} was added, and {FORMS[1]}, or {FORMS[2]} (fits worse by 0.3 in chi-square) fits as well" in text
    assert f"rvwear extend with --effect {FORMS[1]} in place of {FORMS[0]} adds the first of these" in text
    # Of what is said in comparison with the first nothing is said beside another; of forms that are all needed none is another's.
    assert other_forms([named], FORMS[2], {FORMS[2]}) == {FORMS[0]: "", FORMS[1]: ""}
    assert forms_untold({FORMS[0]: other_forms([named | {"forms": {"carrier": ["c"]}}], FORMS[0], {FORMS[0]})}) == []


def test_each_form_that_fits_as_well_has_its_line(monkeypatch, capsys, tmp_path):
    step = {"nuisances": {}, "effects": FORMS[:1], "reason": "so", "signals": [], "kept": True, "verdict": HELPED, "campaign": "c", "training_before": 2.0,
            "training_after": 1.0, "other_forms": {FORMS[0]: FORMS[1:]}, "untold": ["which it is"]}  # fmt: skip
    monkeypatch.setattr(commands, "inputs", lambda given: (load_model("RV20E-121"), None))
    monkeypatch.setattr("discrepancy.remembered.extended", lambda file, *given, **more: Extension(replace(file, steps=(step,)), step, HELPED))
    target = str(tmp_path / "better.toml")
    assert main(["extend", "RV20E-121", "my bench", "--effect", "support_compliance", "--output", target]) == 0
    found = [parser().parse_args(shlex.split(line)[1:]) for line in capsys.readouterr().out.splitlines() if line.startswith("  rvwear extend")]
    assert [(line.effect, line.output) for line in found] == [([form], f"{form.replace('.', '_')}.toml") for form in FORMS[1:]]
    # They stand in the file, too, and in JSON.
    assert load_model(target).steps[0]["other_forms"] == {FORMS[0]: FORMS[1:]}
    assert main(["extend", "RV20E-121", "my bench", "--effect", "support_compliance", "--output", target, "--overwrite", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["step"]["other_forms"] == {FORMS[0]: FORMS[1:]}


@pytest.mark.parametrize(("after", "name", "said"), [(14.3, "temperature", "not enough: 14.3 times what noise leaves in the patterns is still left to explain, and it goes with temperature"),
                                                     (14.3, "", "still left to explain"), (1.0, "temperature", "noise leaves there)")])  # fmt: skip
def test_what_helped_and_leaves_much_says_what_it_goes_with(after, name, said):
    """Its error was 14 times the noise, and "helped" was all that stood there."""
    judged = HeldOut(17.0, after, 1e-9, {}, "held-out runs")
    outcome, reason = verdict_of(judged, lambda: name)
    assert outcome == HELPED and reason.endswith(said)


def test_of_conditions_that_go_together_the_one_that_explains_most_is_said():
    left = {"findings": [{"dependence": "everywhere"}, {"dependence": "speed"}], "dependence": {
        "load": {"statistic": 40.0, "width": 2, "p": 1e-9}, "temperature": {"statistic": 90.0, "width": 2, "p": 1e-20}, "axis": {"statistic": 99.0, "width": 2, "p": 0.0}}}  # fmt: skip
    records = [SimpleNamespace(factors={"load": 1.0, "temperature": 2.0, "speed": 3.0})]
    doctor = SimpleNamespace(judgement=SimpleNamespace(leftover=lambda fit: (True, 1.0, left, 2.0)), space=SimpleNamespace(records=records),
                             settings=SimpleNamespace(leftover_level=0.004))  # fmt: skip
    assert extension.goes_with(doctor, None) == "temperature"
    left["dependence"] = {}
    assert extension.goes_with(doctor, None) == "speed"
