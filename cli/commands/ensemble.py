"""``rvwear ensemble``: many lives, kept as they finish, and what they say."""

import argparse
import json
import sys
from pathlib import Path

from cli import screen
from cli.show.ensemble import show
from fmu_src.faults import InputFault
from fmu_src.source_hash import source_hash
from studies.ensemble.backends import through_dask, through_joblib
from studies.ensemble.ensemble_file import Ensemble, load_ensemble
from studies.ensemble.member import Task, run
from studies.ensemble.sampling import points, values_of
from studies.ensemble.store import Store
from studies.ensemble.summary import summarise


def tasks_of(ensemble: Ensemble) -> list[Task]:
    return [
        Task(number, ensemble.reducer, ensemble.settings, ensemble.duty, ensemble.hours, ensemble.tolerance, values_of(ensemble, row))
        for number, row in enumerate(points(ensemble))
    ]


def ensemble_command(options: argparse.Namespace) -> int:
    if (options.backend == "dask") != bool(options.scheduler):
        raise InputFault("--backend dask and --scheduler ADDRESS go together")
    if options.jobs == 0:
        raise InputFault("--jobs 0: give a number of processes, or -1 for one per core")
    ensemble = load_ensemble(options.file, options.samples)
    path = Path(options.output or f"results/{Path(options.file).stem}_ensemble.json")
    if path.suffix != ".json":
        raise InputFault(f"--output {path}: the name must end in .json")
    tasks = tasks_of(ensemble)
    store = Store(path.with_suffix(".lives"), ensemble.identity() | {"source_hash": source_hash()}, options.restart)
    missing = [task for task in tasks if task.number not in store.lives]
    if len(missing) < len(tasks):
        print(f"{len(tasks) - len(missing)} lives are there already", file=sys.stderr)
    arriving = through_dask(run, missing, options.scheduler) if options.backend == "dask" else through_joblib(run, missing, options.jobs)
    interrupted = False
    try:
        with screen.Progress(len(missing), "lives") as progress:
            for life in arriving:
                if store.add(life):
                    progress.advance()
    except KeyboardInterrupt:
        arriving.close()
        interrupted = True
        print(f"interrupted with {len(store.lives)} of {len(tasks)} lives; the same command goes on", file=sys.stderr)
    found = summarise(ensemble, store.lives, len(tasks)) | {"lives": str(store.path)}
    path.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    if options.json:
        screen.json_text(found)
    else:
        show(found)
        print(f"result  {path}")
    return 130 if interrupted else 0
