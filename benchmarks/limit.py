"""Arithmetic and instructions of the plant's kernels, counted by valgrind, against the machine's peak.

The units' object code (plain x86-64, no newer instructions) runs under callgrind in a tiny C program;
counts repeat to the instruction.  Executed instructions are joined with their disassembly, which
tells arithmetic from the rest.  Of a run with N steps one with a single step is taken away, so that start and
initialisation do not count.  Linux with gcc, binutils and valgrind.
"""

import math
import re
import shutil
import subprocess
import tempfile
from collections import defaultdict
from dataclasses import dataclass
from pathlib import Path

from benchmarks.ratios import Figure, Measured, cost
from fmu_src.native import load_object, object_code
from reducers.reducer import Reducer, load_reducer
from rv_plant import plant

DRIVER = Path(__file__).with_name("count.c")
TOOLS = ("valgrind", "gcc", "objdump")
# Operations of one scalar instruction; packed ones work on two (or four) numbers, fused ones make two.
ARITHMETIC = re.compile(r"^v?(add|sub|mul|div|sqrt|min|max|fmadd\d*|fmsub\d*|fnmadd\d*|fnmsub\d*)(sd|pd)$")
KERNEL = re.compile(r"^rv_plant\.(.*)\.\d+$")
# Double-precision operations a cycle: one scalar unit adding or multiplying, and the widest of this machine.
WIDEST = {"avx512f": 32, "fma": 16, "avx": 8}


@dataclass(frozen=True)
class Count:
    """Of one step: instructions and double-precision operations, and both by kernel."""

    instructions: float
    operations: float
    assemblies: float
    by_kernel: dict[str, tuple[float, float]]


def available() -> bool:
    return all(shutil.which(tool) for tool in TOOLS)


def kernel_name(symbol: str) -> str:
    """``mesh.mesh_contacts`` of the compiler's ``rv_plant.mesh.mesh_contacts.47``; libm's names stay."""
    match = KERNEL.match(symbol)
    return match[1] if match else symbol


def operations_by_address(program: Path) -> dict[int, int]:
    text = subprocess.run(["objdump", "-d", "--no-show-raw-insn", str(program)], capture_output=True, text=True, check=True).stdout
    found = {}
    for line in text.splitlines():
        address, tab, instruction = line.partition(":\t")
        if not tab:
            continue
        words = instruction.split(None, 1)
        match = ARITHMETIC.match(words[0]) if words else None
        if match:
            width = 1 if match[2] == "sd" else 4 if "ymm" in instruction else 2
            found[int(address, 16)] = width * (2 if match[1].startswith("f") else 1)
    return found


def profile(program: Path, arguments: list[str], folder: Path) -> tuple[dict[str, tuple[int, int]], int]:
    """({function: (instructions, operations)}, what the program summed)."""
    output = folder / "callgrind.out"
    command = ["valgrind", "--tool=callgrind", "--dump-instr=yes", "--dump-line=no", "--compress-pos=no", "--compress-strings=no", "--demangle=no",
               f"--callgrind-out-file={output}", str(program), *arguments]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"the counted program failed: {done.stdout} {done.stderr[-500:]}")
    operations = operations_by_address(program)
    found: dict[str, list[int]] = defaultdict(lambda: [0, 0])
    function, is_call = "", False
    for line in output.read_text().splitlines():
        if line.startswith("fn="):
            function = kernel_name(line[3:].split("'")[0])
        elif line.startswith("calls="):
            # The next line has what the callee cost; that is counted there.
            is_call = True
        elif line.startswith("0x"):
            if not is_call:
                address, executed = line.split()
                found[function][0] += int(executed)
                found[function][1] += int(executed) * operations.get(int(address, 16), 0)
            is_call = False
    return {name: (a, b) for name, (a, b) in found.items()}, int(done.stdout.split()[1])


