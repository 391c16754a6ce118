"""The pages of the loop: complete, offline, equal bytes for equal results, true to the numbers, also where there is little to show."""

import json
import re
import xml.etree.ElementTree as ET
from dataclasses import dataclass, replace
from types import SimpleNamespace

import numpy as np
import plotly.graph_objects as go
import pytest
from shared import unpacked

from cli.show.comparison import show_answer
from discrepancy.alike.other_places import LookAlike, place_text
from discrepancy.compare import Comparison, by_signal, warnings_of
from discrepancy.experiment.next_run import NextRun
from discrepancy.extend import DID_NOT_HELP, HELPED, NOT_PROVEN, Extension
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.law.recover import recover
from discrepancy.inference.misfit.localise import Localisation
from discrepancy.inference.next_experiment import NextExperiment, Proposal
from discrepancy.inference.verdict import INCOMPLETE, NONE, ONE, SET, SEVERAL, STOPPED, UNKNOWN
from discrepancy.model_file import ModelFile
from discrepancy.page import amounts, ladder_picture, write_page
from discrepancy.page.answer import headline
from discrepancy.page.changed_figures import changed_figures
from discrepancy.page.response import averaged
from discrepancy.page.runs import runs_of
from discrepancy.page.series import whose_noise
from discrepancy.page.spectra import sizes, spectrum
from discrepancy.problem import Candidate, Parameter, Record
from discrepancy.scales import AXES
from discrepancy.verdict import Answer, effects_of
from discrepancy.words.intervals import UNDETERMINED
from pages.words import counted

ARCSEC = np.pi / 180.0 / 3600.0
ANGLE = np.linspace(0.0, 2.0 * np.pi, 240, endpoint=False)
CANDIDATES = (
    Candidate("clearance", "clearance", (Parameter("gap", "m", 0.0, 0.0, 1e-4, 1e-6, 1),), signals=("transmission_error",)),
    Candidate("sensor_gain.input_torque", "gain", (Parameter("gain", "1", 0.0, -0.5, 0.5, 0.02),), signals=("input_torque",), part="chain"),
    Candidate("runout", "runout", (Parameter("run_c", "rad", 0.0, -1e-2, 1e-2, 1e-6), Parameter("run_s", "rad", 0.0, -1e-2, 1e-2, 1e-6)),
              signals=("transmission_error",)),
)  # fmt: skip
FRICTION = Parameter("friction", "1", 0.01, 0.0, 0.1, 1e-3, prior=5e-4, description="coefficient")


def law(record, v):
    load = record.factors["load"]
    if record.quantity == "input_torque":
        return np.full(1, v.get("friction", 0.01) * load * (1.0 + v.get("gain", 0.0)))
    return (3.0 * ARCSEC * np.cos(40 * ANGLE) + 2.0 * (v.get("gap", 0.0) + v.get("tilt", 0.0)) * load / 167.0 * np.cos(20 * ANGLE)
            + v.get("run_c", 0.0) * np.cos(ANGLE) + v.get("run_s", 0.0) * np.sin(ANGLE))  # fmt: skip


@dataclass
class Model:
    """What the pages ask of a physical model."""

    records: list
    file: object
    campaign: object
    nuisances: tuple = (FRICTION,)
    candidates: tuple = CANDIDATES
    unpredicted: tuple = ()

    def predict(self, values, which=None):
        return [law(self.records[i], values) for i in (range(len(self.records)) if which is None else which)]


