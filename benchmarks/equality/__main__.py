"""``python -m benchmarks.equality [COUNT]``: scenarios through every flavour of the units; exit code 1 where bits differ that should not."""

import argparse
import sys
import tempfile
from pathlib import Path

import numpy as np

from benchmarks.equality.flavours import Flavours, flavours
from benchmarks.equality.scenarios import Scenario, scenarios, states
from orchestrator.component import InProcess, unit_of

# What computes with the same functions of the same C library: not a bit may differ.
SAME_BITS = ("FMU",)
# What is nothing but rounding, always or where discs are alike and their forces cancel on the housing: judged by the size of what it is left of.
ROUNDING_OF = {
    "housing_force_x": "largest_pin_force", "housing_force_y": "largest_pin_force", "ideal_output_rest": "ideal_output", "cage_rest": "cage",
}  # fmt: skip


def run_plainly(reducer: str, unit: str, step: str, values: str, out: str) -> None:
    """In a process whose kernels are plain Python."""
    with np.load(values) as given:
        scenario = Scenario("", reducer, unit, float(step), {name: value if value.shape else value.item() for name, value in given.items()})
    np.save(out, states(scenario, InProcess("unit", scenario.specification)))


def difference(scenario: Scenario, found: np.ndarray, right: np.ndarray) -> tuple[float, str]:
    """(largest difference over the largest value of the same variable, or of what it is the rounding of, its name) among outputs and surfaces after the last step."""
    worst, where = 0.0, ""
    table = unit_of(scenario.specification).table
    for v in table.of_role("output", "state"):
        place = slice(table.offset[v.name], table.offset[v.name] + v.size)
        a, b = (cells[-1, place].view("i8" if v.is_integer else "f8").astype(float) for cells in (found, right))
        scale = np.abs(b).max() if v.size else 0.0
        if v.name in ROUNDING_OF:
            scale = max(scale, abs(float(right[-1, table.offset[ROUNDING_OF[v.name]]].view("f8"))))
        share = float(np.abs(a - b).max() / scale) if scale > 0.0 else float(np.abs(a).max(initial=0.0) > 0.0)
        if share > worst:
            worst, where = share, v.path
    return worst, where


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.equality", description=__doc__)
    parser.add_argument("count", nargs="?", type=int, default=50)
    parser.add_argument("--flavour", action="append", help="part of its name (default: all)")
    options = parser.parse_args()
    chosen, failed = scenarios(options.count), False
    with tempfile.TemporaryDirectory() as folder:
        reference = {(s.reducer, s.name): Flavours(Path(folder)).in_process(s) for s in chosen}
        for name, run in flavours(Path(folder)):
            if options.flavour and not any(part in name for part in options.flavour):
                continue
            if isinstance(run, str):
                print(f"{name:28} not here: {run}", flush=True)
                continue
            equal, shares = 0, []
            for scenario in chosen:
                found, right = run(scenario), reference[scenario.reducer, scenario.name]
                equal += bool(np.array_equal(found, right))
                if not np.array_equal(found, right):
                    shares.append((*difference(scenario, found, right), f"{scenario.reducer}, {scenario.name}"))
            shares.sort(reverse=True)
            failed |= bool(shares) and any(part in name for part in SAME_BITS)
            words = f"; {np.median([s[0] for s in shares]):.1g} in the middle, most {shares[0][0]:.2g} of {shares[0][1]} ({shares[0][2]})" if shares else ""
            print(f"{name:28} {equal:3} of {len(chosen)} bit-equal{words}", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
