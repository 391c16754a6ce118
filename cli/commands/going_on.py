"""The command lines with which one goes on from an answer."""

import argparse
import math
import shlex
import sys
from typing import TYPE_CHECKING

from cli.options import NOTHING_ADDED_CODE

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from typing import Any

    from discrepancy.model_file import ModelFile
    from discrepancy.verdict import Answer


def line_after(options: argparse.Namespace, answer: "Answer") -> str:
    """The command with which one goes on from a diagnosis; empty where there is nothing that a command could add."""
    from discrepancy.compare import another_reducer
    from discrepancy.held_names import LOCKED_AT, LOCKED_POSITION
    from discrepancy.inference.verdict import BASE_OFF, INCOMPLETE, NONE, SET, UNKNOWN

    if answer.verdict == NONE:
        asked = "questions that are" if len(answer.untold) > 1 else "question that is"
        why = f"of this model, with the {asked} open" if answer.untold else "of this model: nothing is missing here"
        return f"{shlex.join(['rvwear', 'build', '--reducer', options.model, '--output', 'units'])}    # the FMUs {why}"
    data = ["--data", options.data] if options.data else []
    if named := another_reducer(answer.model):
        words = ["rvwear", "diagnose", named.as_named, options.campaign, *data]
        return f"{shlex.join(words)}    # the reducer that the campaign names"
    if answer.verdict == BASE_OFF and not numbers_of(answer):
        return ""
    # What is not sure is added by name alone.
    foremost = first_to_add(answer)
    by_name = [word for name in (foremost["candidates"][:1] if foremost else named_in(answer)) for word in ("--effect", name)]
    drafted = "extend", ["--draft", "effects"], "makes an effect of what is recovered"
    command, more, what = {
        SET: ("next", [], "the measurement that tells them apart"),
        UNKNOWN: drafted if law_with_a_form(answer) else ("next", [], "where to measure more of it"),
        BASE_OFF: ("extend", [*by_name, "--output", "better.toml"], "corrects the base model"),
        INCOMPLETE: ("extend", [*by_name, "--output", "better.toml"],
                     f"adds {'the likeliest of these' if foremost else 'what is named'}, and judges it on runs that were not used"),
    }.get(answer.verdict, ("extend", ["--output", "better.toml"], "adds it, and judges it on runs that were not used"))
    if command == "extend" and any(effect["name"] == LOCKED_POSITION for effect in answer.effects):
        what += f"; a position belongs to the bench: state {LOCKED_AT} in the campaign's condition instead where it is known"
    return f"{shlex.join(['rvwear', command, options.model, options.campaign, *data, *more])}    # {what}"


def lines_after_extending(options: argparse.Namespace, model: str) -> str:
    """The command lines with which one goes on from a model that has what was missing."""
    more = [options.campaign, *(["--data", options.data] if options.data else [])]
    compared, diagnosed = (shlex.join(["rvwear", command, model, *more]) for command in ("compare", "diagnose"))
    return f"next  {compared}    # what is left beside it\nthen  {diagnosed}    # whether more is missing"


def nothing_added(options: argparse.Namespace, answer: "Answer", why: str) -> int:
    """Says why ``extend`` leaves the model as it is, with ``--json`` as part of the diagnosis; its exit code."""
    from cli.screen import json_text

    if options.json:
        json_text(answer.as_json() | {"nothing_added": why})
    print(f"rvwear extend: {why}", file=sys.stderr)
    return NOTHING_ADDED_CODE


