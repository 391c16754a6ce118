"""In: what the dropped files are taken for and why, corrected by what was clicked, saved as the command line's campaign.toml."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.guess.given_names import by_pattern
from discrepancy.campaign.guess.propose import Proposal, propose
from discrepancy.campaign.guess.run import NothingFits, guessed_run
from discrepancy.campaign.guess.table import table_of
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import campaign_text, checked, name_of, write_campaign
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.mending import TITLES
from discrepancy.campaign.quantities import FACTORS, QUANTITIES, TAGS, keys_that_matter, roles_of
from discrepancy.campaign.repetition_words import COPY
from discrepancy.campaign.unplaced import CODE, unplaced, unplaced_in
from discrepancy.held_names import LOCKED_AT
from discrepancy.problem import WITH_ZERO
from fmu_src.faults import InputFault
from pages.look import significant
from reducers.library import available, named_in
from workbench.confirming import answer_of
from workbench.doubts import as_told, doubts
from workbench.editing import cells
from workbench.folder import Folder
from workbench.form import exactly, factor, number, with_minute
from workbench.page_words import on_page

# Points of the little curve that shows what a column looks like, and columns of a file that are shown.
POINTS, MOST_COLUMNS = 80, 40
WISHES = "wishes"
# Units that are offered for a column, by its SI unit; any other may be typed.
OFFERED = {
    "rad": ("arcsec", "arcmin", "deg", "mdeg", "rad", "urad", "turn"), "N.m": ("N.m", "mN.m", "kN.m", "lbf.inch", "lbf.foot"),
    "rad/s": ("rpm", "rad/s", "Hz", "deg/s"), "s": ("s", "ms", "h", "min"), "K": ("degC", "K", "degF"), "m": ("um", "mm", "m"), "1": ("1", "%", "ppm"),
    "kg": ("mg", "g", "kg"), "m/s^2": ("m/s^2", "g_0"), "N.m/rad": ("N.m/arcmin", "N.m/rad", "lbf.inch/arcmin"), "N": ("N", "kN"), "m/s": ("m/s", "mm/s"),
}  # fmt: skip


def choices() -> dict[str, Any]:
    """What there is to choose from: quantities with their roles, units, keys of a condition, words of tags."""
    return {
        "quantities": {
            q.name: {"description": q.description, "unit": q.usual_unit, "tags": [*q.tags, *q.optional_tags], "matter": keys_that_matter(q),
                     "zero": q.name in WITH_ZERO,
                     "roles": {role: {"title": TITLES.get(role, role.replace("_", " ")), "description": key.description,
                                      "units": OFFERED.get(key.unit, (key.unit,))} for role, key in roles_of(q).items()}}
            for q in QUANTITIES.values()
        },
        "factors": {key.key: {"example": key.example, "description": key.description} for key in FACTORS},
        "tags": {tag.name: {"choices": list(tag.choices), "description": tag.description} for tag in TAGS.values()},
        "reducers": available(),
    }  # fmt: skip


def wishes_of(given: Mapping[str, Any]) -> Wishes:
    """From JSON; InputFault for a key or kind that there is not."""
    texts = {}
    for key in ("units", "columns", "quantities", "conditions", "tags", "zeros"):
        texts[key] = {str(name): str(value) for name, value in mapping(given, key).items() if str(value).strip()}
    texts["conditions"] = {name: with_minute(text) if name.endswith("_speed") else text for name, text in texts["conditions"].items()}
    counts = {str(column): number(steps, f"counts of {column}") for column, steps in mapping(given, "counts").items()}
    scales = {str(column): factor(text, f"scale of {column}") for column, text in mapping(given, "scales").items()}
    held = given.get("held_out")
    names = given.get("names", ())
    if not isinstance(names, (list, tuple)) or not (held is None or isinstance(held, list)):
        raise InputFault("names and held_out are lists")
    return Wishes(str(given["reducer"]) if given.get("reducer") else None, tuple(str(n) for n in names if str(n).strip()), texts["units"], texts["columns"],
                  counts, texts["quantities"], texts["conditions"], None if held is None else tuple(map(str, held)), texts["tags"],
                  str(given["angle_of"]) if given.get("angle_of") else None, scales, texts["zeros"])  # fmt: skip


def mapping(given: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    value = given.get(key) or {}
    if not isinstance(value, dict):
        raise InputFault(f"{key} is a table of names and values")
    return value


@dataclass(frozen=True)
class Proposed:
    """A proposal, the corrections that it follows, those that no longer fit anything, and why a file has no part in it."""

    proposal: Proposal
    wishes: Wishes
    gone: list[str]
    unread: dict[Path, str]


def proposed(folder: Folder, given: Mapping[str, Any]) -> Proposed:
    """What is made of the files that can be read; InputFault where that is nothing.

    Conditions are named anew where the pattern of names changes; what was once remembered of names may fit no file any more.
    """
    files = folder.measurements()
    reducer = given.get("reducer", named_above(files))
    wishes = wishes_of({**given, "reducer": str(folder.model({"model": reducer})) if reducer else None})
    old = [n for n in wishes.names if n in folder.recall(WISHES).get("names", ()) and not any(by_pattern(file, n) for file in files)]
    wishes = replace(wishes, names=tuple(n for n in wishes.names if n not in old))
    left_out = [f"names {n}: no file fits any more; it is left out" for n in old]
    name = name_of(folder.root)
    # One bad file takes nothing from the others: first those that are no tables, which is known from drawing them.
    unread = unread_of(folder, [file for file in files if not columns_of(file, file.stat().st_mtime_ns)], wishes)
    files = [file for file in files if file not in unread] or files
    try:
        return Proposed(propose(files, wishes, name), wishes, left_out, unread)
    except InputFault:
        unread |= unread_of(folder, files, wishes)
        files = [file for file in files if file not in unread] or files
    try:
        return Proposed(propose(files, wishes, name), wishes, left_out, unread)
    except InputFault as fault:
        if "there is no condition" not in str(fault) and "there is no such condition" not in str(fault):
            raise
    plain = {k: v for k, v in wishes.conditions.items() if ":" not in k}
    there = propose(files, replace(wishes, conditions=plain, held_out=None), name).conditions
    kept = {k: v for k, v in wishes.conditions.items() if ":" not in k or k.rpartition(":")[0] in there}
    held = None if wishes.held_out is None else tuple(n for n in wishes.held_out if n in there)
    gone = sorted({k.rpartition(":")[0] for k in wishes.conditions.keys() - kept.keys()} | set(wishes.held_out or ()) - set(held or ()))
    fitting = replace(wishes, conditions=kept, held_out=held)
    left_out += [f"condition {n}: there is none of that name any more; what was said of it is left out" for n in gone]
    return Proposed(propose(files, fitting, name), fitting, left_out, unread)


def named_above(files: Sequence[Path]) -> str | None:
    """The reducer that lines above the tables name: it is taken until another one is chosen, or none."""
    return named_in(line for file in files for line in drawn(file, file.stat().st_mtime_ns).above)


def unread_of(folder: Folder, files: Sequence[Path], wishes: Wishes) -> dict[Path, str]:
    """Files that nothing can be made of, whatever names mean, and why."""
    found = {}
    for file in files:
        try:
            guessed_run(file, replace(wishes, names=()))
        except InputFault as fault:
            found[file] = in_words(folder, fault)
    return found


def wish(folder: Folder, given: dict[str, Any]) -> None:
    """Remember what was corrected; InputFault where nothing could be made of a file any more, and all stays as it was.

    Where nothing can be made of them as it is, every step counts.
    """
    wishes_of(given)
    try:
        unread = {file: why for file, why in proposed(folder, given).unread.items() if columns_of(file, file.stat().st_mtime_ns)}
        if unread:
            before = proposed(folder, folder.recall(WISHES)).unread
            for file in unread.keys() - before.keys():
                raise InputFault(unread[file])
    except InputFault as fault:
        if folder.measurements() and not fault_of(folder):
            raise InputFault(in_words(folder, fault)) from None
    folder.remember(WISHES, given)


def fault_of(folder: Folder) -> str:
    """Why nothing can be made of the files as they stand; empty if something can."""
    try:
        proposed(folder, folder.recall(WISHES))
    except InputFault as fault:
        return in_words(folder, fault)
    return ""


def in_words(folder: Folder, fault: InputFault) -> str:
    """A fault of the command without its options and without the folder's own path."""
    text = fault.on_page if isinstance(fault, NothingFits) else on_page(str(fault))
    return text.replace(f"{folder.root}/", "")


