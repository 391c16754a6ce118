"""Look, Diagnose and Add it, in headless Chromium: what is compared, named and added."""

import shutil
import time

import pytest
from browser import ANSWER, EXAMPLE, dropped

from workbench.folder import opened


def test_a_result_of_another_model_says_so(bench, tmp_path):
    page = dropped(bench, tmp_path)
    said = page.evaluate(PAST)
    assert said[0] == "" and "is of RV20E-121; the model that is chosen now is model.toml" in said[1] and "have changed since" in said[2]
    assert said[3] == "" and said[4] == "What stands below is of before. It is being computed anew." and "came to no result" in said[5]


# Of the chosen model, of another, of files that changed since, and while it is asked anew: once it is there, before, and where nothing comes of it.
PAST = """async () => {
    const { past } = await import('./static/past.js'), result = { model: 'RV20E-121', begun: 1 };
    const told = (model, job) => past(result, { begun: 1, old: false, state: 'done', ...job }, { model: () => model });
    return [told('RV20E-121', {}), told('model.toml', {}), told('RV20E-121', { old: true }), told('RV20E-121', { state: 'running' }),
      told('RV20E-121', { begun: 2, old: true, state: 'running' }), told('RV20E-121', { begun: 2, state: 'stopped' })];
  }"""


def test_what_was_opened_stays_open_when_a_result_arrives(bench):
    """Three sections of the evidence closed whenever an experiment was asked for."""
    bench.view("diagnose")
    assert bench.page.evaluate("""async () => {
        const { h, redraw } = await import("./static/dom.js");
        const parts = () => ["Rivals", "How well"].map((text) => h("details", {}, h("summary", {}, text), h("p", {}, "told")));
        const place = redraw(h("div", {}), parts());
        place.lastChild.open = true;
        redraw(place, parts());
        return [...place.children].map((part) => part.open);
    }""") == [False, True]


def test_a_refused_effect_reads_as_refused_and_offers_no_better_model(bench):
    """The error on unused runs rose: in bad colours, no units to build, the other of what was named to try instead."""
    page = bench.page
    page.goto(bench.address)
    refused, kept = (page.evaluate(ADDED, [is_kept, after]) for is_kept, after in ((False, 25.5), (True, 1.2)))
    assert "How the error fell" not in refused["heads"] and "How the error fell" in kept["heads"]
    assert any(head.startswith("Refused: crank eccentricity + raceway wear (inner)") for head in refused["heads"])
    assert any("model.toml is written without it" in text for text in refused["said"]) and not kept["said"]
    assert refused["after"] == "bad" and kept["after"] == "good"
    assert not {"Look at the better model", "Build its FMUs"} & set(refused["buttons"]) and "Build its FMUs" in kept["buttons"]
    assert {"Try crank eccentricity alone", "Try raceway wear (inner) alone", "Back to the answer"} <= set(refused["buttons"])


def test_nothing_is_to_be_added_to_an_adequate_model(bench):
    """What was turned down stood there with a button to add it."""
    bench.page.goto(bench.address)
    told = bench.page.evaluate("""async () => {
      const { addPart } = await import('./static/better.js');
      return [['none', []], ['none', ['drag']], ['unknown', ['drag']]].map(([verdict, names]) => {
        const answer = { model: 'RV20E-121', verdict, effects: [], base_off: [], confusable: [], rejected: names.map((name) => ({ name })) };
        const part = addPart({ answer, extension: null, context: { busy: () => '' }, old: '' }), add = part.querySelector('#extend');
        return [part.querySelector('h2').textContent, add && [add.className, !!add.closest('details:not([open])')]];
      });
    }""")
    nothing = "Nothing is to be added: the model is adequate"
    assert told == [[nothing, None], [nothing, ["", True]], ["Add it to the model", ["main", False]]]


