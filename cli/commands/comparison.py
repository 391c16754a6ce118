"""``rvwear compare``, ``localise``, ``diagnose``, ``extend``, ``ladder`` and ``next``: the loop of model against measurement."""

import argparse
import shlex
import sys
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from cli.commands.drafting import run_draft
from cli.commands.going_on import extend_line, line_after, lines_after_extending, named_in, nothing_added, other_lines, refit_text, refusal
from cli.completion import completed_by, reducer_completions
from cli.ending import exit_code
from cli.exporting import add_exports, check_exports, write_exports
from cli.options import NOTHING_ADDED_CODE, add_json, all_cores, folder, page_path
from cli.written import say_file
from fmu_src.faults import InputFault
from fmu_src.held_file import held
from fmu_src.progress import task

if TYPE_CHECKING:
    from discrepancy.campaign.model import Campaign
    from discrepancy.compare import Comparison
    from discrepancy.model_file import ModelFile
    from discrepancy.verdict import Answer, AnswerSoFar

GOES_ON = "the same command goes on from there"
MODEL_HELP = "model file, reducer file or name of a reducer"


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    for name, run, text in (
        ("compare", run_compare, "hold a model against a campaign: error against noise, per signal and condition"),
        ("localise", run_localise, "where a model fails: signals, orders, loads, speeds, temperatures, hours, places"),
        ("diagnose", run_diagnose, "which physical effect a model lacks"),
        ("next", run_next, "the cheapest next experiment that separates what is left"),
    ):
        command = sub.add_parser(name, help=text)
        add_common(command)
        command.set_defaults(run=run)
        if name in ("compare", "diagnose"):
            add_exports(command)
        if name != "next":
            command.add_argument("--fmus", metavar="FOLDER",
                                 help="step RvPlant.fmu and RvWear.fmu of this folder instead of their kernels in this process")
        if name == "diagnose":
            command.add_argument("--draft", metavar="FILE", help="write an effect file from the recovered law, if nothing is named")
    add = sub.add_parser("extend", help="add an effect to a model and judge it on runs that were not used")
    add_common(add)
    add.add_argument("--effect", action="append", metavar="NAME", help="effect, or effect.variant (default: what the diagnosis names)")
    add.add_argument("--draft", metavar="DIR", help="where nothing is named: write the recovered law as an effect into DIR, build, fit and judge it")
    add.add_argument("--name", metavar="NAME", help="with --draft: what the effect is called (default: by what it acts on)")
    add.add_argument("--output", metavar="FILE", help="model file to write (default: the model file itself, or NAME.toml)")
    add.add_argument("--overwrite", action="store_true", help="write over another file that is there")
    add.add_argument("--fmus", metavar="FOLDER", help="build the FMUs of the extended model there")
    add.add_argument("--anyway", action="store_true", help="keep an effect that did not help")
    # Given by --draft, which says itself how a model is used that needs the effect drafted.
    add.add_argument("--drafted", action="store_true", help=argparse.SUPPRESS)
    add.set_defaults(run=run_extend)
    ladder = sub.add_parser("ladder", help="how the error fell, step by step")
    add_model(ladder)
    add_json(ladder, "print the steps as JSON, nothing else")
    add_exports(ladder)
    ladder.add_argument("--html", metavar="FILE", help="write a page with the ladder as a picture")
    ladder.set_defaults(run=run_ladder)


def add_model(command: argparse.ArgumentParser) -> None:
    completed_by(command.add_argument("model", help=MODEL_HELP), reducer_completions)


def add_common(command: argparse.ArgumentParser) -> None:
    add_model(command)
    command.add_argument("campaign", help="folder with campaign.toml")
    command.add_argument("--data", metavar="FOLDER", help="where the data files are (default: as campaign.toml says)")
    add_json(command, "print the result as JSON, nothing else")
    command.add_argument("--html", metavar="FILE", help="write a page with pictures")


def inputs(options: argparse.Namespace) -> "tuple[ModelFile, Campaign]":
    from discrepancy.campaign.load import load_campaign
    from discrepancy.model_file import load_model

    page_path(options.html)
    # Not under the command's own task, which tells from the last time how long it takes.
    with task("reading the campaign"):
        file, campaign = load_model(options.model), load_campaign(options.campaign, options.data)
    campaign.require_fittable()
    return file, campaign


def write_html(options: argparse.Namespace, result: object) -> None:
    if page := page_path(options.html):
        from discrepancy.page import write_page

        write_page(result, page)


