"""Try, in headless Chromium: numbers of effects and the curves that follow them."""

import json
import shutil
import time

import pytest
from browser import EXAMPLE, until


@pytest.mark.campaign
def test_a_first_number_in_try_is_marked_until_the_exact_one_is_there(bench):
    shutil.copytree(EXAMPLE, bench.folder, dirs_exist_ok=True)
    page, held = bench.page, []

    def asked(route):
        given = route.request.post_data_json
        if given["roughly"] or not given["values"]:
            route.continue_()
        else:
            held.append(route)

    page.route("**/try/curve", asked)
    bench.view("try")
    page.fill("input[type=search]", "thermal expansion")
    page.locator("[data-parameter=thermal_expansion]").focus()
    page.keyboard.press("ArrowRight")
    page.locator("#followed", has_text="≈").get_by_text("first look, the exact number follows").wait_for()
    page.locator("#followed", has_text=" of this run alone").wait_for()
    while not held:
        page.wait_for_timeout(100)
    held[0].continue_()
    page.locator("#followed", has_not_text="first look").wait_for()
    # What was tried is there again when the view is, or the page.
    tried = page.locator("[data-parameter=thermal_expansion]").input_value()
    page.unroute("**/try/curve")
    for again in (lambda: (bench.view("look"), bench.view("try")), page.reload):
        again()
        page.locator("#followed", has_text="thermal expansion").wait_for(timeout=60_000)
        assert page.locator("[data-parameter=thermal_expansion]").input_value() == tried


def test_under_try_a_model_s_own_effects_stay_and_it_says_so(bench):
    """All off was taken for the reducer without the effect, and called base model."""
    shutil.copytree(EXAMPLE, bench.folder, dirs_exist_ok=True)
    text = '[model]\nname = "better"\nreducer = "RV20E-121-rigid"\n[effects.thermal_expansion]\nexpansion = "2e-6 1/K"\n'
    (bench.folder / "model.toml").write_text(text, encoding="utf-8")
    page = bench.page
    bench.view("try")
    page.locator("button", has_text="All off").wait_for()
    page.select_option("#model", "model.toml")
    page.locator("button", has_text="Back to the model as it is").wait_for()
    page.locator("#followed", has_text="the model as it is, its own effects on (thermal expansion)").wait_for()
    page.locator("summary", has_text="thermal expansion").first.click()
    page.locator("button", has_text="Without it").first.click()
    page.locator("#followed", has_not_text="its own effects on").wait_for()
    page.locator("button", has_text="Back to the model as it is").click()
    page.locator("#followed", has_text="its own effects on").wait_for()
    page.select_option("#model", "RV20E-121-rigid")
    page.locator("button", has_text="All off").wait_for()
    page.locator("#followed", has_text="base model").wait_for()


def test_a_search_under_try_opens_what_is_called_so_alone(bench):
    shutil.copytree(EXAMPLE, bench.folder, dirs_exist_ok=True)
    page = bench.page
    bench.view("try")
    page.fill("input[type=search]", "(planet)")
    page.locator("[data-parameter=planet_runout]").wait_for()
    titles = page.locator("ul.list > li > details[open] > summary").all_inner_texts()
    assert titles == ["first stage error (planet)"]
    # Numbers of the reducer are called, and have the units, as on the reducer's page; what of the runs is looked at stands below the curves.
    page.locator("#taken", has_text="runs, one of each condition").wait_for()
    page.fill("input[type=search]", "grease.pressure_viscosity")
    page.get_by_label("grease.pressure_viscosity [1/GPa]", exact=True).wait_for()
    page.fill("input[type=search]", "(planet)")
    page.locator("[data-parameter=planet_runout]").wait_for()
    # The words about an effect are those of all its forms: these are listed below it.
    listed = page.locator("ul.list > li > details > summary").all_inner_texts()
    assert listed[0] == titles[0] and "first stage error (mesh)" in listed


def test_a_model_is_made_ready_once_whatever_the_server_tells_meanwhile(bench):
    """Its effects were drawn again when the second answer came: what was opened or pressed by then was gone."""
    shutil.copytree(EXAMPLE, bench.folder, dirs_exist_ok=True)
    page, asked = bench.page, []

    def late(route):
        asked.append(route.request.method)
        (bench.folder / f"more_{len(asked)}.csv").write_text("angle;error\n0;0\n")
        time.sleep(3.0)
        route.continue_()

    page.route("**/try", late)
    bench.view("try")
    page.locator("ul.list > li > details").first.wait_for()
    page.wait_for_timeout(1000)
    assert asked == ["POST"]


