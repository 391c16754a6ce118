"""Where the table begins in a workbook, and what its header says."""

from pathlib import Path
from statistics import median
from typing import Any

from discrepancy.campaign.guess.said import Doubt
from discrepancy.campaign.guess.text_layout import MOST_LINES, Cut, Layout, head_of, share
from discrepancy.campaign.readers import ReadFault, first_rows

# Share of figures that makes a row one of a table, and which part of the usual one is as much (assumed).
LEAST, ALMOST = 0.3, 0.9


def layout_of_sheet(path: Path) -> tuple[Layout, tuple[Doubt, ...]]:
    """Of the first sheet that holds something, and that others do too; ReadFault if there is no table of numbers."""
    sheet, sheets, rows = first_rows(path, MOST_LINES)
    width = max(map(len, rows))
    # Rows end with their last filled cell.
    padded = [(number, [*row, *[""] * (width - len(row))]) for number, row in enumerate(rows)]
    filled_rows = [row for row in padded if any(row[1])]
    first = first_of_figures(filled_rows)
    if first is None:
        raise ReadFault(f"sheet {sheet!r}: no table of numbers in its first rows; name the table's columns in one row above it")
    start, headers, units = head_of(Cut("", filled_rows, first, ()))
    reading: dict[str, Any] = {"skip_lines": start} if start else {}
    if units:
        reading["units_line"] = True
    if not headers:
        reading["header"] = False
        filled = [any(row[k] for _, row in padded[start:]) for k in range(width)]
        headers = tuple(str(k + 1) if has_any else "" for k, has_any in enumerate(filled))
    above = tuple(";".join(cell for cell in row if cell) for _, row in padded[:start] if any(row))
    if len(sheets) == 1:
        return Layout(reading, headers, headers, units or ("",) * width, above), ()
    others = ", ".join(map(repr, (name for name in sheets if name != sheet)))
    doubt = Doubt(path.name, f"the sheet {sheet!r} is taken, not {others}", "save each sheet as a file, or add runs with sheet = ... in campaign.toml")
    return Layout({"sheet": sheet, **reading}, headers, headers, units or ("",) * width, above), (doubt,)


def first_of_figures(rows: list[tuple[int, list[str]]]) -> int | None:
    """Where figures begin to stay; None if they nowhere do.

    Above a table stand lines like "Speed: | 15 | rpm", whose share of figures is less than that of most rows of the table.
    """
    shares = [share(fields) for _, fields in rows]
    later = shares[len(shares) // 2 :]
    usual = median(later) if later else 0.0
    if usual < LEAST:
        return None
    first = next(k for k, found in enumerate(shares) if found >= ALMOST * usual)
    # A row of the table with a dropout, whose header stands right above.
    while first > 1 and shares[first - 1] > 0.0 and rows[first - 1][0] == rows[first][0] - 1:
        first -= 1
    return first