def say_page(options: argparse.Namespace) -> None:
    """Where the page is, after everything else; nothing beside JSON."""
    if (page := page_path(options.html)) and not options.json:
        say_file(page, "\npage  ")


def export(options: argparse.Namespace, result: "Comparison | Answer | ModelFile") -> None:
    """As tables and pictures, if they are asked for."""
    if not options.export and not options.picture:
        return
    from discrepancy.page.write import page_of
    from discrepancy.tables import tables_of

    write_exports(options, lambda: tables_of(result), lambda: page_of(result).figures)


def run_compare(options: argparse.Namespace) -> int:
    from cli.screen import json_text
    from cli.show.comparison import show_comparison
    from discrepancy.compare import compare

    check_exports(options)
    given = inputs(options)
    with task("comparing"):
        comparison = compare(*given, jobs=all_cores(), fmus=folder(options.fmus))
    write_html(options, comparison)
    if options.json:
        json_text(comparison.as_json())
    else:
        show_comparison(comparison)
    say_page(options)
    export(options, comparison)
    return 0


def run_localise(options: argparse.Namespace) -> int:
    from cli.screen import console, json_text
    from cli.show.comparison import show_localisation, show_warnings
    from discrepancy.compare import compare

    given = inputs(options)
    with task("localising"):
        comparison = compare(*given, fmus=folder(options.fmus))
    write_html(options, comparison)
    if options.json:
        json_text(comparison.as_json()["localisation"])
    else:
        show_localisation(comparison.diagnostician.localisation)
        show_warnings(console(), comparison.warnings)
    say_page(options)
    return 0


def run_diagnose(options: argparse.Namespace) -> int:
    """Exit code 130 if it was interrupted, 143 if terminated: then it shows what was known by then."""
    from discrepancy.draft.choose import written_to
    from discrepancy.remembered import diagnosed, with_profiles
    from discrepancy.verdict import AnswerSoFar, diagnose

    check_exports(options)
    file, campaign = inputs(options)
    fmus = folder(options.fmus)
    try:
        with task("diagnosing") if fmus else nullcontext():
            answer = diagnose(file, campaign, fmus=fmus) if fmus else diagnosed(file, campaign, jobs=all_cores())
    except AnswerSoFar as stop:
        code = tell_so_far(options, stop, "begin again" if fmus else GOES_ON, draft=None)
        export(options, stop.answer)
        return code
    draft = written_to(answer, Path(options.draft)) if options.draft else None
    with nullcontext() if fmus else with_profiles(answer, file, campaign):
        tell(options, answer, draft=str(draft) if draft else None)
    if not options.json:
        if line := line_after(options, answer):
            print(f"\nnext  {line}")
        if options.draft:
            if draft:
                say_file(draft, "\ndraft  ")
            else:
                print("\nno draft: an effect was named, or no law was recovered that has a place in the units")
    say_page(options)
    export(options, answer)
    return 0


def run_extend(options: argparse.Namespace) -> int:
    """Exit code 3 where nothing was added: the effect did not help on unused runs, or the diagnosis names none that may be added by itself;
    130 and 143 as of ``diagnose``."""
    file, campaign = inputs(options)
    from discrepancy.verdict import AnswerSoFar

    try:
        target = model_target(options, file)
        if options.draft:
            return run_draft(options, file, campaign)
        # Read here and written at the end: nobody else's step is to be lost in between.
        with held(target):
            return add_effect(options, file, campaign, target)
    except AnswerSoFar as stop:
        return tell_so_far(options, stop)


def model_target(options: argparse.Namespace, file: "ModelFile") -> Path:
    """Where the extended model goes, checked before the work: a model file gets its next step, no other file is written over unasked."""
    target = Path(options.output) if options.output else file.path or Path(f"{file.name}.toml")
    if target.exists() and not is_own(file, target) and not options.overwrite:
        option = "--output " if options.output else ""
        raise InputFault(f"{option}{target} exists already and is not overwritten; give another name by --output, or --overwrite")
    return target


def is_own(file: "ModelFile", target: Path) -> bool:
    """Whether that is the file which the model was read from."""
    return file.path is not None and file.path.exists() and target.samefile(file.path)


def tell(options: argparse.Namespace, answer: "Answer", **more: object) -> None:
    """An answer as page and on the screen, or as JSON with ``more``: on the screen whatever becomes of the page, and the page whoever reads no further."""
    from cli.screen import json_text
    from cli.show.comparison import show_answer
    from discrepancy.words.standing_notes import standing_notes

    try:
        write_html(options, answer)
    finally:
        if options.json:
            json_text(answer.as_json() | more)
        else:
            show_answer(answer, standing_notes(answer.model.campaign, answer.model.records))


