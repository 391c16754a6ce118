"""Life, in headless Chromium: fields, hours and reports of a life that runs."""



def test_the_report_of_a_life_says_that_it_draws_until_it_is_there(bench):
    page, held = bench.page, []

    def asked(route):
        held.append(route)

    page.goto(bench.address)
    page.route("**/results/life", lambda route: route.fulfill(json={"title": "a life", "panes": [], "hours": [0, 1], "file": "x", "command": "", "size": 5130000}))
    page.route("**/results/life/report*", asked)
    page.evaluate("""async () => {
      const { show } = await import('./static/life.js'), state = { jobs: { life: { state: 'done', result: true, given: { model: 'RV20E-121' } } } };
      const place = document.getElementById('view');
      place.replaceChildren();
      show(place, { state, busy: () => '', model: () => 'RV20E-121', modelChooser: () => document.createElement('span') });
    }""")
    word = page.get_by_text("The report is being drawn, a page of 5.1 MB…")
    word.wait_for()
    # Where the eye is: in the empty box, whose report is offered in a tab above it.
    inside, frame, tab = (page.locator(name).bounding_box() for name in ("div.report > p", "iframe.report", "a:has-text('in a tab of its own')"))
    assert frame["y"] <= inside["y"] and inside["y"] + inside["height"] <= frame["y"] + frame["height"] + 10 and tab["y"] < frame["y"]
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
