"""The command line as one types it: mistyped, with units, quiet, and what it says of itself."""

import json

import pytest

from cli import doctor
from cli.main import main
from cli.options import number_in
from cli.screen import WIDTH
from cli.show.doctor import show
from cli.show.effects import show_one
from discrepancy.catalogue.catalogue import Entry, entries
from discrepancy.catalogue.examples import cases
from discrepancy.catalogue.signature import Row, Signature, words
from fmu_src.effect import Effect, amplitude


def said(capsys, *arguments):
    """(exit code, stdout, stderr)"""
    try:
        code = main(list(arguments))
    except SystemExit as end:
        code = end.code
    out, err = capsys.readouterr()
    return code, out, err


@pytest.mark.parametrize("arguments, text", [
    (["solv"], "rvwear: there is no command 'solv'; did you mean solve?"),
    (["solve", "--torqe", "3"], "rvwear solve: there is no option --torqe; did you mean --torque?"),
    (["solve", "--torqe=3"], "rvwear solve: there is no option --torqe; did you mean --torque?"),
    (["campaign", "chek"], "rvwear campaign: argument ACTION: there is no 'chek'; did you mean check?"),
    (["campaign", "check", "x", "--dta", "y"], "rvwear campaign check: there is no option --dta; did you mean --data?"),
    (["completion", "tcsh"], "rvwear completion: argument shell: there is no 'tcsh'; choose from bash, zsh, fish"),
    (["solve", "3"], "rvwear solve: '3' is too much; a reducer is given as --reducer 3"),
    (["doctor", "3"], "rvwear doctor: '3' is too much: see rvwear doctor --help"),
    ([], "rvwear: name a command, like rvwear solve; rvwear --help lists all"),
    (["campaign"], "rvwear campaign: say what is to be done; rvwear campaign --help lists it"),
    (["solve", "--torque", "16parsec"], "rvwear solve: --torque 16parsec: setting 'output.load_torque=16parsec': unit 'parsec' does not fit"),
    (["life", "--hours", "-3"], "rvwear life: --hours: hours = -3.0: a positive finite number is needed"),
    (["life", "--hours", "2kg"], "rvwear life: argument --hours: the number = 2 kg: unit 'kg' does not fit"),
    (["run", "x.ssp", "--duration", "long"], "rvwear run: argument --duration: 'long' is no number; give one in s, or with another unit of its kind"),
    (["solve", "--torque", "1,5"], "rvwear solve: --torque 1,5: setting 'output.load_torque=1,5': '1,5' has a comma in its number; write 1.5"),
    (["life", "--hours", "1,000"], "rvwear life: argument --hours: '1,000' has a comma in its number; write 1000, or 1.000"),
    (["reducer", "new", "--pins", "39.5"], "rvwear reducer new: argument --pins: '39.5': a whole number is needed"),
    (["dynamics-wear", "--limit", "3%"], "rvwear dynamics-wear: argument --limit: '3%': a number is needed, without a unit"),
    (["solve", "--model", "m.toml"], "rvwear solve: there is no option --model; --reducer takes the name or the file"),
    (["compare", "--model", "m.toml", "x"], "rvwear compare: there is no option --model; it is given without one: rvwear compare MODEL CAMPAIGN"),
    (["solve", "--helq"], "rvwear solve: there is no option --helq; --help lists those there are"),
    (["effects", "fricton"], "rvwear effects: no effect 'fricton'; did you mean drive_friction"),
])  # fmt: skip
def test_what_was_meant_is_said(capsys, arguments, text):
    code, out, err = said(capsys, *arguments)
    assert code == 2 and out == "" and err.startswith(text), err


@pytest.mark.parametrize("text, torque", [("100", 100.0), ("100Nm", 100.0), ("0.1 kN.m", 100.0), ("10 kgf.m", 98.0665)])
def test_torques_with_and_without_a_unit(capsys, text, torque):
    code, out, _ = said(capsys, "solve", "--positions", "8", "--torque", text, "--json")
    assert code == 0 and json.loads(out)["load_torque_Nm"] == pytest.approx(torque)


@pytest.mark.parametrize("text, hours", [("2000", 2000.0), ("0.1", 0.1), ("2000h", 2000.0), ("90 d", 2160.0), ("30min", 0.5)])
def test_hours_with_and_without_a_unit(text, hours):
    assert number_in("h")(text) == pytest.approx(hours, rel=1e-15) and number_in("h")("0.1") == 0.1


