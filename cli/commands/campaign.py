"""``rvwear campaign from``, ``check``, ``template`` and ``from-rv-te``."""

import argparse
import shlex
from typing import TYPE_CHECKING

from cli.commands import campaign_from
from cli.options import add_json, add_reducer
from cli.written import say_file
from discrepancy.campaign.quantities import QUANTITIES, USUAL
from fmu_src.progress import task

if TYPE_CHECKING:
    from discrepancy.campaign.model import Campaign


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    campaign = sub.add_parser("campaign", help="measurement campaigns: make one from files or public data, check one, write an empty one")
    actions = campaign.add_subparsers(dest="action", required=True, metavar="ACTION")

    campaign_from.add_command(actions)

    check = actions.add_parser("check", help="what is missing, and what could not be told apart")
    check.add_argument("folder", help="folder with campaign.toml")
    check.add_argument("--data", metavar="FOLDER", help="where the data files are (default: as campaign.toml says)")
    check.add_argument(
        "--separable", action="store_true",
        help="also reckon, before the measurement too, which effects the best possible test could not tell apart here (takes a minute or so)",
    )  # fmt: skip
    add_json(check, "print findings as JSON, nothing else")
    check.set_defaults(run=run_check)

    template = actions.add_parser("template", help="write an empty campaign to fill in")
    template.add_argument("folder", help="folder to write to; nothing in it is overwritten")
    template.add_argument(
        "--quantities", nargs="+", metavar="QUANTITY", default=list(USUAL),
        help=f"what is measured (default {' '.join(USUAL)}); of {', '.join(QUANTITIES)}",
    )  # fmt: skip
    template.add_argument("--format", default="csv", help="of the data files: csv or parquet (default csv)")
    add_reducer(template, "name or file of the reducer (default RV20E-121)")
    add_json(template, "print the names of the files as JSON, nothing else")
    template.set_defaults(run=run_template)

    rv = actions.add_parser("from-rv-te", help="make a campaign of your clone of XiLab-Robotics/Physics-Informed-Neural-Networks (a real RV reducer, ratio 81)")
    rv.add_argument("source", metavar="CLONE", help="the clone's folder, or a table of orders (.csv) made of it")
    rv.add_argument("folder", metavar="OUT", help="folder to write to; nothing in it is overwritten")
    rv.add_argument("--reducer", metavar="FILE", help="reducer file for that reducer (default: state its ratio and rated torque)")
    rv.add_argument("--rated", type=float, default=1600.0, metavar="NM", help="rated torque [N m] stated without a reducer file (default 1600, assumed)")
    rv.add_argument("--orders", type=float, nargs="+", metavar="K", help="orders per turn of the output to take from curves (default: the ten of the source)")
    rv.add_argument("--noise", metavar="NUMBER", help='standard deviation of each number of an order, for instance "0.3 arcsec" (default: that, assumed)')
    rv.add_argument("--held-out", type=float, default=0.2, metavar="SHARE", help="share of the whole conditions that is held out (default 0.2)")
    rv.add_argument("--means", action="store_true", help="use the means (order 0), too: all runs share one unknown zero")
    add_json(rv, "print what was made as JSON, nothing else")
    rv.set_defaults(run=run_from_rv_te)


def run_check(options: argparse.Namespace) -> int:
    """Exit code 1 if the campaign allows no diagnosis."""
    from cli.screen import json_text
    from cli.show.campaign import show, show_separability
    from discrepancy.campaign.check import check_campaign
    from discrepancy.campaign.load import load_campaign
    from discrepancy.doubts.locked_doubts import locked_doubts
    from discrepancy.doubts.plausible import scale_doubts

    with task("reading the campaign"):
        campaign = load_campaign(options.folder, options.data)
    with task("holding its scales against the model"):
        doubts = scale_doubts(campaign) + locked_doubts(campaign)
    check = check_campaign(campaign, doubts)
    found = None
    if options.separable:
        from discrepancy.experiment.separability import separability

        with task("holding every effect against every other"):
            found = separability(campaign)
    if options.json:
        json_text(check.as_json() | ({"separability": found.as_json()} if found else {}))
    else:
        show(check)
        if found:
            show_separability(found)
        if not check.problems and (line := compare_line(campaign, options)):
            print(f"next  {line}")
    return 1 if check.problems else 0


def compare_line(campaign: "Campaign", options: argparse.Namespace) -> str:
    """The command that goes on from a check, with what this one was given; empty where the campaign names no reducer that a model could begin with."""
    if campaign.reducer is None:
        return ""
    return shlex.join(["rvwear", "compare", campaign.reducer.as_named, options.folder, *(["--data", options.data] if options.data else [])])


def run_template(options: argparse.Namespace) -> int:
    """Write the files and name them."""
    from cli.screen import json_text
    from discrepancy.campaign.template import write_template

    files = write_template(options.folder, tuple(dict.fromkeys(options.quantities)), options.format, options.reducer)
    if options.json:
        json_text({"files": [str(path) for path in files]})
    else:
        for path in files:
            say_file(path)
        print(f"fill in the files, then: rvwear campaign check {shlex.quote(str(options.folder))}")
    return 0


def run_from_rv_te(options: argparse.Namespace) -> int:
    """Exit code 1 if files had to be left out."""
    from pathlib import Path

    from cli.screen import json_text
    from discrepancy.campaign.from_rv_te import ORDERS, measured_in
    from discrepancy.campaign.write_rv_te import write_campaign

    runs, wrong = measured_in(Path(options.source), options.orders or ORDERS)
    files = write_campaign(Path(options.folder), runs, options.reducer, options.rated, options.noise, options.held_out, options.means)
    conditions = len({run.condition for run in runs})
    if options.json:
        json_text({"files": [str(path) for path in files], "runs": len(runs), "conditions": conditions, "left_out": wrong})
    else:
        for path in files:
            say_file(path)
        print(f"{len(runs)} runs in {conditions} conditions; rvwear campaign check {shlex.quote(str(options.folder))}")
        for text in wrong:
            print(f"left out: {text}")
    return 1 if wrong else 0
