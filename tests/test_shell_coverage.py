"""The C shell: every line, branch and condition of its code is decided each way by calls whose status and words are known."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
import shell_unit

from fmu_src.link import FMI_HEADERS, SHELL
from fmu_src.unit_table import c_source

HERE = Path(__file__).parent / "shell"
UNITS = ("Whole", "Bare")
WRAPPED = ["-Wl,--wrap=malloc,--wrap=calloc"]
pytestmark = pytest.mark.skipif(shutil.which("cc") is None or not sys.platform.startswith("linux"), reason="a C compiler and a linker that wraps functions")


def built(folder, name, compiler, *flags):
    """The calls on the unit of the name, as a program."""
    unit = shell_unit.unit(name)
    folder.mkdir(exist_ok=True)
    (folder / "unit_table.c").write_text(c_source(unit, "{a unit without physics}"), encoding="utf-8")
    (folder / "places.h").write_text(shell_unit.places(unit.table), encoding="utf-8")
    sources = [*sorted(SHELL.glob("*.c")), folder / "unit_table.c", *sorted(HERE.glob("*.c"))]
    command = [*compiler, "-std=c99", "-g", "-w", *flags, *WRAPPED, f"-I{SHELL}", f"-I{FMI_HEADERS}", f"-I{folder}", *map(str, sources), "-o", str(folder / name), "-lm"]
    done = subprocess.run(command, capture_output=True, text=True)
    if "sanitize" in done.stderr or "asan" in done.stderr:
        pytest.skip("the C compiler has no sanitizers")
    assert done.returncode == 0, done.stderr[-3000:]
    return folder / name


@pytest.mark.parametrize("name", UNITS)
def test_every_call_does_what_it_says(tmp_path, name):
    program = built(tmp_path, name, ["cc"], "-O0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    done = subprocess.run([program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    assert int(re.findall(r"\d+", done.stdout)[0]) > 200


def measuring_clang():
    """(clang, llvm-profdata, llvm-cov) of one version that measures conditions, 18 or newer; skips without."""
    for ending in ("", *(f"-{version}" for version in range(30, 17, -1))):
        tools = [shutil.which(f"{name}{ending}") for name in ("clang", "llvm-profdata", "llvm-cov")]
        if all(tools):
            version = re.search(r"version (\d+)", subprocess.run([tools[0], "--version"], capture_output=True, text=True).stdout)
            if version and int(version[1]) >= 18:
                return tools
    pytest.skip("conditions of C are measured with clang and LLVM, 18 or newer (Debian: clang-19 llvm-19), which are not here")


def test_every_condition_of_the_shell_is_decided_each_way(tmp_path):
    clang, profdata, cov = measuring_clang()
    programs, profiles = [], []
    for name in UNITS:
        program = built(tmp_path / name, name, [clang], "-O0", "-fprofile-instr-generate", "-fcoverage-mapping", "-fcoverage-mcdc")
        programs.append(program)
        profiles.append(tmp_path / f"{name}.profraw")
        done = subprocess.run([program], capture_output=True, text=True, env={"LLVM_PROFILE_FILE": str(profiles[-1])})
        assert done.returncode == 0, done.stderr[-3000:]
    subprocess.run([profdata, "merge", "-o", tmp_path / "all", *profiles], check=True)
    objects = [part for program in programs[1:] for part in ("-object", str(program))]
    exported = subprocess.run([cov, "export", str(programs[0]), *objects, f"-instr-profile={tmp_path / 'all'}", *map(str, sorted(SHELL.glob("*.[ch]")))],
                              check=True, capture_output=True, text=True)  # fmt: skip
    data = json.loads(exported.stdout)["data"][0]
    missing = []
    for file in data["files"]:
        name = Path(file["filename"]).name
        missing += [f"{name}:{line}:{column}: never {'true' if yes == 0 else 'false'}" for line, column, _, _, yes, no, *_ in file["branches"] if yes == 0 or no == 0]
        # Last: which conditions of the decision were shown to decide it alone.
        missing += [f"{name}:{record[0]}:{record[1]}: condition {n + 1} decides nothing" for record in file["mcdc_records"] for n, shown in enumerate(record[-1]) if not shown]
        missing += [f"{name}: {summary['covered']} of {summary['count']} {kind}" for kind, summary in file["summary"].items() if summary["covered"] != summary["count"]]
    totals = data["totals"]
    print(", ".join(f"{kind} {summary['covered']} of {summary['count']}" for kind, summary in totals.items()))
    assert not missing, "\n".join(missing)
    assert totals["mcdc"]["count"] > 100 < totals["branches"]["count"]
