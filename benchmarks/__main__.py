"""Run the measurements and write the table.

    python3 build.py bench [ITEM ...] [--quick] [--output results/bench]
    python3 -m benchmarks ...          the same in an environment that is set up

Items: equilibrium, motion, exchange, limit, lives, growth, many, diagnosis.  Writes .json and .html, and the table to the screen.
"""

import argparse
import importlib
import os
import sys
from pathlib import Path

# Before NumPy is loaded: threads of the linear algebra would count as processor time of the peers.
for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

ITEMS = ("equilibrium", "motion", "exchange", "limit", "lives", "growth", "many", "diagnosis")


def main() -> int:
    parser = argparse.ArgumentParser(prog="build.py bench", description=__doc__.splitlines()[0])
    parser.add_argument("items", nargs="*", metavar="ITEM", help=f"of {', '.join(ITEMS)} (default all)")
    parser.add_argument("--quick", action="store_true", help="small cases, to see that all works; figures mean little")
    parser.add_argument("--output", default="results/bench", help="without ending (default results/bench)")
    options = parser.parse_args()
    if unknown := set(options.items) - set(ITEMS):
        parser.error(f"there is no {', '.join(sorted(unknown))}; choose of {', '.join(ITEMS)}")
    from benchmarks import table
    from benchmarks.ratios import machine

    found = {}
    for item in options.items or ITEMS:
        print(f"measuring {item}", file=sys.stderr, flush=True)
        found[item] = importlib.import_module(f"benchmarks.{item}").measure(options.quick)
        # After each, so that a run that is stopped leaves what it has.
        table.write(found, machine(), options.quick, Path(options.output))
    table.show(found)
    print(f"table  {options.output}.html")
    return 0


if __name__ == "__main__":
    sys.exit(main())
