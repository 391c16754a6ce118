"""``rvwear campaign from``, ``rvwear campaign check`` and ``rvwear campaign template``."""

import argparse

from cli.commands import campaign_from
from cli.options import add_json, add_reducer
from discrepancy.campaign.quantities import QUANTITIES, USUAL
from fmu_src.progress import task


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    campaign = sub.add_parser("campaign", help="measurement campaigns: make one from files, check one, write an empty one")
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


def run_check(options: argparse.Namespace) -> int:
    """Exit code 1 if the campaign allows no diagnosis."""
    from cli.screen import json_text
    from cli.show.campaign import show, show_separability
    from discrepancy.campaign.check import check_campaign
    from discrepancy.campaign.load import load_campaign
    from discrepancy.plausible import scale_doubts

    with task("reading the campaign"):
        campaign = load_campaign(options.folder, options.data)
    with task("holding its scales against the model"):
        doubts = scale_doubts(campaign)
    check = check_campaign(campaign, doubts)
    found = None
    if options.separable:
        from discrepancy.separability import separability

        with task("holding every effect against every other"):
            found = separability(campaign)
    if options.json:
        json_text(check.as_json() | ({"separability": found.as_json()} if found else {}))
    else:
        show(check)
        if found:
            show_separability(found)
    return 1 if check.problems else 0


def run_template(options: argparse.Namespace) -> int:
    """Write the files and name them."""
    from cli.screen import json_text
    from discrepancy.campaign.template import write_template

    files = write_template(options.folder, tuple(dict.fromkeys(options.quantities)), options.format, options.reducer)
    if options.json:
        json_text({"files": [str(path) for path in files]})
    else:
        for path in files:
            print(path)
        print(f"fill in the files, then: rvwear campaign check {options.folder}")
    return 0
