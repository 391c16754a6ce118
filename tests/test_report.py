"""The report: complete, self-contained, equal bytes for equal data, and true to the dataset."""

import html
import json
import re
from dataclasses import replace

import numpy as np
import plotly.graph_objects as go
import pytest
from shared import unpacked

from fmu_src.faults import InputFault
from orchestrator.netcdf import series_dataset
from orchestrator.settings import parse_setting
from pages.words import number
from rv_plant.variables import plant_table
from studies import results
from studies.life import Life, LifeSettings, live
from studies.pair import make_pair
from studies.report import circles, findings, inputs, phase, shapes, spectrum, write_report
from studies.report.page import page_of
from studies.report.result import Result
from wear_fmu.kinematics import flank_arc_per_phase, sliding_per_crank_angle

SECTIONS = ("parts", "turn", "growth", "orders-section", "inputs")
NO_WEAR = ("wear.mesh_coefficient=0", "wear.race_law=constant", "wear.race_coefficient=0")


def short_life(reducer, hours, *texts, positions=24):
    """A life with few positions a turn: quick, and enough to draw."""
    settings = [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts]
    pair = make_pair(reducer, settings, positions=positions)
    life = Life(LifeSettings(hours=max(hours, 1.0), tolerance=0.5, first_jump=100.0))
    spectra = [results.order_spectrum(pair, 0.0, 8)]
    if hours:
        live(pair, life, lambda _: None, lambda _: None)
        spectra.append(results.order_spectrum(pair, life.hours[-1], 8))
    else:
        life.note(pair)
    given = {"settings": {s.name: s.value for s in settings}, "life": vars(life.settings).copy()}
    return results.life_dataset(pair, life, spectra, given)


@pytest.fixture(scope="module")
def dataset(rv20e):
    return short_life(rv20e, 300.0, "output.load_torque=200")


@pytest.fixture(scope="module")
def result(dataset):
    return Result.of(dataset)


@pytest.fixture(scope="module")
def page(result):
    return page_of(result)


def content(page):
    return json.loads(re.search(r'<script type="application/json" id="content">(.*?)</script>', page, re.DOTALL)[1])


def without_scripts(page):
    return re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)


def traces_of(figure, disc, hour):
    """What the page's script shows at a disc and an hour."""
    if not figure["states"]:
        return figure["data"]
    rows = figure["states"][min(disc, len(figure["states"]) - 1)]
    updates = rows[min(hour, len(rows) - 1)]
    updates = [rows[0][u] if isinstance(u, int) else u for u in updates]
    return [trace | (update or {}) for trace, update in zip(figure["data"], updates, strict=True)]


def test_equal_data_give_equal_bytes(dataset, tmp_path):
    one = write_report(dataset, tmp_path / "one.html")
    two = write_report(dataset.copy(deep=True), tmp_path / "two.html")
    assert one.read_bytes() == two.read_bytes()
    assert one.stat().st_size < 6e6
    assert sorted(p.name for p in tmp_path.iterdir()) == ["one.html", "two.html"]


def test_nothing_is_loaded_from_elsewhere(page):
    markup = without_scripts(page)
    assert not re.search(r"https?:|@import|url\(|<link|<img|<iframe", markup)
    assert not re.search(r"<script[^>]*\bsrc", page)
    assert all(target.startswith("#") for target in re.findall(r'href="([^"]*)"', markup))
    assert "plotly.js v" in unpacked(page)


def test_every_section_and_figure_is_there(page):
    places = re.findall(r'class="plot" id="plot-([a-z_]+)"', page)
    figures = content(page)["figures"]
    assert [f["name"] for f in figures] == places
    assert all(f'<section id="{name}">' in page for name in SECTIONS)
    assert {"disc", "tooth", "pin", "inner_raceway", "outer_raceway", "pin_map", "roller_map", "tooth_phase",
            "turn_lag", "growth_depth", "growth_errors", "orders", "error_turn"} <= set(places)  # fmt: skip
    captions = re.findall(r"<figcaption>(.*?)</figcaption>", page)
    assert len(captions) == len(figures) and all(len(c) > 10 for c in captions)


