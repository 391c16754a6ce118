"""Names in units that are not SI, and repetitions counted by letters: read, asked about or refused, never taken for something else in silence."""

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from bench_files import ANGLE, ARCMIN, ARCSEC, ERROR, TORQUE, TWIST

from cli.main import main
from discrepancy.campaign.guess.file_names import proposed
from discrepancy.campaign.guess.given_names import by_pattern, require_fit
from discrepancy.campaign.guess.header_units import unit_in
from discrepancy.campaign.guess.locked_words import held_angle
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from fmu_src.faults import InputFault
from fmu_src.units import conversion

INCH_POUND = 0.1129848290276167
NAME = "TE 1800 RPM 1478 in-lbf 77F run A"


def error_file(folder, name, speed=1800.0):
    folder.mkdir(parents=True, exist_ok=True)
    columns = {"Output Angle (deg)": np.degrees(ANGLE), "Transmission Error (arc-sec)": ERROR / ARCSEC, "Input Speed (rpm)": np.full(len(ANGLE), speed)}
    table = pd.DataFrame(columns).to_csv(index=False)
    (folder / f"{name}.csv").write_text(f"Test: Transmission Error\nRun {name[-1]}\n{table}")


def loop_file(folder, name, head="Test: Torsional Stiffness, input locked"):
    folder.mkdir(parents=True, exist_ok=True)
    table = pd.DataFrame({"Load (in-lbf)": TORQUE / INCH_POUND, "Windup (arc-min)": TWIST / ARCMIN}).to_csv(index=False)
    (folder / f"{name}.csv").write_text(f"{head}\n{table}")


def lab(folder):
    for load in (500, 1000, 1478):
        for speed in (600, 1800):
            for run in "AB":
                error_file(folder / "transmission error", f"TE {speed} RPM {load} in-lbf 77F run {run}", speed)
    for run in "AB":
        loop_file(folder / "hysteresis", f"hyst 77F locked at 90 deg run {run}")
    return folder


def test_files_in_customary_units_are_read_without_an_option(tmp_path, capsys):
    """They made 14 conditions of 7, and the twin of a fitted run was held out."""
    folder = lab(tmp_path / "lab")
    proposal = propose([folder], Wishes("RV20E-121"))
    assert len(proposal.conditions) == 7 and not proposal.needs and not proposal.unplaced
    assert [run.replicate.value for run in proposal.runs] == [1, 2] * 7 and all(run.replicate.sure for run in proposal.runs)
    # One family of names for each quantity.
    assert {run.guessed.name.pattern for run in proposal.runs} == {
        "hyst {temperature}F locked at 90 deg run {replicate}", "TE {speed} RPM {load} in-lbf {temperature}F run {replicate}",
    }  # fmt: skip
    (held,) = proposal.held_out
    assert proposal.conditions[held]["load_torque"] == "1000 lbf.inch"
    # The column has the speed that the name states: no question is left of whose it is.
    assert all(doubt.text.startswith("angle_of") for doubt in proposal.doubts)
    records = {record.name: record for record in checked(proposal).records}
    loop, error = records["hyst_77F_locked_at_90_deg_run_A"], records["TE_1800_RPM_1478_in-lbf_77F_run_A"]
    assert loop.factors["locked_at"] == pytest.approx(np.pi / 2) and loop.tags["locked"] == "input"
    assert loop.axes["torque"] == pytest.approx(TORQUE)
    assert error.factors["load"] == pytest.approx(1478 * INCH_POUND) and error.factors["temperature"] == pytest.approx(298.15)
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121", "--dry-run", "--json"]) == 0
    assert len(json.loads(capsys.readouterr().out)["conditions"]) == 7


