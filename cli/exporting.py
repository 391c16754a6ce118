"""``--export`` and ``--picture``: results for other programs and for papers."""

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING

from cli.written import say_file
from fmu_src.faults import InputFault, MissingPart, MissingParts

if TYPE_CHECKING:
    from exports.tables import Table
    from pages.look import Figure

WIDTH_HELP = "of pictures: single (90 mm, the default), middle (140), double (190), or 85mm, 3.5in ..."


def add_exports(command: argparse.ArgumentParser, pictures: bool = True) -> None:
    command.add_argument("--export", action="append", default=[], metavar="FILE", help="write curves and figures as .csv, .parquet, .mat or .xlsx")
    if not pictures:
        command.set_defaults(picture=[], width=None)
        return
    command.add_argument("--picture", action="append", default=[], metavar="FILE", help="draw as .svg, .pdf or .png at the width of a paper's column")
    command.add_argument("--width", metavar="WIDTH", help=WIDTH_HELP)


def check_exports(options: argparse.Namespace) -> None:
    """Before the work: InputFault for what could not be written after it, MissingPart or MissingParts for all packages that are not there."""
    if options.width and not options.picture:
        raise InputFault(f"--width {options.width} without --picture FILE: a width is one of pictures; say --picture figure.svg, too")
    checks: list[tuple[Callable[[Path], None], str]] = []
    if options.export:
        from exports.write import require_writable

        checks += [(require_writable, name) for name in options.export]
    if options.picture:
        from pages.paper import require_drawable, width_of

        width_of(options.width or "single")
        checks += [(require_drawable, name) for name in options.picture]
    missing: dict[str, MissingPart] = {}
    for check, name in checks:
        try:
            check(Path(name))
        except MissingPart as fault:
            missing.setdefault(fault.package, fault)
    if len(missing) > 1:
        raise MissingParts(missing.values())
    for one in missing.values():
        raise one


def write_exports(
    options: argparse.Namespace, tables: "Callable[[], Sequence[Table]]", figures: "Callable[[], Sequence[Figure]]",
    holds: Mapping[str, str] = MappingProxyType({}),
) -> None:  # fmt: skip
    """Write what was asked for and say where it is, and of tables with a file each what they hold, by name; on stderr, where JSON goes to stdout."""
    written: list[Path] = []
    held: dict[Path, str] = {}
    if options.export:
        from exports.write import beside, write_tables

        made = tables()
        for name in options.export:
            of_tables = write_tables(made, Path(name))
            written += of_tables
            if len(of_tables) > 1:
                held |= {own: f"  {holds[table.name]}" for table, own in beside([t for t in made if t.columns], Path(name)) if table.name in holds}
    if options.picture:
        from pages.paper import width_of, write_pictures

        drawn = figures()
        for name in options.picture:
            written += write_pictures(drawn, Path(name), width_of(options.width or "single"))
    for path in written:
        if getattr(options, "json", False):
            print(path, file=sys.stderr)
        else:
            say_file(path, more=held.get(path, ""))