def test_cards_say_what_the_dataset_says(page, dataset):
    pattern = r'data-figure="(\w+)" data-start="([^"]+)" data-end="([^"]+)".*?class="from">(.*?)<.*?class="to">(.*?)<'
    cards = re.findall(pattern, page, re.DOTALL)
    assert len(cards) == 11 and "Torsional stiffness, running" in page and "with the input held, rvwear hysteresis" in page
    assert "transmission_error_over_turn_pp_arcsec" in {name for name, *_ in cards} and "second stage alone" in page
    for name, start, end, start_text, end_text in cards:
        assert float(start) == dataset[name].values[0] and float(end) == dataset[name].values[-1]
        assert (start_text, end_text) == (number(float(start)), number(float(end)))


def test_figures_are_valid_and_not_empty(page, result):
    for figure in content(page)["figures"]:
        for disc in range(result.topology.discs):
            for hour in (0, len(result.shown) - 1):
                go.Figure(traces_of(figure, disc, hour), figure["layout"])
        titles = [axis["title"]["text"] for name, axis in figure["layout"].items() if name[:5] in ("xaxis", "yaxis")
                  and "title" in axis]  # fmt: skip
        assert not titles or any("[" in title for title in titles), figure["name"]


def test_numbers_are_rounded_with_sense():
    shown = {0.0: "0", 6.5714: "6.57", 311.33: "311", 1234.6: "1,230", -51.87: "−51.9", 0.00071: "0.000710"}
    assert {value: number(value) for value in shown} == shown
    assert (number(3e-9), number(0.4912, 2)) == ("3.00e-09", "0.49")
    assert number(float("nan")) == "–"


def test_what_is_coloured_is_what_is_worn():
    angles = np.arange(0.0, 360.0, 0.5)
    depth = np.maximum(0.0, np.sin(np.radians(angles)))
    ways = shapes.directions(angles)
    strips = shapes.bands(10.0 * ways, (10.0 + depth) * ways, depth, np.linspace(0.0, 1.0, 6))
    area = sum(0.5 * abs(np.sum(np.conj(p) * np.roll(p, -1)).imag) for strip in strips for p in strip)
    exact = 0.5 * np.sum((10.0 + depth) ** 2 - 100.0) * np.radians(0.5)
    assert area == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize(
    "depth, room, times", [(6.6e-3, 1.0, 150.0), (0.05, 1.0, 20.0), (1e-5, 0.5, 50_000.0), (0.0, 1.0, 0.0)]
)
def test_magnification_is_round(depth, room, times):
    assert shapes.magnification(depth, room) == pytest.approx(times)


@pytest.mark.parametrize("side, sign", [("inner", -1.0), ("outer", 1.0)])
def test_the_marked_peak_lies_on_the_worn_raceway(result, side, sign):
    figure = next(f for f in circles.figures(result) if f.name == f"{side}_raceway")
    dot = next(t for t in figure.data if t.get("mode") == "markers")
    contours = [t for t in figure.data if t.get("mode") == "lines" and len(t["x"]) > 170]
    radii = np.hypot(contours[-1]["x"], contours[-1]["y"])
    deepest = (sign * radii).argmax()
    angles = [np.arctan2(t["y"][k], t["x"][k]) for t, k in ((dot, 0), (contours[-1], deepest))]
    assert np.degrees(abs(angles[0] - angles[1])) < 6.0
    assert np.hypot(dot["x"][0], dot["y"][0]) == pytest.approx(radii[deepest], rel=0.01)


def test_a_tooth_wears_where_force_and_sliding_say(result):
    """The depth's place follows from force, sliding and arc along the tooth, in the same phases."""
    phases, force, _, _ = phase.force_along(result, -1, 0)
    plant, lobes = result.plant, result.topology.lobes
    geometry = (lobes, plant["pin_circle_radius"], plant["pin_radius"], result.generating[2])
    slide, arc = (
        np.array([f(np.radians(p), *geometry) for p in phases]) for f in (sliding_per_crank_angle, flank_arc_per_phase)
    )
    rate = force ** (1.0 + result.wear["load_exponent"]) * slide / arc
    depth = result["disc_wear"][-1, 0].mean(axis=0)
    predicted = np.interp(result["flank_phase"], phases, rate)
    assert np.corrcoef(predicted, depth)[0, 1] > 0.97


def test_known_orders_follow_from_the_counts(result):
    orders = {cause.order for cause in spectrum.causes(result)}
    assert {39, 40, 78, 80, 120, 121, 1560} <= orders
    assert [c.text for c in spectrum.causes(result) if c.order == 120] == ["sun against the carrier, and 3 × crank against the carrier"]
    # 16 rollers, 40 turns of the crank against the carrier, races of 10.25 and 13.25 mm.
    assert {round(o) for o in orders} >= {361, 279, 17}
    assert spectrum.explanation(result, 160) == "4 × crank against the carrier"
    assert spectrum.explanation(result, 1480).startswith("pin meshing − 80")
    assert spectrum.explanation(result, 533) == ""