def refusal(options: argparse.Namespace, answer: "Answer") -> str:
    """Why nothing is added unasked, and the command lines that add what comes into question."""
    from discrepancy.inference.verdict import BASE_OFF
    from discrepancy.verdict import added_of

    found = answer.diagnosis
    start = f"the diagnosis says {answer.verdict!r} ({found.reason}): nothing is added by itself"
    if answer.verdict == BASE_OFF:
        numbers = numbers_of(answer)
        takes = f"; this line takes the number as it was measured, as a setting of the model:\n  {extend_line(options, numbers)}" if numbers else ""
        declared = answer.diagnosis.base_off[0].name.partition("[")[0] if numbers else ""
        return start + takes + (f"\nor declare it in campaign.toml, [nuisances.{declared}], so that every command calibrates it" if declared else "")
    if answer.confusable:
        lines = [extend_line(options, [candidate]) for effect in answer.effects for candidate in effect["candidates"]]
        return "\n  ".join([f"{start}, for {', '.join(answer.confusable)} cannot be told apart; one of these lines adds one of them:", *lines])
    named = [candidate for effect in answer.effects for candidate in added_of(effect)]
    nearest = named or [rival["name"] for rival in found.rejected[:1]]
    # A law that was recovered without a name can become an effect.
    drafted = f"; this one makes an effect of the law that was recovered:\n  {extend_line(options, (), draft=True)}" if law_with_a_form(answer) else ""
    if not nearest:
        return f"{start}; no effect of the catalogue shows in what was measured{drafted}"
    what = "what is named all the same" if named else "what comes nearest all the same"
    return f"{start}; this line adds {what} and judges it on runs that were held out:\n  {extend_line(options, nearest)}{drafted}"


def extend_line(options: argparse.Namespace, names: "Sequence[str]", anyway: bool = False, draft: bool = False) -> str:
    """The command as it was given, with these effects, or with a draft in the folder ``effects``."""
    words = ["rvwear", "extend", options.model, options.campaign, *(["--draft", "effects"] if draft else [])]
    for name in names:
        words += ["--effect", name]
    for key in ("data", "output", "fmus", "html"):
        if (given := getattr(options, key)) is not None:
            words += [f"--{key}", given]
    words += [f"--{key}" for key in ("json", "overwrite") if getattr(options, key)]
    return shlex.join(words + ["--anyway"] * (anyway or options.anyway))


def other_lines(options: argparse.Namespace, names: "Sequence[str]", step: "Mapping[str, Any]") -> str:
    """The command lines that add, in place of what was added, what fits as well; each to a file of its own."""
    found = []
    for added, others in step.get("other_forms", {}).items():
        for other in others:
            instead = [other if name in (added, added.partition(".")[0]) else name for name in names]
            given = argparse.Namespace(**vars(options) | {"output": f"{other.replace('.', '_')}.toml", "overwrite": False, "html": None, "fmus": None})
            found.append(f"  {extend_line(given, instead)}\n")
    return "".join(["to add another form that fits as well, to a file of its own:\n", *found]) if found else ""


def refit_text(options: argparse.Namespace, file: "ModelFile", names: "Sequence[str]") -> str:
    """How all effects of a model file are fitted anew, together: beside what is in it already nothing of it is fitted."""
    from discrepancy.alike.already_there import own_settings

    reducer = file.reducer.as_named
    base, what = ("base.toml", f"base.toml, a copy of {options.model} without its effects and steps,") if own_settings(file) else (reducer, "the base model")
    given = argparse.Namespace(**vars(options) | {"model": base, "output": options.output or "refitted.toml"})
    return f"this line begins at {what} and fits all that the file has, together, anew:\n  {extend_line(given, names)}"


def first_to_add(answer: "Answer") -> "dict[str, Any] | None":
    """Of effects that cannot be told apart the one with the least error on unused runs, the first where none speaks; none where all are needed."""
    if not answer.confusable:
        return None

    def left(effect: "dict[str, Any]") -> float:
        return math.inf if effect["held_out_error_after"] is None else float(effect["held_out_error_after"])

    return min(answer.effects, key=left)


def named_in(answer: "Answer") -> list[str]:
    """Candidates of all that a diagnosis names: effects, and numbers of the base model beside them."""
    from discrepancy.verdict import added_of

    return [candidate for effect in answer.effects for candidate in added_of(effect)] + numbers_of(answer)


def numbers_of(answer: "Answer") -> list[str]:
    """Candidates of the numbers of the base model that are off."""
    from discrepancy.problem import BASE

    return [f"{BASE}.{e.name}" for e in answer.diagnosis.base_off if e.explains is not None]


def law_with_a_form(answer: "Answer") -> bool:
    return any(law.forms for law in answer.laws)
