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
UNITS = ("rv_plant", "wear_fmu", "rv_reducer")
COMPILER = {False: ["cc", "-fsanitize=address,undefined"], True: ["clang", "-DLIBFUZZER", "-fsanitize=fuzzer,address,undefined"]}


def objects(folder: Path, libfuzzer: bool = False) -> list[str]:
    """Shell and driver, instrumented, the same for every unit; made once in the folder."""
    compiler = COMPILER[libfuzzer]
    sources = [*sorted(SHELL.glob("*.c")), DRIVER]
    made = [str(folder / f"{source.stem}.o") for source in sources]
    if not all(Path(path).exists() for path in made):
        flags = ("-std=c99", "-g", "-O1", "-fno-sanitize-recover=all", f"-I{SHELL}", f"-I{FMI_HEADERS}", "-c")
        subprocess.run([*compiler, *flags, *map(str, sources)], check=True, cwd=folder)
    return made


def build(unit: str, folder: Path, libfuzzer: bool = False, code: bytes | None = None) -> Path:
    """The fuzzer of one unit, shell and driver instrumented; the kernels' object code as it is shipped."""
    specification = load_reducer("RV20E-121").specification(unit)
    kernels, table, fuzzer = (folder / f"{unit}{ending}" for ending in (".unit.o", "_table.c", ".fuzz"))
    kernels.write_bytes(code or object_code(specification))
    table.write_text(c_source(make_unit(specification), "{fuzz}"))
    parts = [*objects(folder, libfuzzer), str(table), str(kernels)]
    subprocess.run([*COMPILER[libfuzzer], "-std=c99", "-fno-sanitize-recover=all", f"-I{SHELL}", *parts, "-o", str(fuzzer), "-lm"], check=True)
    return fuzzer


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--unit", choices=UNITS, default="rv_plant")
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
