"""The example of a page with the reducer as WebAssembly: complete, closed, and at least as fast as the reducer itself."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples" / "browser"))
import make

from fmu_src.link import zig
from fmu_src.wasm.encoding import MODULE, section, text

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
# Of a module that wants 17 pages of memory.
EMPTY = MODULE + section(2, text("env") + text("memory") + b"\x02\x00\x11")
FLAGS = ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--disable-background-networking")


def test_page_is_complete_and_asks_nobody(rv20e, monkeypatch):
    monkeypatch.setattr(make, "core_module", lambda name, table, code: EMPTY)
    monkeypatch.setattr(make, "object_codes", lambda specification, triples: dict.fromkeys(triples, b""))
    page = make.page(rv20e)
    assert "{{" not in page and not re.search(r"(src|href)=[\"']?(https?:)?//", page) and "fetch(" not in page
    assert "default-src 'none'" in page
    facts = json.loads(re.search(r'type="application/json">(.*?)</script>', page, re.DOTALL).group(1))
    assert (facts["pins"], facts["lobes"], facts["discs"], facts["cranks"], facts["pages"]) == (40, 39, 2, 2, 17)
    assert facts["rated"]["torque"] == 167.0 and facts["rated"]["rpm"] == pytest.approx(2000.0 / 121.0)
    assert abs(facts["ratio"]) == pytest.approx(121.0, rel=0.02)
    # The drawn flank lies a pin's radius inside of the pins, up and down by the eccentricity.
    far = [(x * x + y * y) ** 0.5 for x, y, _, _ in facts["flank"]]
    assert max(far) - min(far) == pytest.approx(2.0 * facts["eccentricity"], rel=0.01)


@pytest.fixture(scope="module")
def page(rv20e, tmp_path_factory):
    if CHROMIUM is None or zig() is None:
        pytest.skip('needs chromium, and zig: pip install "rvwear[build]"')
    path = tmp_path_factory.mktemp("page") / "reducer.html"
    path.write_text(make.page(rv20e), encoding="utf-8")
    return path


def test_page_turns_a_reducer_faster_than_it_turns(page):
    assert page.stat().st_size < 1e6
    done = subprocess.run([CHROMIUM, *FLAGS, "--dump-dom", page.as_uri()], capture_output=True, text=True, timeout=120)
    assert 'data-state="ready"' in done.stdout, done.stderr[-2000:]
    assert float(re.search(r'data-factor="([\d.]+)"', done.stdout).group(1)) >= 1.0
    figures = dict(re.findall(r"<dt>(.*?)</dt><dd>(\S+) ", done.stdout))
    assert float(figures["largest pin force"]) > 100.0 and float(figures["lag of the output"]) == pytest.approx(52.0, abs=5.0)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_page_wears_and_fits_any_screen(page, scheme):
    playwright = pytest.importorskip("playwright.sync_api", reason="no playwright")
    with playwright.sync_playwright() as tools:
        browser = tools.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        try:
            sheet = browser.new_page(viewport={"width": 390, "height": 844}, color_scheme=scheme)
            asked, faults = [], []
            sheet.on("request", lambda request: asked.append(request.url))
            sheet.on("pageerror", lambda fault: faults.append(str(fault)))
            sheet.goto(page.as_uri())
            sheet.wait_for_selector("body[data-state=ready]")
            sheet.evaluate("for (const [id, value] of [['lapse', 6], ['torque', 200]]) {"
                           " part(id).value = value; part(id).dispatchEvent(new Event('input')); }")  # fmt: skip
            worn = "unit.get([facts.shown.flank])[0]"
            # The page's own policy forbids what would wait for it.
            for _ in range(200):
                sheet.wait_for_timeout(50)
                if sheet.evaluate(f"{worn} > 1e-7 && picture.worn !== null"):
                    break
            assert "250 h" in sheet.inner_text("#lapseShown") and "200 N m" in sheet.inner_text("#torqueShown")
            sheet.evaluate("part('lapse').value = 0")
            sheet.click("#anew")
            assert sheet.evaluate(worn) < 1e-7
            for width in (390, 1280):
                sheet.set_viewport_size({"width": width, "height": 844})
                assert sheet.evaluate("document.documentElement.scrollWidth") <= width
            assert asked == [page.as_uri()] and not faults
            drawn = sheet.evaluate("part('picture').getContext('2d').getImageData(0, 0, 300, 300).data.some((v) => v > 0)")
            assert drawn and sheet.inner_text("#message") == ""
        finally:
            browser.close()