def test_inputs_list_every_parameter_with_its_source(result, page):
    rows = {row["name"]: row for group in inputs.groups(result) for row in (*group["rows"], *group["off"])}
    paths = plant_table(result.topology).renamed
    assert {paths.get(name, name) for name in result.plant} <= set(rows)
    assert {"material.hardness", "wear.run_in_time", "wear.pins"} <= set(rows)
    assert rows["output.load_torque"]["chosen"] and rows["output.load_torque"]["value"] == "200"
    assert (rows["input.speed"]["value"], rows["input.speed"]["unit"]) == ("2000", "rpm")
    assert (rows["bearing.clearance"]["value"], rows["bearing.clearance"]["unit"]) == ("2.5", "µm")
    assert rows["bearing.clearance"]["assumed"] and not rows["pin.radius"]["assumed"]
    assert result.dataset.attrs["source_hash"] in page and json.loads(result.dataset.attrs["software"])["numpy"] in page


def test_effects_that_are_off_are_folded(dataset):
    """Half of the parameters of a page; an effect that acts stands with all of its own among the others."""
    result = Result.of(dataset)
    groups = inputs.groups(result)
    assert sum(len(group["off"]) for group in groups) > 100 and not [row for group in groups for row in group["rows"] if row["effect"]]
    given = json.loads(dataset.attrs["inputs"])
    name = next(name for name, path in plant_table(result.topology).renamed.items() if path == "effects.carrier_stiffness.turn_cos")
    given["parameters"]["plant"][name] = 0.2
    reducer = inputs.groups(replace(result, inputs=given))[1]
    shown = [row["name"] for row in reducer["rows"] if row["effect"]]
    assert len(shown) == 4 and all(name.startswith("effects.carrier_stiffness.") for name in shown)
    page = page_of(result)
    assert page.count('<details class="fold">') == 2 and "effects that are off" in page


def test_the_finding_is_computed(result):
    text = " ".join(findings.sentences(result))
    for name in ("disc_flank_um", "mean_lag_arcsec", "peak_pin_force_N", "peak_contact_pressure_MPa"):
        assert number(float(result[name][-1])) in text


def test_a_reducer_unknown_to_the_library(dataset):
    foreign = dataset.copy()
    given = json.loads(dataset.attrs["inputs"])
    given["parameters"]["reducer"] = "<b>Mine & yours</b>"
    given["parameters"]["plant"]["new_parameter"] = 7.0
    del given["sources"], given["life"], given["settings"]
    foreign.attrs = dataset.attrs | {"inputs": json.dumps(given)}
    page = page_of(Result.of(foreign))
    assert html.escape("<b>Mine & yours</b>") in page and "<b>Mine" not in page
    assert "new_parameter" in page


@pytest.mark.parametrize("hours, texts", [(0.0, ()), (50.0, NO_WEAR)])
def test_nothing_worn_still_makes_a_page(rv20e, hours, texts):
    result = Result.of(short_life(rv20e, hours, *texts, positions=12))
    page = page_of(result)
    assert all(f'<section id="{name}">' in page for name in SECTIONS)
    assert "Nothing is worn" in page and "NaN" not in without_scripts(page)
    assert all(figure["data"] for figure in content(page)["figures"])


def test_standing_pins_wear_where_they_are_touched(rv20e):
    result = Result.of(short_life(rv20e, 100.0, "wear.pins=stand", positions=12))
    figure = circles.pin(result)
    contour = figure.data[len(result.shown)]
    x, y = np.array(contour["x"]), np.array(contour["y"])
    deepest = np.hypot(x, y).argmin()
    # Below the pin's centre, towards the disc, and to the side.
    assert y[deepest] < 0.0 and abs(x[deepest]) > 0.3 * abs(y[deepest])
    assert "stands in its groove" in page_of(result)


def test_a_result_without_a_life_is_refused(tmp_path):
    series = series_dataset({"time": np.arange(3.0), "plant.output.lag": np.zeros((3, 1))}, {"plant.output.lag": "rad"}, {})
    with pytest.raises(InputFault, match="rvwear life"):
        write_report(series, tmp_path / "none.html")
