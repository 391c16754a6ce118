"""``rvwear extend --draft DIR``: an effect from the law that was recovered, built, fitted and judged like any other.

Units take their effects when they are imported: what is drafted here is built, fitted and judged by ``rvwear extend --effect NAME``
in a process of its own, whose RVWEAR_EFFECTS names DIR.
"""

import argparse
import json
import math
import os
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING

from cli.commands.going_on import nothing_added
from cli.options import NOTHING_ADDED_CODE, all_cores
from cli.written import only_file
from fmu_src.faults import InputFault, RunFault
from fmu_src.progress import task
from fmu_src.source_hash import USER_EFFECTS

if TYPE_CHECKING:
    from discrepancy.campaign.model import Campaign
    from discrepancy.draft.choose import Draft
    from discrepancy.model_file import ModelFile
    from discrepancy.verdict import Answer

# What is named beside a law must leave so much less of the error over noise on fitted runs than the law alone (assumed).
WORTH = 0.98


def run_draft(options: argparse.Namespace, file: "ModelFile", campaign: "Campaign") -> int:
    """Exit code 3 where the effect did not help on unused runs, or there is none to draft."""
    from discrepancy.draft.choose import drafts_of, require_folder, write
    from discrepancy.remembered import diagnosed

    folder = Path(options.draft)
    if options.effect:
        raise InputFault("--draft writes an effect of its own; give either --draft or --effect")
    require_folder(folder)
    answer = diagnosed(file, campaign, jobs=all_cores())
    drafts, reasons = drafts_of(answer, folder, options.name)
    if not drafts:
        return nothing_added(options, answer, no_draft(options, answer, reasons))
    for draft in drafts:
        write(draft)
    try:
        return tried(options, file, answer, drafts, reasons)
    except KeyboardInterrupt as stop:
        files = " and ".join(str(draft.file) for draft in drafts if draft.file.exists())
        raise KeyboardInterrupt(f"while the draft was fitted: {files} is written, the diagnosis is kept, and the same command goes on from there") from stop


def tried(options: argparse.Namespace, file: "ModelFile", answer: "Answer", drafts: "list[Draft]", reasons: list[str]) -> int:
    """The better of the drafts, fitted and judged in a process of its own; the others' files go."""
    from cli.screen import json_text
    from cli.show.draft import show_draft, show_use

    draft = better(options, drafts) if len(drafts) > 1 else drafts[0]
    for other in drafts:
        if other is not draft:
            other.file.unlink()
    if not options.json:
        show_draft(answer, draft, reasons)
        only_file(draft.file)
    done = child(options, draft, [*given(options, ("output", "fmus", "html")), *flags(options, ("anyway", "overwrite"))], options.json)
    if done.returncode not in (0, NOTHING_ADDED_CODE) or (options.json and not done.stdout.strip()):
        # The fault was said on the way.
        return done.returncode
    target = options.output or (str(file.path) if file.path else f"{file.name}.toml")
    use = f"{USER_EFFECTS}={shlex.quote(str(Path(options.draft).resolve()))}"
    if options.json:
        json_text(json.loads(done.stdout) | {"draft": draft.as_json() | {"use": use, "without_place": reasons}})
    else:
        show_use(draft, use, shlex.join(["rvwear", "compare", target, options.campaign]), kept=done.returncode == 0 or options.anyway)
    return done.returncode


def better(options: argparse.Namespace, drafts: "list[Draft]") -> "Draft":
    """The law alone, unless what is named beside it leaves less of the fitted runs' error; unused runs have no say here."""
    with tempfile.TemporaryDirectory() as scratch, task("comparing the law alone and beside what is named", total=len(drafts)) as comparing:
        errors = []
        for draft in drafts:
            done = child(options, draft, ["--output", str(Path(scratch) / "model.toml"), "--overwrite"], True)
            errors.append(float(json.loads(done.stdout)["step"]["training_after"]) if done.stdout.strip() else math.inf)
            comparing.advance()
    if min(errors) == math.inf:
        raise RunFault(f"{' and '.join(str(draft.file) for draft in drafts)}: could not be fitted, as said above")
    alone, beside = drafts
    return beside if errors[1] < WORTH * errors[0] else alone


def child(options: argparse.Namespace, draft: "Draft", more: list[str], as_json: bool) -> "subprocess.CompletedProcess[str]":
    """``rvwear extend`` with the draft among the effects; what it says goes to this screen, or is kept where it is JSON."""
    effects = [word for name in (*draft.beside, draft.name) for word in ("--effect", name)]
    how = ["--json"] if as_json else ["--quiet"] if options.quiet else []
    words = ["extend", options.model, options.campaign, *effects, *given(options, ("data",)), *more, *how, "--drafted"]
    sys.stdout.flush()
    environment = os.environ | {USER_EFFECTS: str(draft.file.resolve().parents[1])}
    return subprocess.run([sys.executable, "-m", "cli", *words], env=environment, text=True, check=False,
                          stdout=subprocess.PIPE if as_json else None)


def given(options: argparse.Namespace, keys: tuple[str, ...]) -> list[str]:
    return [word for key in keys if (value := getattr(options, key)) is not None for word in (f"--{key}", value)]


def flags(options: argparse.Namespace, keys: tuple[str, ...]) -> list[str]:
    return [f"--{key}" for key in keys if getattr(options, key)]


def no_draft(options: argparse.Namespace, answer: "Answer", reasons: list[str]) -> str:
    """Why there is nothing to draft, and what could be done."""
    from discrepancy.inference.verdict import INCOMPLETE, UNKNOWN

    start = f"--draft {options.draft}: the diagnosis says {answer.verdict!r} ({answer.reason})"
    if answer.verdict not in (UNKNOWN, INCOMPLETE):
        return f"{start}: there is no law without a name to draft; `rvwear extend` without --draft adds what is named"
    if not reasons:
        return f"{start}, and no law could be recovered: measure at more levels of load, speed or temperature (`rvwear next` says where)"
    return "\n  ".join([f"{start}, and no recovered law has a place in the units:", *reasons, "an effect of one's own may still say it: docs/effects.md"])