@pytest.mark.parametrize("pattern, load", [
    ("TE {input_speed} RPM {load} in-lbf {temperature}F run {any}", "lbf.inch"), ("TE {input_speed} RPM {load}{any}", "lbf.inch"),
    ("TE {input_speed} {any} {load} {any} {temperature}{any} run {replicate}", "lbf.inch"),
    # What the pattern says wins.
    ("TE {input_speed} RPM {load:ft-lb} in-lbf {temperature}F {any}", "lbf.foot"), ("TE {input_speed} RPM {load:N m}{any}", "N.m"),
])  # fmt: skip
def test_units_beside_fields_are_read(pattern, load):
    """1478 N m and 77 degC were taken of this name, without a word."""
    said = by_pattern(Path(f"{NAME}.csv"), pattern)
    assert said.numbers["load"] == (1478.0, load) and said.numbers["input_speed"] == (1800.0, "rpm") and not said.unsure
    assert said.numbers.get("temperature", (77.0, "degF")) == (77.0, "degF")


@pytest.mark.parametrize("unit, field, known", [
    *((unit, "load", "lbf.inch") for unit in ("in-lbf", "in-lb", "lbf.in", "lb-in", "lbf-in", "inlbf", "in_lbf", "in-lbs", "IN-LBF")),
    *((unit, "load", "lbf.foot") for unit in ("ft-lb", "ft-lbf", "lb-ft", "lbf.ft", "ftlb")), ("oz-in", "load", "ozf.inch"), ("Nm", "load", "N.m"),
    ("N.m", "load", "N.m"), ("N m", "load", "N.m"), ("kNm", "load", "kN.m"), ("kgf-m", "load", "kgf.m"), ("pct", "load", "%"),
    *((unit, "temperature", "degF") for unit in ("F", "degF", "deg F", "°F")), ("K", "temperature", "K"), ("C", "temperature", "degC"),
    ("rps", "speed", "turn/s"), ("krpm", "speed", "krpm"), ("U_min", "speed", "rpm"), ("tr_min", "speed", "rpm"), ("min-1", "speed", "rpm"),
])  # fmt: skip
def test_units_of_names(unit, field, known):
    for gap in ("", "_") if field != "temperature" else ("", " "):
        text = f"te_120{gap}{unit}_2"
        given = by_pattern(Path(f"{text}.csv"), f"te_{{{field}}}{gap}{unit}_{{replicate}}")
        assert given.numbers == {field: (120.0, known)} and not given.unsure
        if unit not in ("pct", "min-1"):
            said = proposed(Path(f"{text}.csv"))
            assert (said.numbers, said.replicate, said.label) == ({field: (120.0, known)}, 2, "")
            assert by_pattern(Path(f"{text}.csv"), said.pattern).numbers == said.numbers


@pytest.mark.parametrize("pattern, said", [
    ("TE {load} RPM {any}", r"'RPM' behind \{load\} is a unit of speed, not of torque; .*\{load:N.m\}"),
    ("TE {any} {input_speed} in-lbf {any}", r"'in-lbf' behind \{input_speed\} is a unit of torque"), ("te_{load}h", r"'h' behind \{load\} is a unit of time"),
    ("te_{speed}U_{any}", r"'U' behind \{speed\} is turns: .*\{speed:rpm\}"), ("te_{load:rpm}", r"\{load:rpm\}: unit 'rpm' does not fit"),
    ("te_{load:in-lbx}", r"unit 'in-lbx' is not known"), ("te_{any:N.m}", r"\{any\} has no unit"),
])  # fmt: skip
def test_units_of_another_kind_beside_a_field_are_refused(pattern, said):
    with pytest.raises(InputFault, match=said):
        by_pattern(Path(f"{NAME}.csv"), pattern)


