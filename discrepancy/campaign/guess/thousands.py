"""Text files in which 1,234 may be a thousand or a fraction: which sign is the decimal one."""

import csv
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import islice, zip_longest
from pathlib import Path
from typing import Any

from discrepancy.campaign.readers.csv import COMMENT, first_lines, opened, scan, sniff_decimal, sniff_delimiter
from discrepancy.campaign.readers.figures import OTHER, contradictions

# Rows that are looked at.
MOST_ROWS = 100_000


@dataclass(frozen=True)
class Signs:
    """``why`` is empty where every other reading contradicts a cell."""

    decimal: str
    why: str

    @property
    def thousands(self) -> str:
        return OTHER[self.decimal]


def signs_of(path: Path, keys: Mapping[str, Any]) -> Signs:
    """By the cells that can be no number otherwise, else by what the columns look like; ``keys`` of a run that read the file."""
    skip, encoding = int(keys.get("skip_lines", 0)), str(keys.get("encoding") or scan(path)[0])
    lines = first_lines(path, encoding, skip)
    delimiter = str(keys.get("delimiter") or sniff_delimiter(lines))
    usual = sniff_decimal(lines, delimiter)
    columns = columns_of(path, encoding, skip, delimiter)
    found = {d: (sum(len(contradictions(column, d)) for column in columns), sum(unlike(column, d) for column in columns)) for d in (usual, OTHER[usual])}
    best = min(found, key=lambda d: found[d])
    mine, other = found[best], found[OTHER[best]]
    if not mine[0] and other[0]:
        return Signs(best, "")
    return Signs(best, "nothing in the file tells which" if mine == other else "more of the file reads so")


def columns_of(path: Path, encoding: str, skip: int, delimiter: str) -> list[list[str]]:
    """Cells of each column that hold something."""
    with opened(path, encoding) as file:
        lines = (line for line in islice(file, skip, skip + MOST_ROWS) if not line.startswith(COMMENT))
        rows = (line.split() for line in lines) if delimiter == " " else csv.reader(lines, delimiter=delimiter, skipinitialspace=True)
        return [[cell.strip() for cell in column if cell.strip()] for column in zip_longest(*rows, fillvalue="")]


def unlike(column: Sequence[str], decimal: str) -> bool:
    """Whether a column looks otherwise than this sign says: whole numbers beside fractions of three digits, or nothing below a thousand."""
    fraction, group = (re.compile(rf"[+-]?\d+{re.escape(sign)}\d{{3}}$") for sign in (decimal, OTHER[decimal]))
    cells = [cell for cell in column if cell[-1].isdigit()]
    whole = any(cell.lstrip("+-").isdigit() for cell in cells)
    if whole:
        return any(fraction.match(cell) for cell in cells)
    return bool(cells) and all(group.match(cell) for cell in cells)
