"""In, in headless Chromium: files are dropped, guessed, corrected and saved."""

import re

from browser import ANSWER, dropped, loop_file, until

from workbench.folder import opened

# A page that paints later than this lets one wait [ms].
FIRST_PAINT = 1000.0


def test_files_are_dropped_guessed_and_corrected(bench, tmp_path):
    """No line written, no key but one choice; the page is there at once, and asks nobody else."""
    page = dropped(bench, tmp_path)
    assert page.get_by_label("column of value").input_value() == "Verdrehung [arcmin]"
    assert page.get_by_label("pattern of the names").input_value() == "loop_{temperature}degC_{replicate}"
    # The best of three: a machine that is busy with other tests paints late.
    assert any(first_paint(bench.tab(), bench.address) < FIRST_PAINT for _ in range(3))
    drawn = page.evaluate(MILLION)
    print(f"a picture of 3 lines and a band of a million samples: {drawn['calls']} calls, {drawn['ms']:.1f} ms with rasterising")
    # Of a million samples a screen shows as many bars as it is wide.
    assert drawn["calls"] < 25_000


def test_an_angle_of_the_motor_is_mended_by_a_click_and_by_its_role(bench, tmp_path):
    """Doubted at its row; the role can be chosen there by hand, too; what one condition needs is not said of the others."""
    page, rows = bench.page, range(401)
    head = "Zeit [s];Winkel [deg];Drehfehler [arcsec]\n"
    (tmp_path / "Drehfehler_50Nm_15rpm_40C_1.csv").write_text(head + "\n".join(f"{0.02 * k:.2f};{217.8 * k:.1f};{k % 7}" for k in rows))
    (tmp_path / "Reibmoment_60C_1.csv").write_text("Motordrehzahl [1/min];Reibmoment [Nm]\n" + "\n".join(f"{300 * k};{0.2 + 0.1 * k:.1f}" for k in range(1, 7)))
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    page.set_input_files("#files", sorted(map(str, tmp_path.glob("*.csv"))))
    page.get_by_text("2 runs in 2 files, 2 conditions").wait_for()
    page.select_option("#measured", "RV20E-121")
    doubt, role = page.locator(".doubt", has_text="121 times the stated 15 rpm"), page.get_by_label("role of Winkel [deg]")
    doubt.get_by_role("button", name="Take Winkel [deg] for the angle of the input (motor)").click()
    doubt.wait_for(state="detached")
    assert role.input_value() == "input_angle"
    role.select_option("angle")
    doubt.wait_for()
    assert "--" not in doubt.inner_text()
    role.select_option(label="angle of the input (motor)")
    doubt.wait_for(state="detached")
    page.fill("#need-load_torque", "0")
    page.keyboard.press("Tab")
    page.locator("#save:enabled").wait_for()
    assert [page.get_by_label("load torque", exact=True).nth(k).input_value() for k in (0, 1)] == ["50", "0"]
    assert page.get_by_text("which is kept, not").count() == 0


def test_cells_that_make_conditions_alike_join_them_and_a_cell_of_both_says_it_of_both(bench, tmp_path):
    page = bench.page
    for k, degrees in enumerate((25, 28), 1):
        rows = "\n".join(f"{1.8 * n:.1f};{(n * k) % 7}" for n in range(201))
        (tmp_path / f"Drehfehler_50Nm_15rpm_{degrees}C_{k}.csv").write_text(f"Winkel Abtrieb [deg];Drehfehler [arcsec]\n{rows}")
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    page.set_input_files("#files", sorted(map(str, tmp_path.glob("*.csv"))))
    page.get_by_text("2 runs in 2 files, 2 conditions").wait_for()
    cells = page.get_by_label("temperature", exact=True)
    cells.nth(1).fill("25")
    page.keyboard.press("Tab")
    page.get_by_text("2 runs in 2 files, 1 condition", exact=True).wait_for()
    cells.nth(0).fill("30")
    page.keyboard.press("Tab")
    until(page, "document.querySelector('[aria-label=temperature]').value === '30'")
    assert page.get_by_text("2 runs in 2 files, 1 condition", exact=True).count() == 1
    cells.nth(0).fill("")
    page.keyboard.press("Tab")
    page.get_by_text("2 runs in 2 files, 2 conditions").wait_for()


