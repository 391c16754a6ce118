"""A campaign.toml as it stands, corrected cell by cell: everything else in it, comments included, stays as it was written."""

import hashlib
from collections.abc import Mapping
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError

from discrepancy.campaign.file_format import ConditionEntry
from discrepancy.campaign.load import load_campaign
from discrepancy.held_names import HELD, LOCKED_AT
from fmu_src.checked_file import replacing
from fmu_src.faults import InputFault
from workbench.folder import Folder
from workbench.form import factor, with_minute

# Of a condition what is one word; of a run's column what says how it is read.
CONDITION = tuple(name for name in ConditionEntry.model_fields if name not in ("interventions", "notes"))
COLUMN = ("column", "unit", "scale")


def cells(folder: Folder) -> dict[str, Any]:
    """What can be corrected: conditions by name, runs with the columns that each file is read by; ``of`` is the text that they stand in."""
    content = folder.campaign.read_bytes()
    document = parsed(content)
    conditions = {
        str(name): {key: entry[key] for key in CONDITION if key in entry}
        for name, entry in table(document.get("conditions")).items() if isinstance(entry, Mapping)
    }  # fmt: skip
    runs = [
        {"id": str(run.get("id", number + 1)), "file": str(run.get("file", "")), "quantity": str(run.get("quantity", "")), "condition": run.get("condition"),
         "columns": {str(role): {key: entry[key] for key in COLUMN if key in entry}
                     for role, entry in table(run.get("columns")).items() if isinstance(entry, Mapping)}}
        for number, run in enumerate(runs_of(document))
    ]  # fmt: skip
    # Where an input was locked is asked of loops: there must be a place to say it.
    readers = [*runs_of(document), *table(document.get("layouts")).values()]
    asked = {"held_out"} | ({LOCKED_AT} if any(table(reader).get("quantity") in HELD for reader in readers) else set())
    keys = [key for key in CONDITION if key in asked or any(key in c for c in conditions.values())]
    return {"of": told(content), "keys": keys, "conditions": conditions, "runs": runs}


def edit(folder: Folder, given: Mapping[str, Any]) -> None:
    """Put one ``value`` at a ``place``; InputFault, and nothing is changed, where the campaign could not be read any more.

    ``place``: ["conditions", name, key], ["runs", number, "condition"], ["runs", number, "columns", role, key], or ["runs", number, "columns", role]
    for the role itself.  An empty value takes the key away.
    """
    content = folder.campaign.read_bytes()
    if given.get("of") != told(content):
        raise InputFault("campaign.toml was changed since this page read it; it is shown anew, correct it again")
    document = parsed(content)
    match given.get("place"):
        case ["runs", int(number), "columns", str(role)] if 0 <= number < len(runs := runs_of(document)) and role in table(runs[number].get("columns")):
            turn(runs[number], role, str(given.get("value") or ""))
        case place:
            holder, key = found(document, place)
            value = fitting(holder.get(key), key, given.get("value"))
            if value is None:
                holder.pop(key, None)
            else:
                holder[key] = value
    rewrite(folder, document)


def recast(folder: Folder, column: str, role: str) -> None:
    """``column`` takes ``role`` in every run and layout that reads it; InputFault as ``edit``."""
    document = parsed(folder.campaign.read_bytes())
    readers = [*runs_of(document), *table(document.get("layouts")).values()]
    reading = [(run, known) for run in readers for known, entry in table(table(run).get("columns")).items() if str(table(entry).get("column")) == column]
    if not reading:
        raise InputFault(f"no run of campaign.toml reads a column {column!r} by that name; correct the columns of single files below")
    for run, known in reading:
        turn(run, known, role)
    rewrite(folder, document)


def turn(run: Any, role: str, other: str) -> None:
    """The column of one role takes another; one that has it already takes the first."""
    columns = run["columns"]
    entries = {known: columns[known] for known in (role, other) if known in columns}
    for known in entries:
        columns.pop(known)
    for known, entry in entries.items():
        columns[other if known == role else role] = entry
    # What the campaign says of angles in general was said of the output's.
    if other == "input_angle" and "angle" not in columns:
        run["angle_of"] = "input"
    elif "angle" in columns and run.get("angle_of") == "input":
        run.pop("angle_of")


def rewrite(folder: Folder, document: Any) -> None:
    """InputFault, and the file stays as it was, where the campaign could not be read any more."""
    with replacing(folder.campaign) as partial:
        partial.write_bytes(tomlkit.dumps(document).encode("utf-8"))
        try:
            load_campaign(folder.root, file=partial)
        except InputFault as fault:
            raise InputFault(str(fault).replace(str(partial), "campaign.toml").replace(f"{folder.root}/", "")) from None


def found(document: Any, place: Any) -> tuple[Any, str]:
    """The table that holds what is meant, and its key there."""
    try:
        match place:
            case ["conditions", str(name), str(key)] if key in CONDITION:
                return document["conditions"][name], key
            case ["runs", int(number), "condition"] if number >= 0:
                return document["runs"][number], "condition"
            case ["runs", int(number), "columns", str(role), str(key)] if number >= 0 and key in COLUMN:
                return document["runs"][number]["columns"][role], key
    except (KeyError, IndexError, TypeError):
        pass
    raise InputFault(f"{place!r} is no place of campaign.toml that can be corrected here")


def fitting(before: Any, key: str, value: Any) -> Any:
    """The value as the file has such: a number where a number stood, true or false for what is held out; None to take it away."""
    if key == "held_out":
        return True if value in (True, "true", "yes") else None
    text = str(value if value is not None else "").strip()
    if not text:
        return None
    if key == "scale":
        return factor(text, key)
    if isinstance(before, (int, float)) and not isinstance(before, bool):
        try:
            number = float(text)
        except ValueError:
            return text
        return int(number) if isinstance(before, int) and number.is_integer() else number
    return with_minute(text) if key.endswith("_speed") else text


def parsed(content: bytes) -> Any:
    try:
        return tomlkit.parse(content.decode("utf-8"))
    except (UnicodeDecodeError, TOMLKitError) as fault:
        raise InputFault(f"campaign.toml cannot be read: {fault}") from None


def runs_of(document: Any) -> list[Any]:
    return [run for run in document.get("runs") or [] if isinstance(run, Mapping)]


def table(given: Any) -> Mapping[Any, Any]:
    return given if isinstance(given, Mapping) else {}


def told(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
