"""The reducers that come with the software, by name: one .toml file each beside this module."""

import re
from collections.abc import Iterable
from pathlib import Path

LIBRARY = Path(__file__).parent
# What may stand between a reducer and its ratio: ``RV-20E i = 121``, ``RV-20E, rapporto 1:121``.
RATIO = re.compile(
    r"(?<!\w)(?:(?:i|u|(?:(?:reduction|gear|speed) )?ratio|r[áa]tio|(?:getriebe)?[üu]bersetzung|untersetzung|rapporto?(?: d[ei] \w+)?"
    r"|rela(?:ci[óo]n|[çc][ãa]o)(?: de \w+)?|减速比|減速比)[\W_]*(?:1\s*[:：/]\s*)?|1\s*[:：/]\s*)(?=\d)", re.IGNORECASE)  # fmt: skip


def available() -> list[str]:
    """Their names, from the names of the files: nothing is read."""
    return sorted(path.stem for path in LIBRARY.glob("*.toml"))


def named_in(lines: Iterable[str]) -> str | None:
    """The one reducer whose name stands in lines of text, however it is parted (``RV-20E 121``, ``RV-20E i=121``); None where none does, or several."""
    text = [plainly(RATIO.sub(" ", line)) for line in lines]
    found = [name for name in available() if any(plainly(name) in line for line in text)]
    # A name may begin with another one.
    longest = [name for name in found if not any(other != name and other.startswith(name) for other in found)]
    return longest[0] if len(longest) == 1 else None


def plainly(text: str) -> str:
    """Letters and figures alone."""
    return re.sub(r"[^a-z0-9]", "", text.lower())
