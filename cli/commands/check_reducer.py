"""``rvwear reducer check``: what a reducer file says, what follows, what does not fit, and the parts to scale."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from cli.completion import completed_by, reducer_completions
from cli.exporting import WIDTH_HELP, check_exports, write_exports
from cli.options import add_json
from cli.written import say_file
from fmu_src.progress import task

if TYPE_CHECKING:
    from reducers.checking import Check
    from studies.catalogue_targets import Target


def add_command(actions: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    command = actions.add_parser("check", help="whether the numbers of a reducer file fit each other; what follows from them, what is usual; the parts drawn")
    completed_by(command.add_argument("reducer", help="reducer file, or a name of the library"), reducer_completions)
    command.add_argument("--html", metavar="FILE", help="write a page with the parts to scale")
    command.add_argument("--picture", action="append", default=[], metavar="FILE", help="draw the parts as .svg, .pdf or .png")
    command.add_argument("--width", metavar="WIDTH", help=WIDTH_HELP)
    add_json(command, "print numbers and what does not fit as JSON, nothing else")
    command.set_defaults(run=run_check, export=[])


def add_list(actions: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    command = actions.add_parser("list", help="the reducers of the library, with a line each")
    add_json(command, "print as JSON, nothing else")
    command.set_defaults(run=run_list)


def run_list(options: argparse.Namespace) -> int:
    from cli.screen import json_text
    from reducers.library import available
    from reducers.reducer import load_reducer

    found = {name: load_reducer(name).description for name in available()}
    if options.json:
        json_text({"reducers": found})
    else:
        longest = max(map(len, found))
        print("\n".join(f"{name:<{longest}}  {text}" for name, text in found.items()))
    return 0


def run_check(options: argparse.Namespace) -> int:
    """Exit code 2 if no such reducer can be made."""
    from cli.screen import json_text
    from cli.show.check_reducer import show
    from reducers.checking import check
    from reducers.reducer import load_reducer
    from studies.catalogue_targets import as_json as targets_json
    from studies.catalogue_targets import held_against

    check_exports(options)
    with task("checking"):
        found, targets = held_against(check(load_reducer(options.reducer)))
    if options.json:
        json_text(as_json(found) | {"catalogue": targets_json(targets)})
    else:
        show(found, targets)
    if options.html or options.picture:
        draw(options, found, targets)
    return 2 if found.faults else 0


def as_json(found: "Check") -> dict[str, object]:
    return {
        "reducer": found.reducer.name, "faults": found.faults, "doubts": found.doubts, "figures": found.figures, "completing": found.completing,
        "numbers": [vars(n) for n in found.numbers],
    }  # fmt: skip


def draw(options: argparse.Namespace, found: "Check", targets: "list[Target]") -> None:
    from pages.render import rendered_sections, written
    from studies.report.checked import page_of, parts

    with task("drawing"):
        if options.html:
            say_file(written(rendered_sections(page_of(found, targets)), Path(options.html)))
        write_exports(options, lambda: (), lambda: parts(found))