def model_of(hidden=None, held=True, extra=None):
    rng = np.random.default_rng(4)
    records = []
    for k, load in enumerate((50.0, 100.0, 130.0, 167.0, 80.0)):
        factors = {"speed": 190.0, "load": load, "temperature": 293.0 + 5.0 * (k % 2)}
        for replicate in range(2):
            for quantity, unit, size in (("transmission_error", "rad", ARCSEC), ("input_torque", "N.m", 0.01)):
                axes = {"angle": ANGLE} if quantity == "transmission_error" else {}
                record = Record(f"{quantity} {k} {replicate}", quantity, unit, f"load {load:g}", replicate, np.zeros(1), axes, factors, "1", held and k == 4)
                values = law(record, hidden or {})
                if extra and axes:
                    values = values + extra(load)
                records.append(replace(record, values=values + size * rng.normal(size=values.size)))
    file = SimpleNamespace(name="gearbox <7>", heading="gearbox <7>", effects={}, in_words="the base model")
    return Model(records, file, SimpleNamespace(name="bench & bolt", rig=None, records=(), copies={}, speed_at="output", ratio=100.0))


def compared(model):
    doctor = Diagnostician(model)
    doctor.prepare()
    space = doctor.space
    predictions = space.predictions(space.base.values, list(range(len(space.records))))
    runs = []
    for record, y, w in zip(space.records, predictions, space.noise.whiteners):
        error, floor = float(np.sqrt(np.mean((record.values - y) ** 2))), float(np.sqrt(np.mean(w.scale**2)))
        runs.append({"run": record.name, "signal": record.quantity, "condition": record.condition, "replicate": record.replicate, "held_out": record.held_out,
                     "unit": record.unit, "samples": y.size, "dropped": 0, "error": error, "noise_floor": floor, "ratio": error / floor})  # fmt: skip
    return Comparison(model, doctor, runs, by_signal(runs), dict(space.base.values), warnings_of(model, []), predictions)


def diagnosed(model):
    doctor = Diagnostician(model)
    found = doctor.run()
    laws = recover(found.fits.space, found.fits.space.base, ["transmission_error"]) if found.verdict == UNKNOWN else []
    return Answer(model, found, found.verdict, found.reason, effects_of(found, doctor), found.confusable, laws, list(found.warnings), [], doctor)


def spike(load):
    return 8.0 * ARCSEC * np.exp(-(((ANGLE - 2.0) / 0.3) ** 2)) * load / 167.0


@pytest.fixture(scope="module")
def comparison():
    return compared(model_of({"gap": 2e-6}))


@pytest.fixture(scope="module")
def answer():
    found = diagnosed(model_of({"gap": 2e-6 * 5}))
    assert found.verdict == ONE and found.effects[0]["name"] == "clearance"
    return found


def step(effect, before, after, verdict, **more):
    half = [None if v is None else 0.5 * v for v in (before, after)]
    signals = [{"signal": "transmission_error", "held_out": held, "unit": "rad", "before": 8e-6, "after": 4e-6, "noise_floor": 3e-6} for held in (False, True)]
    return {"campaign": "bench", "effects": [effect], "verdict": verdict, "reason": f"because of {effect}", "kept": verdict != DID_NOT_HELP,
            "training_before": 6.0, "training_after": 2.0, "held_out_before": before, "held_out_after": after,
            "held_out_error_before": half[0], "held_out_error_after": half[1], "signals": signals} | more  # fmt: skip


def file_of(*steps):
    effects = {"clearance": {"gap": {"value": 2.1e-6, "unit": "m", "low": 1.9e-6, "high": 2.3e-6}}}
    return ModelFile("gearbox 7", SimpleNamespace(name="RV20E-121"), {}, effects if steps else {}, tuple(steps))


STEPS = (step("clearance", 12.34, 3.21, HELPED), step("sensor_gain.input_torque", 3.21, 4.56, DID_NOT_HELP),
         step("runout", None, None, NOT_PROVEN), step("drag", 3.21, 1.05, HELPED))  # fmt: skip


