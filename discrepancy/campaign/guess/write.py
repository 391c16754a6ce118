"""A proposal as campaign.toml: what the command line reads, nothing else."""

import json
import os
import re
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from discrepancy.campaign.file_format import FILE
from discrepancy.campaign.guess.propose import PlacedRun, Proposal
from discrepancy.campaign.guess.whose_angle import over_output
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.model import Campaign
from discrepancy.problem import ERROR
from fmu_src.checked_file import write_text
from fmu_src.faults import InputFault
from fmu_src.file_name import name_of_folder

# Of ``nuisances.encoder_phase``: anywhere in a turn, and elsewhere at each mounting.
PHASE = ('unit = "deg"', "lower = -180", "upper = 180", 'per = "mounting"')


def name_of(folder: Path) -> str:
    """Of the folder, in the signs that a campaign's name may have."""
    return name_of_folder(folder.resolve().name)


def campaign_text(proposal: Proposal, folder: Path) -> str:
    """``folder``: where it will stand; paths of data and reducer count from there."""
    data = os.path.relpath(proposal.data, folder.resolve())
    lines = ["[campaign]", f"name = {toml(proposal.name)}"]
    if proposal.reducer:
        own = Path(proposal.reducer)
        lines.append(f"reducer = {toml(Path(os.path.relpath(own.resolve(), folder.resolve())).as_posix() if own.is_file() else proposal.reducer)}")
    if data != ".":
        lines.append(f"data = {toml(Path(data).as_posix())}")
    for name, stated in proposal.conditions.items():
        lines += ["", f"[conditions.{key_text(name)}]", *(f"{key} = {toml(value)}" for key, value in stated.items())]
        if name in proposal.held_out:
            lines.append(f"held_out = true                          # {proposal.held_out[name].reason}")
    for run in proposal.runs:
        lines += ["", *run_lines(run, proposal.data)]
    for quantity in dict.fromkeys([*([ERROR] if proposal.angle_of else []), *proposal.zeros]):
        lines += ["", f"[quantities.{quantity}]"]
        if quantity in proposal.zeros:
            lines.append(f"zero = {toml(proposal.zeros[quantity])}")
        if quantity == ERROR and (whose := proposal.angle_of):
            lines.append(f"{f'angle_of = {toml(whose.value)}':<39} # {whose.reason}")
    if any(run.guessed.quantity.value == ERROR for run in proposal.runs):
        # Nobody sets an encoder to 0 where the model begins; where its pattern hardly shows it would be taken to stand there.
        lines += ["", "[nuisances.encoder_phase]                # where angles count from: found", *PHASE]
    return "\n".join(lines) + "\n"


def run_lines(run: PlacedRun, data: Path) -> list[str]:
    guessed = run.guessed
    lines = ["[[runs]]", f"id = {toml(run.name)}", f"quantity = {toml(guessed.quantity.value)}{unsure(guessed.quantity.sure)}"]
    lines += [f"tags.{tag} = {toml(guess.value)}{unsure(guess.sure)}" for tag, guess in guessed.tags.items()]
    lines += [f"condition = {toml(run.condition)}", f"replicate = {run.replicate.value}"]
    if guessed.actual:
        lines.append(f"actual = {toml(guessed.actual)}")
    lines.append(f"file = {toml(guessed.path.resolve().relative_to(data).as_posix())}")
    lines += [f"{key} = {toml(value)}" for key, value in guessed.reading.items()]
    if guessed.quantity.value == ERROR and "input_angle" in guessed.columns and not over_output(guessed):
        lines.append('angle_of = "input"')
    if run.where:
        lines.append(f"where = {toml(run.where)}")
    for role, entry in guessed.columns.items():
        keys = {"column": entry.column.value, "unit": entry.unit.value, **entry.keys}
        lines.append(f"columns.{role} = {toml(keys)}{unsure(entry.unit.sure and entry.column.sure)}")
    return lines


def unsure(sure: bool) -> str:
    return "" if sure else "   # not sure"


def key_text(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else toml(key)


def toml(value: Any) -> str:
    """Text, number, truth, list or table of these."""
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key_text(key)} = {toml(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list):
        return f"[{', '.join(map(toml, value))}]"
    if isinstance(value, (bool, str)):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    return repr(value)


def checked(proposal: Proposal) -> Campaign:
    """The campaign as it will be read, from a folder that is gone afterwards; InputFault where it cannot be."""
    with tempfile.TemporaryDirectory(prefix="rvwear-campaign-") as name:
        folder = Path(name)
        (folder / FILE).write_text(campaign_text(proposal, folder), encoding="utf-8")
        try:
            return load_campaign(folder, proposal.data)
        except InputFault as fault:
            raise InputFault(str(fault).replace(f"{folder / FILE}: ", "").replace(str(folder), ".")) from None


def write_campaign(proposal: Proposal, folder: Path, overwrite: bool = False) -> Path:
    """The file that was written; InputFault if there is one already that may not be replaced."""
    place = folder / FILE
    if place.exists() and not overwrite:
        raise InputFault(f"{place} exists already and is not overwritten; give --overwrite to have it written anew, or another folder by --output")
    folder.mkdir(parents=True, exist_ok=True)
    write_text(place, campaign_text(proposal, folder))
    return place