def view(folder: Folder) -> dict[str, Any]:
    """Everything that the page shows of its files."""
    given = folder.recall(WISHES)
    files = folder.measurements()
    found: dict[str, Any] = {
        "files": [{"name": path.relative_to(folder.root).as_posix(), "bytes": path.stat().st_size} for path in files],
        "wishes": given, "saved": folder.campaign.is_file(), "own": written_here(folder), "models": folder.models(), "proposal": None, "fault": "", "gone": [],
        "unread": {}, "doubts": [], "copied": {},
    }  # fmt: skip
    if found["saved"]:
        found |= checked_campaign(folder) | cells_of(folder)
    if not files or (found["saved"] and not found["own"]):
        return found
    try:
        made = proposed(folder, given)
    except InputFault as fault:
        found["fault"] = in_words(folder, fault)
        return found
    proposal, found["gone"] = made.proposal, made.gone
    found["unread"] = {path.relative_to(folder.root).as_posix(): reason for path, reason in made.unread.items()}
    found["proposal"] = proposal.as_json()
    for run, placed in zip(found["proposal"]["runs"], proposal.runs):
        run["file"] = placed.guessed.path.relative_to(folder.root).as_posix()
    for told, doubt in zip(found["proposal"]["doubts"], proposal.doubts):
        told |= {"text": on_page(told["text"])} | answer_of(doubt, proposal)
        if doubt in proposal.unplaced:
            told["cell"] = [doubt.place.split(", ")[0], LOCKED_AT]
    found["columns"] = {path.relative_to(folder.root).as_posix(): columns_of(path, path.stat().st_mtime_ns) for path in files}
    found["text"] = text_of(folder, proposal)
    found["same"] = found["saved"] and folder.campaign.read_text(encoding="utf-8") == found["text"]
    found |= of_numbers(folder, proposal)
    used = {run.guessed.name.pattern for run in proposal.runs}
    found["command"] = command(folder, made, replace(made.wishes, names=tuple(n for n in made.wishes.names if n in used)))
    return found


