"""The claims of the sources: complete, judged from live numbers, and shown truthfully."""

import html
import json
import re
from dataclasses import replace

import numpy as np
import pytest

from cli.main import main
from fmu_src.faults import InputFault
from reducers.library import available
from reproduce import printed_forms as printed
from reproduce import rig, wall
from reproduce.claim import CONDITIONAL, FALLEN, REPRODUCED, SOURCES, VERDICTS, Number
from reproduce.context import BX, Context
from reproduce.judging import run
from reproduce.page import page_of, write_page
from reproduce.statements import available_claims, stated
from reproduce.table import as_json, print_table, span_text, tables_of, value_text

# Claims that need no life run.
QUICK = ["T01", "T02", "T03", "T04", "T05", "T06", "T07", "T08", "T09", "T10", "T11", "T13", "T14", "T17", "T18",
         "T19", "T20",
         "T22", "T23", "T24", "T35", "T36", "T37", "N01", "N02", "N03", "N04", "N05", "N06", "N07", "N08", "N09",
         "N14",
         "L07", "L09", "L10", "L11", "L12", "L17", "L21", "L22", "L25", "L26", "L27", "L28", "L29", "L30", "L33", "L34",
         "L35", "L36", "L37", "L38", "L39", "L40", "L41", "L42", "L43", "L44", "L45", "C01", "C02", "C03", "C07", "C09", "C21", "C22"]  # fmt: skip
# Most of their time.
LONGEST = {"C01", "C02", "C03", "L09", "L11"}


@pytest.fixture(scope="module")
def claims():
    return run(QUICK)


@pytest.fixture(scope="module")
def page(claims):
    return page_of(claims)


def check_complete(claims):
    for claim in claims:
        assert claim.id and claim.title and claim.says and claim.why
        assert claim.source in SOURCES and claim.verdict in VERDICTS
        assert bool(claim.condition) == (claim.verdict == CONDITIONAL), claim.id
        assert claim.grounds, claim.id
        assert claim.stands, (claim.id, [text for text, holds in claim.grounds if not holds])
        for number in claim.numbers:
            assert any(v is not None for v in (number.value, number.printed, number.published)), (claim.id, number.label)
            assert all(np.isfinite(v) for v in (number.value, number.printed, number.low, number.high) if v is not None), (claim.id,
                number.label)
            assert (number.low is None) == (number.high is None) and (number.low is None or number.low <= number.high), (claim.id, number.label)
        said = stated()[claim.id]
        assert (said.source, said.title, said.says) == (claim.source, claim.title, claim.says) and said.has_figure == bool(claim.figures), claim.id
        for figure in claim.figures:
            assert figure.data and figure.layout


def number_of(claims, identity, label):
    (claim,) = [c for c in claims if c.id == identity]
    (number,) = [n for n in claim.numbers if n.label == label]
    return number


def test_every_claim_has_all_its_parts_and_its_grounds_hold(claims):
    check_complete(claims)
    assert [c.id for c in claims] == QUICK


def test_both_sources_the_literature_and_the_catalogue_are_covered():
    ids = available_claims()
    counts = {letter: sum(i.startswith(letter) for i in ids) for letter in "TNLC"}
    assert counts["T"] >= 35 and counts["N"] >= 18 and counts["L"] >= 36 and counts["C"] >= 9


@pytest.mark.parametrize("identity, label, right, printed_value", [
    ("T01", "K1", 0.7482, None),
    ("T05", "BX-40E-rigid: the printed form's largest miss", None, 23.8),
    ("T05", "RV20E-121-rigid: the printed form's largest miss", None, 13.0),
    ("T08", "BX-40E-rigid: smallest convex radius", 2.7, None),
    ("T08", "BX-40E-rigid: the same, printed", None, 8.7),
    ("T23", "at the root", 0.372, -3.83),
    ("T23", "at the tip", 3.04, 0.59),
    ("N07", "largest pin force", 311.2, 319.9),
    ("N08", "k", 4.6e-19, 5.6e-22),
    ("N06", "largest load over the turn", 2.7, None),
    ("C01", "RV20E-121-rigid, literal: stiffness of each crank's supports that closes the gap", 1.4e8, None),
])
def test_key_numbers_agree_with_the_independent_check(claims, identity, label, right, printed_value):
    number = number_of(claims, identity, label)
    for found, expected in ((number.value, right), (number.printed, printed_value)):
        if expected is not None:
            assert found == pytest.approx(expected, rel=0.02, abs=0)


