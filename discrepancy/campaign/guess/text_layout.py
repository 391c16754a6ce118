"""Where the table begins in a text file, how its fields are parted, and what its header says."""

import csv
import re
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

from discrepancy.campaign.readers import ReadFault
from discrepancy.campaign.readers.csv import COMMENT, first_lines, opened, scan, sniff_delimiter
from discrepancy.campaign.readers.encodings import FOUND
from fmu_src.unit_words import unit_of

MOST_LINES = 400
# Of these lines above a table, which may hold figures too, its head is one.
MOST_ABOVE = 12
DELIMITERS = (";", "\t", "|", ",", " ")
FIGURE = re.compile(r"[+-]?(?:\d[\d.,'’\u00a0\u202f]*|[.,]\d+)(?:[eE][+-]?\d+)?$|[+-]?(?:nan|inf)$", re.IGNORECASE)


@dataclass(frozen=True)
class Layout:
    """``reading``: keys of a run that read the table; ``names`` as the reader calls its columns, ``headers`` as the file does."""

    reading: dict[str, Any]
    names: tuple[str, ...]
    headers: tuple[str, ...]
    units: tuple[str, ...]
    above: tuple[str, ...]


@dataclass(frozen=True)
class Cut:
    """The first lines cut at one delimiter: (number of the line, fields); where its figures begin."""

    delimiter: str
    rows: list[tuple[int, list[str]]]
    first: int
    score: tuple[float, ...]


def layout_of(path: Path) -> Layout:
    """ReadFault if there is no table of numbers."""
    encoding, comments = scan(path)
    with opened(path, encoding) as file:
        lines = [line.rstrip("\r\n") for line in islice(file, MOST_LINES)]
    commented = set(comments)
    cuts = [found for mark in DELIMITERS if (found := cut(lines, mark, commented))]
    if not cuts:
        raise ReadFault("no table of numbers in its first lines; name the table's columns in one line above it")
    best = max(cuts, key=lambda c: c.score)
    width = len(best.rows[best.first][1])
    reading: dict[str, Any] = {"encoding": encoding} if encoding not in FOUND else {}
    start, headers, units = head_of(best)
    names = headers
    if units:
        reading["units_line"] = True
    if not headers:
        # Programs that write "# angle te" above their numbers.
        said = next((line.lstrip(COMMENT + " ") for line in reversed(lines[:start]) if line.startswith(COMMENT)), "")
        headers = tuple(fields) if len(fields := parted(said, best.delimiter)) == width else tuple(str(k + 1) for k in range(width))
        reading["header"] = False
        names = tuple(str(k + 1) for k in range(width))
    if any(not line.startswith(COMMENT) and line.strip() for line in lines[:start]):
        reading["skip_lines"] = start
    if sniffed(path, encoding, int(start if "skip_lines" in reading else 0)) != best.delimiter:
        reading["delimiter"] = best.delimiter
    return Layout(reading, names, headers, (*units, *[""] * width)[:width], tuple(line for line in lines[:start] if line.strip()))


def head_of(best: Cut) -> tuple[int, tuple[str, ...], tuple[str, ...]]:
    """(number of the line where the table begins, its headers, its line of units), the last two empty where there are none."""
    width = len(best.rows[best.first][1])
    head = best.first - 1
    units: tuple[str, ...] = ()
    if head >= 1 and is_unit_line(best.rows[head][1]) and fits(best.rows[head - 1][1], width):
        units = tuple(best.rows[head][1])
        head -= 1
    if head >= 0 and fits(best.rows[head][1], width) and not any(FIGURE.match(field) for field in best.rows[head][1]):
        return best.rows[head][0], tuple(field.strip() for field in best.rows[head][1][:width]), units
    return best.rows[best.first][0], (), ()


def sniffed(path: Path, encoding: str, skip: int) -> str:
    return sniff_delimiter(first_lines(path, encoding, skip))


def parted(line: str, delimiter: str) -> list[str]:
    fields = line.split() if delimiter == " " else next(csv.reader([line], delimiter=delimiter, skipinitialspace=True), [])
    return [field.strip() for field in fields]


def cut(lines: Sequence[str], delimiter: str, comments: set[int]) -> Cut | None:
    """The first line from which on figures stand in fields of one number, and how much speaks for this delimiter."""
    rows = [(n, parted(line, delimiter)) for n, line in enumerate(lines) if n not in comments and line.strip()]
    shares = [share(fields) for _, fields in rows]
    for first, (_, fields) in enumerate(rows):
        followers = rows[first : first + 30]
        alike = sum(len(f) == len(fields) and shares[first + k] > 0.0 for k, (_, f) in enumerate(followers))
        if shares[first] >= 0.3 and alike >= 0.8 * len(followers) and not head_below(rows, shares, first):
            headed = first > 0 and fits(rows[first - 1][1], len(fields))
            average = sum(shares[first : first + 30]) / len(followers)
            return Cut(delimiter, rows, first, (headed or first == 0, round(average, 1), len(fields) > 1, len(followers), average))
    return None


def head_below(rows: Sequence[tuple[int, list[str]]], shares: Sequence[float], first: int) -> bool:
    """Whether what begins here are lines above a table (a date, a name and its value), whose head comes soon: words, and more figures below than here."""
    for head in range(first + 1, min(first + MOST_ABOVE, len(rows) - 1)):
        if shares[head] == 0.0 and fits(rows[head][1], len(rows[first][1])):
            below = shares[head + 1 : head + 30]
            return sum(below) / len(below) > sum(shares[first:head]) / (head - first)
    return False


def share(fields: Sequence[str]) -> float:
    """Of the fields that hold something, how many hold a figure."""
    filled = [field for field in fields if field]
    return sum(bool(FIGURE.match(field)) for field in filled) / len(filled) if filled else 0.0


def fits(fields: Sequence[str], width: int) -> bool:
    """As many fields, but for empty ones at the end."""
    return len(fields) >= width and not any(fields[width:]) and any(fields)


def is_unit_line(fields: Sequence[str]) -> bool:
    filled = [field for field in fields if field]
    return bool(filled) and sum(unit_of(field) is not None for field in filled) >= 0.5 * len(filled)
