"""The C shell when memory runs out: every allocation of a unit's life fails once."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from fmu_src.link import FMI_HEADERS
from fmu_src.native import object_code
from fmu_src.unit import make_unit
from fmu_src.unit_table import c_source

ROOT = Path(__file__).resolve().parents[1]
SHELL = ROOT / "fmu_src" / "shell"


@pytest.mark.skipif(shutil.which("cc") is None or not sys.platform.startswith("linux"), reason="a C compiler and a linker that wraps functions")
@pytest.mark.parametrize("unit", ["rv_plant", "wear_fmu", "rv_reducer"])
def test_every_allocation_may_fail(rv20e, tmp_path, unit):
    specification = rv20e.specification(unit)
    (tmp_path / "unit.o").write_bytes(object_code(specification))
    (tmp_path / "unit_table.c").write_text(c_source(make_unit(specification), "{failing}"), encoding="utf-8")
    sources = [*sorted(path for path in SHELL.glob("*.c") if "fmi3" not in path.name), tmp_path / "unit_table.c", ROOT / "tests" / "failing_memory.c", tmp_path / "unit.o"]
    command = ["cc", "-std=c99", "-g", "-O0", "-fsanitize=address,undefined", "-fno-sanitize-recover=all", '-DGUID="{failing}"', f"-I{SHELL}", f"-I{FMI_HEADERS}",
               "-Wl,--wrap=malloc,--wrap=calloc", *map(str, sources), "-o", str(tmp_path / "failing"), "-lm"]  # fmt: skip
    built = subprocess.run(command, capture_output=True, text=True)
    if "sanitize" in built.stderr or "asan" in built.stderr:
        pytest.skip("the C compiler has no sanitizers")
    assert built.returncode == 0, built.stderr[-3000:]
    done = subprocess.run([tmp_path / "failing"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
    allocations, refusals = map(int, re.findall(r"\d+", done.stdout))
    assert allocations > 4 and refusals == allocations
