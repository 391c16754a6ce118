"""Facts that stand in a file are not asked again: the unit of a torque, the side that was held, that nothing loaded it, whose speed it is."""

import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCMIN, ARCSEC, ERROR, FRICTION, SPEEDS, TORQUE, TWIST

from cli.main import main
from discrepancy.campaign.guess.column_words import meaning_of, quantities_named
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.state_words import locked_side, unloaded
from discrepancy.campaign.guess.unit_words import unit_in
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from discrepancy.compare import compare
from discrepancy.model_file import load_model
from fmu_src.faults import RunFault
from fmu_src.units import conversion


@pytest.mark.parametrize("written, size", [
    ("N mm", 1e-3), ("Nmm", 1e-3), ("N·mm", 1e-3), ("N*mm", 1e-3), ("N cm", 1e-2), ("kN m", 1e3), ("mN m", 1e-3), ("N m", 1.0), ("in-lb", 0.1129848),
    ("kgf·cm", 0.0980665), ("kNmm", 1.0),
])  # fmt: skip
def test_torques_in_other_units(tmp_path, written, size):
    assert conversion(unit_in(f"torque [{written}]")[0], "N.m")[0] == pytest.approx(size)
    pd.DataFrame({f"torque [{written}]": TORQUE / size, "twist [arcmin]": TWIST / ARCMIN}).to_csv(tmp_path / "loop.csv", index=False)
    assert checked(propose([tmp_path], Wishes("RV20E-121"))).records[0].axes["torque"] == pytest.approx(TORQUE)


