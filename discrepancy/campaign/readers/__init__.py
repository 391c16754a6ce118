"""Columns out of measurement files, one reader a format, each through the library made for it.

A reader is ``read(path, names, options) -> {name: array}``.  It gives what stands in the file:
no units, no selection.  Text columns come as objects, so that rows can be selected by them.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from fmu_src.faults import InputFault, MissingPart
from fmu_src.reading import reading, require_size, shown
from fmu_src.reading_apart import SECONDS_PER_BYTE as USUAL
from fmu_src.reading_apart import read_apart, restored

# Ending of the file's name -> reader's module.  The modules import their libraries themselves:
# a campaign of CSV files needs none of the others.
ENDINGS = {
    ".csv": "csv", ".txt": "csv", ".dat": "csv", ".tsv": "csv", ".parquet": "parquet", ".mat": "mat", ".mf4": "mdf",
    ".mdf": "mdf", ".tdms": "tdms", ".xlsx": "xlsx", ".xlsm": "xlsx",
}  # fmt: skip

# Formats whose libraries trust what they read.
APART = ("mat", "mdf", "parquet", "tdms", "xlsx")
# Seconds of a core for a byte (assumed: ten times what a million rows of a workbook took, 1.4e-6).
SECONDS_PER_BYTE = {"xlsx": 1.4e-5}
# Bytes of a file, and of what it is when it is unpacked (assumed: hours of many channels).
MOST, MOST_UNPACKED = 2_000_000_000, 2_000_000_000
# Signs of a list of names in a fault.
MOST_SHOWN = 1000


@dataclass(frozen=True)
class Options:
    """How a file is read; see docs/campaigns.md."""

    format: str | None = None
    delimiter: str | None = None
    decimal: str | None = None
    thousands: str | None = None
    encoding: str | None = None
    header: bool = True
    units_line: bool = False
    skip_lines: int = 0
    group: str | None = None
    sheet: str | None = None
    align: str | None = None


def kind_of(path: Path, stated: str | None = None) -> str | None:
    """The format that is stated, or that the ending tells."""
    endings = [s.lower() for s in path.suffixes if s.lower() != ".gz"]
    return stated or (ENDINGS.get(endings[-1]) if endings else None)


def contents(path: Path, kind: str) -> dict[str, str]:
    """Columns of a file of a binary format, with the units that it states ("" for none)."""
    found: dict[str, str] = asked_apart("contents_as", path, kind)
    return found


def first_rows(path: Path, most: int) -> tuple[str, tuple[str, ...], tuple[tuple[str, ...], ...]]:
    """Of a workbook: the first sheet that holds something, all that do, and the first rows of that one as texts."""
    sheet, sheets, rows = asked_apart("first_rows_as", path, "xlsx", most)
    return sheet, sheets, rows


def asked_apart(function: str, path: Path, kind: str, *arguments: object) -> Any:
    """What a function of this module finds in the process that reads binary formats."""
    require_size(path, MOST)
    with reading(path, kind, "check the file"):
        try:
            return apart(function, path, kind, *arguments)
        except ModuleNotFoundError as problem:
            raise MissingPart(f"{path.name}: reading {kind}", problem.name or kind, "measurements") from None


def apart(function: str, path: Path, kind: str, *arguments: object) -> Any:
    return read_apart(f"{__name__}:{function}", path, kind, *arguments, seconds_per_byte=SECONDS_PER_BYTE.get(kind, USUAL))


def first_rows_as(path: Path, kind: str, most: int) -> Any:
    """In the process that reads binary formats."""
    with reading(path, kind, "check the file"):
        return import_module(f"{__name__}.{kind}").first_rows(path, most)


def contents_as(path: Path, kind: str) -> dict[str, str]:
    """In the process that reads binary formats."""
    with reading(path, kind, "check the file"):
        found: dict[str, str] = import_module(f"{__name__}.{kind}").contents(path)
    return found


def read_columns(path: Path, names: set[str], options: Options, place: str) -> dict[str, np.ndarray]:
    """The named columns; ``place`` is the run, for the errors."""
    if not path.is_file():
        raise InputFault(f"{place}: file = {str(path)!r}: there is no such file; correct the name or add the file")
    kind = kind_of(path, options.format)
    if kind is None:
        raise InputFault(
            f"{place}: file = {path.name!r}: the ending does not tell the format; name it {', '.join(ENDINGS)},"
            ' or state format = "csv" | "parquet" | "mat" | "mdf" | "tdms" | "xlsx"'
        )
    columns = read_by(path, names, options, kind, place)
    lengths = {name: len(column) for name, column in columns.items()}
    if len(set(lengths.values())) > 1:
        raise InputFault(
            f"{place}: {path}: columns of different length ({', '.join(f'{k}: {n}' for k, n in lengths.items())});"
            " take columns that were sampled together, or export them so"
        )
    return columns


def read_by(path: Path, names: set[str], options: Options, kind: str, place: str) -> dict[str, np.ndarray]:
    """What the format's reader finds, its faults with the place of the run."""
    try:
        with reading(path, kind, "check the file, or state its format"):
            require_size(path, MOST)
            arguments = (path, kind, sorted(names), vars(options))
            columns: dict[str, np.ndarray] = restored(apart("read_as", *arguments)) if kind in APART else read_as(*arguments)
    except ModuleNotFoundError as problem:
        raise MissingPart(f"{place}: file = {path.name!r}: reading {kind}", problem.name or kind, "measurements") from None
    except InputFault as fault:
        raise InputFault(f"{place}: {fault}") from None
    return columns


def read_as(path: Path, kind: str, names: Sequence[str], options: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """In this process, or in that which reads binary formats."""
    with reading(path, kind, "check the file, or state its format"):
        columns: dict[str, np.ndarray] = import_module(f"{__name__}.{kind}").read(path, set(names), Options(**options))
    return columns


class ReadFault(InputFault):
    """What is wrong with a file and how to mend it; the place is added by the caller."""


def missing_column(name: str, available: Iterable[object]) -> ReadFault:
    """No such column, with what there is."""
    names = [shown(str(n)) for n in available]
    some = ", ".join(names[:30]) + (f", ... ({len(names)} in all)" if len(names) > 30 else "")
    return ReadFault(f"column {name!r}: the file has no such column; it has {some[:MOST_SHOWN]}")


def aligned(signals: Mapping[str, tuple[np.ndarray, np.ndarray | None]], align: str | None) -> dict[str, np.ndarray]:
    """Signals (values, own time or None) on one time base.

    Loggers sample channels at different rates.  Nothing is interpolated unless the run says
    onto which channel's times.
    """
    times = {name: time for name, (_, time) in signals.items() if time is not None}
    if align is None:
        first = next(iter(times.values()), np.zeros(0))
        apart = [n for n, t in times.items() if len(t) != len(first) or not np.array_equal(t, first)]
        if apart:
            raise ReadFault(
                f"columns {', '.join(signals)} were not sampled at the same times ({apart[0]} differs from"
                f" {next(iter(times))}); state align = \"{next(iter(times))}\" to interpolate the others linearly onto"
                " its times"
            )
        return {name: values for name, (values, _) in signals.items()}
    if align not in times:
        raise ReadFault(
            f"align = {align!r}: not a column of this run with its own times; choose from {', '.join(times)}"
        )
    base = times[align]
    lowest, highest = max(t[0] for t in times.values()), min(t[-1] for t in times.values())
    base = base[(base >= lowest) & (base <= highest)]
    return {name: values if time is None else np.interp(base, time, values) for name, (values, time) in signals.items()}
