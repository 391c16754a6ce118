"""A file's columns, with what the file says of them."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from discrepancy.campaign.guess.said import Doubt
from discrepancy.campaign.guess.sheet_layout import layout_of_sheet
from discrepancy.campaign.guess.text_layout import layout_of
from discrepancy.campaign.guess.thousands import Signs, signs_of
from discrepancy.campaign.readers import ENDINGS, Options, ReadFault, contents, kind_of, read_columns
from fmu_src.arrays import Floats
from fmu_src.faults import InputFault, nearest_path
from fmu_src.reading import reading

# A column is one of numbers if so many of its filled cells are (assumed: the others are dropouts).
NUMBERS = 0.5
# Sheets of other programs, and of old Excel.
SHEETS = (".xls", ".xlsb", ".ods")
# A column of so many different words tells rows apart.
MOST_WORDS = 20


@dataclass(frozen=True)
class Table:
    """``columns``: numbers (n,) in the file's own units, NaN where there is none, by the reader's names; ``headers`` as the file calls them.

    ``units``: what the file states outside the headers; ``reading``: keys of a run that read the file; ``above``: lines above the table.
    """

    path: Path
    columns: Mapping[str, Floats]
    headers: Mapping[str, str]
    units: Mapping[str, str]
    reading: Mapping[str, Any]
    above: tuple[str, ...] = ()
    doubts: tuple[Doubt, ...] = ()


def table_of(path: Path) -> Table:
    """InputFault with the file's name if it cannot be read."""
    if not path.is_file():
        raise InputFault(f"{path}: there is no such file{nearest_path(path) or '; correct the name'}")
    kind = kind_of(path)
    if path.suffix.lower() in SHEETS:
        raise InputFault(f"{path}: such sheets are not read; save it as .xlsx (or the sheet as CSV) and name that file")
    if kind is None:
        raise InputFault(f"{path}: the ending does not tell the format; name it {', '.join(ENDINGS)}")
    if kind not in ("csv", "xlsx"):
        units = contents(path, kind)
        raw = together(path, {name: name for name in units}, {})
        return Table(path, numeric(raw)[0], {name: name for name in units}, units, {})
    doubts: list[Doubt] = []
    with reading(path, "a table", "name the table's columns in one line above it"):
        if kind == "csv":
            layout = layout_of(path)
        else:
            layout, others = layout_of_sheet(path)
            doubts += others
    keys = dict(layout.reading)
    once = {name: header for name, header in zip(layout.names, layout.headers) if name and layout.names.count(name) == 1}
    raw = {}
    try:
        raw = together(path, once, keys)
    except InputFault as fault:
        if "may be a thousand" not in str(fault):
            raise
        signs = signs_of(path, keys) if kind == "csv" else Signs(".", "nothing tells")
        # Each column of a workbook has its own decimal sign.
        keys |= {"thousands": signs.thousands} | ({"decimal": signs.decimal} if kind == "csv" else {})
        raw = together(path, once, keys)
        if signs.why:
            text = f"numbers such as 1{signs.thousands}234 are taken for thousands, {signs.decimal!r} for the decimal sign: {signs.why}"
            remedy = f'look at the ranges; if they are fractions: decimal = "{signs.thousands}" in campaign.toml, without thousands'
            doubts.append(Doubt(path.name, text, remedy))
    columns, words = numeric(raw)
    for name, said in worded(raw, columns).items():
        text = f"column {once[name]!r} holds words ({', '.join(said)}): rows of several runs may stand in this file"
        doubts.append(Doubt(path.name, text, f'state where = {{ "{name}" = "{said[0]}" }} in campaign.toml, once for each run'))
    if words:
        keys["missing"] = sorted(words)
        text = f"cells with {', '.join(sorted(words))} count as nothing measured"
        doubts.append(Doubt(path.name, text, "correct missing in campaign.toml if they are something"))
    units = {name: unit for name, unit in zip(layout.names, layout.units) if name in once}
    return Table(path, columns, once, units, keys, layout.above, tuple(doubts))


def together(path: Path, names: Mapping[str, str], keys: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """All columns; those that can only be read alone (channels of other rates) one by one."""
    options = Options(**{name: value for name, value in keys.items() if name in Options.__dataclass_fields__})
    try:
        return read_columns(path, set(names), options, path.name)
    except ReadFault:
        raise
    except InputFault as fault:
        if "not sampled at the same times" not in str(fault) and "different length" not in str(fault):
            raise
    return {name: read_columns(path, {name}, options, path.name)[name] for name in names}


def worded(raw: Mapping[str, np.ndarray], columns: Mapping[str, Floats]) -> dict[str, list[str]]:
    """Columns of few words that come again, with these words: they tell rows apart."""
    found = {}
    for name in raw.keys() - columns.keys():
        said = sorted({str(cell).strip() for cell in raw[name] if isinstance(cell, str) and cell.strip()})
        if 2 <= len(said) <= MOST_WORDS and 2 * len(said) <= len(raw[name]):
            found[name] = said
    return found


def numeric(raw: Mapping[str, np.ndarray]) -> tuple[dict[str, Floats], set[str]]:
    """Columns of numbers, and the words that stand in them."""
    found: dict[str, Floats] = {}
    words: set[str] = set()
    for name, column in raw.items():
        if np.issubdtype(column.dtype, np.datetime64):
            missing = np.isnat(column)
            column = column.astype("datetime64[ns]").astype(np.int64).astype(float)
            column[missing] = np.nan
        if column.dtype.kind in "iufb":
            found[name] = column.astype(float)
            continue
        if column.dtype.kind == "c":
            continue
        texts = pd.Series(column, dtype=object)
        values = pd.to_numeric(texts, errors="coerce")
        filled = texts.notna() & (texts.astype(str).str.strip() != "")
        if filled.any() and values.notna().sum() >= NUMBERS * filled.sum():
            found[name] = values.to_numpy(float)
            words |= set(texts[filled & values.isna()].astype(str).str.strip())
    return found, words
