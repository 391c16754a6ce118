"""``rvwear life``, ``dynamics-wear`` and ``report``: wear over hours and its pages."""

import argparse
import json
import sys
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cli.ending import exit_code
from cli.exporting import WIDTH_HELP, add_exports, check_exports, write_exports
from cli.options import add_coupling_options, add_json, add_reducer_options, chosen, folder, number_in, reducer_of, result_path, settings_of
from cli.overload import told_overload
from cli.written import say_file
from fmu_src.checked_file import Damaged, set_aside
from fmu_src.faults import InputFault, nearest_path
from fmu_src.held_file import held
from fmu_src.reading import reading

if TYPE_CHECKING:
    import xarray as xr

    from studies.kept_life import WantedLife

REMEDY = "rvwear life with --reuse computes it again"
# What rvwear ensemble writes.
ENSEMBLE = ".json"


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    hours = sub.add_parser("life", help="wear over thousands of hours, in error-controlled jumps")
    add_reducer_options(hours)
    add_coupling_options(hours)
    hours.add_argument("--hours", type=number_in("h"), default=10_000.0, help="operating hours: 2000, 2000h, 90d (default 10000)")
    hours.add_argument("--duty", metavar="FILE", help="speeds and torques with their shares of the hours (.toml)")
    hours.add_argument("--tolerance", type=float, default=0.01,
                       help="error of the depths over those at the end (default 0.01)")
    hours.add_argument("--first-jump", type=number_in("h"), metavar="HOURS", help="hours of the first jump at most (default: as the tolerance needs)")
    hours.add_argument("--largest-jump", type=number_in("h"), metavar="HOURS", help="hours of the longest jump at most (default: as the tolerance needs)")
    hours.add_argument("--output", help="result file, the report stands beside it (default results/NAME_life.nc; an earlier one of other"
                       " settings stays as NAME_life_1.nc)")
    hours.add_argument("--no-report", action="store_true", help="write no HTML report")
    start = hours.add_mutually_exclusive_group()
    start.add_argument("--resume", action="store_true", help="go on from the checkpoint beside the output")
    start.add_argument("--restart", action="store_true", help="discard a checkpoint and start anew")
    start.add_argument("--reuse", action="store_true", help="show a finished result of the same inputs again, go on from its checkpoint, or start")
    add_json(hours)
    add_exports(hours)
    hours.set_defaults(run=life)

    dynamics = sub.add_parser("dynamics-wear", help="wear of bodies in motion against equilibria: where dynamics matters")
    add_reducer_options(dynamics, positions=False)
    dynamics.add_argument("--speeds", type=float, nargs="+", default=[0.25, 1.0, 2.0], metavar="TIMES",
                          help="multiples of the set input speed (default 0.25 1 2); light load and resonance come along")
    dynamics.add_argument("--hours", type=number_in("h"), default=200.0, help="operating hours at each point (default 200)")
    dynamics.add_argument("--cycles", type=int, default=4, help="meshing cycles that stand for them (default 4)")
    dynamics.add_argument("--limit", type=float, default=2.0, help="percent that count as a difference (default 2)")
    dynamics.add_argument("--output", help="the page (default results/NAME_dynamics.html)")
    add_json(dynamics)
    dynamics.set_defaults(run=dynamics_wear)

    page = sub.add_parser("report", help="write the HTML report of a result again: of a life, or of many lives")
    page.add_argument("result", help="result file of rvwear life (.nc) or rvwear ensemble (.json)")
    page.add_argument("--output", help="report file (default beside the result)")
    page.set_defaults(run=report)
    files = sub.add_parser("export", help="a result file for other programs, or as pictures for a paper")
    files.add_argument("result", help="result file of rvwear life or rvwear run (.nc), or of rvwear ensemble (.json)")
    files.add_argument("files", nargs="+", metavar="FILE", help="what to write: .csv, .parquet, .mat, .xlsx; of lives .svg, .pdf, .png too")
    files.add_argument("--width", metavar="WIDTH", help=WIDTH_HELP)
    files.set_defaults(run=export)


def life(options: argparse.Namespace) -> int:
    """``rvwear life``: jumps over the hours, with checkpoint, result file and report."""
    from studies.duty import load_duty
    from studies.kept_life import WantedLife
    from studies.life import LifeSettings

    check_exports(options)
    reducer, settings, positions = chosen(options)
    life_settings = LifeSettings(options.hours, options.tolerance, options.first_jump, options.largest_jump)
    try:
        life_settings.check()
    except InputFault as fault:
        raise InputFault(f"--{str(fault).partition(' ')[0].replace('_', '-')}: {fault}") from None
    duty = load_duty(options.duty) if options.duty else ()
    path = result_path(options.output, f"{reducer.name}_life")
    wanted = WantedLife(reducer, settings, life_settings, positions, duty, options.scheme, folder(options.fmus))
    beyond = told_overload(reducer, settings, duty)
    with held(path):
        return live_and_write(options, wanted, path, beyond)


def live_and_write(options: argparse.Namespace, wanted: "WantedLife", path: Path, beyond: dict[str, Any]) -> int:
    """The life from where it stands, its result, and what is shown of it; ``beyond`` goes into the JSON."""
    from cli.show.life import telling
    from fmu_src.progress import say
    from studies.kept_life import Paused, belongs_to, checkpoint_of, live_to

    checkpoint = checkpoint_of(path)
    if options.reuse and (known := known_result(path, wanted.inputs)) is not None:
        return show_life(options, known, path, beyond)
    resume = options.resume or (options.reuse and checkpoint.exists() and belongs_to(checkpoint, wanted.inputs))
    if checkpoint.exists() and not (resume or options.restart or options.reuse):
        raise InputFault(f"{checkpoint} holds an unfinished run: give --resume to go on, --restart to start anew")
    if not options.output and path.exists() and known_result(path, wanted.inputs) is None and path.exists():
        print(f"{path} was of other settings: it stays as {stands_aside(path)}", file=sys.stderr)
    try:
        dataset = live_to(path, wanted, resume, telling(say))
    except Paused as interruption:
        print(f"interrupted at {interruption.hours:g} h; go on with --resume", file=sys.stderr)
        return exit_code(interruption)
    return show_life(options, dataset, path, beyond)