def test_an_effect_that_is_opened_under_try_is_seen_to_its_end(bench):
    """The panel cut it at its bottom."""
    shutil.copytree(EXAMPLE, bench.folder, dirs_exist_ok=True)
    page = bench.page
    bench.view("try")
    page.locator("ul.list > li > details").first.wait_for()
    parts = """() => {
      const { bottom, height } = document.querySelector('ul.list').getBoundingClientRect();
      const item = [...document.querySelectorAll('ul.list > li')].findLast((li) => li.getBoundingClientRect().bottom < Math.min(bottom, innerHeight));
      item.id = 'lowest';
      return height;
    }"""
    height = page.evaluate(parts)
    page.locator("#lowest summary").click()
    page.locator("#lowest details[open]").wait_for()
    seen = """() => {
      const list = document.querySelector('ul.list').getBoundingClientRect(), item = document.querySelector('#lowest').getBoundingClientRect();
      return [item.height, item.top >= list.top - 1, item.bottom <= Math.min(list.bottom, innerHeight) + 1];
    }"""
    until(page, f"({seen})()[2]", seconds=5.0)
    tall, from_top, to_bottom = page.evaluate(seen)
    assert 100 < tall < height and from_top and to_bottom


def test_a_number_under_try_beyond_its_bounds_says_which_it_has_and_what_is_shown(bench):
    """400 became 30 with neither the range nor a unit; the words stayed when the slider was moved."""
    bench.page.goto(bench.address)
    told = bench.page.evaluate("""async () => {
      const { entry } = await import('./static/try_effects.js'), values = {};
      const p = { name: 'disc_hole_shift_1', called: 'disc hole shift 1', unit: 'µm', factor: 1e6, offset: 0, off: 0, low: -15, high: 15, bounds: [-30, 30], amplitude: true, description: '' };
      const item = entry({ title: 'holes', parameters: [p] }, { values, open: true, drawList: () => {}, follow: () => {} });
      const [range, field] = item.querySelectorAll('input'), said = [];
      const give = (input, text, event) => {
        input.value = text;
        input.dispatchEvent(new Event(event));
        said.push([field.value, item.querySelector('[role=status]').textContent, Math.round(1e6 * (values.disc_hole_shift_1 ?? 0))]);
      };
      give(field, '400', 'change');
      give(field, '20', 'change');
      give(field, '-30.001', 'change');
      give(range, '4', 'input');
      return [said, field.nextElementSibling.getAttribute('role')];
    }""")
    bounds = "must lie in [−30, 30] µm"
    assert told == [
        [["30", f"400 µm {bounds}; 30 µm is shown", 30], ["20", "", 20], ["-30", f"−30.001 µm {bounds}; −30 µm is shown", -30], ["4", "", 4]], "status"
    ]


def test_a_move_under_try_does_not_wait_for_the_exact_curve(bench):
    """It was sent only once that had come; what comes then is of before and is not drawn."""
    page, asked, held = bench.page, [], []
    slider = {"name": "gap", "called": "gap", "unit": "um", "factor": 1e6, "offset": 0, "off": 0, "low": 0, "high": 9, "bounds": [0, 9], "typical": 1,
              "amplitude": True, "all_round": False, "counts": False, "description": "", "of": ""}  # fmt: skip
    effect = {"name": "clearance", "title": "clearance", "part": "", "signals": [], "law": "", "says": "", "source": "", "parameters": [slider]}
    run = {"run": "r", "signal": "transmission_error", "title": "t", "condition": "c", "replicate": 1, "held_out": False, "samples": 1, "axis": "angle"}
    words = {"unit": "arcsec", "axis": {"name": "angle", "title": "angle"}, "loop": False, "stems": False, "title": "t", "condition": "c", "free": False,
             "aside": [], "placed": "", "count": 1}  # fmt: skip

    def curve(route):
        given = route.request.post_data_json
        asked.append(given["roughly"])
        tried = 1e6 * given["values"].get("gap", 0.0)
        answer = json.dumps(words | {"rms": [9.0, tried]}).encode() + b"\n" + bytes(20)
        if given["roughly"]:
            route.fulfill(body=answer)
        else:
            held.append((route, answer))

    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    page.route("**/try", lambda route: route.fulfill(json={"model": "m", "effects": [effect], "numbers": [], "runs": [run]}))
    page.route("**/try/everywhere", lambda route: route.fulfill(json=None))
    page.route("**/try/curve", curve)
    page.evaluate("""async () => {
      const { show } = await import('./static/try.js'), place = document.getElementById('view');
      place.replaceChildren();
      show(place, { state: { saved: true, folder: 'f', models: [], library: [], jobs: {} }, model: () => 'm', modelChooser: () => document.createElement('span'),
                    act: (promise) => promise });
    }""")
    page.fill("input[type=search]", "clearance")
    page.locator("[data-parameter=gap]").focus()
    page.keyboard.press("ArrowRight")
    until(page, "() => document.querySelector('#followed')?.textContent.includes('first look')")
    while not held:
        page.wait_for_timeout(50)
    before = page.locator("#followed").inner_text()
    page.keyboard.press("ArrowRight")
    until(page, "(before) => !document.querySelector('#followed').textContent.startsWith(before.slice(0, 50))", before)
    after = page.locator("#followed").inner_text()
    assert asked[-1] is True and "first look" in after
    held[0][0].fulfill(body=held[0][1])
    page.wait_for_timeout(100)
    assert page.locator("#followed").inner_text() == after
    # And when the hand rests the exact one follows.
    while len(held) < 2:
        page.wait_for_timeout(50)
    held[1][0].fulfill(body=held[1][1])
    page.locator("#followed", has_not_text="first look").wait_for()
