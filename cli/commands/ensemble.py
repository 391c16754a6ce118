"""``rvwear ensemble``: many lives, kept as they finish, and what they say."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cli.ending import exit_code
from cli.exporting import add_exports, check_exports, write_exports
from cli.options import add_json, page_path
from cli.written import only_file, say_file
from fmu_src.checked_file import write_text
from fmu_src.faults import InputFault, MissingPart
from fmu_src.held_file import held
from fmu_src.progress import task

if TYPE_CHECKING:
    from studies.ensemble.ensemble_file import Ensemble

# Of the optional part "ensembles".
NEEDED = ("SALib", "dask", "distributed", "joblib")


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    command = sub.add_parser("ensemble", help="lives of many reducers: scatter of parts, duty and parameters")
    command.add_argument("file", help="what scatters and how, and the limits (.toml, examples/ensemble.toml)")
    command.add_argument("--samples", type=int, help="base samples, a power of two, before the file's")
    command.add_argument("--jobs", type=int, default=-1, help="processes (default: one per core)")
    command.add_argument("--backend", choices=("joblib", "dask"), default="joblib", help="this machine (default), or a Dask cluster")
    command.add_argument("--scheduler", metavar="ADDRESS", help="of the Dask cluster: tcp://host:8786; its workers need this package")
    command.add_argument("--output", help="result (default results/NAME_ensemble.json); finished lives are kept beside it")
    command.add_argument("--restart", action="store_true", help="discard the lives that are there")
    add_json(command, "result as JSON on stdout")
    command.add_argument("--html", metavar="FILE", help="write a page: bands over the hours, hours to the limits, what matters")
    add_exports(command)
    command.set_defaults(run=ensemble)


def ensemble(options: argparse.Namespace) -> int:
    """``rvwear ensemble``: what it needs beyond the rest is named where it is missing."""
    try:
        return compute(options)
    except ModuleNotFoundError as missing:
        if missing.name is None or missing.name.partition(".")[0] not in NEEDED:
            raise
        raise MissingPart("rvwear ensemble", missing.name, "ensembles") from None


def compute(options: argparse.Namespace) -> int:
    """Draw the lives, run those that are missing, keep and judge them."""
    from studies.ensemble.ensemble_file import load_ensemble

    if (options.backend == "dask") != bool(options.scheduler):
        raise InputFault("--backend dask and --scheduler ADDRESS go together")
    if options.jobs == 0:
        raise InputFault("--jobs 0: give a number of processes, or -1 for one per core")
    check_exports(options)
    page_path(options.html)
    drawn = load_ensemble(options.file, options.samples)
    path = Path(options.output or f"results/{Path(options.file).stem}_ensemble.json")
    if path.suffix != ".json":
        raise InputFault(f"--output {path}: the name must end in .json")
    with held(path):
        return live_and_judge(options, drawn, path)


def live_and_judge(options: argparse.Namespace, drawn: "Ensemble", path: Path) -> int:
    """The lives that are missing, kept as they come, and what all of them say."""
    from cli import screen
    from cli.show.ensemble import show
    from exports.plain import plain_json
    from fmu_src.source_hash import source_hash
    from studies.ensemble.backends import through_dask, through_joblib
    from studies.ensemble.bands import kept
    from studies.ensemble.member import run
    from studies.ensemble.sampling import tasks_of
    from studies.ensemble.store import Store
    from studies.ensemble.summary import summarise

    tasks = tasks_of(drawn)
    store = Store(path.with_suffix(".lives"), drawn.identity() | {"source_hash": source_hash()}, options.restart)
    if store.damaged:
        print(f"{store.path}: {store.damaged} lives in it are damaged or cut off and run again", file=sys.stderr)
    missing = [task for task in tasks if task.number not in store.lives]
    if len(missing) < len(tasks):
        print(f"{len(tasks) - len(missing)} lives are there already", file=sys.stderr)
    arriving = through_dask(run, missing, options.scheduler) if options.backend == "dask" else through_joblib(run, missing, options.jobs)
    interrupted = 0
    try:
        with task("lives", total=len(missing)) as living:
            for life in arriving:
                if store.add(life):
                    living.advance()
    except KeyboardInterrupt as interruption:
        arriving.close()
        interrupted = exit_code(interruption)
        print(f"interrupted with {len(store.lives)} of {len(tasks)} lives; the same command goes on", file=sys.stderr)
    found = summarise(drawn, store.lives, len(tasks)) | {"lives": str(store.path)}
    found = kept(found, drawn, store.lives, len(tasks))
    write_text(path, plain_json(found, indent=1) + "\n")
    if options.json:
        screen.json_text(found)
    else:
        show(found)
        say_file(path, "result  ")
    if options.html:
        write_page(found, Path(options.html))
        if options.json:
            only_file(options.html)
        else:
            say_file(options.html, "page    ")
    if options.export or options.picture:
        from studies.ensemble.tables import tables_of
        from studies.report.lives import figures_of

        write_exports(options, lambda: tables_of(found), lambda: figures_of(found))
    return interrupted


def write_page(found: dict[str, Any], path: Path) -> None:
    from pages.render import rendered_sections, written
    from studies.report.lives import page_of

    with task("drawing"):
        written(rendered_sections(page_of(found)), path)