def test_whose_angle_it_is_is_doubted_and_chosen_beside_the_columns(bench, tmp_path):
    page = bench.page
    head = "Zeit [s];Winkel Abtrieb [deg];Drehfehler [arcsec]\n"
    (tmp_path / "Drehfehler_50Nm_15rpm_40C_1.csv").write_text(head + "\n".join(f"{0.02 * k:.2f};{1.8 * k:.1f};{k % 7}" for k in range(201)))
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    page.set_input_files("#files", sorted(map(str, tmp_path.glob("*.csv"))))
    page.select_option("#measured", "RV20E-121")
    doubt = page.get_by_text("no head says for certain whose the angle is")
    doubt.wait_for()
    page.get_by_label("whose angle").select_option(label="the input, over the ratio")
    doubt.wait_for(state="detached")
    assert page.get_by_label("whose angle").input_value() == "input"


def test_a_unit_is_refused_where_it_is_typed_and_a_scale_stays(bench, tmp_path):
    page = dropped(bench, tmp_path)
    page.reload()
    page.get_by_label("unit of Verdrehung [arcmin]").select_option("other…")
    page.get_by_label("unit", exact=True).fill("arcmin/3437.75")
    page.keyboard.press("Tab")
    cell = page.locator("td", has=page.get_by_label("unit", exact=True))
    cell.get_by_text("a factor is no part of a unit").wait_for()
    assert page.get_by_label("unit", exact=True).input_value() == "arcmin/3437.75"
    page.get_by_label("scale of Verdrehung [arcmin]").fill("1/3437.75")
    page.keyboard.press("Tab")
    page.get_by_label("unit of Verdrehung [arcmin]").wait_for()
    bench.view("in")
    page.reload()
    page.get_by_label("scale of Verdrehung [arcmin]").wait_for()
    assert page.get_by_label("scale of Verdrehung [arcmin]").input_value() == "1/3437.75" and "scale = 0.0002908" in page.locator("pre.file").text_content()


def test_from_the_doubt_about_a_locked_input_a_click_leads_to_its_cell_where_mean_may_be_typed(bench, tmp_path):
    """Before saving, after it, and where campaign.toml was written by hand."""
    page = dropped(bench, tmp_path)
    page.select_option("#measured", "RV20E-121")
    page.get_by_role("combobox", name="locked").select_option("input")
    page.locator(".note", has_text="nobody says where the input was locked").get_by_role("button", name="Say it: locked at").click()
    cell = page.locator("input:focus")
    assert cell.get_attribute("aria-label") == "locked at" and cell.get_attribute("placeholder") == "or mean"
    assert page.get_by_label("load torque", exact=True).count() == 0 and page.get_by_text('"mean" may be typed instead').is_visible()
    page.locator("#save:enabled").wait_for()
    assert "fault" not in page.evaluate("async () => (await fetch('in/save', { method: 'POST', body: '{}' })).text()")
    (bench.folder / "campaign.toml").write_text("# by hand\n" + (bench.folder / "campaign.toml").read_text(encoding="utf-8"), encoding="utf-8")
    bench.view("in")
    page.reload()
    page.locator("#cells-conditions").wait_for()
    page.locator("#findings .note", has_text="nobody says where the input was locked").get_by_role("button", name="Say it: locked at").click()
    assert (cell.get_attribute("aria-label") or "").startswith("locked at of ")
    cell.fill("mean")
    cell.press("Tab")
    page.locator("#findings .note", has_text="nobody says").wait_for(state="detached")
    assert 'locked_at = "mean"' in (bench.folder / "campaign.toml").read_text(encoding="utf-8")