def written(result, tmp_path):
    """The page's text; checks what every page must fulfil."""
    one, two = write_page(result, tmp_path / "one.html"), write_page(result, tmp_path / "two.html")
    assert one.read_bytes() == two.read_bytes() and one.stat().st_size < 7e6
    page = one.read_text(encoding="utf-8")
    markup = re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
    assert not re.search(r"https?:|@import|url\(|<link|<img|<iframe", markup)
    assert not re.search(r"<script[^>]*\bsrc", page) and "plotly.js v" in unpacked(page)
    links = re.findall(r'href="#([^"]*)"', markup)
    assert all(re.search(rf'<(section|details class="fold notes") id="{name}"', markup) for name in links)
    figures = figures_of(page)
    assert [f["name"] for f in figures] == re.findall(r'class="plot" id="plot-(\w+)"', markup)
    for figure in figures:
        go.Figure(figure["data"], figure["layout"])
        for choice in figure["choices"]:
            assert len(choice["traces"]) == len(figure["data"])
            go.Figure([t | u for t, u in zip(figure["data"], choice["traces"])], figure["layout"] | choice["layout"])
    return page


def figures_of(page):
    return json.loads(re.search(r'<script type="application/json" id="content">(.*?)</script>', page, re.DOTALL)[1])["figures"]


def figure(page, name):
    return next(f for f in figures_of(page) if f["name"] == name)


def test_comparison_shows_every_run_and_error(comparison, tmp_path):
    page = written(comparison, tmp_path)
    assert "gearbox &lt;7&gt; against bench &amp; bolt" in page
    worst = max(comparison.signals, key=lambda s: s["ratio"])
    assert amounts.text(worst["error"], worst["unit"]) in page and amounts.number(worst["ratio"]) in page
    series = figure(page, "run_transmission_error")
    assert len(series["choices"]) == 5 and "load 80 (held out)" in page
    measured = next(t for t in series["data"] if t.get("name") == "measured")
    first = next(r for r in comparison.model.records if r.quantity == "transmission_error")
    assert measured["y"] == pytest.approx(first.values / ARCSEC, abs=0.02)
    numbers = figure(page, "run_number_input_torque")
    shown = [y for t in numbers["data"][:4:2] for y in t["y"]]
    assert sorted(shown) == pytest.approx(sorted(float(r.values[0]) for r in comparison.model.records if r.quantity == "input_torque"), rel=1e-3)
    heat = figure(page, "error_map")["data"][0]
    assert len(heat["y"]) == 2 and len(heat["x"]) == 5 and "held out" in heat["x"][-1]
    assert "friction" in page and "± 0.000500" in page
    place = figure(page, "place")["data"][0]
    best = comparison.diagnostician.localisation.findings[0]
    named = [f for f in comparison.diagnostician.localisation.findings if not f.feature.startswith("order ")]
    assert not named or any(f"{100 * named[0].share:.0f} %" in row for row in place["text"])
    assert best.feature in page


def far_off(model):
    """One sample of one repetition 500 times its noise off."""
    k = next(k for k, r in enumerate(model.records) if r.name == "transmission_error 3 1")
    values = model.records[k].values.copy()
    values[60] += 500.0 * ARCSEC
    model.records[k] = replace(model.records[k], values=values, far_off=(60,))
    return model


def test_a_sample_far_off_is_a_mark_at_the_edge_and_stretches_no_axis(comparison, tmp_path):
    found = figure(written(compared(far_off(model_of({"gap": 2e-6}))), tmp_path), "run_transmission_error")
    # The conditions in their order, held-out ones last.
    choice = found["choices"][3]
    drawn = [y for t in choice["traces"][:-1] for y in t["y"] if y is not None]
    [mark] = choice["traces"][-1]["y"]
    measured = [y for t in choice["traces"][2:6:2] for y in t["y"] if y is not None]
    assert max(map(abs, drawn)) < 20.0 and mark == pytest.approx(max(measured), abs=0.01)
    assert float(choice["traces"][-1]["text"][0]) == pytest.approx(500.0, abs=15.0) and choice["traces"][-1]["x"] == [90]
    assert all(c["traces"][-1]["x"] == [] for c in found["choices"] if c is not choice) and "far off" in found["data"][-1]["hovertemplate"]
    # Where there is none, nothing is drawn for it.
    assert len(figure(written(comparison, tmp_path), "run_transmission_error")["data"]) == len(found["data"]) - 1


