"""Pages of ladders, extensions, the next experiment, and of answers that are not plain: true to the numbers."""

import json
import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest
from page_model import ARCSEC, CANDIDATES, STEPS, compared, diagnosed, figure, figures_of, file_of, model_of, named, spike, step, written

from cli.show.comparison import show_answer
from discrepancy.experiment.next_run import NextRun
from discrepancy.extend import DID_NOT_HELP, HELPED, NOT_PROVEN, Extension
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.next_experiment import NextExperiment, Proposal
from discrepancy.inference.verdict import INCOMPLETE, SEVERAL, UNKNOWN
from discrepancy.page import amounts, ladder_picture, write_page
from discrepancy.page.answer import headline
from discrepancy.page.changed_figures import changed_figures
from discrepancy.problem import Candidate, Parameter
from discrepancy.words.intervals import UNDETERMINED


@pytest.fixture(scope="module")
def answer():
    return named()


def test_law_without_a_name(tmp_path):
    model = model_of(extra=spike)
    model.candidates = CANDIDATES[:2]
    found = diagnosed(model)
    assert found.verdict == UNKNOWN and found.laws
    page = written(found, tmp_path)
    law = found.laws[0]
    form = law.forms[0]
    assert form.text in page and f"{100 * form.confidence:.0f} %" in page
    curve = figure(page, "law_transmission_error")
    assert {t["name"] for t in curve["data"]} >= {"95 %", "measured, averaged", "curve"}
    bare = replace(found, laws=[], diagnosis=replace(found.diagnosis, rejected=[], localisation={"findings": [], "map": [], "conditions": {}, "level": 0.001}))
    empty = written(bare, tmp_path)
    assert "No law was recovered" in empty and "No rival came near" in empty


def test_ladder_shows_steps_that_did_not_help(tmp_path):
    page = written(file_of(*STEPS), tmp_path)
    assert "3 of 4 steps are part of the model" in page and "fell from 12.3 to 1.05" in page
    assert "Did not help: sensor gain (input torque)" in page and "because of sensor_gain.input_torque" in page
    stairs = next(t for t in figure(page, "ladder")["data"] if t.get("name") == "unused runs")
    assert [v for v in stairs["y"] if v is not None][:3] == [12.34, 12.34, 3.21] and 4.56 not in stairs["y"]
    cross = [t for t in figure(page, "ladder")["data"] if t.get("marker", {}).get("symbol") == "x"]
    assert [4.56] in [t["y"] for t in cross]
    assert ">2.10<" in page and "1.90 to 2.30" in page
    assert "No step yet" in written(file_of(), tmp_path)


def test_extension_says_what_it_did(tmp_path):
    failed = written(Extension(file_of(*STEPS[:2]), STEPS[1], DID_NOT_HELP), tmp_path)
    assert "did not help" in failed and "3.21" in failed and "4.56" in failed and amounts.text(4e-6, "rad") in failed
    unproven = written(Extension(file_of(STEPS[2]), STEPS[2], NOT_PROVEN), tmp_path)
    assert "No run was held out" in unproven


def test_an_extension_shows_its_key_figures_before_and_with_the_effect(tmp_path):
    """Only a comparison of the new model did, beside what was measured alone."""
    pairs = []
    for k in range(14):
        before = KeyFigure("hysteresis", f"{k} degC", "lost motion" if k else "torsional stiffness", "rad" if k else "N.m/rad", 3e-4, (4.0 - 0.1 * k) * 1e-4, 1e-6, 3, True)
        pairs.append((before, replace(before, model=3.01e-4)))
    extension = Extension(file_of(*STEPS[:2]), STEPS[1], HELPED, figures=pairs)
    few, every = changed_figures(extension)[0].tables
    assert len(few.rows) == 2 and len(every.rows) == 14 and every.folded == "All 14 key figures"
    row = next(row for row in few.rows if row[2] == "lost motion")
    assert row[3:] == ["1.0313 arcmin", "0.0034 arcmin", "1.3407 arcmin", "1.0348 arcmin", "90.0 → 1.00"]
    assert "model before" in written(extension, tmp_path)
    assert changed_figures(replace(extension, figures=[])) == []


