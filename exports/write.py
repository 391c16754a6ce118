"""Tables into files; what kind is told by the file's ending."""

import re
from collections.abc import Callable, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from exports.decimal_digits import decimal
from exports.plain import plain
from exports.tables import Table
from fmu_src.checked_file import replacing
from fmu_src.faults import InputFault, MissingPart

# What Excel can hold.
MOST_ROWS, MOST_COLUMNS = 1_048_575, 16_384
# MATLAB's names are no longer than this.
LONGEST_NAME = 63


def require_writable(path: Path) -> None:
    """Before the work, so that none is lost: InputFault for an ending that is none, MissingPart for a library that is not there."""
    kind = path.suffix.lower()
    if kind not in KINDS:
        raise InputFault(f"--export {path}: the ending says what is written: {', '.join(KINDS)}")
    package = NEEDS.get(kind)
    if package and find_spec(package) is None:
        raise MissingPart(f"--export {path.name}", package, "measurements")


def write_tables(tables: Sequence[Table], path: Path) -> list[Path]:
    """The files that were written, each whole or not at all.

    MAT and Excel hold all tables; of CSV and Parquet each has a file of its own, the first under ``path``, the others as ``NAME_table.csv``.
    CSV is UTF-8, with a byte order mark where a sign is outside ASCII.
    A note is a comment line in CSV, a sheet in Excel, a field in MAT, an attribute of the frame in Parquet.
    Heads are ``torque [N.m]``; in MAT fields are ``torque`` and a structure ``units`` has the same fields.
    """
    require_writable(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    kept = [table for table in tables if table.columns]
    return KINDS[path.suffix.lower()](kept, path)


def beside(tables: Sequence[Table], path: Path) -> list[tuple[Table, Path]]:
    return [(table, path if number == 0 else path.with_name(f"{path.stem}_{table.name}{path.suffix}")) for number, table in enumerate(tables)]


def write_csv(tables: Sequence[Table], path: Path) -> list[Path]:
    for table, own in beside(tables, path):
        with replacing(own) as partial:
            # As many digits as a number has, without those that a conversion of units made.
            frame = table.frame()
            text = (f"# {table.note}\n" if table.note else "") + frame.assign(**{str(head): decimal(frame[head]) for head in frame}).to_csv(index=False)
            # Excel takes UTF-8 without a byte order mark for the machine's own code page; other programs need none where all is ASCII.
            partial.write_text(text, encoding="utf-8" if text.isascii() else "utf-8-sig", newline="")
    return [own for _, own in beside(tables, path)]


def write_parquet(tables: Sequence[Table], path: Path) -> list[Path]:
    for table, own in beside(tables, path):
        with replacing(own) as partial:
            table.frame().to_parquet(partial, index=False)
    return [own for _, own in beside(tables, path)]


def write_excel(tables: Sequence[Table], path: Path) -> list[Path]:
    from openpyxl import Workbook

    book = Workbook(write_only=True)
    for table in tables:
        rows = len(table.columns[0].values)
        if rows > MOST_ROWS or len(table.columns) > MOST_COLUMNS:
            raise InputFault(f"{path}: the table {table.name} has {rows} rows and {len(table.columns)} columns, more than Excel holds; export .parquet or .csv")
        sheet = book.create_sheet(table.name[:31])
        sheet.append([column.head for column in table.columns])
        for row in zip(*(plain(column.values) for column in table.columns)):
            sheet.append(row)
    if note := "; ".join(dict.fromkeys(table.note for table in tables if table.note)):
        book.create_sheet("note").append([note])
    with replacing(path) as partial:
        book.save(partial)
    return [path]


def write_mat(tables: Sequence[Table], path: Path) -> list[Path]:
    import scipy.io

    content = {}
    for table in tables:
        names = field_names([column.name for column in table.columns])
        columns: dict[str, Any] = {name: np.asarray(column.values) for name, column in zip(names, table.columns)}
        columns = {name: values.astype(object) if values.dtype.kind in "US" else values for name, values in columns.items()}
        columns["units"] = {name: column.unit or "1" for name, column in zip(names, table.columns)}
        if table.note:
            columns["note"] = table.note
        content[field_names([table.name])[0]] = columns
    with replacing(path) as partial:
        scipy.io.savemat(partial, content, appendmat=False, oned_as="column", long_field_names=True)
    return [path]


def field_names(names: Sequence[str]) -> list[str]:
    """As MATLAB takes them: letters, digits and underscores, a letter first, each once."""
    found: list[str] = []
    for name in names:
        plain = re.sub(r"\W+", "_", name, flags=re.ASCII).strip("_")
        plain = (plain if plain[:1].isalpha() else f"x{plain}")[:LONGEST_NAME]
        found.append(plain if plain not in found else f"{plain[: LONGEST_NAME - 6]}_{len(found) + 1}")
    return found


KINDS: dict[str, Callable[[Sequence[Table], Path], list[Path]]] = {
    ".csv": write_csv, ".parquet": write_parquet, ".mat": write_mat, ".xlsx": write_excel,
}  # fmt: skip
NEEDS = {".parquet": "pyarrow", ".xlsx": "openpyxl"}
