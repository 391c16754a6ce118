"""Excel workbooks (.xlsx, .xlsm), through openpyxl: what stands in the cells of one sheet.

Nothing is computed: of a formula the value counts that was saved with it.  Rows count from the sheet's first one.
"""

import datetime
import zipfile
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from openpyxl import load_workbook

from discrepancy.campaign.readers import MOST_UNPACKED, Options, ReadFault, missing_column
from discrepancy.campaign.readers.csv import DECIMAL_COMMA, GROUPED
from discrepancy.campaign.readers.figures import plain
from fmu_src.reading import MOST_MEMBERS

# What Excel itself can hold.
MOST_ROWS, MOST_COLUMNS = 1_048_576, 16_384
# Cells of one row, filled or not, and of a whole sheet that are kept (assumed: an hour of ten channels at 1 kHz).
MOST_CELLS = 40_000_000
# Rows in which a sheet that holds anything has something (assumed).
FIRST = 100
# Signature of the files of old Excel, and of workbooks behind a password.
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
Row = tuple[Any, ...]


def read(path: Path, names: set[str], options: Options) -> dict[str, np.ndarray]:
    with opened(path) as book:
        sheet = chosen_sheet(book, options.sheet)
        rows = rows_of(book, sheet)
        head = next(rows, ()) if not options.skip_lines else next(islice(rows, options.skip_lines, None), ())
        header = [text_of(cell) for cell in head]
        if not options.header:
            header, rows = [str(k + 1) for k in range(len(head))], (row for part in ([head], rows) for row in part)
        if options.units_line:
            next(rows, None)
        places = {name: place_of(name, header) for name in sorted(names)}
        kept = [tuple(row[k] if k < len(row) else None for k in places.values()) for row in rows if any(cell is not None for cell in row)]
    first = options.skip_lines + options.header + options.units_line
    columns = {name: [row[k] for row in kept] for k, name in enumerate(places)}
    require_saved_values(path, sheet, places, first, any(None in cells for cells in columns.values()))
    return {name: column_of(name, cells, options) for name, cells in columns.items()}


@contextmanager
def opened(path: Path) -> Iterator[Any]:
    """The workbook with the values that were saved with its formulas; ReadFault if it is none, or none that should be opened."""
    with closing(load(path, True)) as book:
        yield book


def load(path: Path, values: bool) -> Any:
    with path.open("rb") as file:
        if file.read(len(OLE)) == OLE:
            raise ReadFault("a workbook of old Excel (.xls), or one with a password; save it as .xlsx without a password")
    with zipfile.ZipFile(path) as archive:
        members = archive.infolist()
        # zipfile reads no more of a member than it is said to hold.
        if len(members) > MOST_MEMBERS or sum(member.file_size for member in members) > MOST_UNPACKED:
            raise ReadFault(f"unpacked it has more than {MOST_UNPACKED / 1e9:g} GB or {MOST_MEMBERS} parts; export less at a time")
    return load_workbook(path, read_only=True, data_only=values, keep_links=False)


def chosen_sheet(book: Any, stated: str | None) -> str:
    """The stated sheet, or the only one that has anything in it."""
    names = [sheet.title for sheet in book.worksheets]
    if stated is not None:
        if stated not in names:
            raise ReadFault(f"sheet = {stated!r}: the workbook has no such sheet; it has {', '.join(map(repr, names[:30]))}")
        return stated
    filled = filled_sheets(book)
    if len(filled) == 1:
        return filled[0]
    raise ReadFault(f"several sheets hold something; state sheet = one of {', '.join(map(repr, filled[:30]))}")


def filled_sheets(book: Any) -> list[str]:
    """Those that have anything in their first rows; ReadFault if there is none."""
    names = [sheet.title for sheet in book.worksheets]
    filled = [name for name in names if any(any(cell is not None for cell in row) for row in islice(rows_of(book, name), FIRST))]
    if not filled:
        raise ReadFault(f"no sheet has anything in its first {FIRST} rows; it needs a row of column names")
    return filled


