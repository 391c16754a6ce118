"""``rvwear example``: a copy with its data, over nothing that is there."""

import json

import pytest

from cli.commands.example import EXAMPLES, shipped
from cli.main import main
from reducers.library import LIBRARY


@pytest.fixture(autouse=True)
def in_an_empty_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def test_examples_are_listed_with_a_line_each(capsys):
    assert main(["example"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(EXAMPLES)
    assert all(len(line) < 120 for line in lines)
    assert main(["example", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["examples"] == EXAMPLES


@pytest.mark.parametrize("name, entry", [("hidden_effect", "hidden_effect"), ("pair", "pair.toml"), ("load_fmu.c", "load_fmu.c")])
def test_an_example_is_copied_with_its_data(tmp_path, name, entry):
    assert main(["example", name]) == 0
    source, target = shipped() / entry, tmp_path / "examples" / entry
    files = [source] if source.is_file() else [p for p in source.rglob("*") if p.is_file() and p.suffix != ".pyc"]
    assert files
    assert all((target / path.relative_to(source)).read_bytes() == path.read_bytes() for path in files)


def test_nothing_is_overwritten(tmp_path, capsys):
    (tmp_path / "examples" / "pair.toml").mkdir(parents=True)
    assert main(["example", "pair"]) == 2
    assert "not overwritten" in capsys.readouterr().err
    assert main(["example", "ensemble"]) == 0


def test_an_unknown_example_is_refused(tmp_path, capsys):
    assert main(["example", "pear"]) == 2
    assert "give one of browser, catalogue_stiffness" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("command", ["solve --reducer reducer.toml --positions 8", "life --duty duty.toml --hours 1 --positions 8 --no-report"])
def test_files_of_windows_editors_are_read(tmp_path, command):
    """They begin with a byte order mark and end their lines in their own way."""
    sources = {"reducer.toml": LIBRARY / "BX-40E.toml", "duty.toml": shipped() / "move_and_return.toml"}
    for name, source in sources.items():
        lines = source.read_text(encoding="utf-8").splitlines()
        (tmp_path / name).write_bytes("\r\n".join(lines).encode("utf-8-sig"))
    assert main(command.split()) == 0
