"""Claims with other numbers of the reducer: said as such, and never in place of the published ones."""

import html
import json
from dataclasses import replace

import pytest

from cli.altered import note_of, noted_figure
from cli.commands.reproduce import default_page
from cli.main import main
from fmu_src.faults import InputFault
from reproduce import kept
from reproduce.claim import REGISTRY
from reproduce.judging import run
from reproduce.moved import unmoved_in
from reproduce.page import page_of
from reproduce.statements import available_claims
from reproduce.table import as_json, curves_of, print_table, tables_of


def test_another_number_of_the_reducer_moves_the_figure_and_is_said():
    small, large = (run(["t24"], changes=[f"crank.eccentricity={e}mm"])[0] for e in (1.0, 1.3))
    tables = {table.name: table.frame() for table in tables_of([small])}
    drawn = tables["sliding_distance"]
    assert next(iter(drawn)) == "curve" and len(drawn) == sum(len(trace["x"]) for trace in small.figures[0].data)
    # Cranks of 1 mm slide less than those of 1.3 mm, the paper's being between.
    assert drawn.iloc[:, 2].max() < curves_of(large.figures[0]).frame().iloc[:, 2].max()
    assert "With crank.eccentricity=1.0mm instead" in page_of([small], ["crank.eccentricity=1.0mm"])
    # The independent solver had the paper's.
    assert all(number.audited is None for number in small.numbers) and "independent" not in page_of([small], ["crank.eccentricity=1.0mm"]).partition("</head>")[2]
    with pytest.raises(InputFault, match=r"no parameter or input 'crank\.size'"):
        run(["T24"], changes=["crank.size=1mm"])


def test_a_number_that_moves_nothing_is_said_to(capsys, monkeypatch, tmp_path):
    """On the screen, as JSON, on the page and in the picture; what is moved by it is not named there."""
    monkeypatch.chdir(tmp_path)
    assert main(["reproduce", "T05", "T01", "--set", "crank.circle_radius=38mm"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "crank.circle_radius=38mm moved nothing in T01, T05: numbers and curves there are the same without it" in told
    assert "crank.circle_radius=38mm moved nothing in T01, T05" in html.unescape((tmp_path / "results" / "reproduce_T05_T01_set.html").read_text("utf-8"))
    assert main(["reproduce", "T05", "T11", "--set", "bearing.clearance=10um", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["unmoved"] == ["T05"]
    still, moved = run(["T05", "T24"], changes=["pin.radius=2.9mm"])
    assert still.is_moved and still.figures_moved == (True,) and unmoved_in([still, replace(moved, numbers_moved=True, figures_moved=(False,))], ["a=1", "b=2"]) == (
        "a=1, b=2 moved nothing in the figure of T24: numbers and curves there are the same without them"
    )  # fmt: skip
    assert not unmoved_in(run(["T05"]), [])


def test_a_run_with_other_numbers_is_called_one_and_the_sources_are_computed_once(capsys, monkeypatch):
    """"Reproduced" stood beside numbers that no source has, and each claim was computed twice, each time."""
    made, judge = [], REGISTRY["T24"]

    def counted(context):
        made.append(context.changes)
        return judge(context)

    monkeypatch.setitem(REGISTRY, "T24", counted)
    kept.place_of("T24").unlink(missing_ok=True)
    changes = ["crank.eccentricity=1.29mm"]
    (first,), (again,) = run(["T24"], changes=changes), run(["T24"], changes=["crank.eccentricity=1.28mm"])
    assert made == [changes, (), ["crank.eccentricity=1.28mm"]]
    assert first.told == f"with other numbers than the source's, judged anew: {first.outcome}" and again.is_moved
    (still,) = run(["T05"], changes=["crank.circle_radius=38mm"])
    assert not still.is_moved and still.told.startswith("with other numbers than the source's, which move nothing here, judged anew: ")
    print_table([first])
    said = " ".join(capsys.readouterr().out.replace("│", " ").split())
    assert "other numbers: reproduced " in said and "judged anew" in said
    assert f'<span class="tag">{html.escape(first.told).replace("&#x27;", "&#39;")}</span>' in page_of([first], changes)
    assert as_json([first])["claims"][0]["told"] == first.told and tables_of([first])[1].frame()["verdict"][0] == first.told


def test_other_numbers_do_not_carry_the_cause_of_the_published_verdict(capsys):
    (theirs,), (moved,) = run(["T24"]), run(["T24"], changes=["crank.eccentricity=1.0mm"])
    assert theirs.cause == theirs.why and moved.cause.startswith("crank.eccentricity=1.0mm (BX-40E-rigid had 1.3 mm): the cause that is told")
    print_table([moved])
    shown = (capsys.readouterr().out, html.unescape(page_of([moved], moved.altered)), json.dumps(as_json([moved]), ensure_ascii=False),
             *(str(table.frame()) for table in tables_of([moved])[:2]))  # fmt: skip
    assert all(theirs.why[:40] not in text and moved.why[:40] not in text for text in shown)
    assert as_json([moved])["claims"][0]["why"] == moved.cause and f'<p class="why">{moved.cause}' in html.unescape(page_of([moved], moved.altered))
    # What nothing was moved in keeps its cause.
    (still,) = run(["T05"], changes=["crank.circle_radius=38mm"])
    assert still.cause == still.why


def test_a_page_of_some_claims_or_of_other_numbers_does_not_take_the_place_of_that_of_all(capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    whole = tmp_path / "results" / "reproduce.html"
    whole.parent.mkdir()
    whole.write_text("all of them", encoding="utf-8")
    assert main(["reproduce", "t01", "-q"]) == 0 == main(["reproduce", "T01", "--set", "crank.circle_radius=38mm", "-q"])
    assert capsys.readouterr().out.split() == ["results/reproduce_T01.html", "results/reproduce_T01_set.html"] and whole.read_text("utf-8") == "all of them"
    assert (default_page([], []), default_page([], ["a=1"])) == ("results/reproduce.html", "results/reproduce_set.html")
    assert len(default_page(available_claims(), [])) < 200


def test_a_figure_says_what_was_set_and_whether_that_moved_it():
    changes = ["crank.eccentricity=1mm (BX-40E-rigid had 1.3 mm)"]
    assert note_of(changes).endswith("conclusions drawn from those need not hold") and note_of(changes, is_moved=False).endswith("nothing here is moved by that")
    # One to scale has no axis to write below.
    (claim,) = run(["T05"])
    noted = noted_figure(claim.figures[0], note_of(changes))
    assert noted.data[-1]["name"] == note_of(changes) and noted.data[-1]["type"] == "scatter" and noted.layout["showlegend"]