def tell_so_far(options: argparse.Namespace, stop: "AnswerSoFar", again: str = GOES_ON, **more: object) -> int:
    """What was known when a diagnosis, or that which a command begins with, was interrupted, for this is an answer, too; its exit code."""
    tell(options, stop.answer, **more)
    say_page(options)
    print(f"rvwear {options.command}: interrupted; {again}", file=sys.stderr)
    return exit_code(stop)


def add_effect(options: argparse.Namespace, file: "ModelFile", campaign: "Campaign", target: Path) -> int:
    from cli.screen import json_text
    from cli.show.comparison import show_extension
    from discrepancy.alike.already_there import AlreadyThere
    from discrepancy.extend import DID_NOT_HELP, UnknownEffect, build_units
    from discrepancy.inference.verdict import ONE, SEVERAL
    from discrepancy.model_file import save_model
    from discrepancy.remembered import diagnosed, extended

    names = options.effect
    if not names:
        answer = diagnosed(file, campaign, jobs=all_cores())
        if answer.verdict not in (ONE, SEVERAL):
            return nothing_added(options, answer, refusal(options, answer))
        names = named_in(answer)
    with task(f"adding {', '.join(names)}"):
        try:
            extension = extended(file, campaign, names, anyway=options.anyway, jobs=all_cores(), said=not options.effect)
        except KeyboardInterrupt as stop:
            raise KeyboardInterrupt(f"while {', '.join(names)} was fitted: {target} is as it was; {stop}") from stop
        except UnknownEffect as fault:
            meant = [fault.nearest[0] if name == fault.name else name for name in names] if fault.nearest else []
            raise InputFault(f"{fault}" + (f"\n  {extend_line(options, meant)}" if meant else "")) from None
        except AlreadyThere as fault:
            raise InputFault(f"{fault}; {refit_text(options, file, fault.names)}") from None
    save_model(extension.file, target)
    fmus = []
    if options.fmus and extension.verdict != DID_NOT_HELP:
        with task("building the FMUs"):
            fmus = [str(path) for path in build_units(target, Path(options.fmus))]
    write_html(options, extension)
    if options.json:
        json_text(extension.as_json() | {"file": str(target), "fmus": fmus})
    else:
        show_extension(extension)
        say_file(target, "model  ", "" if extension.step["kept"] else "    # written without it: the model as it was, and what was tried as a step not kept")
        if not extension.step["kept"]:
            again = argparse.Namespace(**vars(options) | {"overwrite": options.overwrite or not is_own(file, target)})
            print(f"to keep it all the same:\n  {extend_line(again, names, anyway=True)}")
        for path in fmus:
            say_file(path, "FMU    ")
        if extension.step["kept"] and not is_own(file, target):
            print(other_lines(options, names, extension.step), end="")
        if extension.step["kept"] and not options.drafted:
            print(f"\n{lines_after_extending(options, str(target))}")
    say_page(options)
    return NOTHING_ADDED_CODE if extension.verdict == DID_NOT_HELP else 0


def run_ladder(options: argparse.Namespace) -> int:
    from cli.screen import json_text
    from cli.show.comparison import show_ladder
    from discrepancy.model_file import load_model

    check_exports(options)
    file = load_model(options.model)
    write_html(options, file)
    if options.json:
        json_text({"model": file.name, "steps": list(file.steps)})
    else:
        show_ladder(file)
    say_page(options)
    export(options, file)
    return 0


def run_next(options: argparse.Namespace) -> int:
    from cli.screen import json_text
    from cli.show.comparison import show_next
    from discrepancy.experiment.next_run import next_run
    from discrepancy.inference.verdict import SET
    from discrepancy.verdict import AnswerSoFar

    given = inputs(options)
    with task("looking for an experiment"):
        try:
            run = next_run(*given, jobs=all_cores())
        except AnswerSoFar as stop:
            return tell_so_far(options, stop)
    write_html(options, run)
    if options.json:
        json_text(run.as_json())
    else:
        show_next(run)
        line = line_after(options, run.answer) if run.asked or not run.result else ""
        # What asks for this command again is no way on.
        if run.answer.verdict != SET and (line or run.asked):
            if line and not line.startswith("rvwear next "):
                print(f"\nnext  {line}")
            if run.asked:
                print(f"then  {shlex.join(['rvwear', 'next', options.model, options.campaign])}    # with the new runs in it: it diagnoses anew")
    say_page(options)
    return 0