@pytest.mark.parametrize("name, pattern", [("te_50neu_1", "te_{load}neu_{replicate}"), ("te_50rpm", "te_{load}{any}"), ("te_50rpm_b", "te_{load}{condition}")])
def test_letters_behind_a_number_that_are_no_unit_of_it_are_doubted(tmp_path, name, pattern):
    error_file(tmp_path, name)
    proposal = propose([tmp_path], Wishes("RV20E-121", names=(pattern,)))
    (doubt,) = (d for d in proposal.doubts if "is no unit of torque" in d.text)
    assert "N.m is taken" in doubt.text and "{load:UNIT}" in doubt.remedy
    settled = propose([tmp_path], Wishes("RV20E-121", names=(pattern.replace("{load}", "{load:in-lbf}"),)))
    assert not any("no unit of" in d.text for d in settled.doubts)
    assert {c["load_torque"] for c in settled.conditions.values()} == {"50 lbf.inch"}


@pytest.mark.parametrize("name, pattern", [
    ("te_50_rev", "te_{load}_{direction}"), ("te_50_rev", "te_{load}_{any}"), ("te_50_rev", "te_{load}_rev"), ("te_50x15", "te_{load}x{speed}"),
    ("te_50_40C", "te_{load}_{temperature}C"), ("te_50_m2", "te_{load}_m{replicate}"),
])  # fmt: skip
def test_what_stands_apart_from_a_number_is_no_unit_of_it(name, pattern):
    said = by_pattern(Path(f"{name}.csv"), pattern)
    assert said.numbers["load"] == (50.0, "N.m") and not said.unsure


@pytest.mark.parametrize("name, count", [
    ("te_50Nm_run A", 1), ("te_50Nm_run_B", 2), ("te_50Nm_runC", 3), ("TE 50Nm Lauf B", 2), ("te 50Nm trial 2", 2), ("te 50Nm rep A", 1), ("te_50Nm-run-b", 2),
    ("te_50Nm_Versuch A", 1), ("te_50Nm_prova B", 2), ("te_50Nm_essai_B", 2), ("te trial 2 50Nm", 2), ("te_run_1_50Nm", 1), ("te run A 50Nm", 1),
    # Neither a word of its own nor a letter alone counts.
    ("te_50Nm_A", None), ("te_50Nm_rund", None), ("te_50Nm_Rig B", None), ("te_50Nm_runaway", None),
])  # fmt: skip
def test_letters_count_repetitions_behind_words_that_say_so(name, count):
    said = proposed(Path(f"{name}.csv"))
    assert said.replicate == count and (not said.label) == (count is not None)
    if count:
        again = by_pattern(Path(f"{name}.csv"), said.pattern)
        assert (again.replicate, again.numbers) == (count, said.numbers)


def test_a_replicate_of_a_pattern_is_a_number_or_a_letter_of_its_own():
    assert by_pattern(Path("te_50_b.csv"), "te_{load}_{replicate}").replicate == 2
    assert by_pattern(Path("te_50NmB.csv"), "te_{load}Nm{replicate}").replicate == 2
    assert by_pattern(Path("te_50_ab.csv"), "te_{load}_{replicate}") is None and by_pattern(Path("te_new.csv"), "te_{condition}{replicate}") is None


@pytest.mark.parametrize("pattern, said", [
    ("TE {speed} RPM {load} in-lbf {temperature}C {any}", "TE 600 RPM 500 in-lbf 77F run A.csv fits up to 'TE {speed} RPM {load} in-lbf {temperature}', but instead of 'C' 'F run A' stands there"),
    ("TE {speed} RPM {load} in-lbf", "fits to its end, but ' 77F run A' is left of the name; {any} stands for it"), ("x_{load}", "does not begin with 'x'"),
    ("TE {speed} RPM {load} in-lbf {temperature}F {replicate}", "instead of '{replicate}' (a number or one letter) 'run A' stands there"),
    ("{any}run {condition} {load}", "but instead of ' ' the name ends there"),
])  # fmt: skip
def test_a_pattern_that_fits_no_file_says_how_far_it_fits(pattern, said):
    files = [Path("hyst 77F locked at 90 deg run A.csv"), Path("TE 600 RPM 500 in-lbf 77F run A.csv")]
    with pytest.raises(InputFault, match="fits none of the 2 files") as fault:
        require_fit(files, [pattern])
    assert said in str(fault.value)


