"""``python -m benchmarks.random_sets [COUNT]``: random legal parameters of three topologies, in balance, and in process as in FMUs; exit code 1 with a finding."""

import argparse
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.random_sets.run import REDUCERS, Sets, Tally


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m benchmarks.random_sets", description=__doc__)
    parser.add_argument("count", nargs="?", type=int, default=2000, help="sets, the topologies in turn (default 2000)")
    parser.add_argument("--first", type=int, default=0, help="number of the first set")
    parser.add_argument("--reducer", action="append", help=f"in turn (default {', '.join(REDUCERS)})")
    parser.add_argument("--no-fmus", action="store_true", help="in process alone")
    options = parser.parse_args()
    reducers = options.reducer or REDUCERS
    tally, started = Tally(), time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        all_sets = [Sets(name, None if options.no_fmus else Path(folder)) for name in reducers]
        for number in range(options.first, options.first + options.count):
            found = len(tally.findings)
            all_sets[number % len(all_sets)].run(number, tally)
            for finding in tally.findings[found:]:
                print(f"{reducers[number % len(all_sets)]} {finding}", flush=True)
        for sets in all_sets:
            sets.close()
    print(f"{tally.units} sets in {time.monotonic() - started:.0f} s, {len(tally.findings)} findings")
    for outcome, count in tally.outcomes.most_common():
        print(f"{count:8} {outcome}")
    for check, share in sorted(tally.worst.items()):
        print(f"{share:8.2g} of what is allowed: {check}")
    return 1 if tally.findings else 0


if __name__ == "__main__":
    sys.exit(main())