def test_of_forms_that_look_alike_the_named_one_is_added_and_the_others_are_offered(bench):
    """All of them were added at once."""
    bench.page.goto(bench.address)
    told = bench.page.evaluate("""async () => {
      const { addPart } = await import('./static/better.js');
      const wear = { candidates: ['raceway_wear.inner'], instead: ['raceway_wear.outer'] }, drag = { candidates: ['drag'], instead: [] };
      return [[[wear], []], [[wear, drag], []], [[wear, drag], ['raceway_wear', 'drag']]].map(([effects, confusable]) => {
        const answer = { model: 'RV20E-121', verdict: 'one effect', effects, base_off: [], confusable, rejected: [] }, asked = [];
        const part = addPart({ answer, extension: null, context: { busy: () => '', start: (kind, given) => asked.push(given.effects) }, old: '' });
        part.querySelector('#extend').click();
        return [asked[0], ...[...part.querySelectorAll('option')].map((o) => o.textContent)];
      });
    }""")
    alike = "raceway wear (outer), which looks alike"
    assert told[0] == [["raceway_wear.inner"], "raceway wear (inner)", alike]
    together = "raceway wear (inner) + drag", "raceway wear (inner)", "drag", "raceway wear (outer) + drag, which looks alike"
    assert told[1] == [["raceway_wear.inner", "drag"], *together]
    assert told[2] == [["raceway_wear.inner"], "raceway wear (inner)", "drag", alike]


def test_below_an_adequate_model_no_experiment_is_asked_for_but_anyway(bench):
    """'Propose the next experiment' stood there as what to do next."""
    bench.page.goto(bench.address)
    told = bench.page.evaluate("""async () => {
      const { nextPart } = await import('./static/better.js'), found = { verdict: 'nothing is left to separate', asked: [], proposals: [], stakes: {} };
      return [['none', null], ['none', found], ['one effect', null], ['none', null, ['Whose it is.']]].map(([verdict, next, untold]) => {
        const part = nextPart({ answer: { model: 'RV20E-121', verdict, untold }, next, context: { busy: () => '' } });
        return [part.querySelector('h2').textContent, part.querySelector('#next').closest('details')?.open ?? null];
      });
    }""")
    nothing = "Nothing is left to explain: no further experiment is asked for"
    assert told == [[nothing, False], [nothing, True], ["What to measure next", None], ["What can still be asked: one question", False]]


def test_charts_that_were_not_scrolled_to_are_printed(bench):
    """They were empty on paper; in a section that is closed there is nothing to draw."""
    page = bench.page
    page.goto(bench.address)
    page.evaluate("""async () => {
      const { sections } = await import('./static/page.js'), { script } = await import('./static/net.js'), view = document.getElementById('view');
      const figure = (name) => ({ name, title: name, caption: '', data: [{ type: 'bar', x: ['a'], y: [1] }], layout: {}, height: 300, labels: [], keys: [] });
      const section = (name) => ({ title: name, lead: '', figures: [figure(name)], tables: [] });
      const apart = document.createElement('div');
      apart.append(...sections([section('open'), section('closed')], 1));
      view.after(apart);
      apart.style.paddingTop = '9000px';
      await script('plotly.js');
      await script('narrow.js');
    }""")
    drawn = "() => [...document.querySelectorAll('[data-figure]')].map((place) => [place.dataset.figure, place.querySelectorAll('.bars path').length])"
    assert page.evaluate(drawn) == [["open", 0]]
    page.pdf()
    assert page.evaluate(drawn) == [["open", 1]]


def test_no_sheet_for_the_rig_is_offered_where_nothing_is_proposed(bench):
    bench.page.goto(bench.address)
    empty, full = (bench.page.evaluate(PROPOSED, proposals) for proposals in ([], [{"experiment": "loops", "cost": 2, "least": 9, "mean": 9}]))
    assert "Sheet for the rig" not in empty and "nothing is left to separate" in empty and "Sheet for the rig" in full


PROPOSED = """async (proposals) => {
    const { nextPart } = await import('./static/better.js');
    const next = { verdict: 'nothing is left to separate', asked: [], proposals, stakes: {}, cost_unit: 'runs', command: '' };
    return nextPart({ answer: { verdict: 'set' }, next, context: { busy: () => '' } }).textContent;
  }"""


