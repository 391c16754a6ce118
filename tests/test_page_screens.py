"""Saved pages on a dark and on a narrow screen, in a browser."""

import json
import re
from itertools import pairwise

import numpy as np
import pytest

from discrepancy.page import bars, maps
from pages.charts import Curve, chart
from pages.content import Card, Page, Section, Table
from pages.look import Figure
from pages.render import rendered_sections

LONG = "base.hole_position_errors.disc_hole_radial_1 + clock_slip.transmission_error + runout.output"


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    cells = {(signal, f"loop{k}"): 1.0 + k for signal in ("hysteresis[locked=input]", "transmission_error") for k in range(9)}
    figures = [bars.pairs("both", LONG, "caption", [LONG], [352.2], [4.1], (["a"], ["b"])), maps.grid("Map", "caption", "map", cells)]
    orders = [str(k) for k in (1, 2, *range(100, 122))]
    bar = {"type": "bar", "x": orders, "y": [10.0 if o == "105" else 1.0 for o in orders]}
    layout = {"xaxis": {"type": "category", "tickangle": 0}, "margin": {"l": 60, "r": 16, "t": 30, "b": 46}}
    figures.append(Figure("orders", "Orders", "caption", [bar], layout, 12))
    rows = [[LONG, "97 % of the misfit", "1.25 arcmin", "-0.3 to 0.4", "what it means in many words, so that the row becomes wide"]]
    head = ["number", "share", "measured", "held to lie in", "meaning"]
    tables = [Table("The base model is off", head, rows, (2,)), Table("", head, rows, folded="All 1 rows")]
    page = Page("kind", LONG, "conditions", f"It lacks {LONG}.", [Card("error", "4.1", tone="good")], [Section("one", "One", "lead", figures, tables)], [])
    path = tmp_path_factory.mktemp("pages") / "page.html"
    path.write_text(rendered_sections(page), encoding="utf-8")
    return path


def test_notes_may_stand_behind_a_section_folded_where_they_are_many():
    """Four notes filled a telephone's second screen before any figure."""
    def rendered(count, behind):
        texts = [f"note {k}" for k in range(count)]
        return rendered_sections(Page("kind", "title", "", "", [], [Section("one", "One", ""), Section("two", "Two", "")], texts, behind))

    many = rendered(4, "one")
    assert many.index('<section id="one">') < many.index("note 0") < many.index('<section id="two">')
    assert '<details class="fold notes" id="notes"><summary>4 notes</summary>' in many and '<a href="#notes">4 notes</a>' in many
    assert '<details class="fold notes" id="notes" open><summary>1 note</summary>' in rendered(1, "one") and "fold notes" not in rendered(0, "one")
    assert rendered(4, "").index("note 0") < rendered(4, "").index('<section id="one">')


def opened(chromium, file, width, scheme):
    page = chromium.new_page(viewport={"width": width, "height": 900}, color_scheme=scheme)
    page.goto(file.as_uri())
    page.wait_for_selector("#plot-map .heatmaplayer image, #plot-map .heatmaplayer path, #plot-map .hm")
    return page


def light(colour):
    """From 0 (black) to 1 of ``rgb(r, g, b)``."""
    return sum(float(part) for part in re.findall(r"[\d.]+", colour)[:3]) / 765.0


def colours(page):
    style = "(e, name) => getComputedStyle(e)[name]"
    bar = page.locator("#plot-both .bars path").nth(1).evaluate(style, "fill")
    return light(page.locator("body").evaluate(style, "backgroundColor")), light(bar), light(page.locator("#plot-both .xtick text").first.evaluate(style, "fill"))


def test_pages_follow_the_scheme_of_the_screen_and_print_on_white(chromium, file):
    ground, bar, text = colours(opened(chromium, file, 1280, "light"))
    assert ground > 0.9 and bar < 0.5 and text < 0.5
    page = opened(chromium, file, 1280, "dark")
    ground, bar, text = colours(page)
    assert ground < 0.15 and bar > 0.5 and text > 0.5
    page.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    assert colours(page)[1] < 0.5
    page.evaluate("window.dispatchEvent(new Event('afterprint'))")
    page.emulate_media(color_scheme="light")
    page.wait_for_function("getComputedStyle(document.body).backgroundColor === 'rgb(246, 248, 250)'")
    assert colours(page)[1] < 0.5


def test_names_below_upright_bars_stand_apart_and_the_tallest_keeps_its_own(chromium, file):
    edges = "[...document.querySelectorAll('#plot-orders .xtick text')].map((e) => [e.textContent, e.getBoundingClientRect().left, e.getBoundingClientRect().right])"
    for width in (1280, 390):
        ticks = opened(chromium, file, width, "light").evaluate(edges)
        assert all(left >= right for (_, _, right), (_, left, _) in pairwise(ticks)), ticks
        assert "105" in [text for text, _, _ in ticks] and (len(ticks) == 24) == (width == 1280)


def test_nothing_leaves_a_narrow_page(chromium, file):
    page = opened(chromium, file, 390, "light")
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    edges = page.evaluate("""[...document.querySelectorAll('main *, .plot text')].filter((e) => e.getClientRects().length).map((e) => {
        const r = e.getBoundingClientRect(); return [Math.floor(r.left), Math.ceil(r.right), e.textContent.slice(0, 30)]; })""")
    outside = [edge for edge in edges if edge[0] < 0 or edge[1] > 390]
    assert not outside, json.dumps(outside[:5])
    boxes = page.evaluate("[...document.querySelectorAll('#plot-map .xtick text')].map((e) => e.getBoundingClientRect()).map((r) => [r.left, r.right])")
    assert len(boxes) == 9 and all(left >= right for (_, right), (left, _) in pairwise(boxes))
    # A row says what its cells are; what is folded is not shown.
    assert "measured 1.25 arcmin" in page.evaluate(
        "[...document.querySelectorAll('table.stack td')].map((e) => getComputedStyle(e, '::before').content.replaceAll('\"', '') + e.textContent).join('|')"
    )
    assert page.locator("details.fold table").is_hidden()