def test_force_follows_the_sine_only_with_rigid_bearings(claims):
    assert number_of(claims, "T10", "R² of F = C sin α, rigid bearings").value > 0.99
    assert number_of(claims, "T10", "R² of F = C sin α, clearance 10 µm").value < 0.5


def test_a_number_tells_whether_it_confirms_the_check():
    assert Number("a", "1", 1.02, None, 1.0, 0.03).agrees
    assert not Number("a", "1", 1.05, None, 1.0, 0.03).agrees
    assert Number("a", "1", None, 2.0, 2.0).agrees
    assert Number("a", "1", 5.0, None, (4.0, 6.0)).agrees and not Number("a", "1", 7.0, None, (4.0, 6.0)).agrees
    assert Number("a", "1", 5.0).agrees is None
    assert Number("a", "1", 0.9, None, 1.0).off == pytest.approx(-0.1) and Number("a", "1", 7.0, None, (4.0, 5.0)).off == pytest.approx(0.4)
    assert Number("a", "1", 4.5, None, (4.0, 5.0)).off == 0.0 and np.isnan(Number("a", "1", 5.0).off) and np.isnan(Number("a", "1", 5.0, None, 0.0).off)


def test_numbers_that_the_check_does_not_confirm_are_judged(claims, capsys):
    """They stood below the table without a word; now as their figures do: how far off, and the claim's verdict, on the screen and on the page."""
    checked = next(c for c in claims if c.verdict == CONDITIONAL)
    numbers = [Number("first of all", "N", 537.9, None, 595.0), Number("second", "N", 590.7, None, (600.0, 659.0), 0.001)]
    off, fallen = replace(checked, id="T98", numbers=numbers), replace(checked, id="T99", numbers=numbers[:1], grounds=[("it holds", False)])
    assert off.stands and len(off.discrepancies) == 2
    print_table([off, fallen])
    said = capsys.readouterr().out.partition("Not confirmed")[2]
    assert re.search(r"T98 .*first of all.*537\.9.*595.*N .*-9\.6 %.*reproduced", said) and re.search("T99.*no longer", said) and "-1.55 %" in said
    part = page_of([off]).partition('id="discrepancies"')[2].partition("</section>")[0]
    assert part.count(CONDITIONAL) == 1 and part.count("<tr data-verdict") == 2 and "-9.6 % (3 %)" in part and 'rowspan="2" class="fair"' in part
    assert as_json([off])["claims"][0]["numbers"][0]["off"] == pytest.approx(-0.09597, rel=1e-3)


def test_linear_forces_balance_the_moment():
    phase = np.radians(np.arange(40) * 360.0 * 39 / 40)
    force = printed.linear_forces(phase, 80.0, 0.9e-3, 39, 36 / 52)
    lever = 0.9e-3 * 39 * printed.sine_of_pressure_angle(phase, 36 / 52)
    assert force @ lever == pytest.approx(80.0, rel=1e-12, abs=0)
    assert (force >= 0.0).all()


def test_unknown_claim_is_refused():
    with pytest.raises(InputFault, match="X9"):
        run(["X9"])


def test_progress_is_told():
    lines = []
    run(["T01", "T04"], lines.append)
    assert [line.split()[1] for line in lines] == ["T01", "T04"]


def test_a_coarser_run_is_not_called_as_the_one_it_is_held_against(monkeypatch):
    """"run BX-40E-rigid, 10000 h" stood there twice."""
    lines = []
    context = Context(lines.append)
    monkeypatch.setattr(context, "lived", lambda *more: None)
    context.life(BX)
    context.life(BX, positions=24)
    assert [line.strip() for line in lines] == ["BX-40E-rigid, 10000 h", "BX-40E-rigid, 10000 h, 24 positions a turn"]


def test_page_is_offline_complete_and_deterministic(claims, page, tmp_path):
    again = [c for c in QUICK if c not in LONGEST][::5]
    assert page_of([c for c in claims if c.id in again]) == page_of(run(again))
    shown = re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
    assert not re.search(r"(src|href)=[\"'](?!#)", shown) and "@import" not in shown and "url(" not in shown
    for claim in claims:
        assert f'<article id="{claim.id}"' in page
    content = json.loads(re.search(r'id="content">(.*?)</script>', page, re.DOTALL)[1])["figures"]
    assert {f["name"] for f in content} == {f.name for c in claims for f in c.figures}
    assert all(f'id="plot-{f["name"]}"' in shown for f in content)
    path = write_page(claims, tmp_path / "new" / "claims.html")
    assert path.read_text(encoding="utf-8") == page


