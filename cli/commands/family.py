"""``rvwear family``: a whole series from its catalogue, with the same few dials for all sizes."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Any

from cli.options import add_json, page_path
from cli.written import only_file
from fmu_src.faults import InputFault
from fmu_src.progress import task

if TYPE_CHECKING:
    from studies.family import Member


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    family = sub.add_parser("family", help="eight sizes of the RV-E series from catalogue numbers, no dial for one size alone, beside the catalogue")
    family.add_argument("--dial", action="append", default=[], metavar="NAME=VALUE", help="another value of a dial, for all sizes: --dial support_share=4")
    family.add_argument("--fit", action="store_true", help="also fit the dial support_share anew to the stiffness of all sizes together")
    family.add_argument("--html", metavar="FILE", help="write a page that draws where the compliance sits, and what is missing")
    add_json(family)
    family.set_defaults(run=run_family)


def run_family(options: argparse.Namespace) -> int:
    from cli.screen import json_text
    from cli.show.family import show_family
    from studies.family import DIALS, FIXED, family, fitted_share
    from studies.family_marks import marks

    dials, page = dict(DIALS) | dials_of(options.dial), page_path(options.html)
    members = family(dials)
    fitted = None
    if options.fit:
        with task("fitting the supports"):
            fitted = fitted_share(dials)
    if page:
        write_page(dials, members, page)
        only_file(page)
    if options.json:
        json_text({"dials": dials, "fixed": FIXED, "support_share_fitted": fitted, "sizes": [as_json(one) for one in members],
                   "marks": [vars(mark) for mark in marks(members)]})
    else:
        show_family(dials, members, fitted)
    return 0


def dials_of(texts: list[str]) -> dict[str, float]:
    """By name; what there is and how far it goes is checked where it is used."""
    found = {}
    for text in texts:
        name, equals, value = text.partition("=")
        try:
            found[name.strip()] = float(value)
        except ValueError:
            equals = ""
        if not equals:
            raise InputFault(f"--dial {text}: write NAME=VALUE with a plain number, for instance --dial support_share=4")
    return found


def as_json(one: "Member") -> dict[str, Any]:
    table = [{"load_over_rated": share, "output_rpm": rpm, "efficiency_percent": value} for (share, rpm), value in one.efficiency.items()]
    more = {"over_catalogue": one.over_catalogue, "missing_arcmin_per_Nm": one.missing, "missing_over_crank_supports": one.missing_at_cranks}
    return vars(one) | {"size": vars(one.size), "efficiency": table} | more


def write_page(dials: dict[str, float], members: "list[Member]", path: Path) -> None:
    from pages.render import rendered_sections, written
    from studies.report.family import page_of

    with task("drawing"):
        written(rendered_sections(page_of(dials, members)), path)
