"""The trial as others can enter it: campaigns whose truths are sealed, and how to answer.

    python -m benchmarks.blind_trial.publish_open OPEN --sealed TRUTHS --campaigns 200 --jobs 2

OPEN gets the campaigns, seals.txt (SHA-256 of every truth) and an example of an answers file; TRUTHS, which is kept back until the answers
are in, the truths themselves.  It resumes: what is there is not made again.  Without --seed nobody can guess which campaigns they are.
"""

import argparse
import os
import secrets
import sys
import time
from pathlib import Path

from benchmarks.blind_trial.answers import seals_of, write_answers
from benchmarks.blind_trial.final import final_plan
from benchmarks.blind_trial.generator.make import CannotMake, Task, make
from benchmarks.blind_trial.words import SEALS

SEED_FILE, CAMPAIGNS, EXAMPLE = "seed.txt", "campaigns", "answers_example.json"


def one(task: Task, folder: Path, sealed: Path) -> tuple[str, str]:
    """(name, seal), the seal empty where the strength could not be met."""
    try:
        return task.name, str(make(task, folder / CAMPAIGNS, sealed)["seal"])
    except (CannotMake, RuntimeError):
        return task.name, ""


def publish(folder: Path, sealed: Path, campaigns: int, seed: int, jobs: int) -> list[str]:
    """Makes what is missing; the names of all campaigns."""
    from joblib import Parallel, delayed

    (folder / CAMPAIGNS).mkdir(parents=True, exist_ok=True)
    sealed.mkdir(parents=True, exist_ok=True)
    (sealed / SEED_FILE).write_text(f"{seed}\n", encoding="utf-8")
    (folder / SEALS).touch()
    done = seals_of(folder)
    left = [t for t in final_plan(seed)[:campaigns] if t.name not in done]
    started = time.perf_counter()
    with (folder / SEALS).open("a", encoding="utf-8") as seals:
        made = Parallel(n_jobs=jobs, return_as="generator_unordered", batch_size=1)(delayed(one)(t, folder, sealed) for t in left)
        for count, (name, seal) in enumerate(made, 1):
            if seal:
                seals.write(f"{seal}  {name}\n")
                seals.flush()
            minutes = (time.perf_counter() - started) / count * (len(left) - count) / 60.0
            print(f"{name} {'sealed ' + seal if seal else 'not made'} [{count} of {len(left)}, {minutes:.0f} min left]", flush=True)
    names = sorted(seals_of(folder))
    # An answer to everything that is not "none" for nobody: what nothing missing looks like.
    write_answers(folder / EXAMPLE, "nothing is ever missing", {name: {"verdict": "none", "effects": [], "seconds": 0.0} for name in names})
    return names


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="where the campaigns go")
    parser.add_argument("--sealed", type=Path, required=True, help="where the truths go; not below FOLDER")
    parser.add_argument("--campaigns", type=int, default=200)
    parser.add_argument("--seed", type=int, help="default: one that nobody knows, kept with the truths")
    parser.add_argument("--jobs", type=int, default=-1)
    arguments = parser.parse_args()
    if arguments.sealed.resolve().is_relative_to(arguments.folder.resolve()):
        parser.error("--sealed is below the folder that is given away")
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    known = arguments.sealed / SEED_FILE
    seed = arguments.seed
    if seed is None:
        seed = int(known.read_text(encoding="utf-8")) if known.is_file() else secrets.randbits(48)
    names = publish(arguments.folder, arguments.sealed, arguments.campaigns, seed, arguments.jobs)
    print(f"{len(names)} campaigns in {arguments.folder}; docs/blind_trial_enter.md says how to answer")
    return 0


if __name__ == "__main__":
    sys.exit(main())
