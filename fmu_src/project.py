"""Version, authors and licence: the project's entry in ``pyproject.toml``, from which FMUs, wheel and documents have them.

A checkout reads the file itself, an installed wheel the metadata that were made from it.
"""

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.metadata import Distribution, distribution
from pathlib import Path
from typing import Any

from fmu_src.source_hash import ROOT

NAME = "rvwear"
# The licence as long as the owner has chosen none: a licence expression that refers to no known licence.
UNDECIDED = "LicenseRef-Undecided"
# Where the text of a licence stands, by the packaging standard's own default.
LICENCE_FILES = ("LICEN[CS]E*", "COPYING*", "NOTICE*", "AUTHORS*")


@dataclass(frozen=True)
class Project:
    """``licence`` is an SPDX licence expression; ``texts`` are the contents of the licence files, if there are any."""

    version: str
    author: str
    licence: str
    texts: tuple[str, ...] = ()

    def attributes(self, code_hash: str) -> dict[str, str]:
        """What a model description says of its makers, in both FMI versions; the version names the sources too."""
        return {"version": f"{self.version}+{code_hash[:16]}", "author": self.author, "license": self.licence}

    def terms(self) -> str:
        """What may be done with what was made, as text."""
        if self.licence == UNDECIDED:
            return f"The licence of {NAME} is not decided yet ({self.licence}): ask its makers before you pass it on.\n"
        return "\n\n".join((f"{NAME} {self.version}, {self.author}, licence {self.licence}.\n", *self.texts))


@cache
def project() -> Project:
    file = ROOT / "pyproject.toml"
    # Other people's wheels have left files of this name beside an installed package.
    ours = file.is_file() and entry_of(file).get("name") == NAME
    return of_checkout(file) if ours else of_installation(distribution(NAME))


def entry_of(file: Path) -> dict[str, Any]:
    entry: dict[str, Any] = tomllib.loads(file.read_text(encoding="utf-8")).get("project", {})
    return entry


def of_checkout(file: Path) -> Project:
    entry = entry_of(file)
    found = sorted({path for pattern in LICENCE_FILES for path in file.parent.glob(pattern)})
    texts = tuple(path.read_text(encoding="utf-8") for path in found)
    return Project(entry["version"], ", ".join(author["name"] for author in entry["authors"]), entry["license"], texts)


def of_installation(installed: Distribution) -> Project:
    facts = installed.metadata
    texts = tuple(installed.read_text(f"licenses/{name}") or "" for name in sorted(facts.get_all("License-File") or ()))
    return Project(facts["Version"], facts["Author"], facts["License-Expression"], texts)


def requirements() -> dict[str, list[str]]:
    """What is needed ("") and what the optional parts need, by part, as ``numpy>=2.4``."""
    file = ROOT / "pyproject.toml"
    if file.is_file() and entry_of(file).get("name") == NAME:
        entry = entry_of(file)
        return {"": list(entry["dependencies"])} | {part: list(names) for part, names in entry["optional-dependencies"].items()}
    found: dict[str, list[str]] = {"": []}
    for text in distribution(NAME).requires or []:
        name, _, condition = text.partition(";")
        part = condition.rpartition("extra ==")[2].strip(" '\"") if "extra ==" in condition else ""
        found.setdefault(part, []).append(name.strip())
    return found