def test_a_guess_that_is_right_is_stated_by_a_click_and_saving_says_what_stands_open(bench, tmp_path):
    """The field was empty although names hold the angle, saving went on without a word, and a right guess could not be stated as it is."""
    page = bench.page
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    paths = [loop_file(tmp_path / f"Schleife_{place}Grad_1.csv", 200 + place, 400.0) for place in (40, 300)]
    for path in paths:
        path.write_text(path.read_text(encoding="utf-8").replace("Verdrehung [arcmin]", "Lage"), encoding="utf-8")
    page.set_input_files("#files", [str(path) for path in paths])
    page.get_by_text("2 runs in 2 files, 2 conditions").wait_for()
    page.select_option("#measured", "RV20E-121")
    page.locator("#save:enabled").wait_for()
    names = page.locator("tr", has=page.get_by_label("held out")).locator("b").all_inner_texts()
    told = page.locator("#open")
    assert "where the input was locked in 300Grad, 40Grad: loops are predicted as the mean over a turn" in told.inner_text()
    assert "what else is not sure above is taken as it stands" in told.inner_text()
    # A unit, a tag, and the angles that names hold.
    page.get_by_role("button", name=re.compile("so it is: Lage is value")).click()
    page.locator("td.reason", has_text="(given: ").wait_for()
    page.get_by_role("button", name="so it is: locked input").click()
    page.get_by_role("button", name="so it is: locked input").wait_for(state="detached")
    assert page.get_by_placeholder("40 deg?").count() == 1
    page.get_by_role("button", name="Yes: locked at 300 deg, 40 deg, as their names say").click()
    told.wait_for(state="detached")
    assert [one.input_value() for one in page.get_by_label("locked at", exact=True).all()] == ["300", "40"]
    assert page.locator("tr", has=page.get_by_label("held out")).locator("b").all_inner_texts() == names
    # The same said of the numbers in the names leaves the conditions their names.
    page.get_by_label("locked at", exact=True).first.fill("")
    page.get_by_label("locked at", exact=True).first.press("Tab")
    page.get_by_label("numbers in the names").select_option(label="input locked at [°]")
    told.wait_for(state="detached")
    assert page.locator("tr", has=page.get_by_label("held out")).locator("b").all_inner_texts() == names


def test_from_where_measurements_count_is_chosen_and_mountings_get_a_column(bench, tmp_path):
    page = dropped(bench, tmp_path)
    page.select_option("#measured", "RV20E-121")
    page.get_by_label("zero of hysteresis").select_option(label="known: its mean counts")
    page.locator("pre.file", has_text='zero = "absolute"').wait_for(state="attached")
    assert page.get_by_label("mounting", exact=True).count() == 0
    page.locator("#mountings").select_option("apart")
    page.get_by_label("mounting", exact=True).first.fill("2")
    page.get_by_label("mounting", exact=True).first.press("Tab")
    page.locator("pre.file", has_text='mounting = "2"').wait_for(state="attached")
    page.locator("#mountings").select_option("")
    page.get_by_label("mounting", exact=True).first.wait_for(state="detached")
    assert "mounting = " not in page.locator("pre.file").text_content()


def test_from_a_note_of_a_result_about_a_locked_input_a_click_leads_to_its_cell(bench, tmp_path):
    """In had such a button, Look and Diagnose told what to write and not where."""
    page, text = dropped(bench, tmp_path), "loops in 20degC: nobody says where the input was locked; state it"
    page.select_option("#measured", "RV20E-121")
    page.get_by_role("combobox", name="locked").select_option("input")
    page.locator("#save:enabled").wait_for()
    assert "fault" not in page.evaluate("async () => (await fetch('in/save', { method: 'POST', body: '{}' })).text()")
    folder = opened(bench.folder)
    shown = ANSWER["page"] | {"warnings": [text, "another"]}  # type: ignore[operator]
    folder.remember("jobs/diagnose/job", {"kind": "diagnose", "given": {"model": "RV20E-121"}, "begun": 1.0})
    folder.remember("jobs/diagnose/beat", {"state": "done", "at": 2.0, "seconds": 1.0, "said": [], "tasks": []})
    folder.remember("jobs/diagnose/result", ANSWER | {"page": shown, "cells": {text: ["20degC", "locked_at"]}})
    bench.view("diagnose")
    notes = page.locator(".note:visible", has=page.locator("button"))
    notes.get_by_role("button", name="Say it: locked at").click()
    page.locator("input:focus").wait_for()
    assert page.locator("input:focus").get_attribute("id") == "c-20degC-locked_at"
    assert page.locator("#tab-in[aria-selected=true]").count() == 1
    told = page.evaluate("""async (text) => {
      const { notes } = await import('./static/look_parts.js'), went = [];
      const found = notes({ warnings: [text], calibrated: [], cells: { [text]: ['angle'] } }, { go: (name) => went.push(name) });
      found.querySelector('.note button').click();
      // Of a model that nobody diagnosed it is asked later.
      const first = notes({ warnings: [text], calibrated: [], cells: { [text]: ['diagnose'] } }, { go: (name) => went.push(name) });
      first.querySelector('.note button').click();
      return [found.querySelector('.note').textContent, first.querySelector('.note').textContent, went];
    }""", text)
    assert told == [f"{text} Say it: whose the angle is", f"{text} Diagnose first", ["in", "diagnose"]]