def count(reducer: Reducer, fidelity: int, code: bytes | None = None, steps: int = 72) -> Count:
    """Of one position of a turn (equilibrium) or one communication step of that length (motion)."""
    table = reducer.plant
    records = table.new_records()
    records["fidelity"], records["largest_crank_step"] = fidelity, 1.0
    crank_speed = abs(float(reducer.plant.by_name["input_speed"].start)) * reducer.topology.lobes / (1.0 + 3.0 * reducer.topology.pins)
    duration = repr(2.0 * math.pi / 72 / crank_speed)
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        (folder / "unit.o").write_bytes(code or object_code(reducer.specification("rv_plant")))
        (folder / "record").write_bytes(records.tobytes())
        program = folder / "counted"
        subprocess.run(["gcc", "-O1", "-static", "-no-pie", str(DRIVER), str(folder / "unit.o"), "-lm", "-o", str(program)], check=True)
        cell = str(table.offset["assemblies" if fidelity else "iterations"])
        one, few = profile(program, [str(folder / "record"), "1", duration, cell], folder)
        whole, many = profile(program, [str(folder / "record"), str(steps + 1), duration, cell], folder)
    away = {}
    for name, (instructions, operations) in whole.items():
        before = one.get(name, (0, 0))
        if instructions > before[0]:
            away[name] = ((instructions - before[0]) / steps, (operations - before[1]) / steps)
    # An equilibrium's first assembly is no iteration.
    assemblies = (many - few) / steps + (0 if fidelity else 1)
    return Count(sum(a for a, _ in away.values()), sum(b for _, b in away.values()), assemblies, away)


def peak() -> tuple[float, float]:
    """(scalar, widest) double-precision operations a second of one core, from its clock and its instructions."""
    info = Path("/proc/cpuinfo").read_text(encoding="ascii", errors="replace")
    clock, flags = re.search(r"cpu MHz\s*:\s*([\d.]+)", info), re.search(r"flags\s*:\s*(.*)", info)
    if clock is None or flags is None:
        raise RuntimeError("/proc/cpuinfo names neither clock nor instructions of an x86-64 processor")
    hertz = 1e6 * float(clock[1])
    wide = next((width for flag, width in WIDEST.items() if flag in flags[1].split()), 4)
    # Two scalar additions or multiplications a cycle without fused ones.
    return 2.0 * hertz, wide * hertz


def measure(quick: bool = False) -> Measured:
    found = Measured()
    if not available():
        found.figures.append(Figure("limit", f"not measured: needs {', '.join(TOOLS)}", math.nan, "1"))
        return found
    scalar, widest = peak()
    for name in ("RV20E-121-rigid",) if quick else ("RV20E-121-rigid", "BX-40E-rigid"):
        reducer = load_reducer(name)
        code = object_code(reducer.specification("rv_plant"))
        contacts = 2 * reducer.topology.pins
        rollers = reducer.topology.discs * reducer.topology.cranks * reducer.topology.rollers

        def add(what: str, value: float, note: str = "", name: str = name) -> None:
            found.figures.append(Figure("limit", f"{name}: {what}", value, "1", note=note))

        for fidelity, what in ((0, "one equilibrium"), (1, "one communication step in motion (1/72 turn)")):
            c = count(reducer, fidelity, code)
            seconds = seconds_of(reducer, fidelity, code)
            add(f"{what}, instructions", c.instructions)
            add(f"{what}, double-precision operations", c.operations)
            add(f"{what}, assemblies", c.assemblies)
            add(f"{what}, operations a second over the scalar peak", c.operations / seconds / scalar, note=f"{scalar / 1e9:.1f} GFlop/s")
            add(f"{what}, operations a second over the widest vectors' peak", c.operations / seconds / widest,
                note=f"{widest / 1e9:.0f} GFlop/s")
            for prefixes, divisor, words in ((("mesh.", "geometry."), contacts, "one pin, mean of all, without pow"),
                                             (("needle_bearing.",), rollers, "one roller, mean of all, without pow")):
                own = [cost for kernel, cost in c.by_kernel.items() if kernel.startswith(prefixes)]
                add(f"{what}: {words}, operations", sum(b for _, b in own) / c.assemblies / divisor)
                add(f"{what}: {words}, instructions", sum(a for a, _ in own) / c.assemblies / divisor)
            factoring = sum(v[1] for k, v in c.by_kernel.items() if k.startswith("linear."))
            add(f"{what}: factor and solve of one Newton step, operations", factoring / max(1.0, c.assemblies - (1 - fidelity)))
            for kernel, (instructions, _) in sorted(c.by_kernel.items(), key=lambda row: -row[1][0])[:6]:
                add(f"{what}: share of instructions in {kernel}", instructions / c.instructions)
    return found


def seconds_of(reducer: Reducer, fidelity: int, code: bytes) -> float:
    """Processor time of one step of the very object code that was counted."""
    records = reducer.plant.new_records()
    records["fidelity"], records["largest_crank_step"] = fidelity, 1.0
    assert plant.initialise(records) == 0
    duration = 2.0 * math.pi / 72 / abs(float(records["crank_speed"][0]))
    step, address, steps = load_object(code)["step"], records.ctypes.data, 720
    return cost(lambda: [step(address, 0.0, duration) for _ in range(steps)], 5) / steps
