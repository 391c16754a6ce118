"""What names of files say of loads, and what is asked where they do not say it; the command that is printed can be run as it stands."""

import shlex
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCMIN, ARCSEC, ERROR, TORQUE, TWIST

from cli.main import main
from cli.show.guessed_runs import in_one
from discrepancy.campaign.guess.conditions import joined
from discrepancy.campaign.guess.file_names import proposed
from discrepancy.campaign.guess.given_names import by_pattern
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from fmu_src.faults import InputFault


def error_files(folder, *names):
    folder.mkdir(exist_ok=True)
    for name in names:
        pd.DataFrame({"Winkel Abtrieb [°]": np.degrees(ANGLE), "Drehfehler [arcsec]": ERROR / ARCSEC}).to_csv(folder / f"{name}.csv", index=False)
    return folder


def loop_files(folder, *names):
    for name in names:
        pd.DataFrame({"torque [N.m]": TORQUE, "twist [arcmin]": TWIST / ARCMIN}).to_csv(folder / f"{name}.csv", index=False)
    return folder


def test_names_of_conditions_keep_degrees(tmp_path):
    """``entrée_bloquée_à_90``, of which nobody knows what 90 is."""
    names = [f"Hystérésis entrée bloquée à {angle} essai {k}" for angle in ("0°", "90 °") for k in (1, 2)]
    proposal = propose([loop_files(tmp_path, *names)], Wishes("RV20E-121"))
    assert {name: stated["locked_at"] for name, stated in proposal.conditions.items()} == {"entrée_bloquée_à_0deg": "0 deg", "entrée_bloquée_à_90deg": "90 deg"}
    # Of other signs of the kind not all are degrees.
    assert [joined([text]) for text in ("bloqueado a 90º", "1º bloque", "n° 3", "80 %")] == ["bloqueadoa90deg", "1ºbloque", "n3", "80pct"]


@pytest.mark.parametrize("name, load, pattern", [
    ("DGF_Last50Nm_Lauf2", 50, "DGF_Last{load}Nm_Lauf{replicate}"), ("g7_T100Nm_2", 100, "g7_T{load}Nm_{replicate}"), ("TE 100 Nm 2", 100, "TE {load} Nm {replicate}"),
    ("TE_100_Nm_2", 100, "TE_{load}_Nm_{replicate}"), ("Last100Nm_2", 100, "Last{load}Nm_{replicate}"), ("Last_100Nm_2", 100, "Last_{load}Nm_{replicate}"),
    ("load12,5Nm_2", 12.5, "load{load}Nm_{replicate}"), ("Pruefling_Last 1,2 kNm_2", 1.2, "Pruefling_Last {load} kNm_{replicate}"),
])  # fmt: skip
def test_loads_in_names(name, load, pattern):
    said = proposed(Path(f"{name}.csv"))
    unit = "kN.m" if "kNm" in name else "N.m"
    assert said.pattern == pattern and said.numbers == {"load": (load, unit)} and said.replicate == 2
    assert by_pattern(Path(f"{name}.csv"), pattern).numbers == said.numbers


@pytest.mark.parametrize("name, numbers, pattern, replicate", [
    ("te-50Nm-40C-1", {"load": 50.0, "temperature": 40.0}, "te-{load}Nm-{temperature}C-{replicate}", 1),
    ("te-50Nm-60C-2", {"load": 50.0, "temperature": 60.0}, "te-{load}Nm-{temperature}C-{replicate}", 2),
    ("te-40C", {"temperature": 40.0}, "te-{temperature}C", None),
    # A minus stays one: behind another hyphen, behind the letter that names the number, and where underlines part the name.
    ("te--10C", {"temperature": -10.0}, "te-{temperature}C", None), ("te-T-10C", {"temperature": -10.0}, "te-T{temperature}C", None),
    ("temp-10C", {"temperature": -10.0}, "temp{temperature}C", None), ("te_-10C", {"temperature": -10.0}, "te_{temperature}C", None),
    ("2024-05-03", {}, "{any}", None),
    ("角度伝達誤差_50Nm_2回目", {"load": 50.0}, "角度伝達誤差_{load}Nm_{replicate}回目", 2), ("传动误差_50Nm_第2次", {"load": 50.0}, "传动误差_{load}Nm_第{replicate}次", 2),
])  # fmt: skip
def test_hyphens_part_names_that_nothing_else_parts(name, numbers, pattern, replicate):
    found = proposed(Path(f"{name}.csv"))
    assert ({key: number for key, (number, _) in found.numbers.items()}, found.pattern, found.replicate) == (numbers, pattern, replicate)


@pytest.mark.parametrize("name", ["Probe2h_1", "Probe_2_C_1", "V2K", "te_run_2"])
def test_letters_and_single_signs_are_no_units(name):
    assert not proposed(Path(f"{name}.csv")).numbers


