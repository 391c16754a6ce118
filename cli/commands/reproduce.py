"""``rvwear reproduce``: the claims of the sources, held against the computation."""

import argparse
from pathlib import Path

from cli.exporting import add_exports, check_exports, write_exports
from cli.options import add_json, require_place
from cli.written import say_file
from fmu_src.faults import InputFault
from fmu_src.progress import say


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    claims = sub.add_parser("reproduce", help="every claim of the sources held against the computation")
    claims.add_argument("claims", nargs="*", help="ids or prefixes: T, N16, C (default all)")
    claims.add_argument("--output", help="the page (default results/reproduce.html of all claims; reproduce_T24.html of T24 alone, ..._set.html with --set)")
    claims.add_argument("--list", action="store_true", dest="listed", help="say what the claims are, compute nothing")
    claims.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE",
        help="another number of the reducers than the sources': bearing.clearance=10um; verdicts need not hold then, and the exit code is 0;"
        " what it does not move is said (each claim is computed with the sources' numbers, too, unless a command did so before)",
    )  # fmt: skip
    add_json(claims)
    add_exports(claims)
    claims.set_defaults(run=reproduce)


def reproduce(options: argparse.Namespace) -> int:
    """``rvwear reproduce``: the sources' claims, judged."""
    if options.listed:
        return show_list(options)
    from cli import screen
    from cli.altered import note_of, noted_figure, noted_tables
    from reproduce.judging import run as judge
    from reproduce.moved import unmoved_in
    from reproduce.page import write_page
    from reproduce.statements import stated
    from reproduce.table import as_json, holdings, print_table, tables_of

    check_exports(options)
    if options.picture and not any(one.has_figure for one in stated(options.claims or None).values()):
        drawn = ", ".join(name for name, one in stated().items() if one.has_figure)
        raise InputFault(f"--picture {options.picture[0]}: {', '.join(options.claims)} has no figure; these claims have: {drawn}")
    page = Path(options.output or default_page(options.claims, options.set))
    require_place(page, "--output", ".html")
    require_settings(options.set)
    claims = judge(options.claims or None, say, options.set)
    # Of the last, as it is reached with all reducers that were altered.
    altered = claims[-1].altered if claims else ()
    note, still = note_of(altered), unmoved_in(claims, options.set)
    write_page(claims, page, altered, still)
    if options.json:
        unmoved = [claim.id for claim in claims if not claim.is_moved]
        screen.json_text(as_json(claims) | {"page": str(page), "set": options.set, "altered": list(altered), "unmoved": unmoved})
    else:
        print_table(claims)
        if note:
            print(note)
        if still:
            print(still)
        say_file(page, "page  ")
    figures = [
        noted_figure(figure, note_of(claim.drawn_with[k], claim.figures_moved[k]) if claim.drawn_with else "")
        for claim in claims for k, figure in enumerate(claim.figures)
    ]  # fmt: skip
    write_exports(options, lambda: noted_tables(tables_of(claims), note), lambda: figures, holdings(claims))
    return 0 if options.set or all(claim.stands for claim in claims) else 1


def default_page(claims: list[str], changes: list[str]) -> str:
    """Named after what was asked: a page of some claims, or of other numbers, does not take the place of that of all."""
    from fmu_src.file_name import file_name

    name = "_".join(("reproduce", *(claim.upper() for claim in claims)))
    return f"results/{file_name(name)}{'_set' if changes else ''}.html"


def require_settings(changes: list[str]) -> None:
    """Before the work: InputFault for a number that the sources' reducers do not have, or in a unit that does not fit."""
    from reproduce.context import BX, REAL_BX, REAL_RV, RV, Context

    context = Context(changes=changes)
    for name in (BX, RV, REAL_BX, REAL_RV) if changes else ():
        context.reducer(name)


def show_list(options: argparse.Namespace) -> int:
    """Id, title and words of each claim, and whether it draws anything."""
    from cli import screen
    from reproduce.statements import stated

    found = stated(options.claims or None)
    if options.json:
        told = {name: {"source": one.source, "title": one.title, "says": one.says, "figure": one.has_figure} for name, one in found.items()}
        screen.json_text({"claims": told})
        return 0
    table = screen.dense("")
    for head in ("id", "claim", "figure", "what the source says"):
        table.add_column(head, overflow="fold")
    for name, one in found.items():
        table.add_row(name, one.title, "yes" if one.has_figure else "", one.says)
    screen.console(screen.WIDTH).print(table)
    return 0