def test_a_unit_that_is_not_known_is_said_and_its_half_is_none(tmp_path):
    pd.DataFrame({"torque [furlong mm]": TORQUE, "twist [arcmin]": TWIST / ARCMIN}).to_csv(tmp_path / "loop.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    assert proposal.runs[0].guessed.quantity.value == "hysteresis"
    assert any("[furlong mm] in its header is no unit that is known here; N.m is usual" in doubt.text for doubt in proposal.doubts)


def test_a_torque_in_a_wrong_unit_is_named_where_there_is_no_equilibrium(tmp_path):
    pd.DataFrame({"torque": 1000 * TORQUE, "twist [arcmin]": TWIST / ARCMIN}).to_csv(tmp_path / "loop_1.csv", index=False)
    campaign = checked(propose([tmp_path], Wishes("RV20E-121")))
    with pytest.raises(RunFault, match=r"no equilibrium .*run loop_1: the torque reaches 167000 N.m .*state unit = \"N.mm\""):
        compare(load_model("RV20E-121"), campaign)


@pytest.mark.parametrize("text, side", [
    ("Antrieb gesperrt", "input"), ("Hysterese_Abtrieb_gesperrt_20C", "output"), ("input shaft locked", "input"), ("locked input", "input"), ("Output: fixed", "output"),
    ("blockierter Antrieb", "input"), ("Abtriebswelle ist arretiert", "output"), ("AntriebGesperrt", "input"), ("motor clamped", "input"), ("输入轴固定", "input"),
    ("input_locked", "input"), ("Antrieb frei, Abtrieb gesperrt", "output"), ("Antriebsfestigkeit", None), ("Antrieb gesperrt, Abtrieb gesperrt", None), ("20 degC", None),
])  # fmt: skip
def test_which_side_is_held(text, side):
    assert locked_side(text) == side


@pytest.mark.parametrize("text, said", [
    ("ohne Last", True), ("te_no_load_1", True), ("No-load", True), ("unloaded", True), ("Leerlaufmessung", True), ("空载", True), ("mit Last", False), ("load 0.5", False),
])  # fmt: skip
def test_nothing_loads_it(text, said):
    assert unloaded(text) == said


def test_facts_in_the_head_are_read_and_printed(tmp_path, capsys):
    """One command, nothing asked, nothing doubted."""
    head = "Prüfer;K. Ö.\n{}\nDrehzahl Abtrieb;15 1/min\n\n"
    for name, said, columns in (
        ("Hysterese_Lauf1", "Abtrieb gesperrt", {"Abtriebsmoment [Nm]": TORQUE, "Verdrehung [arcmin]": TWIST / ARCMIN}),
        ("Reibmoment_Lauf1", "ohne Last", {"Drehzahl Antrieb [1/min]": SPEEDS, "Reibmoment Antrieb [Nm]": FRICTION}),
        ("DGF_Lauf1", "unbelastet", {"Winkel Abtrieb [°]": np.degrees(ANGLE), "Drehfehler [arcsec]": ERROR / ARCSEC}),
    ):
        (tmp_path / f"{name}.csv").write_text(head.format(said) + pd.DataFrame(columns).to_csv(index=False, sep=";", decimal=","), encoding="utf-8")
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    assert not proposal.doubts and not proposal.needs
    runs = {run.guessed.quantity.value: run for run in proposal.runs}
    assert runs["hysteresis"].guessed.tags["locked"].value == "output" and "no_load_torque" in runs
    assert proposal.conditions[runs["transmission_error"].condition]["load_torque"] == "0 N.m"
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--dry-run"]) == 0
    said = capsys.readouterr().out
    assert 'angle_of = "output": an encoder there lags under load' in said and "locked = output: the file's name or head says so" in said


@pytest.mark.parametrize(("text", "side"), [("Entrée bloquée", "input"), ("sortie_bloquee", "output"), ("moteur verrouillé", "input")])
def test_sides_in_french(text, side):
    assert locked_side(text) == side
    assert unloaded("Essai à vide") and unloaded("couple sans charge") and not unloaded("sous charge")
    assert meaning_of("Angle moteur") == "input_angle" and meaning_of("Vitesse de sortie") == "output_speed" and meaning_of("Angle centrée") == "angle"


@pytest.mark.parametrize(("head", "meaning"), [
    ("Couple sortie", "torque"), ("Couple moteur", "input_torque"), ("Coupled", None), ("Erreur de transmission", "error"), ("Temps", "time"),
    ("Température huile", "temperature"), ("Codeur entrée", "input_angle"), ("Rendement", "efficiency"), ("Rigidité", "stiffness"), ("jeu", "twist"),
    ("Rotorlage", "input_angle"),
])  # fmt: skip
def test_heads_in_french(head, meaning):
    assert meaning_of(head) == meaning


def test_names_of_files_in_french(tmp_path):
    """A word within a longer one speaks of nothing else: a torque without load is no torque under load, which would ask for one."""
    assert quantities_named("couple_a_vide_40C") == ["no_load_torque"] and quantities_named("boucle_1") == ["hysteresis"]
    pd.DataFrame({"Vitesse moteur [tr/min]": SPEEDS, "Couple moteur [Nm]": FRICTION}).to_csv(tmp_path / "couple_a_vide_40C.csv", index=False, sep=";")
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    assert proposal.runs[0].guessed.quantity.value == "no_load_torque" and not proposal.doubts and not proposal.needs
    assert proposal.runs[0].guessed.columns["input_speed"].unit.value == "rpm"


def test_sides_of_speeds():
    assert meaning_of("Drehzahl Antrieb") == "input_speed" and meaning_of("Drehzahl Abtrieb") == "output_speed" and meaning_of("Drehzahl") == "speed"


def test_a_tag_speaks_for_what_has_it_or_is_said_to_be_idle(tmp_path):
    pd.DataFrame({"hours": np.arange(9.0), "depth [um]": np.arange(9.0)}).to_csv(tmp_path / "wear.csv", index=False)
    (doubt,) = [d for d in propose([tmp_path], Wishes("RV20E-121", tags={"locked": "input", "surface": "pin"})).doubts if "--tag" in d.text]
    assert "--tag locked=input says nothing: no file is taken for hysteresis" in doubt.text and doubt.remedy == "--quantity 'FILES=hysteresis'"


@pytest.mark.parametrize("tags, sure", [({}, False), ({"locked": "input"}, True)])
def test_who_says_which_side_was_locked_speaks_of_loops(tmp_path, tags, sure):
    pd.DataFrame({"moment": np.linspace(0, 167, 100), "winkel": np.linspace(0, 3, 100)}).to_csv(tmp_path / "m.csv", index=False)
    quantity = propose([tmp_path], Wishes("RV20E-121", tags=tags)).runs[0].guessed.quantity
    assert quantity.value == "hysteresis" and quantity.sure == sure