def test_a_number_in_names_that_nobody_understands_is_asked_about(tmp_path, capsys):
    """One value for all files would be wrong: the pattern is proposed, once, and as printed it does what was meant."""
    folder = error_files(tmp_path / "Prüfstand 7", "te_X50_1", "te_X100_1", "te_X167_1")
    loop_files(folder, "loop_20C_1", "loop_20C_2")
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121", "--condition", "output_speed=15 rpm"]) == 1
    command = shlex.split(capsys.readouterr().out.strip().splitlines()[-1])
    assert command.count("--names") == 1 and "te_X{load_torque:N.m}_{replicate}" in command and not any("load_torque=" in word for word in command)
    assert main(command[1:]) == 0
    out = capsys.readouterr().out
    assert "load_torque 167 N m" in out and "load_torque 50 N m" in out
    assert shlex.split(out.strip().splitlines()[-1]) == ["rvwear", "compare", "RV20E-121", str(folder)]


def test_what_two_quantities_need_is_asked_once(tmp_path, capsys):
    folder = error_files(tmp_path / "a", "te")
    pd.DataFrame({"input_speed [rpm]": [200.0, 600, 1000], "efficiency [%]": [60.0, 61, 62]}).to_csv(folder / "efficiency.csv", index=False)
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121", "--condition", "output_speed=15 rpm", "--held-out"]) == 1
    command = shlex.split(capsys.readouterr().out.strip().splitlines()[-1])
    assert command.count("load_torque=...") == 1 and "--held-out" in command


def test_files_that_fit_no_pattern_are_guessed_and_said_where_others_of_their_kind_fit(tmp_path):
    """A pattern of transmission errors made a doubt of each loop, which it was not meant for."""
    folder = loop_files(error_files(tmp_path / "a", "te_50_1", "te_100_1", "Drehfehler_75Nm_Lauf1"), "Hysterese_20C_Lauf1")
    proposal = propose([folder], Wishes("RV20E-121", names=("te_{load}_{replicate}",)))
    loads = {c["load_torque"] for c in proposal.conditions.values() if "load_torque" in c}
    assert proposal.conditions["20degC"] == {"temperature": "20 degC"} and {"50 N.m", "75 N.m", "100 N.m"} == loads
    said = [doubt for doubt in proposal.doubts if "fits none of the given names" in doubt.text]
    assert [doubt.place for doubt in said] == ["Drehfehler_75Nm_Lauf1.csv"] and "--names 'Drehfehler_{load}Nm_Lauf{replicate}'" in said[0].remedy
    without = propose([folder], Wishes("RV20E-121"))
    loop, as_without = (next(run for run in found.runs if "Hysterese" in run.guessed.path.name) for found in (proposal, without))
    assert loop.guessed.name == as_without.guessed.name


def test_repetitions_that_do_not_count_from_one_are_doubted(tmp_path):
    """Speeds of P100-N10 and P100-N20 were taken for repetitions without a word."""
    for name in ("P100-N10", "P100-N20"):
        pd.DataFrame({"angle [deg]": np.degrees(ANGLE), "te [arcsec]": ERROR / ARCSEC}).to_csv(tmp_path / f"{name}.csv", index=False)
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    (doubt,) = (d for d in proposal.doubts if "repetitions" in d.text)
    assert doubt.text.startswith("10, 20 in P100-N{replicate}") and "--names 'P100-N{speed}'" in doubt.remedy
    # Numbers from 1 on are what they seem.
    for name, counted in (("P100-N10", "P100-N1"), ("P100-N20", "P100-N2")):
        (tmp_path / f"{name}.csv").rename(tmp_path / f"{counted}.csv")
    assert not any("repetitions" in d.text for d in propose([tmp_path], Wishes("RV20E-121")).doubts)


def test_conditions_side_by_side_in_one_file_are_told(tmp_path):
    """The first of three loads was taken, under the last load of the file's name."""
    columns = {f"TE {load}Nm (arcsec)": ERROR / ARCSEC * load / 100 for load in (50, 100, 167)}
    pd.DataFrame({"Winkel (Grad)": np.degrees(ANGLE), **columns}).to_csv(tmp_path / "te_50_100_167Nm.csv", index=False)
    (doubt,) = (d for d in propose([tmp_path], Wishes("RV20E-121")).doubts if "differ by a number alone" in d.text)
    assert "'TE 50Nm (arcsec)' is taken, not 'TE 100Nm (arcsec)', 'TE 167Nm (arcsec)'" in doubt.text and "columns.value" in doubt.remedy
    given = propose([tmp_path], Wishes("RV20E-121", columns={"value": "TE 100Nm (arcsec)"}))
    assert not any("differ by a number alone" in d.text for d in given.doubts)


def test_the_first_pattern_that_fits_counts(tmp_path):
    folder = error_files(tmp_path / "a", "te_50_1", "te_x_1")
    proposal = propose([folder], Wishes("RV20E-121", names=("te_{load}_{replicate}", "te_{condition}_{any}")))
    assert [run.guessed.name.pattern for run in proposal.runs] == ["te_{load}_{replicate}", "te_{condition}_{any}"]


