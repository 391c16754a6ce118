"""An FMU in this process or in one of its own."""

from pathlib import Path

from orchestrator.call_limits import USUAL_LIMITS, CallLimits
from orchestrator.component import Component
from orchestrator.fmu import Fmu
from orchestrator.isolation import Isolated


def open_fmu(name: str, path: str | Path, isolate: bool = False, limits: CallLimits = USUAL_LIMITS, wasm: bool = False) -> Component:
    """One instance of an FMU, in a process of its own (``limits`` hold there alone) or as WebAssembly if so asked."""
    return Isolated(name, path, limits) if isolate else Fmu(name, path, wasm)
