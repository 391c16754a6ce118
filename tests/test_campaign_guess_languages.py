"""Heads as benches write them in several languages: units, what a column means, what a line above the table states, which side is held."""

import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCSEC, ERROR

from discrepancy.campaign.amount import amount
from discrepancy.campaign.guess.column_words import meaning_of, quantities_named
from discrepancy.campaign.guess.header_units import name_of, unit_in
from discrepancy.campaign.guess.lines_above import stated_above
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.state_words import locked_side, unloaded
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from fmu_src.unit_words import COUNTS, WRITTEN, plain, unit_of
from fmu_src.units import parse


def test_every_unit_can_be_converted_and_no_word_stands_for_two():
    meant = {}
    for kind, units in WRITTEN.items():
        for unit, words in units.items():
            assert unit == COUNTS or parse(unit)
            for word in words.split():
                assert meant.setdefault(plain(word), (unit, kind)) == (unit, kind), word


@pytest.mark.parametrize("header, meaning, unit", [
    ("Vitesse de sortie [tr/min]", "output_speed", "rpm"), ("Vitesse tr/min", "speed", "rpm"), ("Temps [s]", "time", "s"), ("Température (°C)", "temperature", "degC"),
    ("Couple de sortie [daN·m]", "torque", "daN.m"), ("Erreur de transmission [secondes d'arc]", "error", "arcsec"), ("Jeu [min d'arc]", "twist", "arcmin"),
    ("Régime moteur tr·min⁻¹", "input_speed", "rpm"), ("Rendement [%]", "efficiency", "%"), ("Usure flanc µm", "wear", "um"),
    ("Coppia in uscita [Nm]", "torque", "N.m"), ("Velocità ingresso [giri/min]", "input_speed", "rpm"), ("Tempo [s]", "time", "s"), ("Errore [secondi d'arco]", "error", "arcsec"),
    ("Par de salida (N·m)", "torque", "N.m"), ("Ángulo de entrada [grados]", "input_angle", "deg"), ("velocidad de salida r.p.m.", "output_speed", "rpm"), ("Tiempo", "time", None),
    ("Ângulo de saída [graus]", "angle", "deg"), ("Erro de transmissão (seg. arco)", "error", "arcsec"), ("Rotação de entrada (rot/min)", "input_speed", "rpm"),
    ("Binário de saída (N.m)", "torque", "N.m"), ("Folga [min. de arco]", "twist", "arcmin"), ("Posição do eixo (contagens)", "angle", "counts"), ("Tempo (s)", "time", "s"),
    ("Ângulo de rotação [rad]", "angle", "rad"), ("Torque de entrada N.m", "input_torque", "N.m"), ("Temperatura do óleo (°C)", "temperature", "degC"),
    ("Drehzahl U/min", "speed", "rpm"), ("n in r/min", "speed", "rpm"), ("T_N.m", "torque", "N.m"), ("Drehzahl Abtrieb [U·min⁻¹]", "output_speed", "rpm"),
    ("输出转速：转/分", "output_speed", "rpm"), ("输入转矩（牛·米）", "input_torque", "N.m"), ("传动误差（角秒）", "error", "arcsec"),
    ("入力トルク [Ｎ・ｍ]", "input_torque", "N.m"), ("出力回転数[回転/分]", "output_speed", "rpm"), ("回転角[度]", "angle", "deg"), ("剛性 [N・m / arc-min]", "stiffness", "N.m/arcmin"),
])  # fmt: skip
def test_heads(header, meaning, unit):
    assert (meaning_of(name_of(header)), (unit_in(header) or (None,))[0]) == (meaning, unit)


@pytest.mark.parametrize("line, stated", [
    ("Vitesse de sortie : 10 tr/min", {"output_speed": (10.0, "rpm")}), ("Vitesse de sortie\u00a0: 10\u00a0tr/min", {"output_speed": (10.0, "rpm")}),
    ("Charge = 100 N.m, vitesse d'entrée = 1210 tr/min", {"load": (100.0, "N.m"), "input_speed": (1210.0, "rpm")}), ("Durée de l'essai : 12 h", {}),
    ("Rotação de saída: 16,5 rpm; carga: 110 N.m", {"output_speed": (16.5, "rpm"), "load": (110.0, "N.m")}),
    ("Velocità uscita: 15 giri/min", {"output_speed": (15.0, "rpm")}), ("Par de salida: 100 N·m; temperatura: 30 °C", {"load": (100.0, "N.m"), "temperature": (30.0, "degC")}),
    ("输出转速：15 转/分", {"output_speed": (15.0, "rpm")}), ("负载：167 N・m", {"load": (167.0, "N.m")}), ("油温,25.1℃", {"temperature": (25.1, "degC")}), ("出力回転数：15 回転/分", {"output_speed": (15.0, "rpm")}),
])  # fmt: skip
def test_lines_above_the_table(line, stated):
    assert stated_above((line,)) == stated


@pytest.mark.parametrize("text, side", [
    ("arbre d'entrée bloqué", "input"), ("la sortie est immobilisée", "output"), ("Ingresso bloccato", "input"), ("uscita fissa", "output"), ("entrada bloqueada", "input"),
    ("salida fija", "output"), ("入力軸固定", "input"), ("出力側をロック", "output"), ("entrada travada", "input"), ("saída fixa", "output"), ("eixo de saída bloqueado", "output"), ("entrée libre", None), ("salida", None),
])  # fmt: skip
def test_which_side_is_held(text, side):
    assert locked_side(text) == side


@pytest.mark.parametrize("text", ["couple_a_vide", "senza carico", "sin carga", "en vacío", "binário sem carga", "torque em vazio", "空載"])
def test_nothing_loads_it(text):
    assert unloaded(text)
    assert quantities_named("couple_a_vide")[0] == "no_load_torque" and quantities_named("raideur_1") == ["hysteresis"]


def test_a_french_file_is_read_whole(tmp_path):
    """Its line above the table was passed over, and the speed asked for."""
    head = "Banc n° 3\nVitesse de sortie : 10 tr/min\nCouple de sortie : 100 N.m\n\n"
    table = pd.DataFrame({"Angle sortie [degrés]": np.degrees(ANGLE), "Erreur de transmission [secondes d'arc]": ERROR / ARCSEC})
    (tmp_path / "essai_1.csv").write_text(head + table.to_csv(index=False, sep=";", decimal=","), encoding="cp1252")
    proposal = propose([tmp_path], Wishes("RV20E-121", angle_of="output"))
    assert not proposal.needs and not proposal.doubts
    # A word for a measurement names no condition.
    assert "essai" not in proposal.conditions
    assert list(proposal.conditions.values()) == [{"output_speed": "10 rpm", "load_torque": "100 N.m"}]
    assert checked(proposal).records[0].values == pytest.approx(ERROR, abs=1e-9)


def test_what_heads_may_say_a_condition_may_be_given_in():
    assert amount("10 tr/min", "rpm", "speed") == pytest.approx(10.0) and amount("3 daN.m", "N.m", "load") == pytest.approx(30.0) and unit_of("giri/min") == ("rpm", "speed")
