"""``python -m benchmarks.fuzzing [MINUTES]``: mutants of every reader in turn; exit code 1 if one does not hold the property."""

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

from benchmarks.fuzzing.readers import READERS
from benchmarks.fuzzing.run import Outcome, trial


def main() -> int:
    parser = argparse.ArgumentParser(prog="build.py fuzz", description=__doc__)
    parser.add_argument("minutes", nargs="?", type=float, default=10.0, help="for all readers together (default 10)")
    parser.add_argument("--reader", action="append", choices=list(READERS), help="this one alone (default: all)")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    readers = options.reader or list(READERS)
    folder = Path(tempfile.mkdtemp(prefix="rvwear-fuzz-"))
    outcomes: list[Outcome] = []
    for reader in readers:
        outcome = trial(reader, options.seed, 60.0 * options.minutes / len(readers), 10**9, folder / reader)
        outcomes.append(outcome)
        print(f"{reader:20} {outcome.done:8} mutants, {outcome.refused:8} refused in {outcome.kinds:4} ways", *outcome.found, sep="\n    ", flush=True)
    total, found = sum(outcome.done for outcome in outcomes), sum(len(outcome.found) for outcome in outcomes)
    print(f"{total} mutants, {found} findings" + (f"; the files are in {folder}" if found else ""))
    if not found:
        shutil.rmtree(folder)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
