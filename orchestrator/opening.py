"""An FMU in this process or in one of its own."""

from pathlib import Path

from orchestrator.component import Component
from orchestrator.fmu import Fmu
from orchestrator.isolation import Isolated


def open_fmu(name: str, path: str | Path, isolate: bool = False, wasm: bool = False) -> Component:
    """One instance of an FMU, in a process of its own or as WebAssembly if so asked."""
    return Isolated(name, path) if isolate else Fmu(name, path, wasm)
