"""The page, pictures and tables of many lives; from the command and from its file."""

import json
import re
from itertools import pairwise

import numpy as np
import pytest

pytest.importorskip("SALib")

from cli.main import main
from fmu_src.source_hash import source_hash
from studies.ensemble.bands import bands, kept, scatters
from studies.ensemble.ensemble_file import load_ensemble
from studies.ensemble.figures import FIGURES
from studies.ensemble.sampling import independent_rows, tasks_of
from studies.ensemble.store import Store
from studies.ensemble.summary import summarise
from studies.report.lives import figures_of, page_of

TEXT = """
reducer = "RV20E-121"
samples = 4
hours = 1000
[parameters]
bearing.clearance = { distribution = "normal", mean = 2, deviation = 0.3, unit = "um" }
wear.mesh_coefficient = { distribution = "lognormal", median = 5e-9, factor = 1.3, unit = "1" }
[limits]
lost_motion_arcmin = 1.0
"""


def life(number):
    """Grows along the square root of the hours, in each life to another end."""
    hours = [0.0, 10.0, 100.0, 500.0, 1000.0]
    return {"number": number, "hours": hours, "figures": {name: [(0.8 + 0.03 * number) * (h / 1000.0) ** 0.5 for h in hours] for name in FIGURES}}


@pytest.fixture
def file(tmp_path):
    """Of an ensemble whose lives are all done."""
    path = tmp_path / "e.toml"
    path.write_text(TEXT, encoding="utf-8")
    drawn = load_ensemble(path)
    store = Store(tmp_path / "e.lives", drawn.identity() | {"source_hash": source_hash()})
    for task in tasks_of(drawn):
        store.add(life(task.number))
    return path


def found_of(path, count=16, text=TEXT):
    path.write_text(text, encoding="utf-8")
    drawn = load_ensemble(path)
    lives = {number: life(number) for number in range(count)}
    return drawn, lives, kept(summarise(drawn, lives, 16), drawn, lives, 16)


def test_bands_are_the_quantiles_of_the_lives_that_stand_for_the_distributions(tmp_path):
    drawn, lives, found = found_of(tmp_path / "e.toml")
    ends = [0.8 + 0.03 * n for n in independent_rows(drawn)]
    told = bands(drawn, lives, 16)
    for pane in told["panes"]:
        assert [row[-1] for row in pane["quantiles"]] == pytest.approx(np.quantile(ends, told["shares"]), rel=1e-5)
    assert [pane["limit"] for pane in told["panes"]] == [1.0 if name == "lost_motion_arcmin" else None for name in FIGURES]
    assert {pane["unit"] for pane in told["panes"]} == {"um", "arcmin", "arcsec"} and (told["lives"], told["counted"]) == (16, len(ends))
    assert found["scatters"] == scatters(drawn) and scatters(drawn)[0] == {
        "name": "bearing.clearance", "parameter": "bearing_clearance", "distribution": "normal", "unit": "um", "numbers": {"mean": 2.0, "deviation": 0.3},
    }  # fmt: skip


def test_the_workbench_draws_the_same_bands(tmp_path):
    from workbench.ensemble_step import shown

    drawn, lives, found = found_of(tmp_path / "e.toml")
    told = shown(drawn, lives, 16)
    assert [pane["quantiles"] for pane in told["panes"]] == [pane["quantiles"] for pane in found["bands"]["panes"]]
    assert {pane["unit"] for pane in told["panes"]} == {"µm", "arcmin", "arcsec"}


def test_page_and_pictures_say_what_the_lives_do(tmp_path):
    _, _, found = found_of(tmp_path / "e.toml")
    band, share = figures_of(found)
    panes = [band.layout[f"yaxis{k}" if k else "yaxis"] for k in ("", 2, 3, 4, 5, 6)]
    assert [pane["title"]["text"] for pane in panes][:5:4] == ["inner raceway<br>[µm]", "lost motion<br>[arcmin]"]
    # One below the other, and one limit in the pane that it belongs to.
    assert all(upper["domain"][0] > lower["domain"][1] for upper, lower in pairwise(panes))
    [limit] = band.layout["shapes"]
    assert limit["yref"] == "y5" and limit["y0"] == 1.0 and len(band.data) == 3 * len(FIGURES)
    assert {trace["name"] for trace in share.data} == {"bearing.clearance", "wear.mesh_coefficient"}
    page = page_of(found)
    assert page.finding.startswith("Half of the reducers reach a limit by ") and page.cards[0].label == "time to the first limit" and not page.warnings
    assert [row[:2] for section in page.sections for table in section.tables for row in table.rows][-1] == ["wear.mesh_coefficient", "lognormal"]


