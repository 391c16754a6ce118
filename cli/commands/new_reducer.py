"""``rvwear reducer new``: a reducer of which little is known, completed by design rules."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from cli.commands import check_reducer
from cli.completion import completed_by, reducer_completions
from cli.options import add_json, number_in, told_in
from cli.written import only_file
from fmu_src.faults import InputFault
from fmu_src.progress import task

if TYPE_CHECKING:
    from reducers.completion.complete import Completion
    from reducers.completion.given import Given
    from reducers.reducer import Reducer
    from studies.catalogue_lost_motion import Meets
    from studies.catalogue_targets import Target
    from studies.completed_ranges import Influence


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    group = sub.add_parser("reducer", help="reducer files: check one, or complete a new one from what a catalogue says")
    actions = group.add_subparsers(dest="action", required=True, metavar="ACTION")

    check_reducer.add_command(actions)
    check_reducer.add_list(actions)
    new = actions.add_parser("new", help="a whole reducer file from ratio, tooth numbers, rated torque and a few measures, by design rules")
    new.add_argument("--ratio", type=ratio_in, required=True, help="ratio with the carrier as output: 1 + pins z2/z1")
    new.add_argument("--pins", type=int, help="pins in the ring: one more than a disc has lobes (default 40, or what the ratio needs: assumed)")
    new.add_argument("--rated", type=number_in("N.m"), required=True, metavar="NM", help="rated output torque [N m]")
    new.add_argument("--lobes", type=int, help="lobes of a disc, where somebody counted them: one less than pins")
    new.add_argument("--diameter", type=number_in("mm"), metavar="MM", help="outer diameter of the housing [mm] (default: the ring follows from the torque)")
    new.add_argument("--speed", type=number_in("rpm"), metavar="RPM", help="rated output speed [rpm] (default 15, usual in catalogues)")
    new.add_argument("--cranks", type=int, help="2 or 3 (default 2, three from 1000 N m on)")
    new.add_argument("--rollers", type=int, help="needle rollers of a crank bearing (default 16)")
    new.add_argument("--lost-motion", type=number_in("arcmin"), metavar="ARCMIN",
                     help="lost motion of the catalogue [arcmin]: the gap of the flanks is made as that asks for; where none is narrow enough, clearance of"
                          " the bearings and play of the first stage, too, within their ranges (not given: 1 bounds that gap)")
    new.add_argument("--stiffness", type=told_in("N.m/arcmin"), metavar="NM/ARCMIN",
                     help="torsional stiffness of the catalogue [N m/arcmin]: the supports of the cranks are made as soft as that asks for")
    new.add_argument(
        "--meet-lost-motion", action="store_true",
        help="end where no gap of the flanks, no clearance and no play within their ranges make that lost motion",
    )  # fmt: skip
    new.add_argument(
        "--known", action="append", default=[], metavar="NAME=VALUE",
        help="a number that was measured, with its unit: --known pin.radius=3mm; what hangs on it follows",
    )  # fmt: skip
    new.add_argument("--name", help="name of the reducer (default: of ratio and torque)")
    new.add_argument("--output", metavar="FILE", help="the reducer file (default NAME.toml)")
    new.add_argument("--overwrite", action="store_true", help="write over a file that is there")
    completed_by(
        new.add_argument("--against", metavar="REDUCER", help="hold what is completed against a full file of the same reducer, of the library or one's own"),
        reducer_completions,
    )
    new.add_argument(
        "--sensitivity", action="store_true",
        help="also say which ranges matter for which signal: the bench at both ends of each (a minute)",
    )
    new.add_argument("--html", metavar="FILE", help="write a page with the parts to scale, and what else is asked for")
    add_json(new, "print numbers, ranges and rules as JSON, nothing else")
    new.set_defaults(run=run_new)


def run_new(options: argparse.Namespace) -> int:
    """The file is written after it was read and checked as any other."""
    from cli.screen import json_text
    from cli.show.new_reducer import show, show_against, show_influences
    from fmu_src.checked_file import write_text
    from reducers.completion.command import usual_name
    from reducers.completion.compare import against
    from reducers.completion.file import text_of
    from reducers.reducer import load_reducer
    from studies.catalogue_lost_motion import as_in_catalogue
    from studies.catalogue_targets import as_json as targets_json
    from studies.catalogue_targets import asked_of, targets_of, tested

    given = given_by(options)
    name = options.name or usual_name(given)
    target = target_of(options.output or f"{name}.toml", "--output", ".toml", options.overwrite)
    page = target_of(options.html, "--html", ".html", options.overwrite) if options.html else None
    with task("completing and checking"):
        completion = as_in_catalogue(given, *catalogue_of(options))
        text = text_of(completion, name)
        reducer = checked(text, target)
    write_text(target, text)
    only_file(target)
    with task("testing its stiffness"):
        test = tested(reducer)
        targets = targets_of(test, asked_of(completion.given))
    found = sensitivity(completion) if options.sensitivity else []
    if page is not None:
        write_page(completion, reducer, found, targets, page)
        only_file(page)
    rows = against(completion, load_reducer(options.against)) if options.against else []
    if options.json:
        compared = {"against": [vars(row) | {"inside": row.inside, "tests": row.tests} for row in rows]} if options.against else {}
        moved = {"sensitivity": [vars(one) | {"share": one.share} for one in found]} if options.sensitivity else {}
        read = None if test is None else {"lost_motion": test.lost_motion_arcmin, "stiffness": test.stiffness_Nm_per_arcmin}
        json_text({"file": str(target)} | as_json(completion) | {"tested": read, "catalogue": targets_json(targets)} | compared | moved)
    else:
        show(completion, name, target, test, targets, command_of(options, completion.given, target))
        if options.against:
            show_against(rows, name, options.against)
        if options.sensitivity:
            show_influences(completion, found)
    return 0


def catalogue_of(options: argparse.Namespace) -> tuple[float | None, "Meets", str]:
    """As ``as_in_catalogue`` takes what the catalogue says."""
    from studies.catalogue_lost_motion import Meets

    told = options.stiffness
    meets = Meets.SURELY if options.meet_lost_motion else Meets.NOT if options.lost_motion is None else Meets.AS_NEAR_AS_IT_GOES
    return (None if told is None else told.value), meets, ("" if told is None else told.text)


def command_of(options: argparse.Namespace, given: "Given", target: Path) -> list[str]:
    """The command as it was given, that it writes over its files but not: whoever types it says so."""
    from reducers.completion.command import words_of

    asked = [word for name in ("name", "against", "html") if (value := getattr(options, name)) for word in (f"--{name}", value)]
    return [*words_of(given), *asked, *(["--sensitivity"] if options.sensitivity else []), "--output", str(target)]


def sensitivity(completion: "Completion") -> "list[Influence]":
    from studies.completed_ranges import influences

    with task("running the bench at the ends of each range", total=2 * len(completion.dials) + 1) as running:
        return influences(completion, advance=running.advance)


def write_page(completion: "Completion", reducer: "Reducer", found: "list[Influence]", targets: "list[Target]", path: Path) -> None:
    from pages.render import rendered_sections, written
    from studies.report.completed import page_of

    with task("drawing"):
        written(rendered_sections(page_of(completion, reducer, found, targets)), path)


def given_by(options: argparse.Namespace) -> "Given":
    from reducers.completion.given import given_with
    from reducers.completion.known import known_numbers

    return given_with(
        ratio=options.ratio, pins=options.pins, rated=options.rated, lobes=options.lobes, diameter=options.diameter, speed=options.speed,
        cranks=options.cranks, rollers=options.rollers, lost_motion=options.lost_motion, known=known_numbers(options.known),
    )  # fmt: skip


def ratio_in(text: str) -> float:
    """As a catalogue prints it, too: 1:121."""
    from reducers.completion.given import of_ratio

    try:
        return float(of_ratio(text))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no ratio; write 121, or 1:121") from None


def target_of(text: str, option: str, ending: str, overwrite: bool) -> Path:
    """Where a file goes, checked before the work."""
    path = Path(text)
    if path.suffix != ending:
        raise InputFault(f"{option} {path}: the name must end in {ending}")
    if path.is_dir():
        raise InputFault(f"{option} {path} is a folder; give a file name in it that ends in {ending}")
    if path.exists() and not overwrite:
        raise InputFault(f"{option} {path} exists already and is not overwritten; give another name, or --overwrite")
    return path


def checked(text: str, path: Path) -> "Reducer":
    """The reducer of the text, read as a file of that name would be."""
    import tomllib

    from reducers.reducer import reducer_of

    try:
        return reducer_of(tomllib.loads(text), path)
    except InputFault as fault:
        raise InputFault(f"no reducer follows from what is given, and {path} is not written: {fault}; look at the units of what is given") from None


def as_json(completion: "Completion") -> dict[str, object]:
    return {
        "numbers": [
            {"name": n.name, "unit": n.unit, "value": n.value, "range": [n.low, n.high], "source": n.source, "dials": list(n.dials)}
            for n in completion.numbers.values()
        ],
        "dials": [vars(dial) for dial in completion.dials],
        "doubts": completion.doubts,
    }  # fmt: skip
