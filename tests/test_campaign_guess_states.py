"""Facts that stand in a file are not asked again: the unit of a torque, the side that was held, that nothing loaded it, whose speed it is."""

import math
import shlex
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCMIN, ARCSEC, ERROR, FRICTION, SPEEDS, TORQUE, TWIST

from cli.main import main
from discrepancy.campaign.guess.column_words import meaning_of, quantities_named
from discrepancy.campaign.guess.header_units import unit_in
from discrepancy.campaign.guess.locked_words import angle_named, locked_angle
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.state_words import locked_side, unloaded
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from discrepancy.compare import compare
from discrepancy.model_file import load_model
from fmu_src.faults import InputFault, RunFault
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


@pytest.mark.parametrize("text, angle", [
    ("Ingresso bloccato a 40°", "40 deg"), ("Eingang gesperrt bei 40 Grad", "40 deg"), ("Antrieb bei 40,5 Grad gesperrt", "40.5 deg"), ("input locked at 40 deg", "40 deg"),
    ("Input shaft: locked at -40 degrees", "-40 deg"), ("entrée bloquée à 40°", "40 deg"), ("Arbre d'entrée bloqué à l'angle 40 degrés", "40 deg"), ("entrada bloqueada a 40°", "40 deg"),
    ("Ingresso bloccato all'angolo 40 gradi", "40 deg"), ("motor clamped at 0.7 rad", "0.7 rad"), ("# Input locked: 40 deg", "40 deg"), ("Input locked at;40;deg", "40 deg"),
    ("入力軸固定：40°", "40 deg"), ("入力軸を40°で固定", "40 deg"), ("输入轴锁定在40°", "40 deg"), ("loop_input_locked_at_40deg_1", "40 deg"),
    # A temperature, a torque, the other side, another part, two angles, or nothing that leads to the number.
    ("Ingresso bloccato a 40 °C", None), ("Eingang gesperrt, 40 Grad", None), ("Eingang gesperrt bei 40 Grad Celsius", None), ("input locked at 40 Nm", None),
    ("input locked at 40", None), ("uscita bloccata a 40°", None), ("Eingang frei, Abtrieb gesperrt bei 40°", None), ("Encoder fixed at 40 deg", None), ("入力軸固定 40℃", None),
    ("input locked at 40 deg, then input locked at 80 deg", None), ("isteresi_40gradi", None),
    ("Isteresi ingresso bloccato 90° prova 2", "90 deg"), ("ingresso bloccato 26°C", None), ("input locked 0 deg", "0 deg"),
    ("ヒステリシス_入力軸固定90deg_2回目", "90 deg"), ("输入轴锁定 45°", "45 deg"), ("入力軸固定25度", None),
])  # fmt: skip
def test_where_the_input_was_locked(text, angle):
    assert locked_angle([text]) == angle


def test_an_angle_in_a_name_is_one_that_may_be_meant():
    assert [angle_named(name) for name in ("isteresi_40gradi_prova1", "loop-300deg-1", "loop_40degC_1", "loop_2_15rpm")] == ["40 deg", "300 deg", None, None]


def italian_loops(folder, **heads):
    """``isteresi_NAME.csv``, each with its line above the table, and a transmission error whose name has a kind of two words."""
    head = "Banco prova\n{}\nVelocità uscita: 15 giri/min\n\n"
    for name, said in heads.items():
        table = pd.DataFrame({"coppia [Nm]": TORQUE, "torsione [arcmin]": TWIST / ARCMIN, "temperatura [°C]": 35.0 + 0.001 * np.arange(len(TORQUE))})
        (folder / f"isteresi_{name}.csv").write_text(head.format(said) + table.to_csv(index=False, sep=";", decimal=","), encoding="cp1252")
    for load in (84, 167):
        table = pd.DataFrame({"angolo uscita [°]": np.degrees(ANGLE), "errore [arcsec]": ERROR / ARCSEC, "temperatura [°C]": 35.0 + 0.001 * np.arange(len(ANGLE))})
        (folder / f"errore_trasmissione_{load}Nm.csv").write_text(head.format("") + table.to_csv(index=False, sep=";", decimal=","), encoding="cp1252")
    return folder


