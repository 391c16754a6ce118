"""The folder that a workbench works in: a campaign as the commands know it, and ``.workbench`` with what the page remembers.

All state is here: a page that is loaded anew, a second tab and a server that was killed and started again find it.
"""

import json
import os
import re
import tomllib
from dataclasses import dataclass
from functools import lru_cache
from itertools import islice
from pathlib import Path
from typing import Any

from discrepancy.campaign.measurement_files import measurement_files
from discrepancy.refused_file import only_refused
from fmu_src.checked_file import replacing, write_text
from fmu_src.faults import InputFault, nearest, nearest_path
from reducers.library import available

MEMORY = ".workbench"
CAMPAIGN, MODEL = "campaign.toml", "model.toml"
# A name that every system takes, and no way out of the folder.
NAME = re.compile(r"[^\x00-\x1f/\\:*?\"<>|.][^\x00-\x1f/\\:*?\"<>|]{0,199}")
# Measurements and files of reducers that a folder shows at most.
MOST_FILES = 5000


@dataclass(frozen=True)
class Folder:
    """``root`` is the only place that is read and written."""

    root: Path

    @property
    def campaign(self) -> Path:
        return self.root / CAMPAIGN

    @property
    def memory(self) -> Path:
        """What the page remembers; may be thrown away."""
        return self.root / MEMORY

    def inside(self, name: str) -> Path:
        """A file of the folder by its path from there; InputFault for one that lies outside, links followed."""
        place = (self.root / name).resolve()
        if "\x00" in name or not place.is_relative_to(self.root.resolve()) or place == self.root.resolve():
            raise InputFault(f"{name!r} lies outside of {self.root}: the workbench reads and writes in its folder alone")
        return place

    def new_file(self, name: str, content: bytes) -> Path:
        """A dropped file; one with the same content stays as it is, and none is overwritten."""
        if not NAME.fullmatch(name):
            raise InputFault(f"{name!r} cannot be the name of a file here; rename it, without / \\ : * ? \" < > | and not beginning with a dot")
        if name == CAMPAIGN:
            raise InputFault(f"{CAMPAIGN} is not dropped but saved here: open its folder instead (rvwear workbench FOLDER)")
        place = self.inside(name)
        if place.exists():
            if place.read_bytes() == content:
                return place
            raise InputFault(f"{name} is in the folder already, with other content; nothing is overwritten: rename the dropped file")
        with replacing(place) as partial:
            partial.write_bytes(content)
        return place

    def measurements(self) -> list[Path]:
        """Files whose ending tells that they may hold measurements, here and in folders below, in the order of their names."""
        return list(islice(measurement_files(self.root), MOST_FILES))

    def models(self) -> list[str]:
        """Model and reducer files of the folder."""
        return [path.name for path in sorted(self.root.glob("*.toml")) if path.name != CAMPAIGN and is_model(path, path.stat().st_mtime_ns)]

    def model(self, given: dict[str, Any]) -> str | Path:
        """The model that is asked for: the name of a reducer, or a file of the folder."""
        name = str(given.get("model") or "")
        if not name:
            raise InputFault("which model is held against the measurements has to be said first: choose a reducer or a model file")
        if name.endswith(".toml"):
            return self.inside(name)
        if name not in available():
            raise InputFault(f"{name}: there is no such reducer; choose from {', '.join(available())}, or a file of the folder{nearest(name, available(), 1)}")
        return name

    def measured(self) -> str:
        """The reducer that campaign.toml says was measured, if it is one of the library or of the folder."""
        try:
            content = tomllib.loads(self.campaign.read_text(encoding="utf-8"))
            name = str(content["campaign"]["reducer"])
        except (OSError, ValueError, KeyError, TypeError):
            return ""
        return name if name in available() or name in self.models() else ""

    # what the page remembers ----------------------------------------------------------------
    def recall(self, name: str) -> dict[str, Any]:
        """What ``remember`` put there; nothing where it is missing or damaged."""
        try:
            found = json.loads((self.memory / f"{name}.json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            return {}
        return found if isinstance(found, dict) else {}

    def remember(self, name: str, values: dict[str, Any]) -> None:
        write_text(self.memory / f"{name}.json", json.dumps(values, ensure_ascii=False, allow_nan=False))

    def stamp(self, model: str = "") -> str:
        """Changes when campaign, measurements or the model's file do: what was computed before is old then."""
        from hashlib import sha256

        found = sha256()
        for path in [self.campaign, *([self.inside(model)] if model.endswith(".toml") else []), *self.measurements()]:
            if path.is_file():
                told = path.stat()
                found.update(f"{path.name} {told.st_size} {told.st_mtime_ns}\n".encode())
        return found.hexdigest()[:20]


@lru_cache(maxsize=256)
def is_model(path: Path, changed: int) -> bool:
    """Whether a file says that it is a model or a reducer, as it begins to; one that cannot be read is shown, so that choosing it says why.

    Where nothing but refused effects stands in it, it is its reducer, which is in the list already.
    """
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return True
    return (isinstance(content.get("model"), dict) and not only_refused(content)) or isinstance(content.get("reducer"), dict)


def opened(root: Path) -> Folder:
    """InputFault where no such folder can be made or written: a file, or more than the last part of the path that is not there."""
    if root.exists() and not root.is_dir():
        raise InputFault(f"{root} is a file; give the folder that is worked in, for instance {root.absolute().parent}")
    if not root.absolute().parent.is_dir():
        raise InputFault(f"{root}: there is no folder {root.absolute().parent}{nearest_path(root)}; make it first, or correct the name")
    try:
        root.mkdir(exist_ok=True)
    except OSError as problem:
        raise InputFault(f"{root}: {problem.strerror or problem}; give a folder") from None
    if not os.access(root, os.R_OK | os.W_OK | os.X_OK):
        raise InputFault(f"{root} cannot be read and written; give another folder")
    return Folder(root.resolve())
