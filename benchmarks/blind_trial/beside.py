"""Puts campaigns of a trial that is done through the peers: made again, their truths compared (not by their seals: the last digits of a
prediction are the machine's).

    python -m benchmarks.blind_trial.beside --final --folder FOLDER --every 10

Ctrl-C stops, the same command goes on.
"""

import argparse
import json
import math
import os
import sys
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

from benchmarks.blind_trial.final import final_plan
from benchmarks.blind_trial.generator.make import Task, make
from benchmarks.blind_trial.peers import lacking, peers_of
from benchmarks.blind_trial.plan import plan
from benchmarks.blind_trial.results import end_line, finished, peers_in
from benchmarks.blind_trial.words import ABOUT, BESIDE


def beside(task: Task, truth: dict[str, Any]) -> dict[str, Any]:
    """What the peers say of one campaign of a trial."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        # How far the nearest other effects are was reckoned by the trial.
        make(replace(task, rivals=False), folder / "campaigns", folder / "sealed")
        again = json.loads((folder / "sealed" / f"{task.name}.json").read_text(encoding="utf-8"))
        if not same({**again, "rivals": None}, {**truth, "rivals": None}):
            raise RuntimeError(f"{task.name}: this code makes another campaign than the trial had")
        return {"number": task.number, "peers": peers_of(folder / "campaigns" / task.name)}


def same(a: object, b: object) -> bool:
    """Whether two truths are equal but for the last digits of numbers."""
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(same(a[k], b[k]) for k in a)
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, float) and isinstance(b, float):
        return math.isclose(a, b, rel_tol=1e-6)
    return a == b


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--folder", type=Path, required=True, help="folder of the trial")
    parser.add_argument("--final", action="store_true", help="it is the final trial")
    parser.add_argument("--every", type=int, default=10, help="one campaign in so many")
    parser.add_argument("--jobs", type=int, default=-1)
    arguments = parser.parse_args()
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    from joblib import Parallel, delayed

    about = json.loads((arguments.folder / ABOUT).read_text(encoding="utf-8"))
    if about.get("final", False) != arguments.final:
        parser.error(f"{arguments.folder} is {'' if about.get('final') else 'not '}a final trial's")
    if problem := lacking():
        parser.error(problem)
    tasks = final_plan(about["seed"]) if arguments.final else plan(about["campaigns"], about["seed"])
    results, done = finished(arguments.folder), peers_in(arguments.folder)
    left = [t for t in tasks if t.number % arguments.every == 0 and t.number not in done and "truth" in results.get(t.number, {})]
    path = arguments.folder / BESIDE
    end_line(path)
    with path.open("a", encoding="utf-8") as lines:
        found = Parallel(n_jobs=arguments.jobs, return_as="generator_unordered", batch_size=1)(delayed(beside)(t, results[t.number]["truth"]) for t in left)
        for k, line in enumerate(found, 1):
            lines.write(json.dumps(line) + "\n")
            lines.flush()
            print(f"{line['number']:5d} {line['peers']} [{k} of {len(left)}]", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
