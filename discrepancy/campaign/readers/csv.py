"""Delimited text, plain or gzipped; delimiter and decimal sign are found if they are not stated."""

import csv
import gzip
import re
import warnings
from itertools import islice
from pathlib import Path
from typing import TextIO

import numpy as np
import pandas as pd

from discrepancy.campaign.readers import MOST_UNPACKED, Options, ReadFault, missing_column
from discrepancy.campaign.readers.encodings import encodings_of
from discrepancy.campaign.readers.figures import contradictions, plain

# In this order: a comma may be the decimal sign, so it is tried last.
DELIMITERS = (";", "\t", "|", ",")
DECIMAL_COMMA = re.compile(r"\s*[+-]?\d+,\d+(?:[eE][+-]?\d+)?\s*$")
GROUPED = re.compile(r"\s*[+-]?[1-9]\d{0,2},\d{3}\s*$")
SNIFFED_LINES = 30
COMMENT = "#"
# Bytes that tell the encoding: the header is among them.
SEEN = 1 << 16


def read(path: Path, names: set[str], options: Options) -> dict[str, np.ndarray]:
    encoding, comments = scan(path, options.encoding)
    lines = first_lines(path, encoding, options.skip_lines)
    if not lines:
        raise ReadFault("the file is empty; it needs a line of column names")
    delimiter = options.delimiter or sniff_delimiter(lines)
    decimal = options.decimal or sniff_decimal(lines, delimiter)
    skipped = sorted({*range(options.skip_lines), *comments})
    with warnings.catch_warnings():
        # pandas would cut off fields beyond the header's with a mere warning: half of every "1,5" for instance.
        warnings.simplefilter("error", pd.errors.ParserWarning)
        try:
            frame = pd.read_csv(
                path, sep=r"\s+" if delimiter == " " else delimiter, decimal=decimal,
                header=0 if options.header else None, skiprows=skipped, encoding=encoding,
                skipinitialspace=True, compression="gzip" if path.suffix.lower() == ".gz" else None, low_memory=False,
                index_col=False,
            )  # fmt: skip
        except (pd.errors.ParserError, pd.errors.ParserWarning) as problem:
            raise ReadFault(
                f"rows and header differ in their number of fields, read with delimiter {delimiter!r} and decimal"
                f" {decimal!r} ({str(problem).strip()}); state delimiter and decimal, or skip_lines"
            ) from None
    # Without a header the columns are called 1, 2, 3 ...
    frame.columns = [str(c).strip() for c in frame.columns] if options.header else [str(k + 1) for k in range(len(frame.columns))]
    if options.units_line:
        frame = frame.iloc[1:]
    names_in_file = [field.strip() for field in next(csv.reader(lines, delimiter=delimiter))] if options.header else []
    columns = {}
    for name in sorted(names):
        if name not in frame.columns:
            raise missing_column(name, frame.columns)
        if names_in_file.count(name) > 1:
            raise ReadFault(f"column {name!r}: the file has {names_in_file.count(name)} columns of this name; rename one")
        columns[name] = plain(frame[name], decimal, options.thousands).to_numpy()
    return columns


def scan(path: Path, stated: str | None = None) -> tuple[str, list[int]]:
    """Encoding, and the numbers of the comment lines; pandas' own comments would also cut a column name like "sensor #1"."""
    if path.suffix.lower() == ".gz":
        require_unpacked_size(path)
    with (gzip.open if path.suffix.lower() == ".gz" else open)(path, "rb") as file:
        beginning = file.read(SEEN)
    for encoding in (stated,) if stated else encodings_of(beginning):
        try:
            with opened(path, encoding) as file:
                # Blocks first: a file of a million lines has no comment, mostly.
                found = any(COMMENT in block for block in iter(lambda: file.read(SEEN), ""))
            if not found:
                return encoding, []
            with opened(path, encoding) as file:
                return encoding, [number for number, line in enumerate(file) if line.startswith(COMMENT)]
        except UnicodeDecodeError:
            continue
        except LookupError:
            raise ReadFault(f"encoding = {stated!r} is not known; state one like \"utf-8\", \"cp1252\", \"gb18030\"") from None
    if stated:
        raise ReadFault(f"not a text in {stated}; correct encoding, or leave it out")
    raise ReadFault("not a text in UTF-8, UTF-16 or Windows-1252; export it as UTF-8, state its encoding, or its format")


def require_unpacked_size(path: Path) -> None:
    size = 0
    with gzip.open(path, "rb") as file:
        while block := file.read(1 << 20):
            size += len(block)
            if size > MOST_UNPACKED:
                raise ReadFault(f"unpacked it has more than {MOST_UNPACKED / 1e9:g} GB; export less at a time")


def opened(path: Path, encoding: str) -> TextIO:
    if path.suffix.lower() == ".gz":
        return gzip.open(path, "rt", encoding=encoding)
    return open(path, encoding=encoding)


def first_lines(path: Path, encoding: str, skip: int) -> list[str]:
    with opened(path, encoding) as file:
        lines = (line.rstrip("\n") for line in islice(file, skip, None))
        return list(islice((line for line in lines if line.strip() and not line.startswith(COMMENT)), SNIFFED_LINES))


def sniff_delimiter(lines: list[str]) -> str:
    """The first that cuts all lines into the same number of fields, at least two."""
    for delimiter in DELIMITERS:
        counts = {len(fields) for fields in csv.reader(lines, delimiter=delimiter)}
        if len(counts) == 1 and counts.pop() > 1:
            return delimiter
    if len(lines) > 1 and all(DECIMAL_COMMA.match(line) for line in lines[1:]):
        # A single column; any delimiter but the comma.
        return ";"
    # Blanks, or a single column; a lone header does not tell, its names may hold blanks.
    blanks = len(lines) > 1 and {len(line.split()) for line in lines} == {len(lines[-1].split())}
    return " " if blanks and len(lines[-1].split()) > 1 else ","


def sniff_decimal(lines: list[str], delimiter: str) -> str:
    """A comma where some field has one, unless another field can be no number then and all can with a point: 0.346 beside 4,282."""
    fields = [field for row in csv.reader(lines, delimiter=delimiter) for field in row]
    found = [field for field in fields if DECIMAL_COMMA.match(field)]
    # Between commas only quoted fields have one; and 1,234 may be a thousand.
    if not any(delimiter != "," or not GROUPED.match(field) for field in found):
        return "."
    return "." if contradictions(fields, ",") and not contradictions(fields, ".") else ","