@pytest.mark.parametrize("arguments, text", [
    (["compare", "RV20E-12", "bench"], "no reducer 'RV20E-12'; did you mean RV20E-121?; give one of"),
    (["diagnose", "RV20E-121", "bnch"], "no campaign file at bnch/campaign.toml; did you mean bench?; rvwear campaign from"),
    (["next", "modl.toml", "bench"], "no such file at modl.toml; did you mean model.toml?"), (["export", "lif.nc", "a.csv"], "no result file at lif.nc; did you mean life.nc?"),
    (["compare", "model.tml", "bench"], "no reducer 'model.tml'; did you mean model.toml?"), (["compare", "modle", "bench"], "did you mean model.toml?"),
    (["campaign", "from", "bench/te_1.cvs", "--reducer", "RV20E-121"], "there is no such file; did you mean bench/te_1.csv?"),
])  # fmt: skip
def test_mistyped_names_are_told_before_any_work(capsys, tmp_path, monkeypatch, arguments, text):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "bench").mkdir()
    for name in ("bench/te_1.csv", "model.toml", "life.nc"):
        (tmp_path / name).touch()
    code, out, err = said(capsys, *arguments)
    assert code == 2 and out == "" and text in err and "comparing" not in err and "diagnosing" not in err


def test_quiet_says_nothing_but_json_and_errors(capsys, tmp_path):
    assert said(capsys, "solve", "--positions", "8", "--quiet") == (0, "", "")
    assert json.loads(said(capsys, "solve", "--positions", "8", "-q", "--json")[1])["positions"] == 8
    code, out, err = said(capsys, "campaign", "check", str(tmp_path / "none"), "--quiet")
    assert code == 2 and out == "" and "none" in err