def test_what_was_measured_of_a_turning_reducer_is_in_no_condition_with_a_locked_input(tmp_path):
    """A no-load torque over the speed, of whose condition nothing is said, stood in that of the loops."""
    for k in (1, 2):
        pd.DataFrame({"Md (Nm)": TORQUE, "Verdrehung (arcmin)": TWIST / ARCMIN + k}).to_csv(tmp_path / f"Schleife_Antrieb_gesperrt_bei_0Grad_{k}.csv", index=False)
    pd.DataFrame({"Drehzahl Antrieb [1/min]": [500.0, 1000.0, 2000.0], "Leerlaufmoment [Nm]": [0.05, 0.06, 0.07]}).to_csv(tmp_path / "Leerlauf.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    placed = {run.guessed.quantity.value: run.condition for run in proposal.runs}
    assert placed == {"no_load_torque": "single", "hysteresis": "Antrieb_gesperrt_bei_0Grad"}
    assert proposal.conditions == {"single": {}, "Antrieb_gesperrt_bei_0Grad": {"locked_at": "0 deg"}}


def test_a_position_in_the_head_is_the_condition_s_and_nothing_is_asked(tmp_path, capsys):
    folder = italian_loops(tmp_path, **{"40gradi_prova1": "Ingresso bloccato a 40°", "300gradi": "Ingresso bloccato a 300°"})
    proposal = propose([folder], Wishes("RV20E-121", angle_of="output"))
    assert proposal.conditions["40gradi"]["locked_at"] == "40 deg" and proposal.conditions["300gradi"]["locked_at"] == "300 deg" and not proposal.doubts
    factors = {record.name: record.factors.get("locked_at") for record in checked(proposal).records}
    assert factors["isteresi_300gradi"] == pytest.approx(np.radians(300)) and factors["errore_trasmissione_84Nm"] is None
    # Where nothing else tells conditions apart the angles name them.
    for k, path in enumerate(sorted(folder.glob("isteresi*")), 1):
        path.rename(folder / f"isteresi_prova{k}.csv")
    assert {"40deg", "300deg"} <= {name.removesuffix("_15rpm") for name in propose([folder], Wishes("RV20E-121")).conditions}
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121", "--angle-of", "output"]) == 0
    assert capsys.readouterr().out.rstrip().endswith(f"next:\n  rvwear compare RV20E-121 {folder}")


def test_angles_in_names_are_said_to_be_positions_by_one_option(tmp_path, capsys):
    """An option for each condition stood there, which the first call could not have: names of conditions come out of it."""
    folder = italian_loops(tmp_path, **{"40gradi": "Ingresso bloccato", "300gradi": "Ingresso bloccato"})
    words = ["campaign", "from", str(folder), "--reducer", "RV20E-121", "--angle-of", "output"]
    assert main(words) == 0
    out = capsys.readouterr().out
    assert f"  rvwear {shlex.join([*words, '--overwrite'])} --condition locked_at=named\n" in out
    assert "angles of all files are taken to count from one zero" in " ".join(out.split())
    wishes = Wishes("RV20E-121", conditions={"locked_at": "named"}, angle_of="output")
    proposal = propose([folder], wishes)
    assert {name: stated.get("locked_at") for name, stated in proposal.conditions.items() if "gradi" in name} == {"40gradi": "40 deg", "300gradi": "300 deg"}
    assert not proposal.unplaced and not any("locked_at" in stated for name, stated in proposal.conditions.items() if "gradi" not in name)
    assert main([*words, "--overwrite", "--condition", "300gradi:mounting=b"]) == 0
    assert "count from one zero" not in " ".join(capsys.readouterr().out.split())
    with pytest.raises(InputFault, match="40gradi:locked_at"):
        propose([folder], replace(wishes, conditions={"40gradi:locked_at": "named"}))


def test_a_position_that_nobody_says_is_asked_with_the_command_that_says_it(tmp_path, capsys):
    folder = italian_loops(tmp_path, **{"40gradi": "Ingresso bloccato", "caldo": "Ingresso bloccato"})
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121", "--angle-of", "output"]) == 0
    out = capsys.readouterr().out
    assert "nobody says where the input was locked" in out
    assert out.rstrip().endswith(f"look at what is not sure, then:\n  rvwear campaign check {folder}\n  rvwear compare RV20E-121 {folder}")
    (command,) = (shlex.split(line) for line in out.splitlines() if line.startswith("  rvwear campaign from"))
    assert command[-4:] == ["--condition", "40gradi:locked_at=40 deg", "--condition", "caldo:locked_at=..."]
    assert main(command[1:]) == 2
    assert "--condition caldo:locked_at=...: put what it is in place of the dots, as in locked_at=90 deg" in capsys.readouterr().err
    assert main([*command[1:-1], "caldo:locked_at=mean"]) == 0
    assert "not sure" not in capsys.readouterr().out
    # Of a folder's files, as a shell lists them, the folder; of some of them these.
    files = sorted(map(str, folder.glob("*.csv")))
    for given, told in ((files, [str(folder)]), (files[1:], files[1:])):
        assert main(["campaign", "from", *given, "--reducer", "RV20E-121", "--angle-of", "output", "--overwrite"]) == 0
        (command,) = (shlex.split(line) for line in capsys.readouterr().out.splitlines() if line.startswith("  rvwear campaign from"))
        assert command[3 : command.index("--reducer")] == told
    # With the output locked there is nothing to ask.
    assert not propose([folder], Wishes("RV20E-121", tags={"locked": "output"}, angle_of="output")).doubts


def test_kinds_of_files_are_left_out_of_the_names_of_conditions_whole(tmp_path):
    folder = italian_loops(tmp_path, **{"40gradi": "Ingresso bloccato a 40°"})
    assert sorted(propose([folder], Wishes("RV20E-121")).conditions) == ["167N.m", "40gradi", "84N.m"]
    # Words of a kind that nobody knows as one go where numbers tell all apart, and stay where they alone do.
    for load in (84, 167):
        (folder / f"errore_trasmissione_{load}Nm.csv").rename(folder / f"errore_grezzo_{load}Nm.csv")
    assert sorted(propose([folder], Wishes("RV20E-121")).conditions) == ["167N.m", "40gradi", "84N.m"]
    for state in ("freddo", "caldo"):
        for load in (84, 167):
            text = (folder / f"errore_grezzo_{load}Nm.csv").read_bytes()
            (folder / f"errore_{state}_{load}Nm.csv").write_bytes(text)
    assert {"freddo_84N.m", "caldo_84N.m"} <= propose([folder], Wishes("RV20E-121")).conditions.keys()


def test_of_loops_locked_at_several_angles_any_may_be_held_out():
    """"The last one; nothing says which lies inside the others" stood beside 0, 120 and 240 deg."""
    from discrepancy.campaign.guess.held_out import held_out

    conditions = {f"{angle}deg": {"locked_at": f"{angle} deg", "temperature": "24 degC"} for angle in (0, 120, 240)}
    (guess,) = held_out(conditions, {name: ["hysteresis"] for name in conditions}).values()
    assert guess.reason.endswith("they differ by where the input was locked alone (0 deg, 120 deg, 240 deg), and angles go round: none lies beyond the others, any would do")
    plain = {name: {"temperature": "24 degC"} for name in conditions}
    (guess,) = held_out(plain, {name: ["hysteresis"] for name in plain}).values()
    assert guess.reason.endswith("nothing says which lies inside the others")


@pytest.mark.parametrize(("word", "taken"), [
    ("input", "input"), ("Eingang", "input"), ("Antrieb gesperrt", "input"), ("入力軸", "input"), ("in", "input"), ("sortie", "output"), ("Output", "output"),
    ("Ausgang gesperrt, der Eingang frei", "output"), ("input at 40 deg", "input"),
])  # fmt: skip
def test_a_word_of_a_side_is_said_to_be_taken_for_it(tmp_path, capsys, word, taken):
    """Other words than the file's own were refused as ``runs[1] (loop_1).tags.locked``, and doubts named none."""
    (tmp_path / "loop_1.csv").write_text("torque [Nm],turn [arcmin]\n" + "\n".join(f"{math.sin(k / 9)},{math.sin(k / 9)}" for k in range(80)), encoding="utf-8")
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--dry-run", "--tag", f"locked={word}"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert f'tags.locked = "{taken}"' in said and (f"{word!r} is taken for {taken}" in said) == (word.lower() != taken)
    assert ("said of the condition: --condition 'locked_at=40 deg'" in said) == ("40" in word)


def test_a_word_that_is_not_understood_is_refused_with_those_that_are(tmp_path, capsys):
    (tmp_path / "loop_1.csv").write_text("torque [Nm],turn [arcmin]\n" + "\n".join(f"{math.sin(k / 9)},{math.sin(k / 9)}" for k in range(80)), encoding="utf-8")
    command = ["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--dry-run"]
    for word, more in (("banana", ""), ("40 deg", "; where it was held is said of the condition: --condition 'locked_at=40 deg'"), ("inptu", "; did you mean input?"),
                       ("entrada y salida", "")):  # fmt: skip
        assert main([*command, "--tag", f"locked={word}"]) == 2
        assert f"--tag locked={word}: {word!r} is not understood; which side was held is one of input, output{more}" in " ".join(capsys.readouterr().err.split())
    assert main(command) == 0
    assert "locked = input is assumed; --tag locked=input if so; --tag locked=WORD, which is input or output" in " ".join(capsys.readouterr().out.split())
