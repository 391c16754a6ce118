"""What a scenario runs as: each flavour of the units, and the other platforms by emulators where these are."""

import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.equality.scenarios import NAMES, STEPS, Scenario, driven, states
from fmu_src.link import FMI_HEADERS, PLATFORMS, zig
from fmu_src.native import object_code
from fmu_src.package import build_fmu, build_native, build_source, compile_sources
from fmu_src.state import HEADER_SIZE
from orchestrator.component import InProcess, unit_of
from orchestrator.opening import open_fmu

ROOT = Path(__file__).resolve().parents[2]
RUNNER = Path(__file__).with_name("run_unit.c")
ARM = ["qemu-aarch64", "-L", "/usr/aarch64-linux-gnu"]

Run = Callable[[Scenario], np.ndarray]


class Missing(RuntimeError):
    """What a flavour needs is not on this machine."""


class Flavours:
    """Builds what scenarios need, once for each reducer and unit, in a folder."""

    def __init__(self, folder: Path):
        self.folder = folder
        self.fmus: dict[tuple[str, str, str], Path] = {}

    def built(self, kind: str, scenario: Scenario) -> Path:
        """The FMU of a kind."""
        key = (kind, scenario.reducer, scenario.unit)
        if key not in self.fmus:
            self.fmus[key] = self.build(kind, scenario, self.folder / "-".join(key))
        return self.fmus[key]

    def build(self, kind: str, scenario: Scenario, folder: Path) -> Path:
        folder.mkdir(parents=True)
        name, specification = NAMES[scenario.unit], scenario.specification
        given = (name, specification, 1e-3, "equality", folder)
        if kind == "editable":
            return build_fmu(*given, object_code(specification))
        if kind == "source":
            return compile_sources(build_source(*given, ("3",))[0], folder / "compiled.fmu")
        if kind == "wasm":
            return build_native(*given, ("3",), wasm=True)[0]
        if kind == "platforms":
            return build_native(*given, ("3",), all_platforms=True)[0]
        return build_native(*given, (kind,))[0]

    def in_process(self, scenario: Scenario) -> np.ndarray:
        return states(scenario, InProcess("unit", scenario.specification))

    def as_fmu(self, kind: str) -> Run:
        def run(scenario: Scenario) -> np.ndarray:
            unit = open_fmu("unit", self.built(kind, scenario), wasm=kind == "wasm")
            try:
                return states(scenario, unit)
            finally:
                unit.close()

        return run

    def plain_python(self, scenario: Scenario) -> np.ndarray:
        """The kernels without a compiler, in a process that was started so."""
        values, out = self.folder / "values.npz", self.folder / "plain.npy"
        kept: dict[str, Any] = {name: np.asarray(value) for name, value in scenario.values.items()}
        np.savez(values, **kept)
        program = "import sys; from benchmarks.equality.__main__ import run_plainly; run_plainly(*sys.argv[1:])"
        environment = os.environ | {"RVWEAR_PLAIN_PYTHON": "1", "PYTHONPATH": str(ROOT)}
        given = [scenario.reducer, scenario.unit, repr(float(scenario.step)), str(values), str(out)]
        subprocess.run([sys.executable, "-c", program, *given], cwd=ROOT, env=environment, check=True)
        found: np.ndarray = np.load(out)
        return found

    def emulated(self, platform: str, command: list[str], folder_of: str) -> Run:
        """Another platform's library, run by a C program of that platform under an emulator."""
        compiler, target = zig(), PLATFORMS[platform].zig_target
        if compiler is None:
            raise Missing('no zig: pip install "rvwear[build]"')
        if shutil.which(command[0]) is None:
            raise Missing(f"no {command[0]}")
        runner = self.folder / f"runner-{platform}.exe"
        options = [] if "windows" in target else ["-ldl"]
        subprocess.run([*compiler, "-target", target, f"-I{FMI_HEADERS}", str(RUNNER), "-o", str(runner), *options], check=True)

        def run(scenario: Scenario) -> np.ndarray:
            path = self.built("platforms", scenario)
            unpacked = path.parent / "unpacked"
            if not unpacked.exists():
                shutil.unpack_archive(path, unpacked, "zip")
            unit = open_fmu("unit", path)
            token = unit.description.instantiationToken  # type: ignore[attr-defined]
            unit.close()
            orders, out = self.folder / "orders.txt", self.folder / "out.bin"
            orders.write_text("\n".join(orders_of(scenario)) + "\n")
            library = unpacked / "binaries" / folder_of / f"{NAMES[scenario.unit]}{PLATFORMS[platform].suffix}"
            subprocess.run([*command, str(runner), str(library), token, str(orders), str(out)], check=True, capture_output=True)
            size = 8 * unit_of(scenario.specification).table.state_cells
            blocks = np.frombuffer(out.read_bytes(), np.uint8).reshape(STEPS + 1, HEADER_SIZE + size)
            return blocks[:, HEADER_SIZE:].copy().view("i8")

        return run


def orders_of(scenario: Scenario) -> Iterator[str]:
    """What run_unit.c is to do, a line each: values by reference, then ``init`` and ``step TIME DURATION``; numbers in hexadecimal."""
    table = unit_of(scenario.specification).table

    def setting(name: str, value: object) -> str:
        v = table.by_name[name]
        numbers = np.broadcast_to(np.asarray(value, float), v.shape).ravel()
        return f"{'i' if v.is_integer else 'r'} {table.offset[name]} {v.size} " + " ".join(float(x).hex() for x in numbers)

    yield from (setting(name, value) for name, value in scenario.values.items())
    yield "init 0 0"
    for n in range(STEPS):
        if scenario.unit == "wear_fmu":
            yield from (setting(name, value) for name, value in driven(n).items())
        yield f"step {float(n * scenario.step).hex()} {float(scenario.step).hex()}"


def flavours(folder: Path) -> Iterator[tuple[str, Run | str]]:
    """(name, how it runs, or why it cannot here)."""
    made = Flavours(folder)
    yield "editable FMU, FMI 2.0", made.as_fmu("editable")
    yield "native FMU, FMI 2.0", made.as_fmu("2")
    yield "native FMU, FMI 3.0", made.as_fmu("3")
    yield "FMU of C99, this compiler", made.as_fmu("source") if shutil.which("cc") else "no C compiler"
    wasm = zig() is not None and importlib.util.find_spec("wasmtime") is not None
    yield "WebAssembly, wasmtime", made.as_fmu("wasm") if wasm else 'pip install "rvwear[build,wasm]"'
    for name, platform, command, folder_of in (
        ("Linux on Arm, qemu", "aarch64-linux", ARM, "aarch64-linux"), ("Windows, wine", "x86_64-windows", ["wine"], "x86_64-windows"),
    ):  # fmt: skip
        try:
            yield name, made.emulated(platform, command, folder_of)
        except Missing as reason:
            yield name, str(reason)
    # The slowest last.
    yield "plain Python", made.plain_python