def cells_of(folder: Folder) -> dict[str, Any]:
    """What of campaign.toml can be corrected cell by cell; nothing where it is no TOML."""
    try:
        return {"cells": cells(folder)}
    except InputFault:
        return {}


def checked_campaign(folder: Folder) -> dict[str, Any]:
    """What campaign.toml holds as it is read, and what ``rvwear campaign check`` finds without computing."""
    try:
        campaign = load_campaign(folder.root)
        check = check_campaign(campaign, unplaced(campaign))
    except InputFault as fault:
        return {"fault": str(fault).replace(f"{folder.root}/", "")}
    return {
        "campaign": {"name": campaign.name, "quantities": list(check.summary), "conditions": list(campaign.conditions)},
        "findings": [as_told(f) | ({"cell": [unplaced_in(campaign.records)[0], LOCKED_AT]} if f.code == CODE else {}) for f in check.findings],
    }


def of_numbers(folder: Folder, proposal: Proposal) -> dict[str, Any]:
    """As the proposal would be read: ``doubts`` of angles once it is known of which reducer, and files that are ``copied``, each with what is wrong with it;
    neither where it cannot be read, which saving says."""
    try:
        campaign = checked(proposal)
    except InputFault:
        return {}
    places = {run.name: run.guessed.path.relative_to(folder.root).as_posix() for run in proposal.runs}
    copied = {places[copy]: f"it holds the same numbers as {places[of]}: {COPY}" for copy, of in campaign.copies.items() if places[copy] != places[of]}
    return {"doubts": doubts(campaign) if proposal.reducer else [], "copied": copied}