# What stands below an answer once its two effects were added.
ADDED = """async ([kept, after]) => {
    const { addPart, ladder } = await import('./static/better.js');
    const effects = ['crank_eccentricity', 'raceway_wear.inner'], page = { cards: [], sections: [] };
    const step = { effects, kept, verdict: kept ? 'helped' : 'did not help', training_before: 9, training_after: 2, held_out_before: 4.82, held_out_after: after };
    const answer = { model: 'RV20E-121', effects: effects.map((e) => ({ candidates: [e] })), base_off: [], confusable: [], rejected: [] };
    const extension = { kept, verdict: step.verdict, reason: 'error on unused runs went elsewhere', effects, steps: [step], left: '', page, ladder: page, command: '' };
    const bag = { answer, extension, built: null, context: { busy: () => '', model: () => 'RV20E-121' }, old: '' };
    const place = document.createElement('div');
    place.append(addPart(bag), ladder(bag));
    const texts = (what) => [...place.querySelectorAll(what)].map((e) => e.textContent);
    return { heads: texts('h2, h3'), said: texts('#refused p'), buttons: texts('button'), after: place.querySelectorAll('#ladder tbody td')[4].firstElementChild.className };
  }"""


def test_a_sheet_is_offered_where_something_is_proposed(bench):
    page = bench.page
    page.goto(bench.address)
    offers = page.evaluate("""async () => {
      const { nextPart } = await import('./static/better.js'), one = { experiment: 'a loop', cost: 2, least: 3, mean: 4 };
      return [[], [one]].map((proposals) => nextPart({ answer: { verdict: 'set' }, next: { verdict: 'nothing to tell apart', asked: [], proposals, stakes: {} },
        context: { busy: () => '' } }).textContent);
    }""")
    assert "Sheet for the rig" not in offers[0] and "Print" not in offers[0] and "Ask again" in offers[0] and "Sheet for the rig" in offers[1]


def test_nothing_is_compared_while_something_else_is_computed(bench):
    page = bench.page
    page.goto(bench.address)
    told = page.evaluate("""async () => {
      const { show } = await import('./static/look.js'), place = document.getElementById('view'), state = { saved: true, jobs: {} };
      let busy = 'Diagnosing: one thing is computed at a time';
      place.replaceChildren();
      const look = show(place, { state, busy: () => busy, model: () => 'RV20E-121', modelChooser: () => document.createElement('span') });
      const button = () => [place.querySelector('#compare').disabled, place.querySelector('#compare').title], during = button();
      busy = '';
      look.update(state);
      return [during, button()];
    }""")
    assert told == [[True, "Diagnosing: one thing is computed at a time"], [False, ""]]


def test_what_is_clicked_while_something_is_computed_waits_for_its_end(bench):
    """"Which effect is missing?" answered with an error of the server."""
    page = bench.page
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    told = page.evaluate("""async () => {
      const { waiting } = await import('./static/waiting.js'), begun = [], taken = Object.assign(new Error('taken'), { status: 409 });
      let busy = '', first = true;
      const act = (promise) => promise.catch((fault) => begun.push(fault.message));
      const begin = async (work) => { if (work === 'late' && first) { first = false; throw taken; } begun.push(work); busy = work; };
      const queue = waiting({ busy: () => busy, act, begin, changed: () => {} });
      await Promise.all([queue.start('compare'), queue.start('next'), queue.start('diagnose')]);
      const during = [queue.waits, [...begun]];
      busy = '';
      queue.heard();
      await queue.start('life');
      queue.leave('life');
      busy = '';
      queue.heard();
      // Another tab was first, which this one has not heard yet.
      await queue.start('late');
      const late = queue.waits;
      queue.heard();
      await new Promise((done) => setTimeout(done, 0));
      return [during, late, begun];
    }""")
    assert told == [[["diagnose"], ["compare"]], ["late"], ["compare", "diagnose", "late"]]
    # The server's word for it is no error of what was sent.
    folder = opened(bench.folder)
    folder.remember("jobs/life/job", {"kind": "life", "given": {}, "begun": time.time()})
    folder.remember("jobs/life/beat", {"state": "running", "at": time.time() + 3.0, "said": [], "tasks": []})
    page.locator("#work", has_text="Living").wait_for()
    asked = "async () => (await fetch('jobs/compare', { method: 'POST', body: JSON.stringify({ model: 'RV20E-121' }) })).status"
    assert page.evaluate(asked) == 409
    page.evaluate("async () => (await import('./static/app.js')).start('compare')")
    assert page.locator("#waits").inner_text().startswith("then: Comparing")
    page.get_by_role("button", name="leave it").click()
    assert page.locator("#waits").count() == 0


