"""The catalogue's list, commands and page."""

import argparse
import json

import pytest

from cli.commands import effects
from discrepancy.catalogue.catalogue import entries, entry
from discrepancy.catalogue.documentation import COMPUTED, PAGE, static_part
from discrepancy.catalogue.examples import AUDITED, CASES, picture
from discrepancy.catalogue.plots import PICTURE, figure
from discrepancy.catalogue.signature import new_bench, signature, words
from discrepancy.page.amounts import effect_title
from fmu_src.faults import InputFault


def run(*arguments):
    top = argparse.ArgumentParser()
    effects.add_commands(top.add_subparsers())
    options = top.parse_args(["effects", *map(str, arguments)])
    return options.run(options)


def test_all_of_the_audit_are_there():
    assert {e.effect.number for e in entries()} - {0} == set(range(1, 25))


def test_cases_stay_within_bounds():
    listed = {e.name: e for e in entries()}
    assert set(CASES) == set(listed)
    every = {p.variable.name: p.variable for e in entries() for p in e.effect.parameters}
    for e in listed.values():
        own = {p.variable.name for p in e.effect.parameters}
        for case in e.cases:
            assert own & case.values.keys()
            assert all(every[name].minimum <= value <= every[name].maximum for name, value in case.values.items())
        assert picture(e.name) in PICTURE


def test_page_is_up_to_date():
    """If this fails: python -m discrepancy.catalogue.documentation."""
    text = PAGE.read_text(encoding="utf-8")
    for e in entries():
        assert static_part(e) in text
    assert text.count(COMPUTED) == sum(len(e.cases) for e in entries())


def test_figures_of_the_audit_belong_to_cases():
    listed = {e.name: e for e in entries()}
    assert all(0 <= case < len(listed[name].cases) for name, case, *_ in AUDITED)


def test_unknown_effect_is_refused():
    with pytest.raises(InputFault, match="no effect 'gravity'"):
        entry("gravity")


def test_list(capsys):
    assert run() == 0
    text = capsys.readouterr().out
    assert "thermal_expansion" in text and "sensor_gain" in text
    assert run("--json") == 0
    assert len(json.loads(capsys.readouterr().out)["effects"]) == len(entries())


def test_one_effect_by_number_and_by_name(capsys):
    assert run("21") == 0
    shown = capsys.readouterr().out
    assert "housing force order 39" in shown and "Figures are those of RV20E-121-rigid" in shown
    # Before them it is said that another reducer may show it otherwise.
    said = " ".join(shown.split())
    assert said.index("an ideal reducer with rigid supports and without losses") < said.index("computed for RV20E-121-rigid")
    assert run("unbalance", "--reducer", "BX-40E", "--json") == 0
    assert json.loads(capsys.readouterr().out)["reducer"] == "BX-40E"
    assert run("unbalance", "--json") == 0
    rows = json.loads(capsys.readouterr().out)["computed"][0]["rows"]
    row = next(r for r in rows if r["figure"] == "housing force order 39" and r["condition"] == "speed 200 %")
    assert row["with"] == pytest.approx(6.35, rel=0.01) and row["without"] < 1e-6


def test_html_page_stands_alone(tmp_path):
    path = tmp_path / "page" / "effects.html"
    assert run("encoder_eccentricity", "--html", path) == 0
    text = path.read_text(encoding="utf-8")
    assert 'id="plot-encoder_eccentricity"' in text and "Plotly" in text
    assert "on the virtual bench at RV20E-121-rigid" in text and "That is an ideal reducer with rigid supports and without losses" in text
    assert "<script src" not in text and "<link" not in text


def test_words_say_what_changes():
    found = signature(new_bench(), "encoder_eccentricity", entry("encoder_eccentricity").cases[0])
    assert words(found)[0].startswith("TE order 1 (rated)") and words(found)[0].endswith("-> 41.2 arcsec")
    assert figure(new_bench(), "drag", entry("drag").cases).data[0]["name"] == "without"


def test_lobes_are_those_of_a_disc_and_a_crank_has_eccentrics():
    """"lobe throw error" was of a crank, "lobe" elsewhere of a disc; keys stay."""
    told = entry("crank_lobe_errors").effect
    texts = [told.title, told.law, told.signature, *(p.variable.description for p in told.parameters), effect_title("crank_lobe_errors.crank_1")]
    assert not [text for text in texts if "lobe" in text] and effect_title("crank_lobe_errors.crank_1") == "crank eccentric errors (crank 1)"
