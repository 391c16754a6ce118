"""An effect of one's own, translated as its unit would be: what the compiler has to say of it is said before anything is built."""

import json
import re
from pathlib import Path

from fmu_src.compiler.loading import fill_unit
from fmu_src.compiler.module import Module
from fmu_src.compiler.types import KernelFault, Layout
from fmu_src.effect_finding import Finding
from fmu_src.unit import make_unit
from reducers.reducer import load_reducer
from studies.effect_child import findings_by

REDUCER = "RV20E-121-rigid"
PATIENCE = 60.0
PLACE = re.compile(r"(.*?):(\d+): (.*)", re.DOTALL)


def not_translated(file: Path) -> list[Finding]:
    """What the compiler refuses of the unit with this sound effect in it; see ``findings_by``."""
    return findings_by("studies.effect_code:main", file, "translated", PATIENCE, plain=False)


def main(name: str) -> None:
    """In the process itself: prints what the compiler says as JSON."""
    refused = []
    try:
        made = make_unit(load_reducer(REDUCER).specification(Path(name).parent.name))
        assert made.kernels is not None
        fill_unit(Module(), *made.kernels, Layout(made.table.dtype))
    except KernelFault as fault:
        place, line, text = PLACE.fullmatch(str(fault)).groups()  # type: ignore[union-attr]
        refused.append((place, int(line), text))
    print(json.dumps(refused))
