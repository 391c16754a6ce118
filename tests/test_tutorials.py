"""The tutorials are run as a reader would: files are written, commands typed, what they print is what the page says.

``...`` in a page stands for anything; other words stand in the output in this order.  Commands that need nothing but rvwear run in this process.
"""

import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from cli.main import main, parser
from cli.parser import chosen_commands

ROOT = Path(__file__).resolve().parents[1]
TUTORIALS = ROOT / "docs" / "tutorials"
BLOCK = re.compile(r"^(?P<before>[^\n]*)\n+```(?P<kind>\w+)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
NAME = re.compile(r"`([\w./-]+\.\w+)`:$")
# Those that run in the default tests take some seconds of one core; the others build units, live or diagnose.
SHORT = ("your_reducer",)
LONG = ("fmi_tool", "two_files", "your_effect", "robot_week", "five_lines", "paper_figure", "hidden")


@dataclass
class Block:
    kind: str
    text: str
    file: str | None


def blocks_of(page):
    for found in BLOCK.finditer(page.read_text(encoding="utf-8")):
        name = NAME.search(found["before"].strip())
        yield Block(found["kind"], found["text"], name[1] if name and found["kind"] != "console" else None)


def commands_of(text):
    """(command, what it should print) of a console block."""
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, printed = part.partition("\n")
        yield command, printed


def plain(text):
    """Words alone: tables have their lines, and fold where the screen ends."""
    return " ".join(re.sub(r"[│┃━─┏┓┡┩└┘┴┼╇┳┬┻╈]", " ", text).split())


def holds(printed, wanted):
    """Whether the output has the pieces between the dots in order."""
    place, output = 0, plain(printed)
    for piece in (plain(piece) for piece in wanted.split("...")):
        found = output.find(piece, place)
        if found < 0:
            return piece
        place = found + len(piece)
    return ""


def run(command, monkeypatch):
    """(exit code, output) of a line as a shell would run it."""
    words = shlex.split(command)
    if words[0] == "rvwear":
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
            code = main(words[1:])
        return code, out.getvalue()
    bin_folder = Path("bin")
    bin_folder.mkdir(exist_ok=True)
    for name, start in (("rvwear", f'"{sys.executable}" -m cli.main'), ("python", f'"{sys.executable}"')):
        (bin_folder / name).write_text(f'#!/bin/sh\nexec {start} "$@"\n', encoding="utf-8")
        (bin_folder / name).chmod(0o755)
    environment = os.environ | {"PATH": f"{bin_folder.resolve()}{os.pathsep}{os.environ['PATH']}", "PYTHONPATH": str(ROOT)}
    done = subprocess.run(command, shell=True, capture_output=True, text=True, env=environment)  # noqa: S602
    return done.returncode, done.stdout or done.stderr


def prepared(name, folder):
    """What a page says is there and does not show."""
    if name == "your_reducer":
        text = (TUTORIALS / "files" / "mine.toml").read_text(encoding="utf-8")
        (folder / "undercut.toml").write_text(text.replace("value = 2.5, unit", "value = 5.5, unit"), encoding="utf-8")


FAILS = ("reducer check undercut.toml",)


@pytest.mark.parametrize("name", [*SHORT, *(pytest.param(name, marks=pytest.mark.campaign) for name in LONG)])
def test_a_tutorial_does_what_it_says(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    prepared(name, tmp_path)
    typed = 0
    for block in blocks_of(TUTORIALS / f"{name}.md"):
        if block.file is not None:
            Path(block.file).parent.mkdir(parents=True, exist_ok=True)
            Path(block.file).write_text(block.text, encoding="utf-8")
        elif block.kind == "python":
            exec(compile(block.text, name, "exec"), {})
            typed += 1
        elif block.kind == "console":
            for command, wanted in commands_of(block.text):
                code, printed = run(command, monkeypatch)
                typed += 1
                assert code == (2 if command.endswith(FAILS) else 0), f"{command}: {printed[-2000:]}"
                lost = holds(printed, wanted)
                assert not lost, f"{command} does not print {lost!r}:\n{printed[-4000:]}"
    assert typed >= 2


def test_the_file_of_a_tutorial_is_the_one_it_shows():
    (shown,) = (block.text for block in blocks_of(TUTORIALS / "your_reducer.md") if block.file == "mine.toml")
    assert shown == (TUTORIALS / "files" / "mine.toml").read_text(encoding="utf-8")


def test_the_notebook_is_that_of_the_page():
    """In Jupytext's percent format; its cells are the lines of the page."""
    notebook = (TUTORIALS / "files" / "five_lines.py").read_text(encoding="utf-8")
    assert notebook.startswith("# ---\n# jupyter:") and notebook.count("# %%") == 6
    compile(notebook, "five_lines.py", "exec")
    first = next(block.text for block in blocks_of(TUTORIALS / "five_lines.md") if block.kind == "python")
    assert all(line in notebook for line in first.splitlines() if line)


def test_every_page_of_a_tutorial_is_tried():
    assert {path.stem for path in TUTORIALS.glob("*.md")} == {*SHORT, *LONG, "cannot_say"}


# Placeholders of usage lines, and lines that show how something would be written.
LOOSE = re.compile(r"\.\.\.|\b[A-Z_]{4,}\b|\[|\bDIR\b|\||<|, ")


def documented_commands():
    pages = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md"), *(ROOT / "examples").rglob("*.md")]
    for page in pages:
        text = page.read_text(encoding="utf-8")
        for block in re.findall(r"```(?:sh|console|)\n(.*?)```", text, re.DOTALL):
            for line in block.replace("\\\n", " ").splitlines():
                line = line.removeprefix("$ ").split("   ")[0].strip()
                # Of a command alone only the name is shown.
                if line.startswith("rvwear ") and len(line.split()) > 3 and not LOOSE.search(line):
                    yield f"{page.relative_to(ROOT)}: {line}"


def test_commands_of_all_pages_are_commands():
    """Every option and word that a page shows is one that there is."""
    top, shown = parser(), sorted(set(documented_commands()))
    assert len(shown) > 30
    wrong = []
    for entry in shown:
        words = shlex.split(entry.partition(": ")[2], comments=True)[1:]
        said = io.StringIO()
        try:
            with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
                options = top.parsed(words)
            assert chosen_commands(top, options)
        except SystemExit as end:
            if end.code:
                wrong.append(f"{entry}: {said.getvalue().strip()}")
    assert not wrong, "\n".join(wrong)