def test_next_experiment(answer, tmp_path):
    proposals = [Proposal("input_torque at 500 rpm, 20 degC", {}, 300.0, 20.0, 12.5, {"a ~ b": 12.5, "a ~ c": 27.5}),
                 Proposal("input_torque at 900 rpm, 20 degC", {}, 100.0, 2.0, 0.001, {"a ~ b": 0.001, "a ~ c": 4.0})]  # fmt: skip
    found = NextExperiment(True, "input_torque at 500 rpm, 20 degC separates all rivals", proposals, {"input_torque at 500 rpm, 20 degC": 0.25})
    page = written(NextRun(answer, found, ["a", "b", "c"], found.verdict), tmp_path)
    assert "1 of 2 possible experiments" in page and "0.25 N m" in page and "&lt; 0.01" in page
    cost, least = figure(page, "ranking")["data"]
    assert cost["x"] == [300, 100] and least["x"] == [12.5, 0]
    nothing = written(NextRun(answer, None, ["clearance"], "nothing is left to separate: clearance stands alone"), tmp_path)
    assert "clearance stands alone" in nothing and not figures_of(nothing)
    off = "no effect is missing: the base model is off (mesh.stiffness); correct it"
    assert "No effect is missing: the base model is off (mesh.stiffness). Correct it." in written(NextRun(answer, None, [], off), tmp_path)
    none = NextExperiment(False, "cannot be separated on this rig", proposals[1:], {})
    assert "None of 1 possible experiments" in written(NextRun(answer, none, ["a", "b"], none.verdict), tmp_path)


def test_ladder_picture_is_a_plain_svg(tmp_path):
    one, two = ladder_picture(file_of(*STEPS), tmp_path / "a.svg"), ladder_picture(file_of(*STEPS), tmp_path / "b.svg")
    assert one.read_bytes() == two.read_bytes() and one.stat().st_size < 20e3
    text = one.read_text(encoding="utf-8")
    words = " ".join(ET.fromstring(text).itertext())
    assert all(t in words for t in ("12.34", "3.21", "1.05", "4.56", "clearance", "did not help, not kept", "noise"))
    assert "href" not in text
    for file in (file_of(), file_of(STEPS[2]), file_of(step("a<b", 5.0, 2.0, HELPED))):
        ET.fromstring(ladder_picture(file, tmp_path / "c.svg").read_text(encoding="utf-8"))


def test_amounts_are_in_the_units_of_a_bench():
    assert amounts.text(5 * ARCSEC, "rad") == "5.00 arcsec" and amounts.text(2e-6, "m") == "2.00 µm" and amounts.text(None, "m") == "–"
    assert amounts.estimate({"value": 3.1e9, "interval": [2e9, 4e9], "unit": "Pa"}) == ("3.10", "2.00 to 4.00", "GPa")
    assert amounts.estimate({"value": 2.0, "interval": [2.0, 2.0], "unit": "s/m"})[1] == UNDETERMINED
    assert amounts.estimate({"value": 1.0, "interval": [0.5, 1.5], "unit": "no such unit"})[2] == "no such unit"
    assert amounts.signal_title("wear_depth[disc=1,surface=inner_race]") == "wear depth (disc 1, surface inner race)"


def test_other_results_have_no_page(tmp_path):
    with pytest.raises(TypeError, match="Comparison"):
        write_page(object(), tmp_path / "x.html")


def test_nothing_is_green_that_no_unused_run_has_shown(answer, tmp_path):
    assert 'class="card good"' in written(answer, tmp_path)
    for result in (compared(model_of(held=False)), diagnosed(model_of({"gap": 1e-5}, held=False)), diagnosed(model_of(held=False))):
        page = written(result, tmp_path)
        assert 'class="card good"' not in page and "#00705a" not in json.dumps(figures_of(page)) and "#e6f3ec" not in page


