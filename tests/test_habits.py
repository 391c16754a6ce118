"""Rules that hold over the tree: style and likely faults (ruff), types (mypy, strict), the review of scientific Python projects."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_src.cache_folder import cache_folder

ROOT = Path(__file__).resolve().parents[1]

pytestmark = pytest.mark.skipif(not (ROOT / "docs").is_dir(), reason="a checkout is looked at")


def run(*command: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([sys.executable, "-m", *command], cwd=ROOT, capture_output=True, text=True)


def test_ruff_finds_nothing():
    done = run("ruff", "check", "--no-cache", "--output-format", "concise", ".")
    assert done.returncode == 0, done.stdout + done.stderr


def test_types_fit_everywhere():
    # Forty seconds of CPU from nothing; with what another checkout of this machine left there one.
    done = run("mypy", "--no-error-summary", "--cache-dir", str(cache_folder("types")))
    assert done.returncode == 0, done.stdout + done.stderr


def test_review_rules_hold_or_are_excepted_with_a_reason():
    done = run("repo_review", ".", "--format", "json")
    failed = {name: check["description"] for name, check in json.loads(done.stdout)["checks"].items() if check["result"] is False}
    assert not failed


def test_what_each_file_takes_is_added_up():
    from types import SimpleNamespace as Made

    from conftest import pytest_terminal_summary

    reports = [Made(nodeid=f"tests/test_{name}.py::x", user_properties=[("cpu", seconds)]) for name, seconds in (("a", 1.5), ("b", 3.0), ("a", 2.0), ("c", 0.1))]
    told = []
    reporter = Made(stats={"passed": reports[:2], "": reports[2:], "warnings": [Made()]}, section=told.append, write_line=told.append)
    pytest_terminal_summary(reporter, Made(getoption=lambda name: name == "cpu"))
    assert told == ["7 s of CPU", "    3.5 s  tests/test_a.py", "    3.0 s  tests/test_b.py"]