def test_families_of_one_quantity_are_corrected_together_and_conditions_in_one_place(bench, tmp_path):
    page = bench.page
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    page.set_input_files("#files", [str(loop_file(tmp_path / name, 200, 400.0)) for name in ("cold_0degC_1.csv", "warm_40degC_1.csv")])
    page.get_by_text("2 runs in 2 files, 2 conditions").wait_for()
    page.select_option("#measured", "RV20E-121")
    page.get_by_label("the same for all of this quantity").first.check()
    unit = page.get_by_label("unit of Verdrehung [arcmin]")
    unit.first.select_option("arcsec")
    while [one.input_value() for one in unit.all()] != ["arcsec", "arcsec"]:
        page.wait_for_timeout(100)
    # The box stands at the height of its row's fields.
    page.get_by_role("checkbox", name="held out").first.check()
    page.locator("label.held .reason").first.wait_for()
    middles = page.evaluate("""() => [...document.querySelector('label.held .reason').closest('tr').querySelectorAll('input')].map((e) => {
      const box = e.getBoundingClientRect(); return box.top + box.height / 2; })""")
    assert max(middles) - min(middles) < 2
    assert "fault" not in page.evaluate("async () => (await fetch('in/save', { method: 'POST', body: '{}' })).text()")
    page.goto(f"{bench.address}#in")
    page.reload()
    page.locator("#cells-runs").wait_for()
    assert page.locator("#cells-conditions").count() == 0


def test_names_that_differ_by_a_number_are_one_table_and_what_it_says_is_chosen(bench, tmp_path):
    """Loads without a unit; loops of other names keep what their words say."""
    page = bench.page
    head = "Zeit [s];Winkel [deg];Drehfehler [arcsec]\n"
    for load in (20, 80, 167):
        (tmp_path / f"Drehfehler_{load}_15rpm_40C_1.csv").write_text(head + "\n".join(f"{0.02 * k:.2f};{1.8 * k:.1f};{k % 7}" for k in range(201)))
    for place in (0, 40):
        loop_file(tmp_path / f"loop_{place}deg_25C_1.csv", 200 + place, 400.0)
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    page.set_input_files("#files", sorted(map(str, tmp_path.glob("*.csv"))))
    page.get_by_text("5 runs in 5 files, 5 conditions").wait_for()
    page.select_option("#measured", "RV20E-121")
    assert page.get_by_label("quantity", exact=True).count() == 2
    page.get_by_text("The 3 numbers in these names (20, 80, 167) are").wait_for()
    # What tells them apart is seen before anything is opened.
    assert page.get_by_text("3 runs: 167, 20, 80", exact=True).get_attribute("title").splitlines()[0] == "Drehfehler_167_15rpm_40C_1.csv"
    page.get_by_text("The 2 numbers in these names (0, 40) are").wait_for()
    loads, places = page.get_by_label("numbers in the names").nth(0), page.get_by_label("numbers in the names").nth(1)
    # Degrees are where the input was locked, and of a transmission error no input is.
    assert places.locator("option").all_inner_texts() == ["names alone", "input locked at [°]"] and "locked" not in loads.inner_text()
    places.select_option(label="input locked at [°]")
    page.get_by_text("The 2 numbers in these names").wait_for(state="detached")
    page.get_by_label("numbers in the names").select_option(label="load torque [N m]")
    page.get_by_text("The 3 numbers in these names").wait_for(state="detached")
    assert page.get_by_label("pattern of the names").first.input_value() == "Drehfehler_{load}_{speed}rpm_{temperature}C_{replicate}"
    # A loop has no load and no speed, and where an input was locked is nothing of one that runs.
    loads, places, speeds = ([one.input_value() for one in page.get_by_label(key, exact=True).all()] for key in ("load torque", "locked at", "output speed"))
    assert sorted(loads) == ["167", "20", "80"] and sorted(places) == ["0", "40"] and len(speeds) == 3 and page.get_by_text("5 runs in 5 files, 5 conditions").count() == 1


