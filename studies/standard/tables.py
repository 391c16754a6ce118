"""A standard test as tables for other programs: figures with their definitions, and the curves that they were read from."""

from collections.abc import Mapping, Sequence

import numpy as np

from exports.tables import Column, Table, rows_table
from fmu_src.units import conversion
from studies.standard.evaluation import UNITS, Curve, Figure

# As a bench writes them.
SHOWN = {"rad": "deg", "rad/s": "rpm"}


def bench_tables(found: Mapping[str, Sequence[Figure]], curves: Mapping[str, Mapping[str, Curve]]) -> list[Table]:
    """``found``: figures by condition; ``curves`` by condition and position, in the units of ``UNITS``."""
    rows = [
        {"condition": condition, "figure": figure.name, "value": figure.value, "least": figure.spread[0] if figure.spread else figure.value,
         "most": figure.spread[1] if figure.spread else figure.value, "unit": figure.unit, "definition": figure.definition}
        for condition, figures in found.items() for figure in figures
    ]  # fmt: skip
    return [rows_table("figures", rows, {}), curve_table(curves)]


def curve_table(grouped: Mapping[str, Mapping[str, Curve]]) -> Table:
    """A row a sample; ``rvwear bench --measured`` reads it back as it is."""
    curves = {(condition, position): curve for condition, group in grouped.items() for position, curve in group.items()}
    names = [name for name in dict.fromkeys(name for curve in curves.values() for name in curve) if all(name in curve for curve in curves.values())]
    lengths = [len(next(iter(curve.values()))) for curve in curves.values()]
    told = zip(("condition", "position"), zip(*curves))
    columns = [Column(name, "", np.repeat(texts, lengths)) for name, texts in told if any(texts)]
    for name in names:
        unit = UNITS.get(name, "rad")
        shown = SHOWN.get(unit, unit)
        factor = conversion(unit, shown)[0]
        columns.append(Column(name, shown, np.concatenate([factor * np.asarray(curve[name], float) for curve in curves.values()])))
    return Table("curves", tuple(columns))
