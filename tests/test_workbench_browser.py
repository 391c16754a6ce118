"""The workbench driven as a user drives it, in headless Chromium: from dropped files to the fallen error.

The whole loop takes some minutes: ``pytest -m campaign tests/test_workbench_browser.py``.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import numpy as np
import pytest

from fmu_src.faults import InputFault
from workbench.folder import opened
from workbench.steps import PAGE_OF_FOUND

ROOT = Path(__file__).parents[1]
EXAMPLE = ROOT / "examples" / "hidden_effect" / "campaign"
CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
# A page that paints later than this lets one wait [ms].
FIRST_PAINT = 1000.0


@pytest.fixture(scope="module")
def chromium():
    """Skipped with a word where something is missing."""
    pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright: pip install playwright")
    if CHROMIUM is None:
        pytest.skip("no Chromium: apt-get install chromium")
    with playwright.sync_playwright() as tools:
        browser = tools.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield browser
        browser.close()


class Bench:
    """The command, its folder, and a page; what the page asks of others or complains of is kept."""

    def __init__(self, chromium, folder: Path, **more: str):
        self.folder, self.chromium, self.more = folder, chromium, more
        self.trouble: list[str] = []
        self.start()
        self.page = self.tab()

    def start(self):
        command = [sys.executable, "-m", "cli", "workbench", str(self.folder), "--no-browser"]
        self.process = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, env=os.environ | self.more)
        assert self.process.stdout
        assert self.process.stdout.readline().startswith("workbench of ")
        self.address = self.process.stdout.readline().strip()

    def tab(self):
        page = self.chromium.new_page(viewport={"width": 1280, "height": 900})
        page.set_default_timeout(60_000)
        page.on("pageerror", lambda e: self.trouble.append(f"script: {e}"))
        page.on("request", lambda r: None if r.url.startswith((self.address, "data:", "blob:")) else self.trouble.append(f"asked elsewhere: {r.url}"))
        return page

    def kill(self):
        self.process.kill()
        self.close()

    def close(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
        assert self.process.wait(10) in (0, -signal.SIGKILL)
        assert self.process.stdout
        self.process.stdout.close()

    def view(self, name):
        self.page.goto(f"{self.address}#{name}")
        self.page.locator(f"#tab-{name}[aria-selected=true]").wait_for()


@pytest.fixture
def bench(chromium, tmp_path, request):
    # A diagnosis that is remembered from an earlier run could not be stopped.
    fresh = {"XDG_CACHE_HOME": str(tmp_path / "cache")} if request.node.get_closest_marker("campaign") else {}
    there = Bench(chromium, tmp_path / "bench 1", **fresh)
    yield there
    there.close()
    assert not there.trouble


def loop_file(path: Path, rows: int, stiffness: float) -> Path:
    """A loop as a bench writes it: semicolons, decimal commas, a unit in the head."""
    torque = 160.0 * np.sin(np.linspace(0.0, 2.0 * np.pi, rows))
    turning = torque / stiffness + 0.05 * np.sign(torque) + 0.003 * np.random.default_rng(rows).standard_normal(rows)
    text = "Drehmoment [Nm];Verdrehung [arcmin]\n" + "\n".join(f"{t:.3f};{y:.4f}" for t, y in zip(torque, turning))
    path.write_text(text.replace(".", ","), encoding="utf-8")
    return path


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
    page.wait_for_function("document.querySelector('[aria-label=temperature]').value === '30'")
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


def test_saving_says_at_once_that_it_is_at_work_and_can_be_clicked_again_where_it_was_refused(bench, tmp_path):
    """For seconds nothing moved."""
    page, held = dropped(bench, tmp_path), []
    page.select_option("#measured", "RV20E-121")
    page.get_by_role("combobox", name="locked").select_option("output")
    page.locator("#save:enabled").wait_for()

    def asked(route):
        held.append(route)

    page.route("**/in/save", asked)
    page.click("#save")
    page.locator("#save:disabled", has_text="Saving …").wait_for(timeout=500)
    assert page.locator("#saving progress").is_visible()
    while not held:
        page.wait_for_timeout(50)
    held[0].fulfill(status=400, json={"fault": "the disk is full"})
    page.get_by_text("the disk is full").wait_for()
    page.locator("#save:enabled", has_text="Save and compare").wait_for()
    assert page.locator("#saving progress").count() == 0
    page.unroute("**/in/save")
    page.click("#save")
    page.locator("#tab-look[aria-selected=true]").wait_for()
    assert (bench.folder / "campaign.toml").is_file()


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
    page.locator("td.reason", has_text="unit: given").wait_for()
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
    page.get_by_label("numbers in the names").select_option(label="load torque [N·m]")
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
    assert load.evaluate(beside) == "N.m"
    load.fill("1001 in-lbf")
    load.press("Tab")
    while 'load_torque = "1001 in-lbf"' not in (page.locator("pre.file").text_content() or ""):
        page.wait_for_timeout(100)
    warmth.fill("78 X")
    warmth.press("Tab")
    page.get_by_text("unit 'X' is not known").wait_for()


def test_a_result_of_another_model_says_so(bench, tmp_path):
    page = dropped(bench, tmp_path)
    said = page.evaluate(PAST)
    assert said[0] == "" and "is of RV20E-121; the model that is chosen now is model.toml" in said[1] and "have changed since" in said[2]
    assert said[3] == "" and said[4] == "What stands below is of before. It is being computed anew." and "came to no result" in said[5]


def test_a_word_that_stands_as_a_whole_is_searched_as_a_whole(bench):
    page = bench.page
    page.goto(bench.address)
    found = page.evaluate("""async () => {
      const { matcher } = await import('./static/search.js');
      const titles = ['hysteresis_40deg', 'hysteresis 40degC', 'hysteresis at 10degC', 'Übertragungsfehler (order 4)', 'Übertragungsfehler (order 40)'];
      return ['40deg', '40', '40d', 'hyst 10deg', 'order 4', '(order', '', 'fehler 40'].map((text) => titles.flatMap((t, k) => (matcher(text, titles)(t) ? [k] : [])));
    }""")
    assert found == [[0], [0, 1, 4], [0, 1], [2], [3], [3, 4], [0, 1, 2, 3, 4], [4]]


# Of the chosen model, of another, of files that changed since, and while it is asked anew: once it is there, before, and where nothing comes of it.
PAST = """async () => {
    const { past } = await import('./static/past.js'), result = { model: 'RV20E-121', begun: 1 };
    const told = (model, job) => past(result, { begun: 1, old: false, state: 'done', ...job }, { model: () => model });
    return [told('RV20E-121', {}), told('model.toml', {}), told('RV20E-121', { old: true }), told('RV20E-121', { state: 'running' }),
      told('RV20E-121', { begun: 2, old: true, state: 'running' }), told('RV20E-121', { begun: 2, state: 'stopped' })];
  }"""


def test_numbers_behind_a_plot_tell_excel_that_they_are_utf8(bench):
    bench.page.goto(bench.address)
    text = """async (text) => { const { marked } = await import('./static/behind.js'); return marked(text); }"""
    assert [bench.page.evaluate(text, head) for head in ('"angle [°]"\n1', '"x [m]"\n1', "滞回")] == ['\ufeff"angle [°]"\n1', '"x [m]"\n1', "\ufeff滞回"]


def test_a_bad_file_stands_in_its_row_and_a_server_that_is_gone_says_so(bench, tmp_path):
    page = dropped(bench, tmp_path)
    (tmp_path / "loop_1.csv").write_text("nothing\n")
    page.set_input_files("#files", str(tmp_path / "loop_1.csv"))
    row = page.locator("#unread tr", has_text="loop_1.csv")
    row.get_by_text("no table of numbers").wait_for()
    assert page.get_by_label("column of value").input_value() == "Verdrehung [arcmin]"
    assert "reducer has to be chosen" in (page.get_attribute("#save:disabled", "title") or "")
    row.get_by_role("button", name="Remove").click()
    page.locator("#unread").wait_for(state="detached")
    assert not (bench.folder / "loop_1.csv").exists()
    bench.kill()
    gone = page.locator("#gone", has_text=f'rvwear workbench "{bench.folder}"')
    gone.wait_for()
    # A view that was never opened cannot be had: nothing is thrown, and what is seen stays.
    page.click("#tab-try")
    page.locator("#tab-in[aria-selected=true]").wait_for()
    assert gone.is_visible() and page.locator("#work").is_hidden() and page.url.endswith("#in")
    bench.start()
    page.goto(bench.address)
    page.get_by_text("2 runs in 2 files, 1 condition").wait_for()


def first_paint(page, address):
    """When a new tab shows something [ms]; it is closed."""
    page.goto(address)
    page.locator("#tab-in").wait_for()
    paints = page.evaluate("performance.getEntriesByType('paint').filter(e => e.name === 'first-contentful-paint').map(e => e.startTime)")
    page.close()
    return paints[0] if paints else float("inf")


def dropped(bench, tmp_path):
    """The page with two repetitions of a loop."""
    page = bench.page
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    page.set_input_files("#files", [str(loop_file(tmp_path / f"loop_20degC_{k}.csv", 200 + k, 400.0)) for k in (1, 2)])
    page.get_by_text("2 runs in 2 files, 1 condition").wait_for()
    return page


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


def test_a_refused_effect_reads_as_refused_and_offers_no_better_model(bench):
    """The error on unused runs rose: in bad colours, no units to build, the other of what was named to try instead."""
    page = bench.page
    page.goto(bench.address)
    refused, kept = (page.evaluate(ADDED, [is_kept, after]) for is_kept, after in ((False, 25.5), (True, 1.2)))
    assert "How the error fell" not in refused["heads"] and "How the error fell" in kept["heads"]
    assert any(head.startswith("Refused: crank eccentricity + raceway wear (inner)") for head in refused["heads"])
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
      return [['none', null], ['none', found], ['one effect', null]].map(([verdict, next]) => {
        const part = nextPart({ answer: { model: 'RV20E-121', verdict }, next, context: { busy: () => '' } });
        return [part.querySelector('h2').textContent, part.querySelector('#next').closest('details')?.open ?? null];
      });
    }""")
    nothing = "Nothing is left to explain: no further experiment is asked for"
    assert told == [[nothing, False], [nothing, True], ["What to measure next", None]]


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
    return { heads: texts('h2, h3'), buttons: texts('button'), after: place.querySelectorAll('#ladder tbody td')[4].firstElementChild.className };
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
      const during = [queue.next, [...begun]];
      busy = '';
      queue.heard();
      await queue.start('life');
      queue.leave();
      busy = '';
      queue.heard();
      // Another tab was first, which this one has not heard yet.
      await queue.start('late');
      const late = queue.next;
      queue.heard();
      await new Promise((done) => setTimeout(done, 0));
      return [during, late, begun];
    }""")
    assert told == [["diagnose", ["compare"]], "late", ["compare", "diagnose", "late"]]
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


def test_on_a_telephone_tables_are_rows_names_fold_and_the_job_at_work_takes_one_line(bench):
    page = bench.page
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    cut = page.evaluate("""async () => {
      const { h, table } = await import('./static/dom.js'), place = document.getElementById('view');
      place.replaceChildren(h('div', { class: 'panel' }, table(['signal', 'changes it by', 'error before', 'after'], [['transmission error', '0.0777 arcsec', '0.467 arcsec', '0.467 arcsec']])));
      const box = place.querySelector('.scroll'), work = document.getElementById('work');
      work.replaceChildren(h('b', {}, 'Looking for the next experiment'), h('progress'), h('span', { class: 'doing' }, 'screening, pin_seats.four_waves: 23 of 86, about 36 s left'), h('button', {}, 'Stop'));
      work.hidden = false;
      return [box.scrollWidth - box.clientWidth, getComputedStyle(box.querySelectorAll('td')[3], '::before').content, work.offsetHeight];
    }""")
    assert cut[:2] == [0, '"after: "'] and cut[2] < 42
    lines = page.evaluate("""async () => {
      const { folded } = await import('./static/paint.js'), c = document.createElement('canvas').getContext('2d');
      const room = c.measureText('1500rpm_167N.').width, names = ['1500rpm_167N.m_warm', 'with_einlaufenderungeschmiert_2'];
      return names.map((name) => [folded(c, name, room), Math.max(...folded(c, name, room).map((line) => c.measureText(line).width - room))]);
    }""")
    # A word that is wider than its place is parted, not cut.
    assert ["".join(parts) for parts, _ in lines] == ["1500rpm_167N.m_warm", "with_einlaufenderungeschmiert_2"]
    assert all(len(parts) > 1 and over <= 0 for parts, over in lines)


# A diagnosis as the page has it.
ANSWER = {"model": "RV20E-121", "tone": "fair", "verdict": "stopped", "headline": "h", "reason": "r", "seconds": 9.0, "effects": [], "confusable": [],
          "base_off": [], "left": "", "sizes": "", "together": "", "stand_ins": [], "rejected": [], "laws": [],
          "page": {"cards": [], "sections": [], "warnings": []}, "doubts": [], "command": "c"}  # fmt: skip


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
    folder.remember("jobs/diagnose/result", answer | {"found": None})
    bench.page.reload()
    head.get_by_text("one effect · 3 min of computing").wait_for()


def test_what_is_at_work_is_told_step_by_step_and_how_long_in_all(bench):
    """Adding an effect took minutes without a word; a diagnosis told of its step alone."""
    folder = opened(bench.folder)
    shutil.copytree(EXAMPLE, bench.folder, dirs_exist_ok=True)
    answer = ANSWER | {"rejected": [{"name": "needle_clearance"}]}
    folder.remember("jobs/diagnose/result", answer)
    far = time.time() + 3600.0

    def at_work(kind, *tasks, said=()):
        for other in ("diagnose", "extend"):
            state = "running" if other == kind else "stopped"
            folder.remember(f"jobs/{other}/job", {"kind": other, "given": {"model": "RV20E-121"}, "begun": far})
            told = [{"done": 0, "total": None, "left": None, "before": None, "what": what, "sentence": what} | more for what, more in tasks]
            folder.remember(f"jobs/{other}/beat", {"state": state, "at": far, "seconds": 3.0, "said": list(said), "tasks": told if other == kind else []})

    at_work("extend", ("adding needle_clearance", {}), ("fitting the base model", {}))
    bench.view("diagnose")
    page = bench.page
    page.locator("#doing-extend li").nth(1).wait_for()
    assert page.locator("#doing-extend li").all_inner_texts() == ["adding needle_clearance", "fitting the base model"]
    at_work("diagnose", ("diagnosing", {}), ("the whole diagnosis", {"before": 600.0, "left": 240.0}), ("screening", {}), ("placing", {}))
    page.get_by_text("About 4 min left in all: the last one took 10 min.").wait_for()
    assert page.locator("#step").inner_text() == "screening › placing"
    at_work("diagnose", ("diagnosing", {}), ("the whole diagnosis", {"before": 600.0}), ("screening", {}))
    page.get_by_text("Longer than the last one by now: the last one took 10 min.").wait_for()
    # Of one that was found again nothing is diagnosed, and nothing would be known sooner by stopping.
    at_work("diagnose", (PAGE_OF_FOUND, {}), said=["found again: the diagnosis of before"])
    page.locator("#view").get_by_text("found again: the diagnosis of before").wait_for()
    shown = page.locator("#view").inner_text()
    assert "Found again" in shown and PAGE_OF_FOUND in shown and "Diagnosing" not in shown and "as far as it is known" not in shown
    at_work("")


def test_what_is_significant_is_no_share_of_nothing(bench):
    page = bench.page
    page.goto(bench.address)
    found = page.evaluate("""async () => {
      const { fails } = await import('./static/look_parts.js');
      const place = (share) => ({ signal: 'transmission_error', feature: 'orders', dependence: 'load', share, p: 8e-7, why: null });
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
              "axis": {"name": "angle", "title": "angle"}, "errors": [{"ratio": 14.12, "held_out": False}, {"ratio": 13.96, "held_out": True}],
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
    assert told == ["transmission error 14.1×, held out 14.0×", "c 14.0×"]


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


def test_the_reducer_view_of_a_model_file_names_its_effects_and_has_their_numbers_first(bench):
    text = '[model]\nname = "better"\nreducer = "RV20E-121-rigid"\n[effects.thermal_expansion]\nexpansion = "2e-6 1/K"\n'
    (bench.folder / "model.toml").write_text(text, encoding="utf-8")
    bench.page.goto(f"{bench.address}#reducer")
    bench.page.locator("label", has_text="reducer").locator("select").select_option("model.toml")
    bench.page.locator("h1", has_text="model.toml (better) with thermal expansion").wait_for()
    first = bench.page.locator("tbody tr").first.inner_text()
    assert "effects.thermal_expansion.expansion" in first and "1/K" in first
    assert bench.page.locator("p.lead").inner_text().startswith("The model is RV20E-121-rigid with thermal expansion.")


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
    assert "um/kN" in page.locator("tr", has=page.locator("[id='n-crank.support_compliance']")).inner_text()
    # What cannot be made says what to type, and where one types it stays.
    page.fill("#ask-lost_motion", "0.1")
    page.get_by_text("type bearing.clearance in 'Every number of its file' below").wait_for()
    assert page.locator("[id='n-bearing.clearance']").is_visible() and page.get_by_text("as it could last be made").is_visible()
    page.fill("#ask-lost_motion", "1")
    page.get_by_text("as it could last be made").wait_for(state="detached")


def test_a_view_that_was_left_draws_nothing_into_the_next_one(bench, tmp_path):
    """Neither while the next one is still fetched nor when what the former waited for comes at last."""
    page, held = dropped(bench, tmp_path), {}
    page.select_option("#measured", "RV20E-121")
    page.locator("#save:enabled").wait_for()
    page.evaluate("() => fetch('in/save', { method: 'POST', body: '{}' })")
    page.route("**/try", lambda route: held.setdefault("try", route))
    page.route("**/static/reducer.js", lambda route: held.setdefault("reducer", route))
    page.click("#tab-try")
    page.get_by_text("Making the model ready…").wait_for()
    page.click("#tab-reducer")
    page.locator("#tab-reducer[aria-selected=true]").wait_for()
    tries = page.locator("#view").get_by_placeholder("search effects").or_(page.get_by_text("Making the model ready"))
    assert tries.count() == 0 and page.locator("#view").inner_text() == "Loading…"
    held["reducer"].continue_()
    page.get_by_role("button", name="Complete one from a few numbers").wait_for()
    held["try"].fulfill(status=400, json={"fault": "too late"})
    page.wait_for_timeout(300)
    assert tries.count() == 0 and page.get_by_text("too late").count() == 0


def test_the_report_of_a_life_says_that_it_draws_until_it_is_there(bench):
    page, held = bench.page, []

    def asked(route):
        held.append(route)

    page.goto(bench.address)
    page.route("**/results/life", lambda route: route.fulfill(json={"title": "a life", "panes": [], "hours": [0, 1], "file": "x", "command": ""}))
    page.route("**/results/life/report*", asked)
    page.evaluate("""async () => {
      const { show } = await import('./static/life.js'), state = { jobs: { life: { state: 'done', result: true, given: { model: 'RV20E-121' } } } };
      const place = document.getElementById('view');
      place.replaceChildren();
      show(place, { state, busy: () => '', model: () => 'RV20E-121', modelChooser: () => document.createElement('span') });
    }""")
    word = page.get_by_text("Drawing the report…")
    word.wait_for()
    while not held:
        page.wait_for_timeout(50)
    held[0].fulfill(body="<p>report</p>", content_type="text/html")
    word.wait_for(state="hidden")
    assert page.locator(".past").count() == 0


def test_a_life_of_another_model_says_so(bench):
    page = bench.page
    page.goto(bench.address)
    page.route("**/results/life", lambda route: route.fulfill(json={"title": "a life", "panes": [], "hours": [0, 1], "file": "x", "command": ""}))
    said = page.evaluate("""async () => {
      const { show } = await import('./static/life.js'), job = { state: 'done', result: true, old: true, given: { model: 'RV20E-121' } };
      const place = document.getElementById('view'), context = { state: { jobs: { life: job } }, busy: () => '', modelChooser: () => '' }, said = [];
      for (const [made, chosen] of [['RV20E-121', 'model.toml'], ['RV20E-121', 'RV20E-121'], ['model.toml', 'model.toml']]) {
        job.given = { model: made };
        place.replaceChildren();
        show(place, { ...context, model: () => chosen });
        for (let k = 0; k < 100 && !place.querySelector('h1'); k++) await new Promise((done) => setTimeout(done, 50));
        said.push([place.querySelector('.past-note')?.textContent ?? '', !!place.querySelector('.past h1')]);
      }
      return said;
    }""")
    # Measurements that changed say nothing of a life of a reducer of the library; the file of a model may be another since.
    assert said[0] == ["What stands below is of RV20E-121; the model that is chosen now is model.toml.", True] and said[1] == ["", False]
    assert "they have changed since" in said[2][0]


def test_a_life_that_runs_says_what_its_hours_count_from_and_which_pass_it_is_and_why(bench):
    """"525 of 10,000 h" of the second pass, or after a pause, might have been hours of that pass alone; they went back without a word of why."""
    panes = [{"title": "depth", "unit": "µm", "lines": [{"name": "flank", "values": [0, 2.5]}]}]
    now = {"model": "RV20E-121", "hours": [0, 525], "until": 10_000, "jumps": 1, "pass": 1, "why": "", "ended": False, "panes": panes}
    page, live = bench.page, {"now": now, "before": {}}
    page.goto(bench.address)
    page.route("**/results/life/live", lambda route: route.fulfill(json=live))
    show = """async (state) => {
      const { show } = await import('./static/life.js'), place = document.getElementById('view');
      const job = { state, given: { model: 'RV20E-121' } };
      place.replaceChildren();
      show(place, { state: { jobs: { life: job } }, busy: () => '', model: () => 'RV20E-121', modelChooser: () => '' });
      for (let k = 0; k < 100 && !place.querySelector('h1'); k++) await new Promise((done) => setTimeout(done, 50));
      return ['h1', '.lead', '#which-pass', '.note'].map((part) => place.querySelector(part)?.textContent ?? '');
    }"""
    title = "RV20E-121: 525 of 10,000 operating hours since new, pass 1"
    first = "Pass 1, in 1 jump; then again from 0 h in more of them, until two passes agree. Figures and solid curves are of this pass, as rough as its jumps."
    assert page.evaluate(show, "running") == [title, "pass 1, in 1 jump: flank 2.50 µm", first, ""]
    now |= {"jumps": 6, "pass": 2, "why": "again from 0 h in 6 jumps, each a part of one of the 3 before: the difference is their error"}
    live["before"] = {"jumps": 3, "pass": 1, "hours": [0, 1], "panes": panes}
    title, second = title.replace("pass 1", "pass 2"), f"Pass 2: {now['why']}. Figures and solid curves are of this pass and its 6 jumps; dashed: pass 1, in 3."
    assert page.evaluate(show, "running") == [title, "pass 2, in 6 jumps: flank 2.50 µm", second, ""]
    # Gone on with after a pause nobody has the curves of the pass before.
    live["before"] = {}
    paused = "Paused at 525 of 10,000 operating hours since new, pass 2: the life goes on from its last jump, as long as hours, torque, speed and model stay."
    assert page.evaluate(show, "stopped")[2:] == [second.replace("; dashed: pass 1, in 3", ""), paused]
    now["ended"] = True
    assert page.evaluate(show, "running")[2] == "Pass 2, in 6 jumps, is the last: the figures are those of the result, which is being written."


def test_hours_of_a_life_are_not_set_back_by_an_answer_that_was_overtaken(bench):
    page, held = bench.page, []

    def asked(route):
        held.append(route)

    page.goto(bench.address)
    page.route("**/results/life/live", asked)
    page.evaluate("""async () => {
      const { show } = await import('./static/life.js'), place = document.getElementById('view');
      const state = { view: {}, jobs: { life: { state: 'running', given: { model: 'RV20E-121' }, tasks: [{ done: 1 }] } } };
      place.replaceChildren();
      const view = show(place, { state, busy: () => '', model: () => 'RV20E-121', modelChooser: () => '' });
      view.update(state);
    }""")
    while len(held) < 2:
        page.wait_for_timeout(50)
    for route, hours in zip(reversed(held), (6944, 4444)):
        now = {"model": "m", "hours": [0, hours], "until": 10_000, "jumps": 6, "pass": 2, "why": "again", "ended": False, "panes": []}
        route.fulfill(json={"now": now, "before": {}})
        page.locator("h1", has_text="m: 6,944 of 10,000 operating hours since new, pass 2").wait_for()
    page.wait_for_timeout(300)
    assert page.locator("h1", has_text="m: 6,944 of 10,000").count() == 1


def test_what_is_left_in_all_stands_beside_a_step_that_is_over_soon(bench):
    """"placing the roller cages, about 1 s left" was read as the end of a diagnosis of 3 minutes."""
    folder, far = opened(bench.folder), time.time() + 3600.0
    task = {"what": "placing", "done": 3, "total": 4, "left": 1.0, "before": None, "span": "", "sentence": "placing: 3 of 4, about 1 s left"}
    folder.remember("jobs/diagnose/job", {"kind": "diagnose", "given": {"model": "RV20E-121"}, "begun": far})
    beat = {"state": "running", "at": far, "seconds": 3.0, "said": [], "tasks": [task], "whole": "up to 50 s"}
    folder.remember("jobs/diagnose/beat", beat)
    bench.page.goto(bench.address)
    bench.page.locator("#work", has_text="placing: 3 of 4, about 1 s left; in all up to 50 s left").wait_for()
    folder.remember("jobs/diagnose/beat", beat | {"state": "stopped", "tasks": [], "whole": ""})


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


def test_the_fields_of_a_life_are_those_of_the_run_that_is_shown_and_what_is_typed_since_stays(bench):
    """After a reload 10000 stood beside a life of 6000 h, and a paused one would have begun anew."""
    page = bench.page
    page.goto(bench.address)
    page.route("**/results/life", lambda route: route.fulfill(json={"title": "a life", "panes": [], "hours": [0, 1], "file": "x", "command": ""}))
    row = {"name": "disc.lobe_radius", "unit": "mm", "distribution": "uniform", "first": "1", "second": "2"}
    said = page.evaluate(
        """async (row) => {
      const { show } = await import('./static/life.js'), place = document.getElementById('view'), asked = [];
      const given = { model: 'RV20E-121', hours: '6000', torque: '120', speed: '900' };
      const many = { ...given, samples: '4', limits: { disc_flank_um: '5' }, scatters: [row] };
      const state = { view: { model: 'RV20E-121' }, jobs: { life: { state: 'done', result: true, begun: 1, given }, ensemble: { state: 'done', result: false, begun: 2, given: many } } };
      const context = { state, busy: () => '', model: () => 'RV20E-121', modelChooser: () => '', act: (promise) => promise, start: (kind, fields) => asked.push(fields) };
      place.replaceChildren();
      const view = show(place, context), until = async (fits) => { for (let k = 0; k < 200 && !fits(); k++) await new Promise((done) => setTimeout(done, 50)); };
      const fields = () => [...place.querySelectorAll('.row')[0].querySelectorAll('input')].map((field) => field.value), said = [fields()];
      place.querySelector('#ensemble').open = true;
      await until(() => place.querySelector('#ensemble-run:enabled'));
      place.querySelector('#ensemble-run').click();
      const hours = place.querySelector('#hours');
      hours.value = '7000';
      hours.dispatchEvent(new Event('change'));
      state.jobs.life.tasks = [{ done: 1 }];
      view.update(state);
      await until(() => place.querySelector('h1'));
      said.push(fields());
      state.jobs.life = { ...state.jobs.life, begun: 3, given: { model: 'RV20E-121', hours: '', torque: '' } };
      view.update(state);
      await until(() => fields()[0] !== '7000');
      return [...said, fields(), asked];
    }""",
        row,
    )
    many = {"hours": "6000", "samples": "4", "limits": {"lost_motion_arcmin": "", "disc_flank_um": "5"}, "scatters": [row]}
    assert said == [["6000", "120", "900"], ["7000", "120", "900"], ["10000", "", ""], [many]]


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
    # The words about an effect are those of all its forms: these are listed below it.
    listed = page.locator("ul.list > li > details > summary").all_inner_texts()
    assert listed[0] == titles[0] and "first stage error (mesh)" in listed


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
    page.wait_for_function(f"({seen})()[2]", timeout=5_000)
    tall, from_top, to_bottom = page.evaluate(seen)
    assert 100 < tall < height and from_top and to_bottom


def test_a_number_under_try_beyond_its_bounds_says_which_it_has_and_what_is_shown(bench):
    """400 became 30 with neither the range nor a unit; the words stayed when the slider was moved."""
    bench.page.goto(bench.address)
    told = bench.page.evaluate("""async () => {
      const { entry } = await import('./static/try_effects.js'), values = {};
      const p = { name: 'disc_hole_shift_1', unit: 'µm', factor: 1e6, offset: 0, off: 0, low: -15, high: 15, bounds: [-30, 30], amplitude: true, description: '' };
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


@pytest.mark.campaign
def test_what_was_corrected_is_there_in_two_tabs_and_after_a_killed_server(bench, tmp_path):
    page = dropped(bench, tmp_path)
    page.select_option("#measured", "RV20E-121")
    page.locator("#save:enabled").wait_for()
    page.get_by_role("combobox", name="locked").select_option("output")
    page.wait_for_function("document.querySelector('label.inline select') !== null")
    other = bench.tab()
    other.goto(f"{bench.address}#in")
    other.locator("select[aria-label=quantity]").wait_for()
    assert other.get_by_role("combobox", name="locked").input_value() == "output" and other.input_value("#measured") == "RV20E-121"
    other.close()
    bench.kill()
    page.locator("#gone").wait_for()
    bench.start()
    bench.view("in")
    page.get_by_role("combobox", name="locked").wait_for()
    assert page.get_by_role("combobox", name="locked").input_value() == "output"
    assert sorted(p.name for p in bench.folder.iterdir()) == [".workbench", "loop_20degC_1.csv", "loop_20degC_2.csv"]


@pytest.mark.campaign
def test_a_campaign_that_was_written_elsewhere_is_corrected_cell_by_cell(bench):
    shutil.copytree(EXAMPLE, bench.folder, dirs_exist_ok=True)
    before, page = (bench.folder / "campaign.toml").read_text(encoding="utf-8"), bench.page
    bench.view("in")
    page.locator("#cells-conditions summary").click()
    page.get_by_label("temperature of loop1").fill("11 degC")
    page.keyboard.press("Tab")
    page.wait_for_function("document.activeElement.id === 'cell-conditions-loop1-hours'")
    page.locator("#cells-runs summary").click()
    page.get_by_label("unit of value in loop1_loop_1").fill("arcmim")
    page.keyboard.press("Tab")
    page.get_by_text("unit 'arcmim' is not known").wait_for()
    assert page.get_by_label("unit of value in loop1_loop_1").input_value() == "arcsec"
    assert (bench.folder / "campaign.toml").read_text(encoding="utf-8") == before.replace('"10 degC"', '"11 degC"', 1)


@pytest.mark.campaign
def test_from_the_files_of_a_hidden_effect_to_the_fallen_error(bench, tmp_path):
    """Drop, look, diagnose, stop and go on, try, ask for the next run, add, build, live; by hand in the page alone."""
    page = bench.page
    drop = tmp_path / "drop"
    drop.mkdir()
    conditions = tomllib.loads((EXAMPLE / "campaign.toml").read_text(encoding="utf-8"))["conditions"]
    heads = {"loop": ("torque,y", "torque [Nm],turning [arcsec]"), "torque": ("input_speed,y", "input_speed [rpm],input_torque [Nm]")}
    for path in sorted(EXAMPLE.glob("*.csv")):
        # As a bench names its files.
        condition, kind, number = path.stem.split("_")
        load, temperature = (re.sub(" .*", "", conditions[condition][k]) for k in ("load_torque", "temperature"))
        name = f"loop_{temperature}degC_{number}.csv" if kind == "loop" else f"torque_{load}Nm_{temperature}degC_{number}.csv"
        (drop / name).write_text(path.read_text(encoding="utf-8").replace(*heads[kind], 1), encoding="utf-8")
    bench.view("in")
    page.set_input_files("#files", sorted(map(str, drop.iterdir())))
    page.get_by_text("26 runs in 26 files, 10 conditions").wait_for()
    page.select_option("#measured", "RV20E-121-rigid")
    page.locator("#save:enabled").click()
    # Look.
    page.locator("#curves canvas").first.wait_for()
    assert "lost motion" in page.locator("#figures").inner_text()
    page.locator("#curves canvas").first.click(position={"x": 300, "y": 120})
    page.keyboard.press("b")
    page.keyboard.press("ArrowRight")
    page.locator(".cursors table").first.wait_for()
    # Diagnose: stopped, it has an answer; gone on with, it has the answer.
    bench.view("diagnose")
    page.locator("#diagnose:enabled").click()
    page.locator("#work", has_text="screening").wait_for()
    page.locator("#sofar", has_text="changing with temperature").wait_for()
    page.locator("#stop").click()
    page.locator("#verdict", has_text="interrupted").wait_for()
    page.locator("#diagnose:enabled", has_text="Go on").click()
    page.locator("#verdict", has_text="The model lacks thermal expansion").wait_for(timeout=300_000)
    # Rivals are listed once, in the evidence.
    assert page.locator("summary", has_text="Rivals").count() == 1
    # Try: the curve follows the hand.
    bench.view("try")
    page.fill("input[type=search]", "thermal expansion")
    slider = page.locator("[data-parameter=thermal_expansion]")
    slider.wait_for()
    slider.focus()
    for _ in range(8):
        page.keyboard.press("ArrowRight")
    page.get_by_text("What it would do to each signal").wait_for(timeout=180_000)
    # Next experiment, the better model, its units.
    bench.view("diagnose")
    page.locator("#next:enabled").click()
    page.get_by_text("thermal expansion stands alone").wait_for(timeout=120_000)
    page.locator("#extend:enabled").click()
    page.locator("#added", has_text="helped").wait_for(timeout=120_000)
    before, after = map(float, re.findall(r"from ([\d.]+) to ([\d.]+)", page.locator("#added").inner_text())[0])
    page.locator("#better:enabled").click()
    page.locator("#tab-look[aria-selected=true]").wait_for()
    page.locator("main:not(:has(.past)) #figures").wait_for(timeout=120_000)
    bench.view("diagnose")
    page.locator(".past #verdict").wait_for()
    assert page.locator(".past-note").inner_text() == "What stands below is of RV20E-121-rigid; the model that is chosen now is model.toml."
    page.locator("#build:enabled").click()
    page.get_by_text("fmus/fmi3/RvPlant.fmu").wait_for(timeout=240_000)
    assert before > 2.0 and after < 0.5 * before
    folder = opened(bench.folder)
    assert (folder.root / "model.toml").is_file() and (folder.root / "fmus" / "fmi3" / "RvPlant.fmu").is_file()
    # Life: paused and gone on with.
    page.select_option("#model", "model.toml")
    bench.view("life")
    page.fill("#hours", "2000")
    page.locator("#live:enabled").click()
    page.locator("iframe.report").wait_for(timeout=120_000)
    for width in (1280, 390):
        page.set_viewport_size({"width": width, "height": 844})
        for name in ("in", "look", "diagnose", "try", "reducer", "life"):
            bench.view(name)
            page.wait_for_timeout(800)
            assert page.evaluate("document.documentElement.scrollWidth") <= width, f"{name} is wider than {width}"


def test_a_port_that_there_is_not_is_refused(tmp_path):
    from workbench.server import serve

    with pytest.raises(InputFault, match="65535"):
        serve(opened(tmp_path), 80_000, 1, print)


def test_the_command_says_what_is_missing(tmp_path):
    """Without the optional packages the way to them."""
    hidden = tmp_path / "starlette"
    hidden.mkdir()
    (hidden / "__init__.py").write_text("raise ModuleNotFoundError('no', name='starlette')")
    environment = os.environ | {"PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}"}
    ended = subprocess.run([sys.executable, "-m", "cli", "workbench", str(tmp_path)], cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=60)
    assert ended.returncode == 2 and 'pip install "rvwear[workbench]"' in ended.stderr