def test_quiet_says_each_file_that_was_written_on_a_line_of_its_own(capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert said(capsys, "solve", "--positions", "8", "--export", "a.csv", "--quiet") == (0, "a.csv\na_figures.csv\n", "")
    assert said(capsys, "reducer", "new", "--ratio", "81", "--pins", "40", "--rated", "412", "--name", "mine", "--html", "mine.html", "-q") == (
        0, "mine.toml\nmine.html\n", "")  # fmt: skip
    assert said(capsys, "reducer", "check", "mine.toml", "--html", "b.html", "-q") == (0, "b.html\n", "")
    assert said(capsys, "schema", "reducer", "--output", "c.json", "-q") == (0, "c.json\n", "")
    assert said(capsys, "run", "--reducer", "RV20E-121-rigid", "--turns", "0.02", "--output", "d.nc", "-q") == (0, "d.nc\n", "")


def test_an_effect_is_numbered_only_where_the_audit_has_it(capsys):
    numbered, own = (next(e for e in entries() if bool(e.effect.number) == has) for has in (True, False))
    show_one(numbered, [], "RV20E-121")
    assert f"{numbered.name}, number {numbered.number} of the physics audit" in " ".join(capsys.readouterr().out.split())
    show_one(own, [], "RV20E-121")
    said = " ".join(capsys.readouterr().out.split())
    assert f"{own.name}, acts in the" in said and "audit" not in said.partition("acts in")[0]


def test_an_effect_that_shows_nothing_says_so_and_asks_for_its_size(capsys):
    effect = Effect(0, "own", "law", "source", "signature", (amplitude("own_turn", "rad", "turning", 5e-6, -1e-2, 1e-2),))
    own = Entry("own", effect, "plant", cases("own", effect))
    still, moved = (Signature("own", own.cases[0], (Row("lost motion", "arcsec", "rated", 40.0, 40.0 + change),)) for change in (0.0, 5.0))
    show_one(own, [still], "RV20E-121")
    said = " ".join(capsys.readouterr().out.split())
    assert "at its usual size 5e-06 rad nothing changes that could be seen here; is the usual size too small, or does it act on another part?" in said
    assert "not listed" not in said and "without" not in said
    show_one(own, [still, moved], "RV20E-121")
    said = " ".join(capsys.readouterr().out.split())
    assert "Those that are not listed do not change" in said and "lost motion" in said


def test_a_slope_that_is_not_positive_is_no_stiffness(capsys):
    """395 -> -1.2e+03 N m/arcmin stood there."""
    effect = Effect(0, "own", "law", "source", "signature", (amplitude("own_turn", "rad", "turning", 5e-6, -1e-2, 1e-2),))
    own = Entry("own", effect, "plant", cases("own", effect))
    found = Signature("own", own.cases[0], (Row("stiffness", "N m/arcmin", "rated", 395.0, -1200.0), Row("lost motion", "arcsec", "rated", 40.0, -45.0)))
    show_one(own, [found], "RV20E-121")
    said = capsys.readouterr().out
    assert "395 │ none: the curve turns back" in said and "-1.2e+03" not in said and "-45" in said
    assert words(found)[0] == "stiffness (rated) 395 N m/arcmin -> none: the curve turns back"


def test_a_word_finds_the_effects_in_which_it_stands(capsys):
    _, out, _ = said(capsys, "effects", "friction", "--json")
    names = {effect["name"] for effect in json.loads(out)["effects"]}
    assert {"stribeck_friction", "drive_friction", "support_hysteresis"} <= names and "thermal_expansion" not in names
    shown = said(capsys, "effects", "friction")[1]
    assert "effects in which 'friction' stands" in shown


@pytest.mark.parametrize("arguments", [["effects"], ["modes"], ["reducer", "new", "--ratio", "81", "--pins", "40", "--rated", "1600", "--output", "FILE"]])
def test_tables_fit_a_hundred_columns(capsys, arguments, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, _ = said(capsys, *[word.replace("FILE", str(tmp_path / "a.toml")) for word in arguments])
    longest = max((line for line in out.splitlines() if str(tmp_path) not in line), key=len)
    assert code == 0 and len(longest) <= WIDTH == 100, longest


def test_a_sound_installation(capsys):
    code, out, _ = said(capsys, "doctor", "--json")
    found = {finding["what"]: finding for finding in json.loads(out)["findings"]}
    assert {"rvwear", "Python", "packages", "C compiler", "cache", "kernels", "[measurements]", "[pictures]", "[rivals]"} <= found.keys()
    assert all(finding["remedy"] for finding in found.values() if finding["state"] != "ok")
    assert code == any(finding["state"] == "wrong" for finding in found.values())


def test_what_is_missing_or_too_old_is_named(monkeypatch, tmp_path, capsys):
    monkeypatch.setattr(doctor, "requirements", lambda: {"": ["numpy>=99", "no-such-package>=1"], "pictures": ["no-such-part"], "test": ["x"]})
    needed, pictures = doctor.packages()
    assert needed.state == doctor.WRONG and "is older than 99" in needed.text and "no-such-package is not installed" in needed.text
    assert pictures.state == doctor.ABSENT and pictures.remedy.endswith('pip install "rvwear[pictures]"')
    monkeypatch.setenv("RVWEAR_EFFECTS", str(tmp_path / "nowhere"))
    (own,) = doctor.own_effects()
    assert own.state == doctor.WRONG and "is no folder" in own.text
    show([needed, pictures, own])
    assert "2 wrong, 1 optional and absent\n" in capsys.readouterr().out
    monkeypatch.setenv("CC", "no-such-compiler")
    monkeypatch.setenv("PATH", str(tmp_path))
    (found,) = doctor.compiler()
    assert found.state in (doctor.ABSENT, doctor.GOOD) and (found.remedy or found.state == doctor.GOOD)


def test_doctor_folds_its_lines_and_leaves_a_command_to_be_copied_whole(capsys):
    """They went on to 153 columns."""
    command = f"/a/place/that/is/{'deep/' * 6}bin/python -m pip install \"rvwear[ensembles]\""
    text = "lives of many reducers on all cores or a cluster (rvwear ensemble): dask is not installed, distributed is not installed"
    found = [doctor.Finding("room for temporary files", doctor.GOOD, "67 GB"), doctor.Finding("[ensembles]", doctor.ABSENT, text, command),
             doctor.Finding("C compiler", doctor.ABSENT, text, f"{text}; {text}")]  # fmt: skip
    show(found)
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= WIDTH and f"  {command}" in lines
    assert " ".join(" ".join(lines).split()).count(text) == 4


def test_help_of_every_command_fits_the_screen(monkeypatch):
    """The tests of ``bench`` stood in one word of 117 columns."""
    import argparse

    from cli.main import parser

    def commands(one):
        inner = [action for action in one._actions if isinstance(action, argparse._SubParsersAction)]
        return [one, *(further for action in inner for command in action.choices.values() for further in commands(command))]

    monkeypatch.setenv("COLUMNS", "100")
    found = commands(parser())
    assert len(found) > 30 and not [line for command in found for line in command.format_help().splitlines() if len(line) > WIDTH]
