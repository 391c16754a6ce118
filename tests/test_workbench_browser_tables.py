"""Tables of the workbench, in headless Chromium: columns for what no file says, answers to "why?" in rows of their own, judged by what can judge."""

from browser import until


def test_hours_and_directions_that_no_name_says_get_a_column(bench, tmp_path):
    """A check asked for them, and In had no place for either."""
    page = bench.page
    for k in (1, 2):
        rows = "\n".join(f"{1.8 * n:.1f};{(n * k) % 7}" for n in range(201))
        (tmp_path / f"Drehfehler_50Nm_15rpm_25C_{k}.csv").write_text(f"Winkel Abtrieb [deg];Drehfehler [arcsec]\n{rows}")
    page.goto(bench.address)
    page.get_by_text("Drop what the bench wrote").wait_for()
    page.set_input_files("#files", sorted(map(str, tmp_path.glob("*.csv"))))
    page.locator("#more-columns").wait_for()
    offered = page.locator("#more-columns option").all_inner_texts()
    assert "direction" in offered and not {"temperature", "mounting", "output speed", "input speed"} & set(offered)
    page.locator("#more-columns").select_option("direction")
    chosen = page.locator("select[aria-label='direction']")
    chosen.wait_for()
    chosen.select_option("reverse")
    until(page, "[...document.querySelectorAll('select[aria-label=direction]')].some((s) => s.value === 'reverse')")
    page.select_option("#measured", "RV20E-121")
    page.locator("#save:enabled").wait_for()
    assert "fault" not in page.evaluate("async () => (await fetch('in/save', { method: 'POST', body: '{}' })).text()")
    assert 'direction = "reverse"' in (bench.folder / "campaign.toml").read_text(encoding="utf-8")


def test_why_in_a_table_has_a_row_of_its_own(bench):
    """In its cell it squeezed the columns of all rows."""
    page = bench.page
    page.goto(bench.address)
    told = page.evaluate("""async () => {
      const { table, why } = await import('./static/dom.js'), of = { relation: 'r', data: 'd', margin: 'm' };
      const shown = table(['a', 'b'], [['1', why(of, 'it')], ['2', '']]);
      document.getElementById('view').after(shown);
      const asked = shown.querySelector('details.why'), rows = () => [...shown.querySelectorAll('tbody tr')].map((r) => r.textContent), seen = [rows()];
      for (const open of [true, false, true]) {
        asked.open = open;
        await new Promise((done) => setTimeout(done, 50));
        seen.push(rows());
      }
      const span = shown.querySelector('tr.because td').colSpan;
      shown.remove();
      return [seen, span];
    }""")
    closed, opened = ["1why?relationrdatadmarginm", "2"], ["1why?", "relationrdatadmarginm", "2"]
    assert told == [[closed, opened, closed, opened], 2]


def test_unused_runs_that_judge_nothing_show_no_error_that_fell(bench):
    """A green bar from 2.09 to 1.42 stood beside "did not help"."""
    page = bench.page
    page.goto(bench.address)
    told = page.evaluate("""async () => {
      const { ladder } = await import('./static/better.js');
      const step = { effects: ['pin_seats'], training_before: 1.7, training_after: 0.06, held_out_before: 2.09, held_out_after: 1.42, verdict: 'did not help', kept: false };
      return [true, false].map((unseen) => {
        const extension = { steps: [{ ...step, unseen }], page: { sections: [] }, ladder: { sections: [] }, effects: ['pin_seats'], kept: false, left: '', model: 'model.toml' };
        const part = ladder({ extension, built: null, context: { busy: () => '', choose: () => {}, go: () => {}, start: () => {} } });
        return [[...part.querySelectorAll('tbody td')].map((c) => c.textContent).slice(3, 5), part.textContent.includes('judge nothing')];
      });
    }""")
    assert told == [[["–", "–"], True], [["2.09", "1.42"], False]]