def test_without_limits_the_page_says_the_lost_motion_and_of_lives_that_failed_or_lack(tmp_path):
    drawn, lives, _ = found_of(tmp_path / "e.toml", text=TEXT.partition("[limits]")[0])
    lives = {number: one for number, one in lives.items() if number < 12} | {1: {"number": 1, "fault": "no equilibrium"}}
    page = page_of(kept(summarise(drawn, lives, 16), drawn, lives, 16))
    assert page.finding.startswith("After 1,000 h half of the reducers have more than ") and len(page.figures) == 1
    assert page.warnings == ["12 of 16 lives are done: the same command goes on.", "1 life failed and is not in the bands: no equilibrium"]
    few = {0: life(0)}
    page = page_of(kept(summarise(drawn, few, 16), drawn, few, 16))
    assert page.finding == "Too few lives have ended for a distribution." and not page.figures and not page.cards


def test_the_command_writes_page_pictures_and_bands_and_its_file_gives_them_again(file, tmp_path, capsys):
    """There were tables and JSON alone, and ``report`` and ``export`` took the JSON for a broken life."""
    out = {kind: str(tmp_path / f"e.{kind}") for kind in ("json", "html", "svg", "csv")}
    assert main(["ensemble", str(file), "--output", out["json"], "--html", out["html"], "--picture", out["svg"], "--export", out["csv"]]) == 0
    said = capsys.readouterr().out
    assert f"page    {out['html']}" in said and (tmp_path / "e_shares.svg").exists() and (tmp_path / "e.svg").stat().st_size > 10_000
    head = (tmp_path / "e_bands.csv").read_text(encoding="utf-8").splitlines()[0]
    assert head.startswith("hours [h],inner_raceway_q05 [um],") and "lost_motion_q50 [arcmin]" in head
    assert main(["report", out["json"], "--output", str(tmp_path / "again.html")]) == 0
    assert (tmp_path / "again.html").read_bytes() == (tmp_path / "e.html").read_bytes()
    assert main(["export", out["json"], str(tmp_path / "x.pdf"), str(tmp_path / "x.csv")]) == 0
    assert (tmp_path / "x.pdf").exists() and (tmp_path / "x_bands.csv").read_bytes() == (tmp_path / "e_bands.csv").read_bytes()
    assert main(["ensemble", str(file), "--output", out["json"], "--html", out["html"], "--json"]) == 0
    assert json.loads(capsys.readouterr().out.partition("\n{")[2].join(["{", ""]))["bands"]["panes"]


@pytest.mark.parametrize("text, said", [
    ("[1, 2]", "no result of rvwear ensemble"), ('{"cards": 1}', "no result of rvwear ensemble"), ("{", "not readable as a result of rvwear ensemble"),
    ('{"lives_planned": 4}', "no bands over the hours.*run rvwear ensemble again"),
    ('{"lives_planned": 4, "bands": {"panes": 3}}', "not readable as a result of rvwear ensemble"),
])  # fmt: skip
def test_another_file_is_said_to_be_none(tmp_path, capsys, text, said):
    path = tmp_path / "a.json"
    path.write_text(text, encoding="utf-8")
    for words in (["report", str(path)], ["export", str(path), str(tmp_path / "a.svg")]):
        assert main(words) == 2
        assert re.search(said, " ".join(capsys.readouterr().err.split()))
    assert main(["report", str(tmp_path / "b.json")]) == 2
    assert "rvwear ensemble writes one" in capsys.readouterr().err


def test_a_page_of_another_ending_is_refused_before_the_lives(file, capsys):
    assert main(["ensemble", str(file), "--html", "e.txt"]) == 2
    assert "must end in .html" in capsys.readouterr().err