def test_a_diagnosis_that_is_found_again_says_when_it_was_made_and_names_its_effect_s_part_once(bench):
    """"3 min of computing" stood there where nothing was computed; "crank 1 at disc 1" in the headline and below it."""
    folder = opened(bench.folder)
    shutil.copytree(EXAMPLE, bench.folder, dirs_exist_ok=True)
    effect = {"name": "crank_lobe_errors", "place": "crank 1 at disc 1", "candidates": ["crank_lobe_errors.crank_1"], "instead": [], "parameters": [],
              "share": "explains", "error": "", "held": ""}  # fmt: skip
    answer = ANSWER | {"verdict": "one effect", "headline": "The model lacks crank eccentric errors (crank 1 at disc 1).", "seconds": 180.0, "effects": [effect]}
    folder.remember("jobs/diagnose/job", {"kind": "diagnose", "given": {"model": "RV20E-121"}, "begun": 1.0})
    folder.remember("jobs/diagnose/beat", {"state": "done", "at": 2.0, "seconds": 1.0, "said": [], "tasks": []})
    folder.remember("jobs/diagnose/result", answer | {"found": 1.7e9, "found_in": "/data/first"})
    bench.view("diagnose")
    head = bench.page.locator("#verdict p").first
    head.get_by_text("found again: made ").wait_for()
    assert "Nov 2023" in head.inner_text() and head.inner_text().endswith(", from the folder /data/first with the same files, in 3 min of computing")
    assert bench.page.locator("#verdict").inner_text().count("crank 1 at disc 1") == 1
    # A form that fits as well stands below it with its values.
    carrier = {"name": "carrier_compliance", "value": "0.0172", "unit": "arcmin/(N m)", "interval": "0.0171 to 0.0173", "meaning": "", "bound": False, "with_base": "",
               "why": None}  # fmt: skip
    others = [{"said": "or carrier (fits as well)", "parameters": [carrier]}]
    folder.remember("jobs/diagnose/result", answer | {"found": None, "effects": [effect | {"others": others}]})
    bench.page.reload()
    head.get_by_text("one effect · 3 min of computing").wait_for()
    assert "or carrier (fits as well):\ncarrier_compliance = 0.0172 arcmin/(N m) 95 %: 0.0171 to 0.0173" in bench.page.locator("#verdict").inner_text()


def test_what_is_significant_is_no_share_of_nothing(bench):
    page = bench.page
    page.goto(bench.address)
    found = page.evaluate("""async () => {
      const { fails } = await import('./static/look_parts.js');
      const place = (share) => ({ signal: 'transmission_error', feature: 'orders', dependence: 'load', share, chance: 'p = 8e-7', why: null });
      return [...fails({ signals: [], places: [place(0.94), place(0.002)] }, {}).querySelectorAll('td.num')].map((cell) => cell.textContent);
    }""")
    assert found == ["94 %, p = 8e-7", "< 1 %, p = 8e-7"]