@pytest.mark.parametrize("unit", ["Upm", "Umin", "U_min", "U-min"])
def test_turns_a_minute_in_names(unit):
    assert proposed(Path(f"te_15{unit}_50Nm_1.csv")).numbers["speed"] == (15.0, "rpm")


def test_turns_in_a_name_are_asked_whether_they_are_those_a_minute(tmp_path, capsys):
    """15U was "a unit of angle"; where no name differed from it, nothing pointed at it."""
    folder = error_files(tmp_path / "bench", "te_15U_50Nm_1", "te_15U_50Nm_2")
    with pytest.raises(InputFault, match=r"'U' behind \{speed\} is turns: does it stand for turns a minute \(U/min\)\? Then write 'te_\{speed:rpm\}U_\{load\}Nm_"):
        propose([folder], Wishes("RV20E-121", names=("te_{speed}U_{load}Nm_{replicate}",)))
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121"]) == 1
    asked = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("  rvwear campaign from"))
    assert main(shlex.split(asked)[1:]) == 0


@pytest.mark.parametrize("text, speed", [("errore 60Nm 750 giri 1", 750.0), ("te_50Nm_1500tours_2", 1500.0), ("et 50Nm 900 vueltas 1", 900.0)])
def test_many_turns_in_a_name_are_turns_a_minute(text, speed):
    found = proposed(Path(f"{text}.csv"))
    assert found.numbers["speed"] == (speed, "rpm") and "{speed:rpm}" in found.pattern
    assert "speed" not in proposed(Path("te_50Nm_15U_1.csv")).numbers and "speed" not in proposed(Path("te_50Nm_2 giri_1.csv")).numbers


def test_a_pattern_says_where_the_input_was_locked(tmp_path):
    """It counts before what the head says; in degrees, or in the unit behind it; one of another kind is refused."""
    for file in list(loop_files(tmp_path, "Schleife 0° 2", "Schleife 120° 2").glob("*.csv")):
        file.write_text("Eingang gesperrt bei 40 deg\n\n" + file.read_text(encoding="utf-8"), encoding="utf-8")
    proposal = propose([tmp_path], Wishes("RV20E-121", names=("Schleife {locked_at}° {replicate}",)))
    assert sorted(stated["locked_at"] for stated in proposal.conditions.values()) == ["0 deg", "120 deg"]
    assert by_pattern(Path("loop_1.5rad_1.csv"), "loop_{locked_at}rad_{replicate}").numbers == {"locked_at": (1.5, "rad")}
    with pytest.raises(InputFault, match="'rpm' behind {locked_at} is a unit of speed, not of angle"):
        by_pattern(Path("loop_15rpm_1.csv"), "loop_{locked_at}rpm_{replicate}")


def test_long_names_of_runs_are_not_cut(tmp_path, capsys):
    """Twelve runs were all "Error_de_transmisión_100_Nm_600_r…"."""
    error_files(tmp_path, *(f"Error de transmisión del banco de ensayo 100 Nm 600 rpm medida {k}" for k in (1, 2)))
    assert main(["campaign", "from", str(tmp_path), "--dry-run", "--reducer", "RV20E-121"]) in (0, 1)
    shown = capsys.readouterr().out
    rows = "".join(line.split("│")[1].strip() for line in shown.splitlines() if line.startswith("│"))
    assert "…" not in shown and "Error_de_transmisión_del_banco_de_ensayo_100_Nm_600_rpm_medida_1, 2" in rows


def test_repetitions_share_a_row_and_a_unit_is_said_once(tmp_path, capsys):
    """Sixteen runs took forty lines with names on two of them, and a unit stood there twice with where it is from."""
    names = [f"Drehfehler_{load}Nm_1450_U_min_Versuch_{k}" for load in (50, 100) for k in (1, 2, 10)]
    error_files(tmp_path, *names, "Drehfehler_150Nm_1450_U_min")
    loop_files(tmp_path, *(f"Hysterese_Eingang_blockiert_90deg_Versuch_{k}" for k in (1, 2, 3, 4)), "Hysterese_warm_1")
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--dry-run"]) == 0
    out = capsys.readouterr().out
    rows = [" ".join(line.strip("│").split("│")[0].split()) for line in out.splitlines() if line.startswith("│")]
    assert rows == [
        "transmission_error:", "Drehfehler_100Nm_1450_U_min_Versuch_1, 2, 10", "Drehfehler_150Nm_1450_U_min", "Drehfehler_50Nm_1450_U_min_Versuch_1, 2, 10",
        "hysteresis:", "Hysterese_Eingang_blockiert_90deg_Versuch_1 to 4", "Hysterese_warm_1",
    ]  # fmt: skip
    said = " ".join(out.split())
    assert "column 'Drehfehler [arcsec]', its name says error, unit arcsec ([arcsec] in its header)" in said and said.count("[arcsec] in its header") == 1
    assert in_one(["te_1_a", "te_2_a"]) == "" and in_one(["te_1", "te_12"]) == "te_1, 12" and in_one(["laufA", "laufB"]) == "laufA, B"
