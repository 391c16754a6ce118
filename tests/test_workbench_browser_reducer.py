"""Reducer, in headless Chromium: read, named, completed from a few numbers."""

import re


def test_a_reducer_that_is_read_says_so(bench):
    page, held = bench.page, []

    def asked(route):
        held.append(route)

    page.route("**/reducer", asked)
    page.goto(f"{bench.address}#reducer")
    page.get_by_text("Reading the reducer…").wait_for()
    held[0].continue_()
    page.get_by_text("Choose a reducer, or complete one").wait_for()
    assert page.get_by_text("Reading the reducer…").count() == 0


def test_where_an_effect_may_sit_as_well_stands_beside_what_is_added_and_drawn(bench):
    """One of four lobes that look alike stood there as a fact."""
    page, told = bench.page, "at which part it is (crank lobe errors at crank 1 at disc 1 or crank 2 at disc 2, which look alike) no other run tells"
    text = f"""[model]
name = "better"
reducer = "RV20E-121"
[effects.crank_lobe_errors]
lobe_throw_error_1 = "3 um"
[[steps]]
effects = ["crank_lobe_errors.crank_1"]
verdict = "helped"
reason = "r"
untold = ["{told}"]
"""
    (bench.folder / "model.toml").write_text(text, encoding="utf-8")
    page.goto(f"{bench.address}#reducer")
    page.locator("label", has_text="reducer").locator("select").select_option("model.toml")
    page.locator("#open-places .note", has_text=told[1:]).wait_for()
    shown = page.evaluate("""async (open) => {
      const { addPart } = await import('./static/better.js');
      const answer = { model: 'm', verdict: 'one effect', effects: [{ candidates: ['crank_lobe_errors.crank_1'] }], base_off: [], confusable: [], rejected: [], open };
      return addPart({ answer, extension: null, context: { busy: () => '' }, old: '' }).querySelector('.note').textContent;
    }""", [told])
    assert shown == told


def test_a_new_reducer_is_called_so_until_it_is_saved_and_no_model_of_others_before_it_is_chosen(bench):
    """The list said RV20E-121 above another one's numbers; once saved it was the model of all views without a word."""
    page, chosen = bench.page, "document.querySelector('#view select').selectedOptions[0].textContent"
    page.goto(bench.address)
    page.evaluate("fetch('state', { method: 'POST', body: JSON.stringify({ model: 'RV20E-121' }) })")
    bench.view("reducer")
    page.reload()
    page.locator("#used", has_text="Look, Diagnose, Try and Life use RV20E-121, this one").wait_for()
    page.click("#new")
    assert page.evaluate(chosen) == "a new reducer, not saved yet" and page.locator("#used").inner_text().endswith("use RV20E-121")
    page.fill("#ask-ratio", "121")
    page.fill("#ask-rated", "412")
    page.click("#save-reducer")
    page.locator("#kept", has_text="ratio-121-412Nm.toml is in the folder. The other views stay with RV20E-121").wait_for()
    assert page.evaluate(chosen) == "ratio-121-412Nm.toml" and page.locator("#used").inner_text().endswith("use RV20E-121")
    page.click("#use")
    page.locator("#used", has_text="use ratio-121-412Nm.toml, this one").wait_for()
    assert page.locator("#use").count() == 0
    bench.view("life")
    page.locator("#model option:checked", has_text="ratio-121-412Nm.toml").wait_for(state="attached")


def test_a_new_reducer_takes_the_gap_of_its_lost_motion_and_a_box_refuses_one_that_is_missed(bench):
    """Typed into the list below the gap that a card told counted for measured; compliances stood in SI there."""
    page = bench.page
    page.goto(bench.address)
    bench.view("reducer")
    page.click("#new")
    page.fill("#ask-ratio", "129")
    page.fill("#ask-rated", "1568")
    page.get_by_text("not given: made by rules alone, hold it against the catalogue").first.wait_for()
    page.fill("#ask-lost_motion", "1")
    page.get_by_text(re.compile(r"1 of the catalogue; taken for it: disc\.equidistant_modification = ")).wait_for()
    page.fill("#ask-lost_motion", "0.1")
    page.get_by_text(re.compile("0.1 of the catalogue, missed; taken for it: ")).wait_for()
    page.check("#meets-lost-motion")
    page.get_by_text(re.compile("nothing within the ranges makes a lost motion of 0.1 arcmin")).wait_for()
    page.fill("#ask-lost_motion", "1")
    page.get_by_text(re.compile("1 of the catalogue; taken for it: ")).wait_for()
    row = page.locator("tr", has=page.locator("[id='n-disc.equidistant_modification']"))
    assert "makes the lost motion that of the catalogue" in row.inner_text() and row.locator("input.changed").count() == 0
    assert "µm/kN" in page.locator("tr", has=page.locator("[id='n-crank.support_compliance']")).inner_text()
    # What cannot be made says what to type, and where one types it stays.
    page.fill("#ask-lost_motion", "0.1")
    page.get_by_text("type bearing.clearance in 'Every number of its file' below").wait_for()
    assert page.locator("[id='n-bearing.clearance']").is_visible() and page.get_by_text("as it could last be made").is_visible()
    page.fill("#ask-lost_motion", "1")
    page.get_by_text("as it could last be made").wait_for(state="detached")


def test_names_in_a_card_fold_on_a_narrow_screen(bench):
    """``disc.equidistant_modification`` left the card of the lost motion, and the screen."""
    page = bench.page
    page.goto(bench.address)
    page.set_viewport_size({"width": 390, "height": 844})
    note = "1 of the catalogue; taken for it: disc.equidistant_modification = 3.25 µm"
    over = page.evaluate("""async (note) => {
      const { cards } = await import('./static/page.js'), card = { label: 'lost motion', value: '1', unit: 'arcmin', tone: 'plain', note };
      document.getElementById('view').replaceChildren(cards([card, card]));
      const edges = [...document.querySelectorAll('.card')].map((c) => [c.scrollWidth, c.clientWidth]);
      return [...edges, [document.documentElement.scrollWidth, 390]];
    }""", note)
    page.set_viewport_size({"width": 1280, "height": 900})
    assert all(needs <= has for needs, has in over), over
