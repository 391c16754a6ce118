"""What an ensemble says, as tables for other programs."""

from typing import Any

from exports.tables import Column, Table, rows_table
from studies.figure_units import figure_unit


def tables_of(found: dict[str, Any]) -> list[Table]:
    """Distributions with their 95 % intervals, hours of life, and which parameter makes which share of the variance."""
    distributions = [
        {"figure": name, "statistic": statistic, "unit": figure_unit(name)} | numbers(value)
        for name, values in found.get("distributions", {}).items() for statistic, value in values.items()
    ]  # fmt: skip
    distributions += [{"figure": "life", "statistic": statistic, "unit": "h"} | numbers(value) for statistic, value in found.get("life_hours", {}).items()]
    shares = [
        {"figure": name, "parameter": parameter, "alone": row["alone"], "with_interactions": row["total"]}
        for name, rows in found.get("sensitivity", {}).items() for parameter, row in rows.items()
    ]  # fmt: skip
    return [rows_table("distributions", distributions, {}), rows_table("sensitivity", shares, {}), *([bands_table(found["bands"])] if "bands" in found else [])]


def bands_table(bands: dict[str, Any]) -> Table:
    """Quantiles of each figure over the hours."""
    columns = [
        Column(f"{pane['name'].rpartition('_')[0]}_q{round(100 * share):02d}", pane["unit"], row)
        for pane in bands["panes"] for share, row in zip(bands["shares"], pane["quantiles"])
    ]  # fmt: skip
    return Table("bands", (Column("hours", "h", bands["hours"]), *columns) if columns else ())


def numbers(value: dict[str, float | None]) -> dict[str, float]:
    """A life that lasts beyond the hours has no number."""
    return {key: float("nan") if value[key] is None else float(value[key] or 0.0) for key in ("value", "low", "high")}