def test_under_look_buttons_and_cards_count_an_error_in_the_same_way(bench):
    """15 was the worst run's, beside a card of 14.1; of a condition it is the root mean square over its repetitions."""
    page = bench.page
    page.goto(bench.address)
    run = {"run": "r", "condition": "c", "replicate": 1, "held_out": False, "mounting": "1", "samples": 3, "dots": True, "noise": 1, "zero": 0}
    places = {name: {"from": 0, "count": 3} for name in ("x", "measured", "predicted", "residual")}
    signal = {"signal": "transmission_error", "title": "transmission error", "unit": "arcsec", "held_out": True, "singles": [], "loop": False, "spectra": [],
              "axis": {"name": "angle", "title": "angle"}, "errors": [{"ratio": 14.12, "held_out": False, "runs": 10}, {"ratio": 13.96, "held_out": True, "runs": 1}],
              "runs": [run | places | {"ratio": 15.0}, run | places | {"ratio": 13.0, "run": "s"}]}  # fmt: skip
    result = {"model": "RV20E-121", "begun": 1, "signals": [signal], "places": [], "orders": {}, "figures": [], "doubts": [], "warnings": [], "cards": [],
              "calibrated": [], "title": "", "finding": "", "conditions": "", "nuisances": {}, "command": ""}  # fmt: skip
    page.route("**/results/compare", lambda route: route.fulfill(json=result))
    page.route("**/results/compare/columns", lambda route: route.fulfill(body=bytes(12)))
    told = page.evaluate("""async () => {
      const { show } = await import('./static/look.js'), place = document.getElementById('view');
      const state = { saved: true, jobs: { compare: { state: 'done', result: true, begun: 1 } }, models: [], library: [] };
      place.replaceChildren();
      show(place, { state, busy: () => '', model: () => 'RV20E-121', modelChooser: () => document.createElement('span'), act: (promise) => promise }).update(state);
      for (let k = 0; k < 100 && !place.querySelector('#signals'); k++) await new Promise((done) => setTimeout(done, 50));
      return [...place.querySelectorAll('.chips button')].map((button) => button.textContent);
    }""")
    assert told == ["transmission error 14.1× of 10 runs, held out 14.0× of 1 run", "c 14.0×"]


def test_a_sample_aside_stretches_no_axis(bench):
    page = bench.page
    page.goto(bench.address)
    found = page.evaluate("""async () => {
      const { Plot } = await import('./static/plot.js'), plot = new Plot();
      const line = { name: 'measured', x: Float32Array.from([0, 1, 2]), y: Float32Array.from([1, 900, 2]), colour: '--measured', aside: [1] };
      plot.set({ panes: [{ title: 'y', lines: [line] }] });
      return plot.paneRange(plot.panes[0], 0, 2);
    }""")
    assert found == pytest.approx([0.94, 2.06])


def test_the_reducer_view_of_a_model_file_names_its_effects_and_has_their_numbers_first(bench):
    text = '[model]\nname = "better"\nreducer = "RV20E-121-rigid"\n[effects.thermal_expansion]\nexpansion = "2e-6 1/K"\n'
    (bench.folder / "model.toml").write_text(text, encoding="utf-8")
    bench.page.goto(f"{bench.address}#reducer")
    bench.page.locator("label", has_text="reducer").locator("select").select_option("model.toml")
    bench.page.locator("h1", has_text="model.toml (better) with thermal expansion").wait_for()
    first = bench.page.locator("tbody tr").first.inner_text()
    assert "effects.thermal_expansion.expansion" in first and "1/K" in first
    assert bench.page.locator("p.lead").inner_text().startswith("The model is RV20E-121-rigid with thermal expansion.")


def test_what_is_off_in_times_the_noise_has_no_sign(bench):
    """-97.9 stood there, 97.9 on the terminal and in Diagnose; which is more, measured and model say."""
    bench.page.goto(bench.address)
    told = bench.page.evaluate("""async () => {
      const { keyFigures, singles } = await import('./static/look_parts.js'), place = document.getElementById('view');
      const why = { relation: '', data: '', margin: '' };
      const figure = { signal: 's', title: 's', condition: 'c', name: 'n', unit: 'N', measured: '1', model: '2', noise: '0.01', off: -97.9, runs: 1, repeated: false, why };
      const run = { run: 'r', condition: 'c', held_out: false, measured: [1], predicted: [2], noise: 0.1, off: [-10] };
      place.replaceChildren(
        keyFigures({ result: { figures: [figure], calibrated: [] }, all: true, text: '', matches: () => true, search: () => {}, showAll: () => {} }),
        singles({ title: 's', unit: 'N', singles: [run] }),
      );
      return [place.querySelector('.off').textContent, [...place.querySelectorAll('td')].at(-1).textContent];
    }""")
    assert told == ["97.9", "10.0"]