@dataclass(frozen=True)
class Drawn:
    """What the page shows of a file: each column's name as the file has it, its size and a curve of few points; and the lines ``above`` its table."""

    columns: list[dict[str, Any]]
    above: tuple[str, ...]


def columns_of(path: Path, changed: int) -> list[dict[str, Any]]:
    return drawn(path, changed).columns


@lru_cache(maxsize=4096)
def drawn(path: Path, changed: int) -> Drawn:
    """Empty where the file is no table; ``changed`` tells one version of a file from the next."""
    try:
        table = table_of(path)
    except InputFault:
        return Drawn([], ())
    found = []
    for name, values in list(table.columns.items())[:MOST_COLUMNS]:
        known = values[np.isfinite(values)]
        few = values[np.linspace(0, len(values) - 1, min(POINTS, len(values))).astype(np.intp)] if len(values) else values
        span = [float(known.min()), float(known.max())] if len(known) else None
        found.append({"name": table.headers.get(name, name), "rows": len(values), "span": span, "curve": significant(few, 4)})
    return Drawn(found, table.above)


def text_of(folder: Folder, proposal: Proposal) -> str:
    return campaign_text(proposal, folder.root)


def written_here(folder: Folder) -> bool:
    """Whether campaign.toml is as the page saved it: only then may it be saved anew."""
    return folder.campaign.is_file() and folder.recall("saved").get("sha256") == sha256(folder.campaign.read_bytes())


def is_saved(folder: Folder) -> bool:
    """Whether campaign.toml holds what is proposed now."""
    if not written_here(folder):
        return False
    return folder.campaign.read_text(encoding="utf-8") == text_of(folder, proposed(folder, folder.recall(WISHES)).proposal)


def sha256(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def save(folder: Folder) -> dict[str, Any]:
    """Write campaign.toml as ``rvwear campaign from`` does; one that was edited by hand stays."""
    proposal = proposed(folder, folder.recall(WISHES)).proposal
    if not proposal.reducer:
        raise InputFault("which reducer was measured has to be said first: choose it above the table")
    checked(proposal)
    if folder.campaign.is_file() and not written_here(folder):
        raise InputFault("campaign.toml was not written on this page, or was changed since: it is not overwritten; rename it to begin anew")
    write_campaign(proposal, folder.root, overwrite=True)
    folder.remember("saved", {"sha256": sha256(folder.campaign.read_bytes())})
    return {"saved": True, "needs": [need.as_json() for need in proposal.needs]}


def command(folder: Folder, made: Proposed, wishes: Wishes) -> str:
    """The command line that proposes the same: of a folder that holds a file which cannot be read, the others by name."""
    import shlex

    named = [str(run.guessed.path) for run in made.proposal.runs] if made.unread else []
    words = ["rvwear", "campaign", "from", *(dict.fromkeys(named) or [str(folder.root)]), *(["--output", str(folder.root)] if named else [])]
    words += ["--reducer", wishes.reducer] if wishes.reducer else []
    for pattern in wishes.names:
        words += ["--names", pattern]
    for option, pairs in (("unit", wishes.units), ("column", wishes.columns), ("scale", wishes.scales), ("counts", wishes.counts),
                          ("quantity", wishes.quantities), ("condition", wishes.conditions), ("tag", wishes.tags), ("zero", wishes.zeros)):  # fmt: skip
        for name, value in pairs.items():
            words += [f"--{option}", f"{name}={exactly(value) if isinstance(value, float) else value}"]
    words += ["--angle-of", wishes.angle_of] if wishes.angle_of else []
    if wishes.held_out is not None:
        words += ["--held-out", *wishes.held_out]
    # What is here already stays but for this.
    words += ["--overwrite"] if (folder.root / "campaign.toml").is_file() else []
    return shlex.join(words)
