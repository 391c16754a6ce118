"""What the tests reach: lines and branches per folder, and what they do not reach, by name.

    python3 build.py test --coverage [further arguments go to pytest] [--write]

Runs the tests under coverage.py, then those of KERNELS with the kernels as plain Python: machine code is not seen.
``--write`` puts the tables into docs/coverage.md.
"""

import json
import os
import shutil
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
FOLDER, PAGE = ROOT / "results" / "coverage", ROOT / "docs" / "coverage.md"
# Tests of single kernels that plain Python does within seconds; tests/test_plain_python.py runs whole units so.
KERNELS = ("assembly", "contact", "damping", "gear_stage", "needle_bearing", "surfaces", "wear_kinematics", "wear_laws")
# Why something is not reached, by the beginning of its path (the longest one that fits).
REASONS = {
    "rv_plant": "kernels run as machine code, which is not seen; counted are runs of whole units and of single kernels as plain Python",
    "wear_fmu": "as rv_plant",
    "rv_reducer": "as rv_plant: the tests of the unit of both run it as machine code",
    "studies/coupled.py": "as rv_plant: loops of coupled units, run as machine code",
    "fmu_src/slaves": "runs inside of editable FMUs, whose Python is embedded: coverage does not see it",
    "fmu_src/wasm": "the WebAssembly units are run by the tests marked platforms",
    "workbench": "its whole loop is gone through in Chromium by the tests marked campaign; the default ones drive its parts and the first views",
    "reproduce": "the claims that need a life of 10,000 h are run by the tests marked campaign",
}
HEAD = """# What the tests reach

Made by `python3 build.py test --coverage --write` (tests/measure_coverage.py); do not edit. Measured is the default run,
without the tests behind markers, by [coverage.py](https://coverage.readthedocs.io), processes that the tests start included.
C code (`fmu_src/shell/`) is run by the tests of native FMUs, some under sanitizers, and is not measured.
"""


def run(arguments: list[str]) -> int:
    """The tests under coverage; the exit code of pytest."""
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    environment = {**os.environ, "COVERAGE_FILE": str(FOLDER / ".coverage")}
    measured = [sys.executable, "-m", "coverage", "run", "-m", "pytest"]
    code = subprocess.run([*measured, *arguments], cwd=ROOT, env=environment).returncode
    plain = {**environment, "RVWEAR_PLAIN_PYTHON": "1"}
    # What they find is found by the first run too: some tests ask for the compiler itself.
    subprocess.run([*measured, *(f"tests/test_{name}.py" for name in KERNELS)], cwd=ROOT, env=plain, stdout=subprocess.DEVNULL)
    subprocess.run([sys.executable, "-m", "coverage", "combine", "--quiet"], cwd=ROOT, env=environment, check=True)
    report = [sys.executable, "-m", "coverage", "json", "--quiet", "-o", str(FOLDER / "coverage.json")]
    subprocess.run(report, cwd=ROOT, env=environment, check=True)
    return code


def files() -> dict[str, dict]:
    """coverage.py's findings by file."""
    found = json.loads((FOLDER / "coverage.json").read_text(encoding="utf-8"))["files"]
    return {path.replace("\\", "/"): file for path, file in sorted(found.items())}


def share(part: int, whole: int) -> str:
    return f"{100.0 * part / whole:.1f} %" if whole else "-"


def row(name: str, summaries: list[dict]) -> str:
    lines, missing, branches, reached = (
        sum(s[key] for s in summaries) for key in ("num_statements", "missing_lines", "num_branches", "covered_branches")
    )
    return f"| {name} | {lines} | {share(lines - missing, lines)} | {branches} | {share(reached, branches)} |"


def table(found: dict[str, dict]) -> list[str]:
    """Lines and branches per folder."""
    folders = defaultdict(list)
    for path, file in found.items():
        folders[path.rpartition("/")[0]].append(file["summary"])
    rows = [row(f"`{folder}/`", summaries) for folder, summaries in sorted(folders.items())]
    whole = row("**all**", [summary for summaries in folders.values() for summary in summaries])
    return ["| folder | lines | reached | branches | reached |", "|---|---|---|---|---|", *rows, whole]


def gaps(file: dict) -> tuple[list[str], int, int]:
    """(functions never entered, lines not reached elsewhere, branches not taken elsewhere)"""
    never, lines, branches = [], 0, 0
    for name, part in file["functions"].items():
        summary = part["summary"]
        if name and summary["num_statements"] and not part["executed_lines"]:
            never.append(name)
        else:
            lines += summary["missing_lines"]
            branches += summary["num_branches"] - summary["covered_branches"]
    return never, lines, branches


def named(found: dict[str, dict]) -> list[str]:
    """What is not reached, file by file, with the reason where there is one."""
    said = []
    for path, file in found.items():
        never, lines, branches = gaps(file)
        if not (never or lines or branches):
            continue
        text = f"- `{path}`: {lines} lines, {branches} branches"
        if never:
            text += f"; never entered: {', '.join(f'`{name}`' for name in never)}"
        said.append(text)
    return said


def reasons(found: dict[str, dict]) -> list[str]:
    return [f"- `{place}`: {why}" for place, why in REASONS.items() if any(path.startswith(place) for path in found)]


def main(arguments: list[str]) -> int:
    code = run([argument for argument in arguments if argument != "--write"])
    found = files()
    lines = [*table(found), "", "## Why some of it is not", "", *reasons(found), "", "## What is not reached", "", *named(found)]
    print("\n".join(lines))
    if "--write" in arguments:
        PAGE.write_text("\n".join([HEAD, *lines, ""]), encoding="utf-8")
    return code


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
