"""Random legal and illegal calls on the C shell, under the address and undefined-behaviour sanitizers.

    .venv/bin/python benchmarks/fuzz.py [--seconds 60] [--unit rv_plant] [--libfuzzer]

Ends with the counts of calls, or with the sanitizer's report and exit code 1.  The random
driver needs gcc or clang with its sanitizers, ``--libfuzzer`` needs clang.
"""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

from fmu_src.link import FMI_HEADERS, SHELL
from fmu_src.native import object_code
from fmu_src.unit import make_unit
from fmu_src.unit_table import c_source
from reducers.reducer import load_reducer

DRIVER = Path(__file__).with_name("fuzz_shell.c")


def build(unit: str, folder: Path, libfuzzer: bool = False, code: bytes | None = None) -> Path:
    """The fuzzer of one unit, shell and driver instrumented; the kernels' object code as it is shipped."""
    specification = load_reducer("RV20E-121").specification(unit)
    (folder / "unit.o").write_bytes(code or object_code(specification))
    (folder / "unit_table.c").write_text(c_source(make_unit(specification), "{fuzz}"))
    compiler = ["clang", "-DLIBFUZZER", "-fsanitize=fuzzer,address,undefined"] if libfuzzer else ["cc", "-fsanitize=address,undefined"]
    sources = [*map(str, sorted(SHELL.glob("*.c"))), str(folder / "unit_table.c"), str(DRIVER), str(folder / "unit.o")]
    subprocess.run(
        [*compiler, "-std=c99", "-g", "-O1", "-fno-sanitize-recover=all", f"-I{SHELL}", f"-I{FMI_HEADERS}", *sources,
         "-o", str(folder / "fuzz"), "-lm"],
        check=True,
    )  # fmt: skip
    return folder / "fuzz"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--unit", choices=("rv_plant", "wear_fmu"), default="rv_plant")
    parser.add_argument("--libfuzzer", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        fuzzer = build(options.unit, Path(temporary), options.libfuzzer)
        if options.libfuzzer:
            arguments = [f"-max_total_time={options.seconds}", "-max_len=16384", "-print_final_stats=1", "-timeout=120"]
        else:
            arguments = [str(options.seconds), str(options.seed)]
        return subprocess.run([str(fuzzer), *arguments], cwd=temporary).returncode


if __name__ == "__main__":
    sys.exit(main())
