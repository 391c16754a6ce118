"""Numbers as benches write them, in columns that pandas left as texts: one cell is a word, or thousands are set apart."""

import re
from collections.abc import Iterable

import pandas as pd

from discrepancy.campaign.readers import ReadFault

# Signs that set thousands apart where the decimal sign is the other one; blanks and apostrophes do anywhere.
OTHER = {",": ".", ".": ","}
BLANKS = " \u00a0\u202f'\u2019"
# A number with one sign in it, whatever that means.
SIGNED = re.compile(r"\s*[+-]?(\d*)([.,])(\d+)(?:[eE][+-]?\d+)?\s*$")


def contradictions(texts: Iterable[str], decimal: str) -> list[str]:
    """Cells that are numbers and cannot be with this decimal sign: the other one sets groups of three apart, of which the first is no 0."""
    found = []
    for text in texts:
        match = SIGNED.match(text)
        if match and match[2] != decimal and not (1 <= len(match[1]) <= 3 and match[1][0] != "0" and len(match[3]) == 3 and "e" not in text.lower()):
            found.append(text)
    return found


def plain(column: pd.Series, decimal: str, thousands: str | None) -> pd.Series:
    """The column with its numbers as Python writes them; words stay as they are.

    ``thousands``: the sign that sets them apart, if stated.  Else a point or comma counts as such where some cell of the column has a
    decimal sign or two groups besides.  ReadFault otherwise: 1.815 alone may be a fraction.
    """
    if pd.api.types.is_numeric_dtype(column):
        return column
    texts = column.where(column.isna(), column.astype(str).str.strip())
    dot, group = re.escape(decimal), re.escape(thousands) if thousands else f"[{re.escape(OTHER[decimal])}{BLANKS}]"
    exponent = r"(?:[eE][+-]?\d+)?"
    ungrouped = re.compile(rf"[+-]?(?:\d+{dot}?\d*|{dot}\d+){exponent}")
    grouped = re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:{group}\d{{3}})+(?:{dot}\d*)?")
    certain = re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:{group}\d{{3}}){{2,}}|.*\d{dot}\d.*|.*[{BLANKS}].*")
    in_groups = texts.str.fullmatch(grouped).fillna(False).astype(bool)
    if in_groups.any():
        if not thousands and not texts.str.fullmatch(certain).fillna(False).any():
            row = int(in_groups.to_numpy().argmax())
            sign = OTHER[decimal]
            raise ReadFault(
                f"column {column.name!r}, row {row + 1}: {column.iloc[row]!r} may be a thousand or a fraction; state thousands ="
                f' "{sign}" if it is a thousand, decimal = "{sign}" if all of the file is so, or export all columns alike'
            )
        texts = texts.where(~in_groups, texts.str.replace(re.compile(group), "", regex=True))
    figures = texts.str.fullmatch(ungrouped).fillna(False).astype(bool)
    return texts.where(~figures, texts.str.replace(decimal, ".", regex=False))