def rows_of(book: Any, name: str) -> Iterator[Row]:
    sheet = book[name]
    # What a file says of its size need not be true.
    sheet.reset_dimensions()
    cells = 0
    for number, row in enumerate(sheet.iter_rows(values_only=True), 1):
        cells += len(row)
        if number > MOST_ROWS or len(row) > MOST_COLUMNS or cells > MOST_CELLS:
            limits = f"{MOST_ROWS} rows, {MOST_COLUMNS} columns or {MOST_CELLS / 1e6:g} million cells"
            raise ReadFault(f"sheet {name!r}: row {number} is beyond {limits}; export less at a time")
        yield row


def text_of(cell: object) -> str:
    return "" if cell is None else str(cell).strip()


def place_of(name: str, header: Sequence[str]) -> int:
    if name not in header:
        raise missing_column(name, [text for text in header if text])
    if header.count(name) > 1:
        raise ReadFault(f"column {name!r}: the sheet has {header.count(name)} columns of this name; rename one")
    return header.index(name)


def require_saved_values(path: Path, sheet: str, places: dict[str, int], first: int, has_empty: bool) -> None:
    """ReadFault for a formula whose value was not saved: some programs write none, and it would count as an empty cell."""
    if not has_empty:
        return
    with closing(load(path, False)) as book, opened(path) as saved:
        for number, (row, values) in enumerate(zip(rows_of(book, sheet), rows_of(saved, sheet)), 1):
            for name, place in places.items():
                if number > first and place < len(row) and row[place] is not None and (place >= len(values) or values[place] is None):
                    raise ReadFault(
                        f"sheet {sheet!r}, column {name!r}, row {number}: a formula without its value; open the file in Excel or LibreOffice and"
                        " save it, or paste the values"
                    )


def column_of(name: str, cells: Sequence[Any], options: Options) -> np.ndarray:
    """Numbers as floats; dates as such, durations and times of day in seconds; anything else as objects, texts with figures as numbers."""
    filled = [cell for cell in cells if cell is not None]
    if filled and all(isinstance(cell, datetime.datetime) for cell in filled):
        return np.array([np.datetime64("NaT") if cell is None else np.datetime64(cell, "us") for cell in cells], "datetime64[us]")
    plainly = [seconds(cell) for cell in cells]
    if all(cell is None or (isinstance(cell, (int, float)) and not isinstance(cell, bool)) for cell in plainly):
        return np.array([np.nan if cell is None else float(cell) for cell in plainly])
    # A number in a cell is one; how figures are written matters in texts alone.
    column = pd.Series(plainly, dtype=object, name=name)
    texts = column.map(lambda cell: isinstance(cell, str)).to_numpy(bool)
    written = column[texts]
    column[texts] = plain(written, options.decimal or decimal_of(written), options.thousands)
    return column.to_numpy()


def decimal_of(texts: pd.Series) -> str:
    """A comma where some text can mean nothing else: 1,234 may be a thousand."""
    return "," if any(DECIMAL_COMMA.match(text) and not GROUPED.match(text) for text in texts) else "."


def seconds(cell: Any) -> Any:
    if isinstance(cell, datetime.timedelta):
        return cell.total_seconds()
    if isinstance(cell, datetime.time):
        return 3600.0 * cell.hour + 60.0 * cell.minute + cell.second + 1e-6 * cell.microsecond
    return cell.isoformat() if isinstance(cell, datetime.date) else cell


def first_rows(path: Path, most: int) -> tuple[str, list[str], list[list[str]]]:
    """The first sheet that holds something, all that do, and the first rows of that one as texts."""
    with opened(path) as book:
        filled = filled_sheets(book)
        return filled[0], filled, [[text_of(seconds(cell)) for cell in row] for row in islice(rows_of(book, filled[0]), most)]
