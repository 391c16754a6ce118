"""Look, in headless Chromium: cursors, curves shifted against each other, why there are no orders, exports one after the other."""

import time

import pytest

from workbench.folder import opened

# A chart of a hundred samples, one each degree, on the page; ``said()``: the table of its cursors and the button.
CHART = """const { Plot } = await import('./static/plot.js'), plot = new Plot();
  const x = Float32Array.from({ length: 101 }, (_, i) => i);
  document.getElementById('view').replaceChildren(plot.element);
  plot.set({ xTitle: 'x', panes: [{ title: 'y', lines: [{ name: 'measured', x, y: x.map((v) => 2 * v), colour: '--measured' }] }] });"""
SAID = """() => [...document.querySelectorAll('.cursors th')].slice(1).map((cell) => cell.textContent.split(': ')[1])
  .concat([...document.querySelectorAll('.bar-top button')].find((b) => b.textContent.startsWith('cursor')).textContent)"""


@pytest.fixture
def page(bench):
    bench.page.goto(bench.address)
    bench.page.get_by_text("Drop what the bench wrote").wait_for()
    return bench.page


def test_a_click_sets_cursor_a_then_b_then_a_again(page):
    """Four clicks moved A, and B stayed empty."""
    page.evaluate(f"async () => {{ {CHART} }}")
    canvas = page.locator("canvas[role=img]")
    wide = canvas.bounding_box()["width"]

    def click(x, **more):
        canvas.click(position={"x": 56 + x / 100 * (wide - 68), "y": 100}, **more)
        return said()

    def said():
        page.wait_for_timeout(100)
        return page.evaluate(SAID)

    assert click(20) == ["20.000", "–", "–", "cursor B"]
    assert click(60) == ["20.000", "60.000", "40.000", "cursor A"]
    assert click(30) == ["30.000", "60.000", "30.000", "cursor B"]
    # Arrows move the one that was set last.
    page.keyboard.press("ArrowRight")
    assert said() == ["31.000", "60.000", "29.000", "cursor B"]
    page.keyboard.press("a")
    assert click(10)[:2] == ["10.000", "60.000"] and click(70)[:2] == ["10.000", "70.000"]
    page.keyboard.press("b")
    page.keyboard.press("ArrowLeft")
    assert said() == ["10.000", "69.000", "59.000", "cursor B"]
    assert click(80, modifiers=["Alt"]) == ["10.000", "80.000", "70.000", "cursor A"]
    # A double click shows all, and sets no cursor.
    canvas.dblclick(position={"x": 300, "y": 100})
    assert said() == ["10.000", "80.000", "70.000", "cursor A"]
    page.keyboard.press("Delete")
    assert said() == ["10.000", "–", "–", "cursor B"]
    assert click(90) == ["10.000", "90.000", "80.000", "cursor A"]


def test_the_residual_is_that_of_the_shifted_curves(page):
    """Measured moved, and its residual and what the cursor read of it stayed."""
    told = page.evaluate("""async () => {
      const { spec } = await import('./static/look_parts.js'), places = {}, numbers = [];
      const column = (name, values) => { places[name] = { from: numbers.length, count: values.length }; numbers.push(...values); };
      const x = Array.from({ length: 21 }, (_, i) => i), noise = x.map((v) => (v < 10 ? 0.5 : 0.25));
      column('x', x);
      column('measured', x.map((v) => 3 * v + 1));
      column('predicted', x.map((v) => 3 * v));
      column('residual', x.map((v, i) => 1 / noise[i]));
      column('noises', noise);
      const all = Float32Array.from(numbers), part = (place) => all.subarray(place.from, place.from + place.count);
      const run = { condition: 'c', noise: 0.5, zero: 0, ...places }, signal = { title: 't', unit: 'u', loop: false, axis: { title: 'angle' } };
      const drawn = (shift) => spec({ part, shift, asMeasured: false, several: false }, signal, [run]);
      const kept = (line, at) => [line.name, ...at.map((i) => (line.told ?? line).x[i]), ...at.map((i) => Math.round(1e3 * (line.told ?? line).y[i]) / 1e3)];
      const found = drawn(1.5), [measured, predicted] = found.panes[0].lines, [left] = found.panes[1].lines;
      return [drawn(0).panes[1].lines[0].y[3], drawn(0).panes[1].title, found.panes[1].title, predicted.x[3], predicted.y[3],
              [measured, predicted, left].map((line) => kept(line, [3, 12])), Number.isNaN(left.y[20])];
    }""")
    # At sample 3 measured is 10 and stands at 4.5, where the prediction is 13.5; beyond its end there is none.
    expected = [["measured", 4.5, 13.5, 10.0, 37.0], ["predicted", 4.5, 13.5, 13.5, 40.5], ["residual / noise, shifted", 4.5, 13.5, -7.0, -14.0]]
    assert told == [2.0, "residual / noise", "residual / noise, shifted", 3.0, 9.0, expected, True]


def test_a_loop_is_shifted_way_by_way(page):
    """Up on one line, down on another: each sample is held against its own way, at a torque that trembles, too."""
    told = page.evaluate("""async () => {
      const { shifted, ways } = await import('./static/shifted.js');
      const way = [...Array(40).keys(), ...Array.from({ length: 41 }, (_, i) => 40 - i)];
      const x = Float32Array.from(way, (v, i) => v + (i % 2 ? 0.2 : 0)), y = x.map((v, i) => 2 * v + (i < 41 ? 0 : 10));
      const found = shifted(x, y, y, 0.5, 2);
      return [ways(Float32Array.from(way)), [...found.residual].map((v) => (v === v ? Math.round(100 * v) / 100 : null)), found.x[3] - x[3]];
    }""")
    turns, residual, moved = told
    assert turns[0] == 0 and abs(turns[1] - 40) <= 1 and turns[2] == 81 and len(turns) == 3 and moved == pytest.approx(2.0)
    assert all(v == pytest.approx(-8.0, abs=1.0) for v in residual[:37] + residual[45:79])
    assert residual[39] is None or abs(residual[39]) < 60.0


