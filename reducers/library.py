"""The reducers that come with the software, by name: one .toml file each beside this module."""

import re
from collections.abc import Container, Iterable
from pathlib import Path

LIBRARY = Path(__file__).parent
# What may stand between a reducer and its ratio: ``RV-20E i = 121``, ``RV-20E, rapporto 1:121``.
RATIO = re.compile(
    r"(?<!\w)(?:(?:i|u|(?:(?:reduction|gear|speed) )?ratio|r[áa]tio|(?:getriebe)?[üu]bersetzung|untersetzung|rapporto?(?: d[ei] \w+)?"
    r"|rela(?:ci[óo]n|[çc][ãa]o)(?: de \w+)?|减速比|減速比)[\W_]*(?:1\s*[:：/]\s*)?|1\s*[:：/]\s*)(?=\d)", re.IGNORECASE)  # fmt: skip

# What may stand between the parts of a name, and a whole number.
BETWEEN, WHOLE = r"[^a-z0-9]*", r"\d+(?![.,]?\d)"


def available() -> list[str]:
    """Their names, from the names of the files: nothing is read."""
    return sorted(path.stem for path in LIBRARY.glob("*.toml"))


def named_in(lines: Iterable[str]) -> str | None:
    """The one reducer whose name stands in lines of text, however it is parted (``RV-20E 121``, ``RV-20E i=121``), its ratio perhaps on a line of its
    own (``Rapport : 121``); None where none does, or several."""
    given = [line.lower() for line in lines]
    text = [RATIO.sub(" ", line) for line in given]
    found = [name for name in available() if any(pattern(name).search(line) for line in text)] or by_ratio(text, {r for line in given if (r := ratio_of(line))})
    # A name may begin with another one.
    longest = [name for name in found if not any(other != name and other.startswith(name) for other in found)]
    return longest[0] if len(longest) == 1 else None


def by_ratio(text: Iterable[str], ratios: Container[str]) -> list[str]:
    """Reducers whose model stands in a line without a number behind it, and whose ratio is one of those of lines of their own."""
    parted = {name: name.rpartition("-") for name in available()}
    return [name for name, (model, _, ratio) in parted.items() if ratio in ratios and any(pattern(model, rf"(?!{BETWEEN}\d)").search(line) for line in text)]


def ratio_of(line: str) -> str:
    """The whole number of a line that begins with a word for the ratio; empty of any other line."""
    label = RATIO.match(line.lstrip(" \t\"'#%;,*-"))
    number = re.match(WHOLE, label.string[label.end() :]) if label and any(c.isalpha() for c in label[0]) else None
    return number[0] if number else ""


def pattern(name: str, behind: str = r"(?!\d|\.\d)") -> re.Pattern[str]:
    """Finds a name in small letters: its letters and numbers each whole, whatever stands between them, and not as the beginning of a longer number."""
    return re.compile(r"(?<![a-z0-9])" + BETWEEN.join(re.findall(r"[a-z]+|\d+", name.lower())) + behind)