def stands_aside(path: Path) -> Path:
    """An earlier result and its page under the next free name; nobody named this one, so nobody meant it to be lost."""
    place = next(p for k in count(1) if not (p := path.with_name(f"{path.stem}_{k}.nc")).exists())
    path.rename(place)
    if (page := path.with_suffix(".html")).exists():
        page.rename(place.with_suffix(".html"))
    return place


def known_result(path: Path, inputs: dict[str, Any]) -> "xr.Dataset | None":
    """A finished result with the same inputs, or None."""
    from orchestrator import netcdf

    if not path.exists():
        return None
    try:
        dataset = netcdf.read(path)
        with reading(path, "a result of rvwear life"):
            stored = dict(json.loads(dataset.attrs["inputs"]))
    except InputFault as fault:
        print(f"{fault}: moved to {set_aside(path)}, the life is computed again", file=sys.stderr)
        return None
    same = all(stored.get(k) == json.loads(json.dumps(v)) for k, v in inputs.items())
    return dataset if same else None


def show_life(options: argparse.Namespace, dataset: "xr.Dataset", path: Path, beyond: dict[str, Any]) -> int:
    """Table or JSON on the screen, and the report."""
    from cli import screen
    from cli.show.life import life_table
    from studies import results

    page = path.with_suffix(".html")
    if not options.no_report:
        from studies.report import write_report

        write_report(dataset, page)
    if options.json:
        screen.json_text({"reducer": options.reducer, "result": str(path)} | results.figure_arrays(dataset) | beyond)
    else:
        life_table(dataset)
        say_file(path, "result  ")
        if not options.no_report:
            say_file(page, "report  ")
    if options.export or options.picture:
        from exports.tables import tables_of
        from studies.report.page import figures_of

        write_exports(options, lambda: tables_of(dataset), lambda: figures_of(dataset))
    return 0


def dynamics_wear(options: argparse.Namespace) -> int:
    """``rvwear dynamics-wear``: wear of both fidelities, and where they differ."""
    from cli import screen
    from cli.show.dynamics import show_dynamics
    from studies.dynamics_wear import as_json, compare
    from studies.report.dynamics import write_dynamics_page

    reducer = reducer_of(options.reducer)
    page = Path(options.output or f"results/{reducer.name}_dynamics.html")
    found = compare(reducer, settings_of(options, reducer), options.speeds, options.hours, options.cycles, options.limit,
                    lambda text: print(text, file=sys.stderr, flush=True))  # fmt: skip
    write_dynamics_page(found, page)
    if options.json:
        screen.json_text(as_json(found) | {"page": str(page)})
    else:
        show_dynamics(found)
        say_file(page, "page  ")
    return 0


def report(options: argparse.Namespace) -> int:
    """``rvwear report``: the page of a result file."""
    from orchestrator import netcdf
    from studies.report import write_report

    path = Path(options.result)
    if not path.is_file():
        raise InputFault(f"no result file at {path}{nearest_path(path)}; {'rvwear ensemble' if path.suffix == ENSEMBLE else 'rvwear life'} writes one")
    page = Path(options.output) if options.output else path.with_suffix(".html")
    if path.suffix == ENSEMBLE:
        from cli.commands.ensemble import write_page
        from studies.report.lives import REMEDY as AGAIN
        from studies.report.lives import WHAT, read_result

        with reading(path, WHAT, AGAIN):
            write_page(read_result(path), page)
        say_file(page)
        return 0
    try:
        dataset = netcdf.read(path)
        with reading(path, "a result of rvwear life", REMEDY):
            write_report(dataset, page)
    except Damaged as fault:
        raise Damaged(f"{fault}; {REMEDY}") from None
    say_file(page)
    return 0


def export(options: argparse.Namespace) -> int:
    """``rvwear export``: a result file in other forms."""
    from exports.tables import tables_of
    from orchestrator import netcdf
    from pages.paper import ENDINGS
    from studies.report.page import figures_of

    options.picture = [name for name in options.files if Path(name).suffix.lower() in ENDINGS]
    options.export = [name for name in options.files if name not in options.picture]
    check_exports(options)
    if Path(options.result).suffix == ENSEMBLE:
        return export_ensemble(options, Path(options.result))
    dataset = netcdf.read(Path(options.result))
    if options.picture and "hour" not in dataset.dims:
        raise InputFault(f"{options.result} holds no life, which {' and '.join(options.picture)} would show: .csv, .parquet, .mat and .xlsx take any result")
    write_exports(options, lambda: tables_of(dataset), lambda: figures_of(dataset))
    return 0


def export_ensemble(options: argparse.Namespace, path: Path) -> int:
    from studies.ensemble.tables import tables_of
    from studies.report.lives import REMEDY as AGAIN
    from studies.report.lives import WHAT, figures_of, read_result

    with reading(path, WHAT, AGAIN):
        found = read_result(path)
        tables, figures = tables_of(found), figures_of(found)
    write_exports(options, lambda: tables, lambda: figures)
    return 0
