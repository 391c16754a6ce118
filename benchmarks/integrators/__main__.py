"""Runs the comparison; see the package."""

import argparse
import json
from pathlib import Path

from benchmarks.integrators import __doc__ as about
from benchmarks.integrators.comparison import compare, show
from benchmarks.integrators.stretches import rated, reversal
from reducers.reducer import load_reducer

REDUCERS = ("RV20E-121-rigid", "BX-40E-rigid")


def main() -> None:
    parser = argparse.ArgumentParser(description=about.splitlines()[0])
    parser.add_argument("--reducer", nargs="+", default=REDUCERS)
    parser.add_argument("--stretch", nargs="+", default=("rated", "reversal"))
    parser.add_argument("--repeats", type=int, default=4, help="runs of which the fastest counts")
    parser.add_argument("--json", type=Path, help="also write the figures to this file")
    arguments = parser.parse_args()
    result = {}
    for name in arguments.reducer:
        table = load_reducer(name).plant
        for kind in arguments.stretch:
            stretch = {"rated": rated, "reversal": reversal}[kind](table)
            print(f"\n{name}, {kind}")
            rows = result[f"{name} {kind}"] = compare(stretch, arguments.repeats)
            show(rows)
    if arguments.json:
        arguments.json.write_text(json.dumps(result, indent=1) + "\n")


if __name__ == "__main__":
    main()