def test_units_typed_in_cells_are_read_or_told_at_once(bench, tmp_path):
    """Cells said "1000 in-lbf N.m", and 77 X was taken without a word."""
    page = bench.page
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    names = ("1000 in-lbf 77F run A", "1000 in-lbf 77F run B", "500 in-lbf 77F run A")
    head = "Zeit [s];Winkel [deg];Drehfehler [arcsec]\n"
    for k, name in enumerate(names):
        (tmp_path / f"Drehfehler 15rpm {name}.csv").write_text(head + "\n".join(f"{0.02 * i:.2f};{1.8 * i:.1f};{(i + k) % 7}" for i in range(201)))
    page.set_input_files("#files", sorted(map(str, tmp_path.glob("*.csv"))))
    page.get_by_text("3 runs in 3 files, 2 conditions").wait_for()
    page.select_option("#measured", "RV20E-121")
    # The reducer that was chosen has the page drawn anew.
    page.locator("#save:not([disabled])").wait_for()
    page.get_by_text("another unit may be typed with it, such as 1478 in-lbf or 77 F").wait_for()
    assert page.get_by_label("pattern of the names").count() == 1
    load, warmth = page.get_by_label("load torque", exact=True).first, page.get_by_label("temperature", exact=True).first
    beside = "e => e.parentElement.querySelector('span').textContent"
    assert load.input_value() == "1000 lbf.inch" and load.evaluate(beside) == ""
    load.fill("113")
    assert load.evaluate(beside) == "N m"
    load.fill("1001 in-lbf")
    load.press("Tab")
    while 'load_torque = "1001 in-lbf"' not in (page.locator("pre.file").text_content() or ""):
        page.wait_for_timeout(100)
    warmth.fill("78 X")
    warmth.press("Tab")
    page.get_by_text("unit 'X' is not known").wait_for()


def first_paint(page, address):
    """When a new tab shows something [ms]; it is closed."""
    page.goto(address)
    page.locator("#tab-in").wait_for()
    paints = page.evaluate("performance.getEntriesByType('paint').filter(e => e.name === 'first-contentful-paint').map(e => e.startTime)")
    page.close()
    return paints[0] if paints else float("inf")


# Draws with the page's own plot, counting what is asked of the canvas.
MILLION = """async () => {
    const { Plot } = await import('./static/plot.js'), { paint } = await import('./static/paint.js');
    const n = 1_000_000, x = Float32Array.from({ length: n }, (_, i) => i / 1000), wave = (k) => x.map((v, i) => Math.sin(v * k) + 0.1 * Math.sin(i));
    const plot = new Plot({ height: 460 });
    document.getElementById('view').replaceChildren(plot.element);
    const line = (name, y) => ({ name, x, y, colour: '--measured' });
    plot.set({ xTitle: 'x', panes: [
      { title: 'y', weight: 2, lines: [line('measured', wave(1)), line('predicted', wave(1.01))], bands: [{ x, low: wave(1), high: wave(1.1) }] },
      { title: 'r', lines: [line('residual', wave(3))] }] });
    paint(plot);
    const own = CanvasRenderingContext2D.prototype;
    let calls = 0;
    for (const name of ['lineTo', 'moveTo', 'fillRect']) { const before = own[name]; own[name] = function (...given) { calls++; return before.apply(this, given); }; }
    const begun = performance.now();
    // What is read back is really drawn.
    for (let i = 0; i < 10; i++) { plot.link.range = [i, 1000 - 20 * i]; paint(plot); plot.canvas.getContext('2d').getImageData(0, 0, 1, 1); }
    return { calls: calls / 10, ms: (performance.now() - begun) / 10 };
  }"""
