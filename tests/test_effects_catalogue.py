"""The catalogue's list, commands and page."""

import argparse
import json
import math
from pathlib import Path

import numpy as np
import pytest

from cli.commands import effects
from discrepancy.campaign.load import load_campaign
from discrepancy.catalogue.catalogue import entries, entry
from discrepancy.catalogue.documentation import COMPUTED, PAGE, static_part
from discrepancy.catalogue.examples import AUDITED, CASES, picture
from discrepancy.catalogue.plots import PICTURE, figure
from discrepancy.catalogue.signature import new_bench, signature, words
from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.candidates import NOT_BY_LOOPS, shown_by
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.prediction.units import Condition
from fmu_src.effect_words import effect_title
from fmu_src.faults import InputFault
from reducers.reducer import load_reducer
from rv_plant.effects import EFFECTS as PLANT_EFFECTS

# Of an effect three times as large as it is likely to be [rad].
SEEN = 0.02 * math.pi / 648000.0


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


def test_an_effect_lists_the_signals_that_it_changes():
    """Seats of pins, a yielding ring and carrier, play over the angle and a tilting moment changed loops and were never looked for in them."""
    bench = Bench(load_reducer("RV20E-121"), {})
    load = bench.rated_load
    running, torques = Condition(94.0, 0.6 * load), load * np.array([0.0, 0.5, 1.0, 0.5, 0.0, -0.5, -1.0, -0.5, 0.0])
    angles = 0.3 + np.linspace(0.0, 2.0 * np.pi / bench.reducer.topology.lobes, 12)
    shown = {"transmission_error": lambda values: bench.column("transmission_error", running, values, angles),
             "hysteresis": lambda values: bench.held(Condition(94.0, load, locked_at=0.4), values, torques)}
    plain = {quantity: read({}) for quantity, read in shown.items()}
    missing = []
    for name, effect in PLANT_EFFECTS.items():
        # Cages are placed in every run, whatever the effect: how far they skid before it is not seen.
        for p in () if name == "roller_skidding" else effect.amplitudes():
            for quantity in shown.keys() - set(shown_by(effect)):
                change = shown[quantity]({p.variable.name: p.variable.start + 3.0 * p.scale}) - plain[quantity]
                if np.ptp(change) > SEEN:
                    missing.append(f"{name}: {p.variable.name} changes {quantity}")
    assert missing == []


def test_what_loops_alone_do_not_tell_from_a_spring_is_not_looked_for_in_them_alone():
    """The compliance that a catalogue's stiffness lacks is one of supports; seats of pins a hundred times as soft as any stood beside it."""
    examples = Path(__file__).parents[1] / "examples"
    campaigns = (load_campaign(examples / place) for place in ("catalogue_stiffness/RV20E-121", "hidden_effect/campaign"))
    loops, more = ({c.name.partition(".")[0] for c in PhysicalModel(load_model("RV20E-121-rigid"), one).candidates} for one in campaigns)
    assert not loops & NOT_BY_LOOPS and "support_compliance" in loops
    assert {"pin_seats", "ring_stiffness", "tilting_moment"} <= more
