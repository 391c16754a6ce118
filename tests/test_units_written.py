"""Units as people write them are the same wherever they are typed: reducer files, settings, options, campaigns."""

import math
import subprocess
import sys

import pytest

from cli.main import main
from cli.screen import console, dense, styled
from discrepancy.campaign.amount import amount
from discrepancy.page.amounts import pretty
from fmu_src.faults import InputFault
from fmu_src.unit_words import COUNTS, WRITTEN, plain, unit_on_screen
from fmu_src.units import UnitError, by_pint, conversion, parse
from orchestrator.settings import parse_value
from pages.words import units_in_print
from reducers.completion.command import typed
from reducers.reducer import load_reducer

INCH_POUND = 0.1129848290276167


@pytest.mark.parametrize("unit, target, factor", [
    ("in-lbf", "N.m", INCH_POUND), ("lb-in", "N.m", INCH_POUND), ("ft-lb", "N.m", 12 * INCH_POUND), ("in-lbf/arcmin", "N.m/arcmin", INCH_POUND), ("um/Nm", "m/(N.m)", 1e-6),
    ("um/N.m", "m/(N.m)", 1e-6), ("um/N m", "m/(N.m)", 1e-6), ("arcmin/N·m", "rad/(N.m)", math.radians(1.0 / 60.0)), ("um/N.m", "m^2/N", 1e-6),
    ("in-lbf/degree", "N.m/degree", INCH_POUND), ("U/min", "rpm", 1.0), ("krpm", "rpm", 1000.0), ("N m", "N.m", 1.0), ("Grad", "deg", 1.0), ("kgf.m", "N.m", 9.80665),
    # A word for several units is that of the kind that is needed.
    ("C", "A.s", 1.0), ("kg.m", "N.m", 9.80665),
])  # fmt: skip
def test_units_as_people_write_them(unit, target, factor):
    assert conversion(unit, target) == pytest.approx((factor, 0.0))


def test_every_spelling_is_its_unit():
    for units in WRITTEN.values():
        for unit, words in units.items():
            for word in words.split() if unit != COUNTS else ():
                assert conversion(plain(word), unit) == pytest.approx((1.0, 0.0)), word


def test_fahrenheit_has_its_zero():
    factor, offset = conversion("F", "K")
    assert 77 * factor + offset == pytest.approx(298.15)


@pytest.mark.parametrize("text", ["in-lbx", "mmm", "+", "((", "N-", "1/"])
def test_no_python_speaks_of_a_unit(text):
    with pytest.raises(UnitError) as fault:
        parse(text)
    assert f"unit {text!r} is not known; write it like" in str(fault.value)
    assert not any(word in str(fault.value) for word in ("operand", "ParserHelper", "defined in the unit registry", "Error"))


def test_reducer_files_settings_and_campaigns_take_the_same(tmp_path, capsys):
    known = load_reducer("RV20E-121")
    text = known.path.read_text(encoding="utf-8")
    line = next(line for line in text.splitlines() if line.startswith("load_torque ="))
    (tmp_path / "mine.toml").write_text(text.replace(line, 'load_torque = { value = 1478, unit = "in-lbf", source = "catalogue" }'), encoding="utf-8")
    assert load_reducer(tmp_path / "mine.toml").starts["load_torque"] == pytest.approx(1478 * INCH_POUND)
    variable = known.plant.by_name["load_torque"]
    assert parse_value("1478in-lbf", variable) == pytest.approx(amount("1478 in-lbf", "N.m", "here")) == pytest.approx(1478 * INCH_POUND)
    with pytest.raises(InputFault, match=r"here = 3 in-lbx: unit 'in-lbx' is not known; .*did you mean"):
        amount("3 in-lbx", "N.m", "here")
    assert main(["reducer", "new", "--ratio", "121", "--pins", "40", "--rated", "3646in-lbf", "--output", str(tmp_path / "new.toml"), "-q"]) == 0
    assert "--rated 411.943 " in (tmp_path / "new.toml").read_text(encoding="utf-8")


