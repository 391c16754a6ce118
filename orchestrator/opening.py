"""An FMU in this process or in one of its own."""

from pathlib import Path

from orchestrator.call_limits import USUAL_LIMITS, CallLimits
from orchestrator.component import Component
from orchestrator.fmu import Fmu
from orchestrator.isolation import Isolated


def open_fmu(name: str, path: str | Path, isolate: bool = False, limits: CallLimits = USUAL_LIMITS) -> Component:
    """One instance of an FMU, in a process of its own if so asked; ``limits`` hold there alone."""
    return Isolated(name, path, limits) if isolate else Fmu(name, path)
