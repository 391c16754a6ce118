"""Results as tables, pictures and files."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd
import xarray as xr

from exports.tables import Table, tables_of
from exports.write import write_tables
from fmu_src.faults import InputFault
from pages.paper import ENDINGS, drawn, width_of, write_pictures
from rvwear.measured import Shown

if TYPE_CHECKING:
    from pages.look import Figure

Result = xr.Dataset | Shown | pd.DataFrame


def tables(result: Result) -> list[Table]:
    if isinstance(result, Shown):
        from discrepancy.tables import tables_of as measured_tables

        return measured_tables(result._result)
    if isinstance(result, pd.DataFrame):
        from exports.tables import Column

        return [Table("table", tuple(Column(str(name), "", result[name].to_numpy()) for name in result.columns))]
    return tables_of(result)


def figures(result: Result) -> "list[Figure]":
    if isinstance(result, Shown):
        from discrepancy.page.write import page_of

        return page_of(result._result).figures
    if isinstance(result, pd.DataFrame):
        raise InputFault("a table of numbers has no picture of its own; export it, or draw it with pandas")
    from studies.report.page import figures_of
    from studies.report.turn import loop_figures, turn_figures

    if "hour" in result.dims:
        return figures_of(result)
    if "turning" in result:
        return loop_figures(result)
    if "crank_angle" in result.coords:
        return turn_figures(result)
    raise InputFault("this dataset has no picture of its own; solve, hysteresis, life, compare and diagnose make results that have")


def frames(result: Result) -> dict[str, pd.DataFrame]:
    """Every table of a result by name, heads with units: what ``export`` writes.

    >>> import rvwear
    >>> list(rvwear.frames(rvwear.hysteresis(steps=4, angles=1)))
    ['step', 'figures']
    """
    return {table.name: table.frame() for table in tables(result)}


def figure_names(result: Result) -> list[str]:
    """Names of the pictures of a result.

    >>> import rvwear
    >>> rvwear.figure_names(rvwear.solve(positions=8))
    ['turn_error', 'turn_force', 'turn_teeth', 'turn_pins']
    """
    return [one.name.strip("_") for one in figures(result)]


def figure(result: Result, name: str | None = None, *, width: str = "single", plotly: bool = False) -> Any:
    """A picture of a result: of matplotlib, ``width`` (``single`` 90 mm, ``middle`` 140, ``double`` 190, ``85mm``) wide, or of plotly.

    ``name``: one of ``figure_names``, by default the first.  MissingPart (an InputFault) without matplotlib.

    >>> import rvwear
    >>> picture = rvwear.figure(rvwear.hysteresis(steps=4, angles=1), width="85mm")
    >>> round(picture.get_figwidth() * 25.4)
    85
    """
    found = {one.name.strip("_"): one for one in figures(result)}
    if name is not None and name not in found:
        raise InputFault(f"figure {name!r}: this result has {', '.join(found)}")
    chosen = found[name] if name is not None else next(iter(found.values()))
    if plotly:
        import plotly.graph_objects as go

        return go.Figure({"data": chosen.data, "layout": chosen.layout})
    return drawn(chosen, width_of(width))


def export(result: Result, *files: str | Path, width: str = "single") -> list[Path]:
    """Write a result as tables (.csv, .parquet, .mat, .xlsx) or pictures (.svg, .pdf, .png), by the files' endings; the files written.

    CSV and Parquet take one table a file, pictures are one a file: further ones stand beside the first as ``NAME_table.csv``, ``NAME_figure.svg``.
    CSV is UTF-8, with a byte order mark where it has signs outside ASCII, for Excel.

    >>> import rvwear, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [path.name for path in rvwear.export(rvwear.hysteresis(steps=4, angles=1), f"{folder}/loop.csv")]
    ['loop.csv', 'loop_figures.csv']
    """
    written: list[Path] = []
    for file in map(Path, files):
        written += write_pictures(figures(result), file, width_of(width)) if file.suffix.lower() in ENDINGS else write_tables(tables(result), file)
    return written
