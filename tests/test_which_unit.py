"""Nobody said which of twelve files of three names to take."""

from pathlib import Path

import pytest

from cli.main import main
from studies import building
from studies.which_unit import PACKAGE, PLANT, UNIT, WEAR, which_to_take

DIST = Path("dist")


def built(*folders):
    return [folder / name for folder in folders for name in (UNIT, PLANT, WEAR, PACKAGE)]


def test_the_unit_of_both_is_named_first_in_its_newest_form():
    whole, apart = which_to_take(DIST, built(DIST, DIST / "fmi2", DIST / "fmi3"))
    assert whole.startswith("to take: dist/fmi3/RvReducer.fmu for tools of FMI 3.0; dist/fmi2/RvReducer.fmu for tools of FMI 2.0; dist/RvReducer.fmu for Python")
    assert apart.startswith("RvPlant.fmu, RvWear.fmu, RvReducer.ssp beside it")


@pytest.mark.parametrize("folders", [(), (DIST / "fmi3",)])
def test_nothing_is_said_where_there_is_no_choice(folders):
    assert which_to_take(DIST, built(*folders)) == []


def test_the_command_says_it_below_its_files(monkeypatch, capsys):
    files = built(DIST, DIST / "fmi2")
    units = [{"fmu": str(path), "flavour": "native", "bytes": 1e6, "built": True} for path in files if path.suffix == ".fmu"]
    monkeypatch.setattr(building, "build_units", lambda *given: (units, [path for path in files if path.suffix == ".ssp"]))
    assert main(["build"]) == 0
    assert "to take: dist/fmi2/RvReducer.fmu for tools of FMI 2.0; dist/RvReducer.fmu for Python" in capsys.readouterr().out
    # A script asks for paths alone.
    assert main(["build", "-q"]) == 0
    assert all(line.endswith((".fmu", ".ssp")) for line in capsys.readouterr().out.splitlines())