def test_json_carries_everything_but_the_figures(claims):
    content = json.loads(json.dumps(as_json(claims), allow_nan=False))
    assert [c["id"] for c in content["claims"]] == QUICK
    assert sum(content["verdicts"].values()) == len(QUICK)
    assert all({"source", "says", "verdict", "why", "numbers", "grounds",
                "stands"} <= set(c) for c in content["claims"])


def test_every_published_figure_is_shown_everywhere(claims, page, capsys):
    """Ours, theirs, range, verdict and cause: on the screen, in the page, in JSON, in exports and on the page of the documentation."""
    held = [(claim, number) for claim in claims for number in claim.held]
    assert len(held) > 60 and len({claim.id for claim, _ in held}) > 20
    print_table(claims)
    out = capsys.readouterr().out
    figures = out[out.index("Their figures and ours"):]
    assert all(head in figures for head in ("ours", "range", "theirs", "verdict")) and "cause" in out
    data = {c["id"]: c for c in as_json(claims)["claims"]}
    exported = {table.name: table.frame() for table in tables_of(claims)}["numbers"]
    assert {"computed", "low", "high", "theirs", "verdict", "cause"} <= set(exported)
    shown = html.unescape(page)
    documented = wall.PAGE.read_text(encoding="utf-8")
    for claim, number in held:
        theirs = span_text(number.published)
        first = theirs.split()[0]
        assert first in figures, (claim.id, number.label)
        row = re.search(rf'<tr[^>]*><td><a href="#{claim.id}">{claim.id}</a></td><td>{re.escape(number.label)}</td>.*', shown)
        assert row and f"<td>{theirs}</td>" in row[0], (claim.id, number.label)
        assert any(n["label"] == number.label and n["theirs"] is not None for n in data[claim.id]["numbers"])
        assert theirs in set(exported[(exported["claim"] == claim.id) & (exported["number"] == number.label)]["theirs"])
    for claim in claims:
        if claim.source in wall.SOURCES:
            for row in wall.rows_of(claim) or [wall.statement_of(claim)]:
                assert row in documented, f"{claim.id}: run python -m reproduce.wall"


# Figures of the literature list, and what else was found, by the claim that holds them.
FIGURES = {
    "L01": (42.7, 12.92, 30.23), "L02": (0.0024,), "L09": (22.91,), "L11": (25.28, -47.22), "L13": (4000.0, 3600.0), "L14": (60.07, 64.64, 56.15, 65.03, 40.0),
    "L15": (25.5, 23.32, 8.89, 6.31), "L16": (131.98, 125.55, 117.41, 0.364, 0.389, 0.412), "L17": (8.208, 10.732, 3.221, 4.347), "L18": (5.0,),
    "L19": (-6.8, -5.5, -5.7), "L20": (224.0, 19.0), "L21": (81.0, 3.9, 8.6, 6.5, 7.1, 1.1, 61.9), "L27": (81.0,), "L37": (), "L38": (3.0,), "L39": (52.48,),
    "L40": (83.3, 94.0), "L41": (113.0,), "L42": (1.0, 2.0),
}  # fmt: skip


def theirs_by_claim():
    """The column "theirs" of the page, by claim."""
    rows = [line.split(" | ") for line in wall.PAGE.read_text(encoding="utf-8").splitlines() if re.match(r"\| [LC]\d\d \| .* \| .* \| .* \| .* \| .* \| ", line)]
    found = {}
    for row in rows:
        found.setdefault(row[0].removeprefix("| "), []).append(row[4])
    return found


def test_no_figure_of_the_literature_is_left_out():
    theirs = theirs_by_claim()
    for identity, values in FIGURES.items():
        assert identity in theirs and {value_text(value) for value in values} <= set(theirs[identity]), (identity, theirs.get(identity))
    beyond = [identity for identity in theirs if identity.startswith("L") and identity >= "L24"]
    assert len(beyond) >= 10, beyond


def test_what_is_kept_of_the_rig_is_what_its_page_says():
    text = (wall.PAGE.parent / "real_data.md").read_text(encoding="utf-8")
    for value in (*rig.PHYSICS, *rig.PHYSICS_SPREAD, *rig.QUADRATIC, *rig.QUADRATIC_SPREAD, *rig.NOTHING_FITTED, *rig.FITTED, *rig.LEARNED, *rig.CLOSED_FORM, rig.RUN_OUT):
        assert f"{value:g}" in text, value
    assert f"{rig.SPRINGS_RANGE[0]:g} to {rig.SPRINGS_RANGE[1]:g}" in text


