"""Object code of a unit, the C shell and ``component.c`` to a core module of WebAssembly, by zig."""

import subprocess
import tempfile
from pathlib import Path

from fmu_src.link import FMI_HEADERS, SHELL, zig
from fmu_src.native import NativeFault

TRIPLE = "wasm32-unknown-wasi"
HERE = Path(__file__).parent
# A reactor: functions to be called, no program that runs.  Its memory comes from outside, see ``component``.
FLAGS = ("-target", "wasm32-wasi", "-mexec-model=reactor", "-std=c99", "-O2", "-ffp-contract=off", "-fno-sanitize=all", "-Wall", "-Werror")
LINK_FLAGS = ("-s", "-Wl,--import-memory", "-Wl,--gc-sections", "-lm")


def require_zig() -> tuple[str, ...]:
    """The command of zig's C compiler."""
    command = zig()
    if command is None:
        raise NativeFault('for WebAssembly zig is needed; install it with: pip install "rvwear[build]"')
    return command


def core_module(name: str, table: str, code: bytes) -> bytes:
    """The core module of a unit; offers FMI 3.0 as ``component.c`` has it."""
    command = require_zig()
    files = {path.name: path.read_bytes() for path in (*SHELL.iterdir(), *HERE.iterdir()) if path.suffix in (".c", ".h") and not path.name.startswith("fmi2")}
    files |= {"unit_table.c": table.encode(), "unit.o": code}
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        for file, content in files.items():
            (folder / file).write_bytes(content)
        sources = sorted(file for file in files if file.endswith(".c"))
        done = subprocess.run(
            [*command, *FLAGS, f"-I{FMI_HEADERS}", *sources, "unit.o", *LINK_FLAGS, "-o", "unit.wasm"],
            cwd=folder, capture_output=True, encoding="utf-8", errors="replace",
        )  # fmt: skip
        if done.returncode != 0:
            raise NativeFault(f"{name} for WebAssembly: {command[0]} failed: {done.stderr.strip()[-2000:]}")
        return (folder / "unit.wasm").read_bytes()
