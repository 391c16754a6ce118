"""What a rebuild for verification adds to a unit: the reference material of its reducer."""

from pathlib import Path
from typing import Any

from fmu_src.faults import InputFault
from reducers.reducer import load_reducer
from studies.reference_material import add_references


def complete(fmu: Path, stamp: dict[str, Any]) -> bool:
    """Add it to an FMU that was built anew; False if the reducer that the stamp names is not the one known here by that name."""
    specification = stamp["specification"]
    try:
        reducer = load_reducer(specification["reducer"])
    except InputFault:
        return False
    if reducer.specification(specification["unit"]) != specification:
        return False
    add_references([fmu], reducer, specification["unit"], stamp["step_size"])
    return True