def test_tolerances_matter_by_size_and_not_by_sign():
    """A proud pin takes more lost motion away than equidistant modification adds; the largest of signed changes hid it."""
    (claim,) = run(["L18"])
    lost = {n.label.removesuffix(": lost motion"): n.value for n in claim.numbers if n.label.endswith(": lost motion")}
    assert max(lost, key=lambda label: abs(lost[label])) == "one pin 3 µm thick" and lost["one pin 3 µm thick"] < 0.0
    assert claim.verdict == CONDITIONAL and "proud pin" in claim.condition and claim.stands


def test_table_names_every_claim(claims, capsys):
    print_table(claims)
    out = capsys.readouterr().out
    assert all(claim.id in out for claim in claims)


def test_a_claim_that_its_numbers_no_longer_carry_is_counted_and_said_as_such(claims, capsys):
    told = []
    (fallen,) = run(["T01"], told.append, ["crank.eccentricity=1.2mm"])
    assert not fallen.stands and fallen.outcome == FALLEN and FALLEN in told[-1]
    both = [fallen, next(c for c in claims if c.verdict == REPRODUCED)]
    assert as_json(both)["verdicts"] == {**dict.fromkeys(VERDICTS, 0), REPRODUCED: 1, FALLEN: 1}
    print_table(both)
    assert f"reproduced 1 {CONDITIONAL} 0 contradicted 0 not testable 0 {FALLEN} 1" in " ".join(capsys.readouterr().out.split())
    page = page_of(both)
    assert f'<p class="label">{FALLEN}</p><p class="values">1</p>' in page and "2 claims of equations" in page and "1 claim of" in page_of([fallen])


def test_a_legend_says_what_a_curve_is_whatever_number_was_changed():
    (claim,) = run(["T18"], changes=["crank.eccentricity=1.1mm"])
    names = {trace["name"] for trace in claim.figures[0].data if "name" in trace}
    assert {"BX-40E-rigid, soft bearings", "BX-40E-rigid, rigid bearings"} <= names


@pytest.mark.campaign
def test_the_whole_run_stands():
    claims = run()
    check_complete(claims)
    assert [c.id for c in claims] == available_claims()
    assert page_of([c for c in claims if c.id in QUICK]) == page_of(run(QUICK))
    inner = number_of(claims, "N10", "inner raceway, 10,000 h (printed: 2,000 h segments)")
    assert inner.value == pytest.approx(3.01, rel=0.02, abs=0)
    assert number_of(claims, "T28", "RV20E-121-rigid, ideal: after 10,000 h").value == pytest.approx(56.0, abs=3.0)


@pytest.mark.parametrize("options, said", [
    (["--set", "crank.ecentricity=1mm"], "did you mean crank.eccentricity"), (["--set", "crank.eccentricity=1kg"], "unit 'kg' does not fit"),
    (["--output", "."], "--output . is a folder"),
])  # fmt: skip
def test_what_cannot_be_is_said_before_the_work(capsys, monkeypatch, tmp_path, options, said):
    monkeypatch.chdir(tmp_path)
    assert main(["reproduce", "T01", *options]) == 2
    told = capsys.readouterr()
    assert said in told.err and "T01" not in told.err


def test_a_claim_says_of_which_reducers_its_numbers_are(capsys):
    """Nothing named them unless a number was changed; a run that another claim made before is of the same."""
    first, second = run(["T23", "T24"])
    (alone,) = run(["T24"])
    assert first.reducers == second.reducers == alone.reducers == ("BX-40E-rigid",)
    assert as_json([alone])["claims"][0]["reducers"] == ["BX-40E-rigid"] and set(tables_of([alone])[0].frame()["reducers"]) == {"BX-40E-rigid"}
    assert "Numbers of BX-40E-rigid." in page_of([alone])
    print_table([alone])
    assert "of BX-40E-rigid" in capsys.readouterr().out and "and no speed" in alone.cause


def test_a_reducer_has_one_name_in_all_that_is_said_of_a_claim(claims):
    """"of BX-40E-rigid" stood below "BX-40E had 3 um" and beside curves of BX-40E, which is another reducer of the library."""
    for claim in (*claims, *run(["T24"], changes=["bearing.clearance=10um"])):
        figures = [text for f in claim.figures for text in (f.title, f.caption, *(str(trace.get("name", "")) for trace in f.data))]
        words = " ".join([*figures, *(n.label for n in claim.numbers), *(text for text, _ in claim.grounds), *claim.altered])
        named = {name for name in available() if re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", words)}
        assert named <= {*claim.reducers}, claim.id
