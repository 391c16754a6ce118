"""What one scripts with: reducers, their lives, models against measurements, systems of FMUs.

    import rvwear

    turn = rvwear.solve("RV20E-121", settings={"output.load_torque": "150 N.m"})     # xarray: series and figures, with units
    rvwear.export(turn, "turn.xlsx", "turn.pdf")

These names stay; all other packages of this project may move.  Nothing is loaded before it is used.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from discrepancy.campaign.load import load_campaign
    from discrepancy.model_file import load_model
    from fmu_src.faults import BeyondRated, InputFault, RunFault
    from orchestrator.system import System, connect
    from orchestrator.system import load as load_system
    from reducers.library import available as reducers
    from reducers.reducer import Reducer, load_reducer
    from rvwear.files import export, figure, figure_names, frames
    from rvwear.measured import Comparison, Diagnosis, compare, diagnose
    from rvwear.reducer import hysteresis, life, modes, read, solve

# Name -> where it is and what it is called there.
PLACES = {
    "reducers": ("reducers.library", "available"), "load_reducer": ("reducers.reducer", "load_reducer"), "Reducer": ("reducers.reducer", "Reducer"),
    "solve": ("rvwear.reducer", "solve"), "hysteresis": ("rvwear.reducer", "hysteresis"), "modes": ("rvwear.reducer", "modes"),
    "life": ("rvwear.reducer", "life"), "read": ("rvwear.reducer", "read"),
    "load_model": ("discrepancy.model_file", "load_model"), "load_campaign": ("discrepancy.campaign.load", "load_campaign"),
    "compare": ("rvwear.measured", "compare"), "diagnose": ("rvwear.measured", "diagnose"), "Comparison": ("rvwear.measured", "Comparison"),
    "Diagnosis": ("rvwear.measured", "Diagnosis"),
    "System": ("orchestrator.system", "System"), "load_system": ("orchestrator.system", "load"), "connect": ("orchestrator.system", "connect"),
    "frames": ("rvwear.files", "frames"), "figure": ("rvwear.files", "figure"),
    "figure_names": ("rvwear.files", "figure_names"), "export": ("rvwear.files", "export"),
    "BeyondRated": ("fmu_src.faults", "BeyondRated"), "InputFault": ("fmu_src.faults", "InputFault"), "RunFault": ("fmu_src.faults", "RunFault"),
}  # fmt: skip
__all__ = [
    "BeyondRated", "Comparison", "Diagnosis", "InputFault", "Reducer", "RunFault", "System", "compare", "connect", "diagnose", "export", "figure",
    "figure_names", "frames", "hysteresis", "life", "load_campaign", "load_model", "load_reducer", "load_system", "modes", "read", "reducers", "solve",
]  # fmt: skip


def __getattr__(name: str) -> Any:
    """A name of the table, from its module; then it is known."""
    if name == "__version__":
        from fmu_src.project import project

        return project().version
    if name not in PLACES:
        raise AttributeError(f"module 'rvwear' has no {name!r}; it has {', '.join(PLACES)}")
    module, there = PLACES[name]
    found = globals()[name] = getattr(import_module(module), there)
    return found


def __dir__() -> list[str]:
    return [*PLACES, "__version__"]
