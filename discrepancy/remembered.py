"""Diagnoses of the same model and the same measurements, kept between commands.

``extend`` and ``next`` begin where ``diagnose`` ended, and ``diagnose`` where it was interrupted.  What is kept goes by the contents of
model, measurements and program: whatever changes, it is computed anew.
"""

import contextlib
import hashlib
import os
import pickle
import tomllib
from collections.abc import Iterator
from dataclasses import replace
from datetime import datetime
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from discrepancy.campaign.model import Campaign
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.outlook import WHOLE
from discrepancy.inference.verdict import Settings
from discrepancy.model_file import ModelFile, every_effect
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.verdict import Answer, AnswerSoFar, diagnose
from fmu_src import checked_file
from fmu_src.cache_folder import cache_folder
from fmu_src.progress import duration, say, task
from fmu_src.source_hash import ROOT

if TYPE_CHECKING:
    from discrepancy.extend import Extension

Kept = TypeVar("Kept", Answer, Diagnostician)
MARK = b"rvwear diagnosis 1\n"
# Larger ones are not kept, and together they take no more than this [bytes].
MOST, MOST_IN_ALL = 300_000_000, 2_000_000_000
PARTS = ("discrepancy", "studies", "rv_plant", "wear_fmu", "reducers", "fmu_src")


def diagnosed(file: ModelFile, campaign: Campaign, settings: Settings = Settings(), jobs: int = 1) -> Answer:
    """The diagnosis, from before if there was one, which is told."""
    answer = remembered(file, campaign, settings, jobs)
    if answer is not None:
        say(found_again(answer, campaign))
    else:
        place = place_of(file, campaign, settings)
        begun = place.with_suffix(".begun")
        doctor = interrupted(file, campaign, settings, jobs)
        try:
            # The rest says nothing of how long the next one takes, nor the last one of the rest.
            with task(WHOLE, whole=True) if doctor is None else task("the rest of the diagnosis"):
                answer = replace(diagnose(file, campaign, settings, jobs=jobs, doctor=doctor), made_in=place_told(campaign))
        except AnswerSoFar as stop:
            write(begun, stop.answer.doctor)
            raise
        write(place, answer)
        begun.unlink(missing_ok=True)
    return answer


@contextlib.contextmanager
def with_profiles(answer: Answer, file: ModelFile, campaign: Campaign, settings: Settings = Settings()) -> Iterator[None]:
    """What is computed to draw an answer that is kept is kept with it: when that is found again, drawing takes no computing either."""
    known = len(answer.profiles)
    yield
    if len(answer.profiles) > known and (place := place_of(file, campaign, settings)).is_file():
        write(place, answer)


def found_again(answer: Answer, campaign: Campaign) -> str:
    """That nothing was computed, or an answer at once would be taken for one of this moment."""
    made, spent = datetime.fromtimestamp(answer.made), duration(answer.diagnosis.seconds)
    when = f"{made.day} {made:%b %Y, %H:%M}"
    folder = elsewhere(answer, campaign)
    where = f", from the folder {folder} with the same files," if folder else ""
    return f"found again: the diagnosis of this model and these measurements, made {when}{where} in {spent} of computing; none of it is computed anew"


def elsewhere(answer: Answer, campaign: Campaign) -> str:
    """The folder that a diagnosis was made from where that is another one than the campaign's; else empty."""
    return answer.made_in if answer.made_in and answer.made_in != place_told(campaign) else ""


def place_told(campaign: Campaign) -> str:
    """The folder as it is told from elsewhere."""
    return str(campaign.folder.resolve())


def extended(file: ModelFile, campaign: Campaign, names: list[str], settings: Settings = Settings(), anyway: bool = False, jobs: int = 1,
             said: bool = False) -> "Extension":  # fmt: skip
    """``extend``, from the diagnosis of the same if there was one, which is told unless it is ``said`` already, else from what it, or an extension,
    had found when it was interrupted.

    KeyboardInterrupt says whether the same goes on from there: what is known by then is kept once the base model is fitted.
    """
    # Here, so that a diagnosis does not load what adds effects.
    from discrepancy.extend import beginning, extend

    known = remembered(file, campaign, settings, jobs)
    if known and not said:
        say(found_again(known, campaign))
    doctor = None if known else interrupted(file, campaign, settings, jobs) or beginning(file, campaign, settings, jobs)
    try:
        return extend(file, campaign, names, settings=settings, anyway=anyway, jobs=jobs, answer=known, doctor=doctor)
    except KeyboardInterrupt as stop:
        raise KeyboardInterrupt(kept_text(file, campaign, settings, doctor)) from stop


