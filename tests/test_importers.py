"""The benchmark of other people's importers: what is missing is said with the remedy, digits are counted, the page stands without any tool."""

from math import inf
from pathlib import Path

import numpy as np
import pytest

from benchmarks.importers import pair, single
from benchmarks.importers.__main__ import main, page
from benchmarks.importers.cases import Bench, Outcome, agreeing_digits, ends_of
from benchmarks.importers.doubling import Doubling, growth
from benchmarks.importers.tools import PROGRAMS, ToolFault, Tools, run
from orchestrator.experiments import Carried

ROOT = Path(__file__).resolve().parents[1]


def test_digits_are_those_of_the_worst_variable():
    assert agreeing_digits({"a": 1.0, "b": 2.0}, {"a": 1.0, "b": 2.0}) == inf
    assert agreeing_digits({"a": 1.0 + 3e-7, "b": 2.0}, {"a": 1.0, "b": 2.0}) == 6.0
    assert agreeing_digits({"a": 5.0}, {"a": 1.0}) == 0.0
    assert agreeing_digits({"a": 2e-9}, {"a": 1e-9}, {"a": 1.0}) == 9.0
    carried = Carried("a", 1.0, 0.5, 1e-6, [], {}, {"time": np.zeros(3), "x": np.array([1.0, -4.0, 2.0])})
    assert ends_of(carried) == ({"x": 2.0}, {"x": 4.0})


def test_exponent_of_the_steps():
    runs = [Doubling(t, round(10.0 * t**-0.5), 1, 1.0) for t in (1e-2, 1e-4, 1e-6)]
    assert growth(runs) == pytest.approx(0.5, abs=0.01)
    assert growth([*runs[:2], Doubling(1e-6, 0, 0, 0.0, "ended after 240 s")]) is None


def test_programs_are_found_by_option_and_environment(tmp_path, monkeypatch):
    program = tmp_path / "fmusim"
    program.write_text("#!/bin/sh\n")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path / "none"))
    assert Tools().path("fmusim") is None
    monkeypatch.setenv("RVWEAR_FMUSIM", str(program))
    assert Tools().path("fmusim") == program
    assert Tools.of([f"mastersim={program}"]).path("mastersim") == program


@pytest.mark.parametrize("option, said", [
    ("fmusim", "--tool fmusim: write NAME=PATH, NAME one of fmusim, mastersim"), ("dymola=/bin/true", "--tool dymola=/bin/true: write NAME=PATH"),
    ("fmusim=/no/such", "--tool fmusim=/no/such: /no/such is no program"), ("fmusim=/tmp", "/tmp is no program"),
])
def test_wrong_tools_are_told(option, said, capsys):
    assert main(["--tool", option]) == 2
    assert said in capsys.readouterr().err


@pytest.mark.parametrize("name", PROGRAMS)
def test_missing_tool_is_told_with_where_it_comes_from(name):
    said = Tools().missing(name)
    assert PROGRAMS[name][1] in said and f"--tool {name}=PATH or RVWEAR_{name.upper()}=PATH" in said
    assert Tools().missing("ecos") == "not installed: pip install ecospy"


def test_failed_program_says_its_first_errors(tmp_path):
    with pytest.raises(ToolFault, match=r"exit code 3: error: no such connector$"):
        run(["sh", "-c", "echo 'error:  no such connector'; echo later; exit 3"], tmp_path)
    with pytest.raises(ToolFault, match="ended after 0.2 s"):
        run(["sleep", "5"], tmp_path, 0.2)


def test_page_without_any_program(monkeypatch, tmp_path):
    monkeypatch.setattr(Tools, "path", lambda tools, name: None)
    monkeypatch.setattr(pair, "package_version", lambda name: None)
    monkeypatch.setattr(pair.shutil, "which", lambda name: None)
    monkeypatch.setattr(single, "through_fmpy", lambda bench, version: [Outcome("fmpy", "1", f"FMI {version}.0", "unit", 3, inf)])
    bench = Bench(tmp_path, tmp_path)
    found = [*single.outcomes(bench, Tools()), *pair.outcomes(bench, Tools())]
    text = page(found, [Doubling(t, n, 1, 0.5) for t, n in ((1e-2, 10), (1e-4, 100), (1e-6, 1000))])
    assert "| fmpy | 1 | FMI 2.0 | unit | 3 | all digits |" in text and "pip install libcosimpy" in text
    assert all(where in text for _, where in PROGRAMS.values()) and "to the power of 0.50" in text


def test_the_page_is_of_this_table():
    kept = (ROOT / "docs" / "importers.md").read_text(encoding="utf-8")
    for tool in ("fmusim", "MasterSim", "OMSimulator", "OpenMCx", "ecos", "libcosim", "fmpy", "examples/pair_master.c"):
        assert f"| {tool}" in kept
    assert "## Step doubling" in kept
