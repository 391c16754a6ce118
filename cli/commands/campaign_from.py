"""``rvwear campaign from``: a campaign folder from files as a bench writes them."""

import argparse
import re
import shlex
import sys
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from cli.completion import completed_by, reducer_completions
from cli.options import REDUCER_HELP, add_json
from cli.written import only_file
from fmu_src.faults import InputFault
from fmu_src.progress import task

if TYPE_CHECKING:
    from discrepancy.campaign.guess.said import Doubt
    from discrepancy.campaign.guess.wishes import Wishes

# The options that a remedy begins with, and what belongs to them.
OPTION = r"--[a-z-]+ (?:'[^']*'|[^\s,;]+)"
FIRST_OPTIONS = re.compile(rf"{OPTION}(?: {OPTION})*")


def add_command(actions: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    command = actions.add_parser(
        "from", help="write campaign.toml for measurement files: columns, units, conditions and repetitions are guessed, what is not sure is said"
    )
    command.add_argument("files", nargs="+", metavar="FILE", help="measurement files, or folders that hold some (those below count, results and fmus do not)")
    command.add_argument("--output", metavar="FOLDER", help="where campaign.toml goes (default: the folder of the files); nothing is overwritten")
    usual = " (default: the one that lines above the tables name, else it is asked for)"
    completed_by(command.add_argument("--reducer", help=REDUCER_HELP.rpartition(" (")[0] + usual), reducer_completions)
    command.add_argument(
        "--names", action="append", default=[], metavar="PATTERN",
        help="what file names say, for instance 'te_{load}Nm_{speed}rpm_{replicate}'; also {input_speed} {output_speed} {temperature} {hours} {locked_at}"
        " {direction} {mounting} {condition} {any}; units beside numbers are read, {load:in-lbf} says one that names have not;"
        " once for each kind of name: the first that fits a file counts, and files that none fits are guessed",
    )  # fmt: skip
    for option, form, text in (
        ("--unit", "COLUMN=UNIT", "unit of a column, where the guess is wrong; FILES:COLUMN=UNIT for some files ('loop*:y=arcmin')"),
        ("--column", "ROLE=COLUMN", "what a column is: value, angle, input_angle, torque, time, output_speed, temperature ... (docs/campaigns.md);"
         " FILES:ROLE=COLUMN for some files"),
        ("--scale", "COLUMN=FACTOR", "what a column is multiplied by ('y=0.001'; -1: the other sense); FILES:COLUMN=FACTOR for some files"),
        ("--counts", "COLUMN=STEPS", "steps a turn of a column that counts an encoder's"),
        ("--quantity", "FILES=QUANTITY", "what files hold ('loop*=hysteresis'); QUANTITY alone for all"),
        ("--condition", "KEY=VALUE", "what no file says ('output_speed=15 rpm'); NAME:KEY=VALUE for one condition; locked_at=named: the input of loops was"
         " locked at the one angle that their names hold; input_speed=named or output_speed=named: the speeds that names and heads say are of that shaft"),
        ("--tag", "KEY=WORD", "what measurements are of: locked=input or output; surface=flank, pin, inner_race or outer_race; disc=1 ..."),
        ("--zero", "QUANTITY=absolute", "the zero of transmission_error, hysteresis or transmission_order is known, so that its mean counts"
         " (default: free, it is taken off)"),
    ):
        command.add_argument(option, action="append", default=[], metavar=form, help=text)
    command.add_argument(
        "--angle-of", choices=("output", "input"),
        help="whose angle transmission errors stand over: of an encoder on the output, which lags under load (assumed), or the input's over the ratio",
    )  # fmt: skip
    command.add_argument("--held-out", nargs="*", metavar="CONDITION", help="conditions to keep for the test (default: proposed); none without a name")
    command.add_argument("--overwrite", action="store_true", help="write campaign.toml anew where there is one")
    command.add_argument("--dry-run", action="store_true", help="show what would be written, write nothing")
    add_json(command, "print the guesses with their reasons as JSON, nothing else")
    command.set_defaults(run=run_from)


def run_from(options: argparse.Namespace) -> int:
    """Show the guesses, write the file, name the command that compares; exit code 1 where the file lacks what that command needs."""
    from cli.screen import json_text
    from cli.show.guesses import show
    from discrepancy.campaign.angle_doubts import angle_doubts
    from discrepancy.campaign.design import Design
    from discrepancy.campaign.findings import copied, samples
    from discrepancy.campaign.guess.propose import propose
    from discrepancy.campaign.guess.write import campaign_text, checked, name_of, write_campaign
    from discrepancy.doubts.plausible import scale_doubts

    files = [Path(file) for file in options.files]
    folder = Path(options.output) if options.output else (files[0] if files[0].is_dir() else files[0].parent)
    with task("reading the files"):
        proposal = propose(files, wishes_of(options, options.reducer), name_of(folder))
    if not options.reducer and (reducer := proposal.named or asked(options)):
        proposal = proposal.of(reducer)
    with task("checking what was read"):
        campaign = checked(proposal) if proposal.reducer else None
        findings = [found for search in (copied, samples) for found in search(Design(campaign))] + angle_doubts(campaign) if campaign else []
    if campaign:
        with task("holding its scales against the model"):
            findings += scale_doubts(campaign, lives=False)
    step = ["campaign", "check"] if proposal.needs else ["compare", str(proposal.reducer)]
    command = shlex.join(["rvwear", *step, str(folder)])
    text = campaign_text(proposal, folder)
    code = 1 if proposal.needs else 0
    if not options.dry_run:
        write_campaign(proposal, folder, options.overwrite)
    if options.json:
        more = {"folder": str(folder), "written": not options.dry_run, "text": text, "next": command}
        json_text(proposal.as_json() | {"findings": [asdict(found) for found in findings]} | more)
        return code
    show(proposal, findings, bool(options.reducer))
    if not options.dry_run:
        only_file(folder / "campaign.toml")
    if options.dry_run:
        print(f"\n{text}")
        print(f"nothing is written; without --dry-run it would be {folder / 'campaign.toml'}")
    elif proposal.needs:
        said = "is written, but lacks what is needed; say it in the file, or once more on the command line"
        # What may be added as it is printed: no angle that has to be put in first.
        ready = [doubt for doubt in proposal.unplaced if "..." not in doubt.remedy]
        print(f"{folder / 'campaign.toml'} {said}:\n  {again(options, [*proposal.needs, *ready])}")
    else:
        guesses = [doubt for doubt in proposal.doubts if doubt.so]
        locked = "where the input was locked" if proposal.unplaced else ""
        if guesses:
            also = f", and {locked}," if locked else ""
            print(f"this line states what was guessed{also} so that it is not asked again; leave out what is wrong\n"
                  f"  {again(options, proposal.unplaced, guesses)}")  # fmt: skip
        elif locked:
            print(f"{locked} is said by (next time with the first call)\n  {again(options, proposal.unplaced)}")
        if proposal.doubts or findings:
            command = f"{shlex.join(['rvwear', 'campaign', 'check', str(folder)])}\n  {command}"
        print(f"{folder / 'campaign.toml'} is written; {'look at what is not sure, then' if proposal.doubts or findings else 'next'}:\n  {command}")
    return code


def again(options: argparse.Namespace, asked: "Sequence[Doubt]", guesses: "Sequence[Doubt]" = ()) -> str:
    """The command as it was given, to be completed by what is asked, and with ``guesses`` as they were made; names that could say a torque are asked to."""
    words = ["rvwear", "campaign", "from", *in_short(options.files)]
    for option in ("output", "reducer", "angle-of"):
        words += [f"--{option}", given] if (given := getattr(options, option.replace("-", "_"))) else []
    for option in ("names", "unit", "column", "scale", "counts", "quantity", "condition", "tag", "zero"):
        words += [word for given in getattr(options, option) for word in (f"--{option}", given)]
    if options.held_out is not None:
        words += ["--held-out", *options.held_out]
    needed = dict.fromkeys(match[0] for need in asked if (match := FIRST_OPTIONS.match(need.remedy)))
    return " ".join([shlex.join([*words, "--overwrite"]), *dict.fromkeys(doubt.so for doubt in guesses), *needed])


def in_short(files: Sequence[str]) -> list[str]:
    """``files`` as given; the folder where they are all that it holds, as a shell makes them of ``folder/*``."""
    from discrepancy.campaign.measurement_files import measurement_files

    folders = {Path(file).parent for file in files}
    if len(files) == 1 or len(folders) != 1 or {Path(file) for file in files} != set(measurement_files(folder := folders.pop())):
        return list(files)
    return [str(folder)]


def asked(options: argparse.Namespace) -> str | None:
    """The reducer, from whoever sits at the terminal; None where nobody does, and in a dry run, which says that it is missing."""
    if options.dry_run or options.json or not sys.stdin.isatty():
        return None
    return input(f"Which reducer was measured ({REDUCER_HELP.rpartition(' (')[0]})? ").strip() or None


def wishes_of(options: argparse.Namespace, reducer: str | None) -> "Wishes":
    from discrepancy.campaign.guess.wishes import Wishes

    counts = pairs("--counts", options.counts)
    for column, steps in counts.items():
        if not steps.strip().isdigit() or int(steps) == 0:
            raise InputFault(f"--counts {column}={steps}: the steps of one turn are a whole number, for instance {column}=4096")
    scales = {column: factor_of(column, text) for column, text in pairs("--scale", options.scale).items()}
    quantities = pairs("--quantity", [text if "=" in text else f"*={text}" for text in options.quantity])
    return Wishes(
        reducer, tuple(options.names), pairs("--unit", options.unit), pairs("--column", options.column), {c: float(n) for c, n in counts.items()}, quantities,
        pairs("--condition", options.condition), None if options.held_out is None else tuple(options.held_out), pairs("--tag", options.tag),
        options.angle_of, scales, pairs("--zero", options.zero),
    )  # fmt: skip


def factor_of(column: str, text: str) -> float:
    """InputFault where it is no number."""
    try:
        return float(text)
    except ValueError:
        raise InputFault(f"--scale {column}={text}: the factor is a number, for instance {column}=0.001") from None


def pairs(option: str, texts: Sequence[str]) -> dict[str, str]:
    """``NAME=VALUE`` as name and value; InputFault without the sign."""
    found = {}
    for text in texts:
        name, equals, value = text.rpartition("=")
        if not equals or not name.strip() or not value.strip():
            raise InputFault(f"{option} {text}: write NAME=VALUE, in quotes where blanks are in it")
        found[name.strip()] = value.strip()
    return found