def test_a_mean_of_repetitions_leaves_out_what_stands_far_off():
    result = compared(far_off(model_of({"gap": 2e-6})))
    runs = [r for r in runs_of(result.diagnostician.space, result.predictions, AXES["speed"]) if r.record.name in ("transmission_error 3 0", "transmission_error 3 1")]
    [mean] = averaged(runs)
    # Bands of means and of single runs stood under one caption.
    assert whose_noise(runs) == "a single run" and whose_noise([mean]) == "a mean of 2 replicates"
    assert whose_noise([mean, *runs]) == "a mean of 1 or 2 replicates (1: a single run)"
    assert mean.measured[60] == pytest.approx(runs[0].measured[60]) and mean.measured[61] == pytest.approx(np.mean([r.measured[61] for r in runs]))
    # A spike of 500 arcsec would stand with 4 at all orders.
    assert sizes(spectrum(runs[1:]).measured)[np.arange(121) % 20 > 0].max() < 0.5 * ARCSEC and spectrum(runs).bridged == 1


def test_comparison_without_findings_held_out_runs_or_nuisances(tmp_path):
    model = model_of(held=False)
    model.nuisances = ()
    result = compared(model)
    quiet = Localisation([replace(g, p=1.0) for g in result.diagnostician.localisation.groups], {}, 0.001)
    result.diagnostician.localisation = quiet
    page = written(result, tmp_path)
    assert "no run is held out" in page and "No place, order or dependence carries a significant misfit" in page
    assert "Nothing was declared for calibration" in page and "(held out)" not in page


def test_comparison_begins_with_what_one_asks_first(comparison, tmp_path):
    """Numbers, then curves with the orders of both over each other, then maps; the answer before the doubts."""
    page = written(comparison, tmp_path)
    places = [page.index(f'<section id="{name}">') for name in ("runs", "errors", "localisation", "nuisances")]
    assert places == sorted(places) and all(f'<section id="{name}">' not in page[places[0]:] for name in ("figures",))
    orders = figure(page, "orders_transmission_error")
    assert [t["name"] for t in orders["data"]] == ["measured", "predicted"]
    assert '<ul class="warnings">' not in page or page.index('<div class="cards">') < page.index('<ul class="warnings">')
    assert counted(1, "condition") == "1 condition" and counted(2, "run") == "2 runs"


def test_notes_of_a_comparison_stand_behind_its_key_figures(comparison, tmp_path):
    """They stood before them, as in no other view."""
    figure = KeyFigure("hysteresis", "20 degC", "lost motion", "rad", 3e-4, 4e-4, 1e-6, 3, True)
    page = written(replace(comparison, figures=[figure], warnings=["said of it"]), tmp_path)
    assert page.index('<section id="figures">') < page.index("said of it") < page.index('<section id="runs">')


def test_diagnosis_of_one_effect(answer, tmp_path):
    page = written(answer, tmp_path)
    best = answer.effects[0]
    assert "The model lacks clearance." in page
    value, interval, unit = amounts.estimate(best["parameters"]["gap"])
    assert unit == "µm" and f">{value}<" in page and f">{interval}<" in page
    bars = figure(page, "held_out")["data"]
    assert (bars[0]["x"][0], bars[1]["x"][0]) == pytest.approx((best["held_out_error_before"], best["held_out_error_after"]), rel=1e-3)
    assert all(r["reason"] in page for r in answer.diagnosis.rejected)
    response = figure(page, "response_transmission_error")
    effect = next(t for t in response["data"] if t.get("name") == "effect")
    load = response["choices"][0]
    assert max(effect["y"]) == pytest.approx(2e-5 * 50.0 / 167.0 / ARCSEC, rel=0.1) and len(load["traces"]) == len(response["data"])
    orders = figure(page, "response_orders_transmission_error")["data"][1]
    assert orders["x"][int(np.argmax(orders["y"]))] == "20"