LOOK = """async ([result, columns]) => {
  const { show } = await import('./static/look.js'), place = document.getElementById('view');
  const state = { saved: true, jobs: { compare: { state: 'done', result: true, begun: 1 } }, models: [], library: [] };
  place.replaceChildren();
  show(place, { state, busy: () => '', model: () => 'RV20E-121', modelChooser: () => document.createElement('span'), act: (promise) => promise }).update(state);
  for (let k = 0; k < 100 && !place.querySelector('#signals'); k++) await new Promise((done) => setTimeout(done, 50));
}"""


def test_look_says_why_there_are_no_orders_and_what_was_bridged(page):
    """One missing sample, and they were gone without a word."""
    place = {"from": 0, "count": 3}
    run = {"run": "r", "replicate": 1, "held_out": False, "mounting": "1", "samples": 3, "dots": True, "noise": 1, "zero": 0, "ratio": 2.0,
           "x": place, "measured": place, "predicted": place, "residual": place}  # fmt: skip
    own = {"condition": "warm", "held_out": False, "turns": 1, "repetitions": 2, "bridged": "2 samples missing or far off are bridged.",
           "measured": [0, 1, 2], "predicted": [0, 1, 1], "residual": [0, 0, 1]}  # fmt: skip
    signal = {"signal": "transmission_error", "title": "transmission error", "unit": "arcsec", "held_out": False, "singles": [], "loop": False,
              "axis": {"name": "angle", "title": "angle"}, "errors": [], "runs": [run | {"condition": "cold"}, run | {"condition": "warm"}],
              "spectra": [own], "no_orders": {"cold": "r: after 40 deg the angle leaps by 9 deg"}}  # fmt: skip
    result = {"model": "RV20E-121", "begun": 1, "signals": [signal], "places": [], "orders": {}, "figures": [], "doubts": [], "warnings": [], "cards": [],
              "calibrated": [], "title": "", "finding": "", "conditions": "", "nuisances": {}, "command": ""}  # fmt: skip
    page.route("**/results/compare", lambda route: route.fulfill(json=result))
    page.route("**/results/compare/columns", lambda route: route.fulfill(body=bytes(12)))
    page.evaluate(LOOK, [None, None])
    assert page.locator("#no-orders").inner_text() == "None at cold: r: after 40 deg the angle leaps by 9 deg"
    page.get_by_role("button", name="warm").click()
    page.get_by_text("2 samples missing or far off are bridged.").wait_for()
    assert page.locator("#no-orders").count() == 0
    signal["spectra"] = []
    page.evaluate(LOOK, [None, None])
    assert page.locator("#orders").inner_text().split("\n\n") == ["Orders of the output's turn", "None at cold: r: after 40 deg the angle leaps by 9 deg"]


def test_exports_wait_for_each_other_and_each_has_its_word(page, bench):
    """Of Excel, PDF and Parquet, chosen one after the other, there was no PDF."""
    told = page.evaluate("""async () => {
      const { waiting } = await import('./static/waiting.js'), begun = [];
      let busy = '';
      const work = (kind, ending) => ({ kind, given: { ending } }), named = ({ kind, given }) => given.ending ?? kind;
      const begin = async (one) => { begun.push(named(one)); if (named(one) === 'mat') throw new Error('no'); busy = named(one); };
      const act = (promise) => promise.catch(() => {});
      const queue = waiting({ busy: () => busy, act, begin, changed: () => {}, apart: ({ kind }) => kind === 'export' });
      for (const ending of ['xlsx', 'pdf', 'parquet', 'pdf', 'mat', 'csv']) await queue.start(work('export', ending));
      await queue.start(work('compare'));
      await queue.start(work('diagnose'));
      const waits = queue.waits.map(named);
      for (let k = 0; k < 8; k++) {
        busy = '';
        queue.heard();
        await new Promise((done) => setTimeout(done, 5));
      }
      return [waits, begun];
    }""")
    waits, begun = told
    assert waits == ["pdf", "parquet", "mat", "csv", "diagnose"] and begun == ["xlsx", *waits]
    # What ended is told wherever one is, and those of before stay.
    folder = opened(bench.folder)
    page.evaluate("""async () => {
      const { exported } = await import('./static/export.js');
      document.getElementById('view').replaceChildren(exported('compare'));
    }""")
    words = page.locator(".exported > *")
    for number, (ending, fault) in enumerate((("xlsx", ""), ("pdf", "the disk is full"), ("csv", ""))):
        begun = time.time()
        result = {"files": [{"name": f"results/compare.{ending}", "bytes": 2000}], "what": "compare", "begun": begun, "command": "c"}
        folder.remember("jobs/export/result", result)
        (folder.memory / "jobs/export/beat.json").unlink(missing_ok=True)
        folder.remember("jobs/export/job", {"kind": "export", "given": {"what": "compare", "ending": ending}, "begun": begun})
        beat = {"state": "failed" if fault else "done", "fault": fault, "at": time.time(), "seconds": 1.0, "said": [], "tasks": []}
        folder.remember("jobs/export/beat", beat)
        words.nth(number).wait_for()
    page.locator(".exported", has_text="CSV: 1 file exported").wait_for()
    told = [line.split("\n")[0] for line in words.all_inner_texts()]
    assert told == ["Excel: 1 file exported to results/", "PDF: the disk is full", "CSV: 1 file exported to results/"]