def kept_text(file: ModelFile, campaign: Campaign, settings: Settings, doctor: Diagnostician | None) -> str:
    """Keeps what ``doctor`` had found when it was interrupted, if that is anything, and says what the same command begins with."""
    if doctor is not None:
        if not hasattr(doctor, "localisation"):
            return "the same command begins anew"
        doctor.space.predictions.unfinished = True
        write(place_of(file, campaign, settings).with_suffix(".begun"), doctor)
    return f"the {'fits so far are' if doctor else 'diagnosis is'} kept, and the same command goes on from there"


def interrupted(file: ModelFile, campaign: Campaign, settings: Settings = Settings(), jobs: int = 1) -> Diagnostician | None:
    """What a diagnosis, or an extension without one, had found when it was interrupted, if one was."""
    doctor = read(place_of(file, campaign, settings).with_suffix(".begun"), Diagnostician)
    if doctor is not None:
        doctor.space.threads.jobs = jobs
        if isinstance(doctor.model, PhysicalModel):
            doctor.model.file, doctor.model.campaign = file, campaign
    return doctor


def remembered(file: ModelFile, campaign: Campaign, settings: Settings = Settings(), jobs: int = 1) -> Answer | None:
    """The diagnosis from before, if there was one."""
    answer = read(place_of(file, campaign, settings), Answer)
    if answer is not None:
        answer.model.threads.jobs = jobs
        # The same was measured of the same; what they are called, and where they lie, may be another.
        answer.model.file, answer.model.campaign = file, campaign
    return answer


def place_of(file: ModelFile, campaign: Campaign, settings: Settings) -> Path:
    return cache_folder("diagnoses") / key(file, campaign, settings)


def key(file: ModelFile, campaign: Campaign, settings: Settings) -> str:
    """File name of what is computed from these by this program."""
    found = hashlib.sha256()
    for part in (program(), repr(sorted(every_effect())), modelled(file), stated(campaign), repr(campaign.nuisances), repr(settings)):
        found.update(hashlib.sha256(part.encode()).digest())
    for record in campaign.records:
        plain = {k: v for k, v in record.__dict__.items() if k not in ("values", "axes")}
        found.update(repr(plain).encode())
        for name, column in [("values", record.values), *sorted(record.axes.items())]:
            found.update(name.encode() + np.ascontiguousarray(column).tobytes())
    return found.hexdigest()[:40]


def modelled(file: ModelFile) -> str:
    """What a model file says of the reducer: neither where it lies, nor what was tried in vain."""
    return repr(replace(file, path=None, steps=tuple(step for step in file.steps if step.get("kept", True))))


def stated(campaign: Campaign) -> str:
    """What campaign.toml says of what was measured: neither comments, nor what it is called and where its files lie."""
    content = tomllib.loads(campaign.text)
    head = {key: value for key, value in content.get("campaign", {}).items() if key not in ("name", "description", "data")}
    return repr(content | {"campaign": head})


@cache
def program() -> str:
    """Hash of all that a diagnosis depends on."""
    found = hashlib.sha256()
    folders = [ROOT / part for part in PARTS] + [Path(f) for f in os.environ.get("RVWEAR_EFFECTS", "").split(os.pathsep) if f]
    for folder in folders:
        for path in sorted(folder.rglob("*.py")) + sorted(folder.rglob("*.toml")):
            found.update(str(path.relative_to(folder)).encode() + path.read_bytes())
    return found.hexdigest()


def read(place: Path, kind: type[Kept]) -> Kept | None:
    """What is kept there, if it is whole and one's own."""
    content = checked_file.read(place, MARK)
    if content is None:
        return None
    found = pickle.loads(content)  # noqa: S301 - one's own file in a private folder, and whole
    return found if isinstance(found, kind) else None


def write(place: Path, kept: Answer | Diagnostician) -> None:
    """Keep an answer, or what a diagnosis had found when it was interrupted, unless it is too large; what is older may have to go."""
    content = pickle.dumps(kept, protocol=pickle.HIGHEST_PROTOCOL)
    if len(content) <= MOST:
        checked_file.write(place, MARK, content)
        with contextlib.suppress(OSError):
            # Another process may be at it.
            make_room(place.parent)


def make_room(folder: Path) -> None:
    """What was not of use for longest goes first."""
    entries = sorted(((p.stat().st_mtime, p.stat().st_size, p) for p in folder.iterdir() if p.is_file()), reverse=True)
    total = 0
    for _, size, path in entries:
        total += size
        if total > MOST_IN_ALL:
            path.unlink(missing_ok=True)