def test_parts_that_look_alike_are_counted_in_the_headline_and_named_below(answer, tmp_path):
    """It had 40 words of four lobes and of the zero that leaves two of them open."""
    others = [LookAlike("crank 2 at disc 2", False, None), LookAlike("crank 1 at disc 2", True, None), LookAlike("crank 2 at disc 1", True, None)]
    for alike, said in ((others, "one of 3 places that look alike"), (others[1:2], "one that looks alike")):
        place = place_text("crank 1 at disc 1", alike, 0.0785)
        placed = replace(answer, effects=[answer.effects[0] | {"variant": "", "place": place, "other_places": [other.place for other in alike]}])
        assert headline(placed) == f"The model lacks clearance (crank 1 at disc 1, or {said})."
        assert f"clearance ({place})" in written(placed, tmp_path)


def test_which_form_and_part_it_is_stands_in_the_headline_and_not_on_the_cards(answer):
    """It stood four times above the evidence."""
    from discrepancy.page.answer import cards

    placed = replace(answer, effects=[answer.effects[0] | {"place": "throw of the eccentric, crank 1 at disc 1"}])
    assert headline(placed) == "The model lacks clearance (throw of the eccentric, crank 1 at disc 1)."
    notes = [card.note for card in cards(placed)]
    assert "best: clearance" in notes and not any("crank 1" in note for note in notes)


def test_an_interrupted_diagnosis_calls_effects_as_every_other_page_does(answer, tmp_path):
    """crank_lobe_errors.crank_1 stood in its headline."""
    reason = "stopped while looking for what is missing beside raceway_wear.inner; best so far: crank_lobe_errors.crank_1 + base.mesh_stiffness"
    stopped = replace(answer, verdict=STOPPED, reason=reason)
    told = "beside raceway wear (inner); best so far: crank eccentric errors (crank 1) + base (mesh stiffness)"
    assert told in headline(stopped) and "crank_lobe_errors" not in written(stopped, tmp_path)


def test_diagnosis_of_a_set_shows_what_is_alike(answer, tmp_path):
    effects = [*answer.effects, answer.effects[0] | {"name": "backlash", "held_out_error_before": None}]
    twins = replace(answer.diagnosis, correlations={"clearance ~ backlash": 0.9987}, confusable=["clearance", "backlash"])
    page = written(replace(answer, verdict=SET, diagnosis=twins, effects=effects, confusable=["clearance", "backlash"]), tmp_path)
    assert "cannot tell apart: clearance and backlash" in page
    assert "0.999" in str(figure(page, "correlations")["data"][0]["text"])


def test_diagnosis_of_nothing(tmp_path):
    found = diagnosed(model_of())
    assert found.verdict == NONE
    page = written(found, tmp_path)
    assert "The model is adequate" in page and 'id="effects"' not in page and 'id="laws"' not in page


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
    left = replace(found.diagnosis, rejected=[*found.diagnosis.rejected, {"name": "tilt", "chi2_difference": 8009.0, "reason": "fits worse by 8009.0 in chi-square"}])
    found = replace(found, diagnosis=left)
    show_answer(found)
    told = " ".join(capsys.readouterr().out.split())
    assert "runout alone it takes away 93 % of the misfit; added to the others, < 1 % more of it" in told
    assert told.count("misfit in the patterns") == 1 and "together this explains" in told
    assert "in place of clearance, beside the others, could stand: tilt" in told and "tilt: " not in told.partition("closest rivals")[2]
    page = written(found, tmp_path)
    bars = figure(page, "shares")["data"]
    assert [t["name"] for t in bars] == ["alone", "added to the others"] and bars[0]["text"][0] == "93 %" and bars[1]["text"][0] == "< 1 %"
    assert len(figure(page, "held_out")["data"][0]["y"]) == 1 and "8009" not in page
