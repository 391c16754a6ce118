"""Instructions of the plant's kernels that were counted last: ``python3 -m benchmarks.instructions`` counts anew.

``tests/test_instructions.py`` holds new counts against them.
"""

import json
from pathlib import Path

from benchmarks.limit import count
from fmu_src.native import object_code
from reducers.reducer import load_reducer

KEPT = Path(__file__).with_suffix(".json")
REDUCERS = ("RV20E-121-rigid",)
FIDELITIES = ("equilibrium", "motion")


def counted() -> dict[str, float]:
    """Of one position of a turn, by reducer and fidelity."""
    found = {}
    for name in REDUCERS:
        reducer = load_reducer(name)
        code = object_code(reducer.specification("rv_plant"))
        for fidelity, what in enumerate(FIDELITIES):
            found[f"{name} {what}"] = count(reducer, fidelity, code, 18).instructions
    return found


if __name__ == "__main__":
    KEPT.write_text(json.dumps(counted(), indent=1) + "\n")