def test_a_long_verdict_folds_and_a_short_one_stays_on_its_line(chromium, file, tmp_path):
    """"with other numbers than the source's, judged anew: ..." was cut off at the edge of its card on a wide screen."""
    long = "with other numbers than the source's, judged anew: reproduced under a stated condition"
    rows = "".join(f'<tr><td>T{k}</td><td>Wear profile, inverted W</td><td class="fair"><span class="tag">{text}</span></td></tr>' for k, text in enumerate((long, "reproduced")))
    sheets = f'<div class="sheets"><div class="sheet"><table class="overview">{rows}</table></div><div class="sheet"></div></div>'
    (path := tmp_path / "verdicts.html").write_text(file.read_text(encoding="utf-8").replace("</main>", f"{sheets}</main>"), encoding="utf-8")
    for width in (1280, 390):
        (edge, tall), (_, low) = opened(chromium, path, width, "light").evaluate(
            "[...document.querySelectorAll('.overview .tag')].map((e) => e.getBoundingClientRect()).map((r) => [r.right, r.height])"
        )
        assert edge <= 0.5 * (width if width > 1000 else 2 * width) and low < 25.0 < tall


def test_numbers_behind_bars_have_room_on_a_narrow_card(chromium, file):
    """The axis goes on behind the longest bar for what is written there."""
    high = opened(chromium, file, 390, "light").evaluate("""() => [['3,880,000'], ['3']].map((text) => narrowed({ height: 100 },
        [{ type: 'bar', orientation: 'h', y: ['base (ring seat compliance)'], x: [100], text }], { xaxis: { range: [0, 125] }, yaxis: {}, margin: { r: 24 } }, 300).layout.xaxis.range[1])""")
    assert high[0] > 150 and high[1] == 125


def test_titles_of_axes_and_names_of_a_legend_fold_on_a_narrow_card(chromium, file):
    """They were cut at the edge of a telephone."""
    told = opened(chromium, file, 390, "light").evaluate("""() => {
        const axis = (text) => ({ title: { text } }), layout = { xaxis: axis('t [s]'), yaxis: { ...axis('share of the depth at the end, of all parts [%]'), automargin: false },
          legend: { orientation: 'h' }, margin: { l: 60, r: 16, t: 10, b: 46 } };
        const trace = { type: 'scatter', x: [0], y: [0], name: 'eccentrics of the cranks at disc 1, up to 6.00 µm (drawn 500 times)' };
        return [330, 900].map((width) => { const { data, layout: shown } = narrowed({ height: 220 }, [trace], layout, width);
          return [shown.xaxis.title.text, shown.yaxis.title.text, shown.margin.l, data[0].name]; }); }""")
    assert told[0] == ["t [s]", "share of the depth at the<br>end, of all parts [%]", 73, "eccentrics of the cranks at disc 1, up to<br>6.00 µm (drawn 500 times)"]
    assert "<br>" not in told[1][1] + told[1][3] and told[1][2] == 60


def test_a_legend_below_leaves_room_for_the_title_of_its_axis_on_a_narrow_card(chromium, file):
    """The title of an axis lay in the legend on a telephone, and the tag of a claim went over the edge."""
    curves = [Curve(name, np.array([0.0, 1.0]), np.array([0.0, k])) for k, name in enumerate(("worn, 10,000 h, of the disc alone", "ideal", "modified by the source"))]
    place = file.with_name("legend.html")
    drawn = chart("legend", "T", "c", curves, "pressure angle between the force and the speed of the disc [deg]", "y")
    place.write_text(rendered_sections(Page("k", "t", "", "", [], [Section("s", "S", "", [drawn], [])], [])), encoding="utf-8")
    page = chromium.new_page(viewport={"width": 390, "height": 844})
    page.goto(place.as_uri())
    page.wait_for_selector("#plot-legend .legend .traces")
    title, legend = (page.locator(f"#plot-legend {part}").first.bounding_box() for part in (".xtitle", ".legend"))
    assert title["y"] + title["height"] <= legend["y"]
    tag = page.evaluate("""() => { document.body.insertAdjacentHTML('beforeend', '<p class="fair" style="width: 90px"><span class="tag">reproduced under a stated condition</span></p>');
        return document.body.lastElementChild.firstElementChild.getBoundingClientRect().width; }""")
    assert tag <= 90


def test_ticks_of_small_numbers_have_a_power_with_its_factor(chromium, file):
    """"5e-09" stood at an axis."""
    curve = Curve("c", np.array([0.0, 1.0]), np.array([0.0, 8e-9]))
    place = file.with_name("small.html")
    figure = chart("small", "T", "c", [curve], "x", "y")
    place.write_text(rendered_sections(Page("k", "t", "", "", [], [Section("s", "S", "", [figure], [])], [])), encoding="utf-8")
    page = chromium.new_page(viewport={"width": 1280, "height": 900})
    page.goto(place.as_uri())
    page.wait_for_selector("#plot-small .ytick text")
    texts = page.evaluate("[...document.querySelectorAll('#plot-small .ytick text')].map((e) => e.textContent)")
    assert any("×10" in text and "−9" in text for text in texts) and not any("e" in text or "n" in text for text in texts), texts
