"""Main figures stay what they are: ``tests/golden/*.json`` holds them with the tolerance of each.

A change on purpose is written anew with ``python3 tests/test_golden.py``; the difference of the files shows it.
"""

import json
import sys
from pathlib import Path

import pytest

from reducers.reducer import load_reducer
from studies.life import Life, LifeSettings, live
from studies.pair import make_pair
from studies.solve import measure
from studies.wear_figures import wear_figures

GOLDEN = Path(__file__).parent / "golden"
REDUCERS = ("RV20E-121", "RV20E-121-rigid", "BX-40E", "BX-40E-rigid")
HOURS = 200.0
# Relative, by figure: equilibria repeat to rounding, wear and angles of peaks to what a jump's control lets through.
TOLERANCES = {"turn": 1e-6, "life": 1e-4}
LEFT_OUT = ("largest_residual", "mean_iterations")


def figures(name: str) -> dict[str, dict[str, float]]:
    pair = make_pair(load_reducer(name))
    _, turn = measure(pair)
    life = live(pair, Life(LifeSettings(HOURS, 0.1, 100.0)), lambda _: None, lambda _: None)
    worn = wear_figures(pair.wear.record()) | {"jumps": len(life.hours) - 1}
    return {"turn": {k: v for k, v in turn.items() if k not in LEFT_OUT}, "life": worn}


@pytest.mark.parametrize("name", REDUCERS)
def test_main_figures_are_what_they_were(name):
    kept, now = json.loads((GOLDEN / f"{name}.json").read_text()), figures(name)
    for part, tolerance in TOLERANCES.items():
        assert now[part] == pytest.approx(kept[part], rel=tolerance, abs=1e-9), part


if __name__ == "__main__":
    for reducer in sys.argv[1:] or REDUCERS:
        (GOLDEN / f"{reducer}.json").write_text(json.dumps(figures(reducer), indent=1) + "\n")