@pytest.mark.parametrize("value, text", [(411.942686635, "411.943"), (412.0, "412"), (7.5, "7.5"), (1234.5678, "1234.5678"), (0.1 + 0.2, "0.3"), (203.2, "203.2")])
def test_numbers_in_commands_have_the_digits_that_were_given_or_six(value, text):
    assert typed(value) == text


def test_what_people_write_for_another_unit_is_none_of_the_models_own():
    """kg.m of an unbalance was read as kgf.m, with a factor of 9.8 in every FMU."""
    reducer = load_reducer("RV20E-121")
    own = {v.unit for table in (reducer.plant, reducer.wear) for v in table.variables}
    assert "kg.m" in own
    assert {unit: parse(unit) for unit in own} == {unit: by_pint(unit) for unit in own}
    assert conversion("kg.m", "N.m") == (9.80665, 0.0)
    assert conversion("g.mm", "kg.m") == (pytest.approx(1e-6), 0.0)


@pytest.mark.parametrize(("source", "target", "factor"), [
    ("Hz", "rad/s", 2.0 * math.pi), ("Hz", "rpm", 60.0), ("rpm", "Hz", 1.0 / 60.0), ("kHz", "deg/s", 360e3), ("kHz", "Hz", 1e3), ("rpm", "rad/s", math.pi / 30.0),
])  # fmt: skip
def test_a_frequency_counts_turns(source, target, factor):
    """25 Hz of a shaft were 239 rpm."""
    assert conversion(source, target) == (pytest.approx(factor, rel=1e-12), 0.0)


@pytest.mark.parametrize(("text", "shown"), [
    ("N.m", "N m"), ("arcmin/(N.m)", "arcmin/(N m)"), ("N.m/arcmin", "N m/arcmin"), ("N.m.arcmin", "N m arcmin"), ("0.05 N.m of 3 kN.m.", "0.05 N m of 3 kN m."),
    ("12 N·m", "12 N m"), ("80 N.mm", "80 N mm"),
    # Names of conditions, heads of columns and what is to be typed stand as they are.
    ("900rpm_50N.m", "900rpm_50N.m"), ("column 'torque [N.m]'", "column 'torque [N.m]'"), ("--set output.load_torque=150N.m", "--set output.load_torque=150N.m"),
    ('unit = "N.m"', 'unit = "N.m"'), ('load_torque = "150 N.m"', 'load_torque = "150 N.m"'), ("T_N.m", "T_N.m"),
])  # fmt: skip
def test_a_torque_has_one_unit_on_screen(text, shown):
    assert unit_on_screen(text) == shown == units_in_print(text)


def test_screen_page_and_faults_have_one_unit_of_a_torque(tmp_path, capsys):
    """N.m, N m and N·m stood beside each other: in tables of the screen, in faults, on pages."""
    assert pretty("N.m/arcmin") == "N m/arcmin" and pretty("rad/(N.m)") == "rad/(N m)" and pretty("g.mm") == "g mm"
    table = dense("torque 3 N.m")
    table.add_column("unit")
    table.add_row("N.m")
    console().print(table)
    console().print("12 N.m", styled("5 N.m", ("7 N.m", "bold")))
    assert main(["reducer", "new", "--ratio", "121", "--rated", "412", "--stiffness", "0.001", "--output", str(tmp_path / "new.toml")]) == 2
    assert main(["reducer", "check", "RV20E-121"]) == 0
    printed = capsys.readouterr()
    assert "12 N m 5 N m7 N m" in printed.out and "N m" in printed.err
    for text in (printed.out, printed.err):
        assert not any(written in text for written in ("N.m", "N·m"))


def test_threads_that_ask_at_once_have_one_registry():
    """A page that was opened while the last one was still answered could not read its reducer: "Unit and Unit of different registries"."""
    asked = """
import sys, threading
from fmu_src.units import parse, registry
sys.setswitchinterval(1e-5)
found = []
threads = [threading.Thread(target=lambda unit=unit: found.append((registry(), parse(unit)))) for unit in ("N.m", "um", "rpm", "arcmin")]
for thread in threads: thread.start()
for thread in threads: thread.join()
print(len(found), len({id(made) for made, _ in found}))
"""
    assert subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True).stdout.split() == ["4", "1"]