def test_named_but_incomplete_does_not_explain_all(answer, tmp_path):
    left = {"findings": [{"signal": "input_torque", "feature": "value", "dependence": "load", "p": 1e-8}]}
    diagnosis = replace(answer.diagnosis, verdict=INCOMPLETE, captured=0.999, leftover=left)
    effects = [answer.effects[0] | {"share_explained": 0.999}]
    page = written(replace(answer, verdict=INCOMPLETE, diagnosis=diagnosis, effects=effects), tmp_path)
    assert not re.search(r"(explains?|is|>) ?100 %", re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL))
    assert "something else is left" in page and "input_torque, value, changing with load" in page


def test_alternatives_that_leave_something_are_not_said_to_be_needed_together(answer):
    effects = [answer.effects[0], answer.effects[0] | {"name": "pin_ring"}]
    left = {"findings": [{"signal": "input_torque", "feature": "value", "dependence": "load", "p": 1e-8}]}
    both = replace(answer, verdict=INCOMPLETE, effects=effects, diagnosis=replace(answer.diagnosis, verdict=INCOMPLETE, leftover=left))
    assert " are part of what the model lacks" in headline(both)
    said = headline(replace(both, confusable=[e["name"] for e in effects]))
    assert said.startswith("One of 2 effects that this campaign cannot tell apart, ") and " is part of what the model lacks, but something else is left" in said


def test_speeds_stand_where_the_campaign_states_them(tmp_path):
    model = model_of({"gap": 2e-6})
    model.records = [replace(r, factors=r.factors | {"speed": 190.0 + 10.0 * k}) for k, r in enumerate(model.records)]
    page = written(compared(model), tmp_path)
    over = next(c for c in figure(page, "run_number_input_torque")["choices"] if "speed" in str(c["layout"]))
    title = over["layout"]["xaxis"]["title"]
    assert "output speed [rpm]" in str(title) and over["traces"][0]["x"][0] == pytest.approx(19.1, abs=0.01)


def test_several_effects_have_two_shares_and_one_error(tmp_path, capsys):
    """The share beside the others is small where effects do alike; a stand-in is no rival that was turned down, and errors are those of all together."""
    model = model_of({"gap": 1e-5, "run_c": 2e-5, "run_s": 1e-5})
    model.candidates = (*CANDIDATES, Candidate("tilt", "tilt", (Parameter("tilt", "m", 0.0, 0.0, 1e-4, 1e-6, 1),), signals=("transmission_error",)))
    found = diagnosed(model)
    assert found.verdict == SEVERAL and found.diagnosis.alternatives == {"clearance": ["tilt"]}
    found.effects[0]["share_alone"], found.effects[0]["share_explained"] = 0.93, 0.001
    assert 0.0 < found.effects[1]["share_alone"] < 1.0
    # In JSON, too, what stands beside them is not turned down, and has its value.
    assert "tilt" not in {r["name"] for r in found.diagnosis.rejected}
    (other,) = found.in_si()["stand_ins"]["clearance"]
    assert other["name"] == "tilt" and other["parameters"]["tilt"]["value"] == pytest.approx(1e-5, rel=0.1)
    show_answer(found)
    told = " ".join(capsys.readouterr().out.split())
    assert "runout alone it takes away 93 % of the misfit; added to the others, < 1 % more of it" in told
    assert told.count("misfit in the patterns") == 1 and "together this explains" in told
    assert "in place of clearance, beside the others, could stand: tilt (tilt = " in told and "tilt: " not in told.partition("closest rivals")[2]
    page = written(found, tmp_path)
    bars = figure(page, "shares")["data"]
    assert [t["name"] for t in bars] == ["alone", "added to the others"] and bars[0]["text"][0] == "93 %" and bars[1]["text"][0] == "< 1 %"
    assert len(figure(page, "held_out")["data"][0]["y"]) == 1
