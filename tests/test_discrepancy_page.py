"""The pages of the loop: complete, offline, equal bytes for equal results, true to the numbers, also where there is little to show."""

import json
from dataclasses import replace

import numpy as np
import pytest
from page_model import ARCSEC, compared, diagnosed, figure, model_of, named, written

from discrepancy.alike.other_places import LookAlike, place_text
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.inference.misfit.localise import Localisation
from discrepancy.inference.refit.profile import profiles
from discrepancy.inference.verdict import NONE, SET, STOPPED
from discrepancy.page import amounts
from discrepancy.page.answer import headline
from discrepancy.page.profiles import figure as profile_figure
from discrepancy.page.response import averaged
from discrepancy.page.runs import runs_of
from discrepancy.page.series import whose_noise
from discrepancy.page.spectra import sizes, spectrum
from discrepancy.scales import AXES
from pages.words import counted


@pytest.fixture(scope="module")
def comparison():
    return compared(model_of({"gap": 2e-6}))


@pytest.fixture(scope="module")
def answer():
    return named()


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


def test_a_profile_of_a_number_that_nothing_tells_has_its_range_for_a_band(answer):
    """Its infinite deviation was drawn: the page ended with an error, and the answer with it."""
    found = profiles(answer.diagnosis.fits.space, answer.diagnosis.fits.members[0])[0]
    told = next(entry for effect in answer.effects for name, entry in effect["parameters"].items() if name == found.name)
    drawn = profile_figure(0, found, "gap", {**told, "standard_deviation": float("inf"), "interval": (0.0, 1e-4)})
    assert json.dumps([drawn.data, drawn.layout], allow_nan=False) and "the runs say nothing of it" in drawn.caption