def test_a_number_that_nothing_has_read_is_asked_about_rather_than_one_value_for_all(tmp_path, capsys):
    """Six loads became one."""
    for sample in ("red", "blue"):
        for load in (500, 1000, 1478):
            error_file(tmp_path, f"TE 1800 RPM X{load} {sample} 77F run A")
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121"]) == 1
    command = shlex.split(capsys.readouterr().out.strip().splitlines()[-1])
    assert "TE {speed} RPM X{load_torque:N.m} {condition} {temperature}F run {replicate}" in command and not any("load_torque=" in word for word in command)
    (need,) = propose([tmp_path], Wishes("RV20E-121")).needs
    assert "if 500, 1000, 1478 in the names are the load" in need.remedy and "are the load, with its unit" in need.remedy
    assert main([*command[1:-1], command[-1].replace("{load_torque:N.m}", "{load_torque:in-lbf}")]) == 0
    assert "load_torque 1478 lbf.inch" in capsys.readouterr().out


@pytest.mark.parametrize("text, angle", [
    ("hyst 77F locked at 90 deg run A", "90 deg"), ("loop_blocked_at_45deg", "45 deg"), ("Schleife gesperrt bei 30 Grad", "30 deg"), ("bloccato a 40°", "40 deg"),
    ("locked, 40 deg", None), ("locked at 40 degC", None), ("at 40 deg", None),
])  # fmt: skip
def test_where_something_was_held(text, angle):
    assert held_angle([text]) == angle


@pytest.mark.parametrize("head, placed", [("input locked", True), ("output locked", False), ("loop", False)])
def test_where_the_input_was_held_is_read_where_the_head_says_that_it_was_the_input(tmp_path, head, placed):
    # The folder's name counts, too.
    loop_file(tmp_path / "a", "hyst locked at 90 deg run A", head)
    (run,) = propose([tmp_path / "a"], Wishes("RV20E-121")).runs
    assert ("locked_at" in run.guessed.factors) == placed


@pytest.mark.parametrize("header, unit", [("Temp (F)", "degF"), ("Oil Temp F", "degF"), ("Kraft_F", None), ("Sensor F", None), ("Torque [in-lbf]", "lbf.inch"), ("T_in", None),
                                          ("Stiffness (in-lb/arc-min)", "lbf.inch/arcmin"), ("Speed, krpm", "krpm")])  # fmt: skip
def test_customary_units_in_headers(header, unit):
    assert (unit_in(header) or (None,))[0] == unit
    if unit:
        conversion(unit, unit)


@pytest.mark.parametrize("given, said", [
    ("temperature=77 X", r"unit 'X' is not known"), ("load_torque=1478 rpm", "unit 'rpm' does not fit"), ("hours=many", "is not a number with a unit"),
])  # fmt: skip
def test_a_number_of_a_condition_that_is_none_is_refused_where_it_was_typed(tmp_path, capsys, given, said):
    error_file(tmp_path, NAME)
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--dry-run", "--condition", given]) == 2
    assert re.search(f"--condition {given.partition('=')[0]}.*{said}", capsys.readouterr().err)


def test_numbers_of_conditions_are_compared_whatever_their_units(tmp_path):
    """A load of 80 N.m lies above one of 500 in-lbf, and 25 degC given is the 77 degF of the names."""
    for name in ("te 500 in-lbf 77F run A", "te 80 Nm 77F run A", "te 167 Nm 77F run A"):
        error_file(tmp_path, name)
    proposal = propose([tmp_path], Wishes("RV20E-121", conditions={"temperature": "25 degC"}))
    (held,) = proposal.held_out
    assert proposal.conditions[held]["load_torque"] == "80 N.m" and not any("which is kept" in doubt.text for doubt in proposal.doubts)
    assert any("77 degF, which is kept, not 78 F" in d.text for d in propose([tmp_path], Wishes("RV20E-121", conditions={"temperature": "78 F"})).doubts)
