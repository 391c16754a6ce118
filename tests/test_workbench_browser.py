"""The workbench driven as a user drives it, in headless Chromium: from dropped files to the fallen error, and what is beside the views.

The whole loop takes some minutes: ``pytest -m campaign tests/test_workbench_browser.py``.
"""

import os
import re
import shutil
import subprocess
import sys
import time
import tomllib

import pytest
from browser import ANSWER, EXAMPLE, ROOT, dropped, until

from fmu_src.faults import InputFault
from workbench.folder import opened
from workbench.steps import PAGE_OF_FOUND


def test_a_word_that_stands_as_a_whole_is_searched_as_a_whole(bench):
    page = bench.page
    page.goto(bench.address)
    found = page.evaluate("""async () => {
      const { matcher } = await import('./static/search.js');
      const titles = ['hysteresis_40deg', 'hysteresis 40degC', 'hysteresis at 10degC', 'Übertragungsfehler (order 4)', 'Übertragungsfehler (order 40)'];
      return ['40deg', '40', '40d', 'hyst 10deg', 'order 4', '(order', '', 'fehler 40'].map((text) => titles.flatMap((t, k) => (matcher(text, titles)(t) ? [k] : [])));
    }""")
    assert found == [[0], [0, 1, 4], [0, 1], [2], [3], [3, 4], [0, 1, 2, 3, 4], [4]]


def test_numbers_behind_a_plot_tell_excel_that_they_are_utf8(bench):
    bench.page.goto(bench.address)
    text = """async (text) => { const { marked } = await import('./static/behind.js'); return marked(text); }"""
    assert [bench.page.evaluate(text, head) for head in ('"angle [°]"\n1', '"x [m]"\n1', "滞回")] == ['\ufeff"angle [°]"\n1', '"x [m]"\n1', "\ufeff滞回"]


def test_what_the_page_took_in_itself_is_not_drawn_anew(bench, tmp_path):
    """The server tells of files that the page has just taken in: a button that was pressed while their table was drawn again did nothing."""
    page = dropped(bench, tmp_path)
    (tmp_path / "loop_1.csv").write_text("nothing\n")
    page.set_input_files("#files", str(tmp_path / "loop_1.csv"))
    row = page.locator("#unread tr", has_text="loop_1.csv")
    row.get_by_text("no table of numbers").wait_for()
    button = row.get_by_role("button", name="Remove").element_handle()
    page.wait_for_timeout(3000)
    assert button.evaluate("button => button.isConnected")


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
    until(page, "location.hash === '#in'")
    assert gone.is_visible() and page.locator("#work").is_hidden()
    bench.start()
    page.goto(bench.address)
    page.get_by_text("2 runs in 2 files, 1 condition").wait_for()


def on_a_telephone(bench):
    """The page of an empty folder, 390 points wide."""
    page = bench.page
    page.set_viewport_size({"width": 390, "height": 844})
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    return page


def test_on_a_telephone_tables_are_rows_names_fold_and_the_job_at_work_takes_one_line(bench):
    page = on_a_telephone(bench)
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


def test_on_a_telephone_how_far_a_figure_is_off_has_its_name(bench):
    """97.9 stood alone below a torsional stiffness: the head of its column is gone there."""
    page = on_a_telephone(bench)
    heads = page.evaluate("""async () => {
      const { keyFigures } = await import('./static/look_parts.js');
      const figure = { signal: 's', title: 'hysteresis', condition: 'c', name: 'torsional stiffness', unit: 'N m/arcmin', measured: '44.661', noise: '0.054', model: '49.976', off: 97.9, runs: 2, repeated: true, why: null };
      const result = { figures: [figure], calibrated: [] };
      document.getElementById('view').replaceChildren(keyFigures({ result, all: true, text: '', matches: () => true, search: null, showAll: null }));
      return [...document.querySelectorAll('table.stack td')].slice(3, 7).map((cell) => getComputedStyle(cell, '::before').content);
    }""")
    assert heads == ['"measured "', '"noise "', '"model "', '"off, in noise "'], heads


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
    at_work("diagnose", ("diagnosing", {}), ("the whole diagnosis", {"before": 600.0, "left": 240.0}), ("screening", {}), ("placing", {}), ("placing", {}))
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


@pytest.mark.campaign
def test_what_was_corrected_is_there_in_two_tabs_and_after_a_killed_server(bench, tmp_path):
    page = dropped(bench, tmp_path)
    page.select_option("#measured", "RV20E-121")
    page.locator("#save:enabled").wait_for()
    page.get_by_role("combobox", name="locked").select_option("output")
    until(page, "document.querySelector('label.inline select') !== null")
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
    until(page, "document.activeElement.id === 'cell-conditions-loop1-hours'")
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
    before, after = map(float, re.findall(r"patterns ([\d.]+) (?:->|→) ([\d.]+)", page.locator("#added").inner_text())[0])
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


def test_the_pattern_of_a_family_of_names_holds_no_angle_of_one_file(bench):
    """That of the first file stood there as if it were all files': "Eingang blockiert 210°"."""
    bench.page.goto(bench.address)
    told = bench.page.evaluate("""async () => {
      const { familyPattern } = await import('./static/in_names.js');
      const runs = (word, ...numbers) => numbers.map((n) => ({ names: `${word} ${n}° Versuch {replicate}`, condition: `at ${n}` }));
      const locked = { "at 210": { locked_at: "210 deg" }, "at 90": { locked_at: "90 deg" } };
      return [runs("blockiert", 210, 90), runs("blockiert", 210), runs("warm", 210, 30)].map((some) => familyPattern(some, locked));
    }""")
    assert told == ["blockiert {locked_at}° Versuch {replicate}", "blockiert 210° Versuch {replicate}", "warm 210° Versuch {replicate}"]
